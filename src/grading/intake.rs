//! From the files and folders that a grader names to one submission a student.

use std::collections::HashMap;
use std::fs::{self, File};
use std::io::{self, Read};
use std::path::{Path, PathBuf};

use super::submission::Submission;
use super::text::printable;
use crate::photon_list::reader::starts_like_a_list;

/// A student's folder that has more in it is none.
const MOST_ENTRIES: usize = 10_000;
const MOST_LEVELS: usize = 6;
/// How pictures start: PNG, JPEG, GIF, BMP, TIFF, WebP, and the framework's own PPM.
const PICTURES: [&[u8]; 9] = [
    b"\x89PNG\r\n\x1a\n",
    b"\xff\xd8\xff",
    b"GIF8",
    b"BM",
    b"II*\0",
    b"MM\0*",
    b"RIFF",
    b"P6",
    b"P3",
];

/// A submission, and what there is to say about its files.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct HandedIn {
    /// The submission.
    pub submission: Submission,
    /// Why it cannot be graded at all.
    pub problem: Option<String>,
    /// What was left out.
    pub notes: Vec<String>,
}

/// The submissions named by `paths`, in that order: a folder is one, a file is one, and a list and a
/// picture that differ in the extension alone are one.
pub fn collect(paths: &[PathBuf]) -> Vec<HandedIn> {
    let mut all: Vec<HandedIn> = Vec::new();
    for path in paths {
        let handed_in = if path.is_dir() { from_folder(path) } else { from_file(path) };
        all.push(HandedIn {
            submission: Submission { name: name(path), ..handed_in.submission },
            ..handed_in
        });
    }
    join_stems(&mut all, paths);
    let mut seen: HashMap<String, usize> = HashMap::new();
    for handed_in in &mut all {
        let times = seen.entry(handed_in.submission.name.clone()).or_default();
        *times += 1;
        if *times > 1 {
            handed_in.submission.name += &format!(" ({times})");
        }
    }
    all
}

fn name(path: &Path) -> String {
    let name = path.display().to_string();
    let trimmed = name.trim_end_matches('/');
    printable(if trimmed.is_empty() { &name } else { trimmed })
}

fn from_file(path: &Path) -> HandedIn {
    let mut handed_in = HandedIn::default();
    let about = match fs::metadata(path) {
        Ok(about) => about,
        Err(error) => {
            handed_in.problem = Some(format!("it cannot be read: {error}"));
            return handed_in;
        }
    };
    if !about.is_file() {
        handed_in.problem = Some("it is neither a file nor a folder".to_owned());
        return handed_in;
    }
    match is_picture(path) {
        Ok(true) => handed_in.submission.picture = Some(path.to_owned()),
        Ok(false) => handed_in.submission.list = Some(path.to_owned()),
        Err(error) => handed_in.problem = Some(format!("it cannot be read: {error}")),
    }
    handed_in
}

fn is_picture(path: &Path) -> io::Result<bool> {
    let mut start = Vec::new();
    File::open(path)?.take(16).read_to_end(&mut start)?;
    Ok(PICTURES.iter().any(|magic| start.starts_with(magic)))
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

/// What a folder holds.
#[derive(Default)]
struct Found {
    lists: Vec<PathBuf>,
    pictures: Vec<PathBuf>,
    /// Called like a list, without being one.
    would_be_lists: Vec<PathBuf>,
    notes: Vec<String>,
    entries: usize,
}

fn from_folder(folder: &Path) -> HandedIn {
    let mut found = Found::default();
    let looked = fs::canonicalize(folder).and_then(|root| look_into(folder, &root, 0, &mut found));
    let mut handed_in = HandedIn { notes: found.notes, ..HandedIn::default() };
    if let Err(error) = looked {
        handed_in.problem = Some(format!("it cannot be read: {error}"));
        return handed_in;
    }
    if found.lists.is_empty() && found.would_be_lists.len() == 1 {
        // Its reader says what is wrong with it.
        found.lists = found.would_be_lists;
    }
    match (choice("photon lists", found.lists, folder), choice("pictures", found.pictures, folder))
    {
        (Ok(None), Ok(None)) => {
            let mut problem = "it has neither a photon list nor a picture in it".to_owned();
            handed_in.notes.iter().for_each(|note| problem += &format!("; {note}"));
            handed_in.problem = Some(problem);
        }
        (Ok(list), Ok(picture)) => {
            handed_in.submission = Submission { list, picture, ..Submission::default() };
        }
        (Ok(Some(list)), Err(problem)) => {
            handed_in.submission.list = Some(list);
            handed_in.notes.push(problem);
        }
        (Err(problem), _) | (_, Err(problem)) => handed_in.problem = Some(problem),
    }
    handed_in
}

/// The one of several `files` that is meant: the one called as this program and the handout call it.
fn choice(what: &str, mut files: Vec<PathBuf>, folder: &Path) -> Result<Option<PathBuf>, String> {
    if files.len() > 1 {
        let is_usual = |path: &&PathBuf| {
            let stem = path.file_stem().and_then(|stem| stem.to_str()).unwrap_or_default();
            ["photons", "assignment8"].contains(&stem)
        };
        let usual: Vec<PathBuf> = files.iter().filter(is_usual).cloned().collect();
        if usual.len() != 1 {
            let names: Vec<String> =
                files.iter().take(5).map(|path| within(path, folder)).collect();
            let (names, all) = (names.join(", "), files.len());
            return Err(format!(
                "there are {all} {what} in it ({names}), of which one is expected"
            ));
        }
        files = usual;
    }
    Ok(files.pop())
}

fn within(path: &Path, folder: &Path) -> String {
    printable(&path.strip_prefix(folder).unwrap_or(path).display().to_string())
}

fn look_into(folder: &Path, root: &Path, level: usize, found: &mut Found) -> io::Result<()> {
    let mut entries = Vec::new();
    for entry in fs::read_dir(folder)? {
        entries.push(entry?);
        found.entries += 1;
        if found.entries > MOST_ENTRIES || level > MOST_LEVELS {
            return Err(io::Error::other(format!(
                "expected a student's folder, found more than {MOST_ENTRIES} files or \
                 {MOST_LEVELS} levels"
            )));
        }
    }
    entries.sort_by_key(fs::DirEntry::file_name);
    for entry in entries {
        let path = entry.path();
        let name = printable(&entry.file_name().to_string_lossy());
        // What systems leave: .DS_Store, ._photons.csv, .git.
        if name.starts_with('.') {
            continue;
        }
        let kind = entry.file_type()?;
        if kind.is_symlink() {
            // What a link within the folder leads to is found without it.
            if !fs::canonicalize(&path).is_ok_and(|target| target.starts_with(root)) {
                found.notes.push(format!("the link {name} leads out of the folder"));
            }
        } else if kind.is_dir() {
            look_into(&path, root, level + 1, found)?;
        } else if !kind.is_file() {
            found.notes.push(format!("{name} is neither a file nor a folder"));
        } else if is_picture(&path)? {
            found.pictures.push(path);
        } else if starts_like_a_list(&path)? {
            found.lists.push(path);
        } else if path.extension().is_some_and(|extension| extension == "csv" || extension == "ply")
        {
            found.would_be_lists.push(path);
        }
    }
    Ok(())
}
