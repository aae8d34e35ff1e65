//! From the files and folders that a grader names to one submission a student.

pub mod class;
pub mod contents;
mod folder;
mod looks;
mod names;

use std::collections::{BTreeMap, HashMap};
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use class::StudentsIn;
use contents::{Contents, contents, is_named_twice};
use folder::Found;
use grading::picture::kinds::{self, Kind};
use grading::picture::reading::MOST_BYTES;
use grading::submission::Submission;
use grading::text::printable;
use looks::Looks;
use names::is_litter;

use crate::written::is_own;

/// Why a file or folder that this program wrote is left out.
const WRITTEN: &str = "grades that this program wrote are no submissions";

/// A submission, and what there is to say about its files.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct HandedIn {
    /// The submission.
    pub submission: Submission,
    /// Why it cannot be graded at all.
    pub problem: Option<String>,
    /// Whether that is no fault of the student's, and may be over soon.
    pub try_again: bool,
    /// What was left out.
    pub notes: Vec<String>,
    /// Which others have the same files.
    pub twins: Vec<String>,
}

/// What a folder is taken for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Folders {
    /// For what it can only be.
    #[default]
    Clear,
    /// For a class: each folder and file in it is a submission.
    Class,
    /// For one submission.
    Submission,
}

/// What a grader named.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Collected {
    /// The submissions, in the order of the paths.
    pub handed_in: Vec<HandedIn>,
    /// The folders that could be a class or one submission, and why.
    pub ambiguous: Vec<String>,
    /// What this program wrote, which is no submission.
    pub own: Vec<PathBuf>,
    /// The folders of the classes.
    pub classes: Vec<PathBuf>,
    /// What in a class is no submission.
    pub notes: Vec<String>,
}

/// The submissions named by `paths`: a file is one, a list and a picture that differ in the
/// extension alone are one, and a folder is one or a class, as `folders` says.
pub fn collect(paths: &[PathBuf], folders: Folders) -> Collected {
    let mut collected = Collected::default();
    let mut all = Vec::new();
    // A pattern for all files of a folder names these, too.
    let is_left_out = |path: &&PathBuf| paths.len() > 1 && (is_litter(path) || is_own(path));
    let (left_out, paths): (Vec<&PathBuf>, Vec<&PathBuf>) = paths.iter().partition(is_left_out);
    collected.own = left_out.into_iter().filter(|path| is_own(path)).cloned().collect();
    let note = |path: &PathBuf| format!("{}: left out: {WRITTEN}", path.display());
    collected.notes.extend(collected.own.iter().map(note));
    let mut looks = Looks::default();
    let class_in = |path: &&PathBuf| match folders {
        Folders::Class if path.is_dir() => Ok(Some(class::unwrapped(path, &mut looks))),
        Folders::Clear if path.is_dir() => class::class_in(path, &mut looks),
        _ => Ok(None),
    };
    let classes: Vec<Result<Option<StudentsIn>, String>> = paths.iter().map(class_in).collect();
    let are_all = classes.iter().all(|class| matches!(class, Ok(Some(_))));
    let mut is_class_itself = Vec::new();
    let mut found = BTreeMap::new();
    for (path, class) in paths.into_iter().zip(classes) {
        match class {
            // A student who hands in folders with others' names is no class.
            Ok(Some(class)) if folders == Folders::Clear && !are_all => {
                collected.ambiguous.push(class::both_readings(&class.folder, &mut looks));
            }
            Ok(Some(class)) => {
                let (students, mut notes) = class::students(&class.folder, &mut looks);
                all.extend(students.into_iter().map(|student| (student, true)));
                collected.notes.append(&mut notes);
                collected.classes.push(class.folder);
                is_class_itself.extend(class.classes);
                found.extend(class.found);
            }
            Ok(None) => all.push((path.clone(), false)),
            Err(why) => collected.ambiguous.push(why),
        }
    }
    let from = |(path, is_of_class): &(PathBuf, bool)| {
        from(path, *is_of_class, found.remove(path), &looks)
    };
    let mut handed_in: Vec<HandedIn> = all.iter().map(from).collect();
    let paths: Vec<PathBuf> = all.into_iter().map(|(path, _)| path).collect();
    for (one, path) in handed_in.iter_mut().zip(&paths) {
        // It costs the others nothing, and gets a grade that says so.
        if is_class_itself.contains(path) {
            let why = class::both_readings(path, &mut Looks::default());
            one.problem = Some(why.clone());
            collected.ambiguous.push(why);
        }
    }
    join_stems(&mut handed_in, &paths);
    let mut seen: HashMap<String, usize> = HashMap::new();
    for one in &mut handed_in {
        let times = seen.entry(one.submission.name.clone()).or_default();
        *times += 1;
        if *times > 1 {
            one.submission.name += &format!(" ({times})");
        }
    }
    tell_twins(&mut handed_in);
    Collected { handed_in, ..collected }
}

/// The submission at `path`, in which this has been `found` if it is a folder that was searched.
fn from(path: &Path, is_of_class: bool, found: Option<Found>, looks: &Looks) -> HandedIn {
    let handed_in = if is_of_class && path.is_symlink() {
        // It may lead to another student's files, or anywhere.
        HandedIn {
            problem: Some("it is a link, which is not followed".to_owned()),
            ..HandedIn::default()
        }
    } else if path.is_dir() {
        match found.map_or_else(|| Found::search(path, looks), Ok) {
            Ok(found) => from_folder(path, found),
            Err(error) => unread(&error),
        }
    } else {
        from_file(path)
    };
    HandedIn { submission: Submission { name: name(path), ..handed_in.submission }, ..handed_in }
}

fn unread(error: &io::Error) -> HandedIn {
    HandedIn {
        problem: Some(format!("it could not be read: {error}: try again")),
        try_again: true,
        ..HandedIn::default()
    }
}

fn from_file(path: &Path) -> HandedIn {
    let mut handed_in = HandedIn::default();
    match fs::metadata(path) {
        Err(error) if path.is_symlink() => {
            handed_in.problem = Some(format!("it is a link that leads nowhere: {error}"));
        }
        Err(error) => return unread(&error),
        Ok(about) if !about.is_file() => {
            handed_in.problem = Some("it is neither a file nor a folder".to_owned());
        }
        Ok(_) => match kinds::start(path) {
            Err(error) => return unread(&error),
            Ok(start) => match kinds::kind(&start, path) {
                Some(Kind::Packed(kind)) => {
                    handed_in.problem = Some(format!("it is packed ({kind}): unpack it first"));
                }
                Some(Kind::Picture(_) | Kind::Document(_)) => {
                    handed_in.submission.picture = Some(path.to_owned());
                }
                None => handed_in.submission.list = Some(path.to_owned()),
            },
        },
    }
    handed_in
}

fn from_folder(folder: &Path, found: Found) -> HandedIn {
    let is_partial = found.is_partial;
    let (choice, notes) = found.choose(folder);
    let mut handed_in = HandedIn { notes, ..HandedIn::default() };
    match choice {
        Ok((None, None)) => {
            let mut problem = "it has neither a photon list nor a picture in it".to_owned();
            handed_in.notes.iter().for_each(|note| problem += &format!("; {note}"));
            if is_partial {
                problem += ": try again";
            }
            handed_in.problem = Some(problem);
            handed_in.try_again = is_partial;
        }
        Ok((list, picture)) => {
            handed_in.submission = Submission { list, picture, ..Submission::default() };
        }
        Err(problem) => handed_in.problem = Some(problem),
    }
    handed_in
}

/// Notes submissions whose pictures are the same, byte by byte; for lists see [`crate::twins`].
fn tell_twins(all: &mut [HandedIn]) {
    let files: Vec<Option<PathBuf>> =
        all.iter().map(|one| one.submission.picture.clone()).collect();
    let mut of_contents: HashMap<Contents, Vec<usize>> = HashMap::new();
    for (at, contents) in contents(&files, MOST_BYTES).into_iter().enumerate() {
        if let Some(contents) = contents {
            of_contents.entry(contents).or_default().push(at);
        }
    }
    for twins in of_contents.values() {
        for at in twins {
            let file = |at: usize| files[at].as_deref().expect("it has contents");
            let is_other =
                |other: &&usize| *other != at && !is_named_twice(file(**other), file(*at));
            let names = twins.iter().filter(is_other).take(5);
            let names: Vec<_> = names.map(|other| all[*other].submission.name.clone()).collect();
            if !names.is_empty() {
                all[*at].twins.push(format!(
                    "the picture is the same, byte by byte, as that of {}; two correct \
                     programs with the same random numbers may produce the same",
                    names.join(", ")
                ));
            }
        }
    }
}

fn name(path: &Path) -> String {
    let name = path.display().to_string();
    let trimmed = name.trim_end_matches('/');
    printable(if trimmed.is_empty() { &name } else { trimmed })
}

/// Joins `alice.csv` and `alice.png`, where there is just one list and one picture of the stem.
fn join_stems(all: &mut Vec<HandedIn>, paths: &[PathBuf]) {
    let mut of_stem: HashMap<PathBuf, (Vec<usize>, Vec<usize>)> = HashMap::new();
    for (at, path) in paths.iter().enumerate().filter(|(_, path)| !path.is_dir()) {
        let (lists, pictures) = of_stem.entry(path.with_extension("")).or_default();
        match &all[at].submission {
            Submission { list: Some(_), .. } => lists.push(at),
            Submission { picture: Some(_), .. } => pictures.push(at),
            _ => {}
        }
    }
    let mut joined = Vec::new();
    for (stem, places) in of_stem {
        if let ([list], [picture]) = (places.0.as_slice(), places.1.as_slice()) {
            let (first, second) = (*list.min(picture), *list.max(picture));
            let later = all[second].submission.clone();
            let submission = &mut all[first].submission;
            submission.list = submission.list.take().or(later.list);
            submission.picture = submission.picture.take().or(later.picture);
            submission.name = name(&stem);
            joined.push(second);
        }
    }
    let mut at = 0;
    all.retain(|_| {
        at += 1;
        !joined.contains(&(at - 1))
    });
}
