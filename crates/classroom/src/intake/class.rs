//! Whether a folder is a class, and who is in it.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use super::WRITTEN;
use super::folder::{Found, has_extension, is_called_a_list, is_of_camera, within};
use super::looks::{Looks, LooksLike, MOST_ENTRIES, Spent};
pub use super::names::{is_litter, student_in};
use super::names::{is_own_file, is_part};
use crate::written::is_own;
use grading::text::printable;
use photon_list::reader::Look;

/// What lies in a folder itself.
#[derive(Default)]
struct Children {
    folders: Vec<PathBuf>,
    /// Links and archives, which are submissions of a class, too.
    others: Vec<PathBuf>,
    lists: Vec<PathBuf>,
    /// Called like lists, or of three columns, but hardly of photons.
    unlikely: Vec<PathBuf>,
    pictures: Vec<PathBuf>,
    rest: Vec<PathBuf>,
    hidden: Vec<PathBuf>,
    /// What this program wrote.
    own: Vec<PathBuf>,
    /// Too many to look at, and called like no list or picture.
    unseen: Vec<PathBuf>,
}

impl Children {
    fn of(folder: &Path, looks: &mut Looks) -> Self {
        let mut children = Self::default();
        let mut paths: Vec<PathBuf> = fs::read_dir(folder)
            .into_iter()
            .flatten()
            .filter_map(|entry| Some(entry.ok()?.path()))
            .filter(|path| !is_litter(path))
            .collect();
        paths.sort();
        let mut spent = Spent::default();
        for path in paths {
            let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
            let place = if name.starts_with('.') {
                &mut children.hidden
            } else if path.is_symlink() || is_called_packed(&path) {
                &mut children.others
            } else if path.is_dir() && is_own(&path) {
                &mut children.own
            } else if path.is_dir() {
                &mut children.folders
            } else if !path.is_file() {
                &mut children.rest
            } else if let Some(seen) = looked_at(&path, &mut spent, looks) {
                match seen {
                    LooksLike::Own => &mut children.own,
                    LooksLike::Picture => &mut children.pictures,
                    LooksLike::Text(Look::List) => &mut children.lists,
                    LooksLike::Text(Look::Unlikely) => &mut children.unlikely,
                    _ if is_called_a_list(&path) => &mut children.unlikely,
                    LooksLike::Packed(_) | LooksLike::Document | LooksLike::Text(Look::Other) => {
                        &mut children.rest
                    }
                }
            // Each submission is read later, within limits of its own.
            } else if is_called_a_list(&path) {
                &mut children.lists
            } else if has_extension(&path, &["png"]) {
                &mut children.pictures
            } else {
                &mut children.unseen
            };
            place.push(path);
        }
        children
    }

    /// A file of each student who seems to have some here, by the stem, or what a course system put
    /// first.
    fn students(&self) -> BTreeMap<String, PathBuf> {
        let unlikely = self.unlikely.iter().filter(|_| self.pictures.is_empty());
        let pictures = self.pictures.iter().filter(|path| is_of_camera(path) != Some(false));
        let mut students = BTreeMap::new();
        for file in self.lists.iter().chain(unlikely).chain(pictures) {
            let stem = stem(file);
            let name = match student_in(&stem) {
                Some((name, id)) => format!("{name}_{id}_0_"),
                None if is_own_file(&stem) => continue,
                None => stem,
            };
            students.entry(name).or_insert_with(|| file.clone());
        }
        students
    }
}

/// What the file `path` looks like, if there is something left to be `spent`.
fn looked_at(path: &Path, spent: &mut Spent, looks: &mut Looks) -> Option<LooksLike> {
    (!spent.is_all()).then(|| {
        let seen = looks.keep(path).unwrap_or(LooksLike::Text(Look::Other));
        spent.add_entry();
        spent.add_bytes(path, seen);
        seen
    })
}

/// Spreadsheets and documents are packed too, but are not called so.
fn is_called_packed(path: &Path) -> bool {
    has_extension(path, &["zip", "gz", "tgz", "xz", "7z", "rar", "bz2", "zst", "tar"])
}

/// A class.
#[derive(Default)]
pub struct StudentsIn {
    /// The folder with the submissions.
    pub folder: PathBuf,
    /// Those submissions that are classes themselves.
    pub classes: Vec<PathBuf>,
    /// What has been found in the folders of submissions.
    pub found: BTreeMap<PathBuf, Found>,
}

/// The class in `folder`, or at the end of a chain of single folders in it, if it is one: it has no
/// list or picture itself, but at least two folders that are not called like parts of a submission
/// have, together more than one submission can. `Err` names both readings where it could be either.
pub fn class_in(folder: &Path, looks: &mut Looks) -> Result<Option<StudentsIn>, String> {
    let (inner, is_wrapped) = innermost(folder, looks);
    match is_class(&inner, looks)? {
        Some(_) if is_wrapped => Err(both_readings(&inner, looks)),
        class => Ok(class),
    }
}

/// The class `folder`, which the grader has called one.
pub fn unwrapped(folder: &Path, looks: &mut Looks) -> StudentsIn {
    let folder = match class_in(folder, looks) {
        Ok(Some(class)) => return StudentsIn { classes: Vec::new(), ..class },
        Ok(None) => folder.to_owned(),
        Err(_) => {
            let (inner, _) = innermost(folder, looks);
            let has_folders = !Children::of(&inner, looks).folders.is_empty();
            if has_folders { folder.to_owned() } else { inner }
        }
    };
    StudentsIn { folder, ..StudentsIn::default() }
}

/// Where a chain of single folders from `folder` ends, and whether the names or files on the way
/// are those of a submission.
fn innermost(folder: &Path, looks: &mut Looks) -> (PathBuf, bool) {
    const LONGEST_CHAIN: usize = 6;
    let (mut inner, mut is_of_submission) = (folder.to_owned(), false);
    for _ in 0..LONGEST_CHAIN {
        let Children { folders, others, lists, unlikely, pictures, rest, unseen, .. } =
            Children::of(&inner, looks);
        let has_own = [others, lists, unlikely, pictures].iter().any(|paths| !paths.is_empty());
        let [only] = folders.as_slice() else { break };
        if has_own {
            break;
        }
        is_of_submission |= !rest.is_empty() || !unseen.is_empty() || is_part(only);
        inner = only.clone();
    }
    (inner, is_of_submission)
}

fn is_class(folder: &Path, looks: &mut Looks) -> Result<Option<StudentsIn>, String> {
    let children = Children::of(folder, looks);
    let own = children.students();
    let Children { folders, lists, unlikely, pictures, .. } = children;
    let has_own = [&lists, &unlikely, &pictures].iter().any(|paths| !paths.is_empty());
    let named: Vec<&PathBuf> = folders.iter().filter(|path| !is_part(path)).collect();
    let search = |path: &&PathBuf| Some((path.to_path_buf(), Found::search(path, looks).ok()?));
    let found: BTreeMap<PathBuf, Found> = named.iter().filter_map(search).collect();
    let students: Vec<_> = found.iter().filter(|(_, found)| found.is_something()).collect();
    let sum =
        |count: fn(&Found) -> usize| students.iter().map(|(_, found)| count(found)).sum::<usize>();
    let classes: Vec<PathBuf> = students
        .iter()
        .filter(|(path, found)| has_several(path, found))
        .map(|(path, _)| (*path).clone())
        .collect();
    let files = [&lists, &pictures, &unlikely].into_iter().flatten();
    let is_exported = files.clone().all(|file| student_in(&stem(file)).is_some());
    let exported: BTreeSet<_> = own.keys().filter(|name| student_in(name).is_some()).collect();
    let stems: BTreeSet<String> = files.map(|file| stem(file)).collect();
    let is_class = match students.len() {
        0 if exported.len() > 1 && is_exported => true,
        0 if own.len() > 1 && (stems.len() > 2 || exported.len() > 1) => {
            return Err(both_readings(folder, looks));
        }
        0 => false,
        _ if has_own && own.len() > 1 => return Err(both_readings(folder, looks)),
        1 if has_own || named.len() == 1 => false,
        // Beside its own list or picture, other pictures are those of a program.
        2.. if has_own && sum(|found| found.lists.len()) == 0 => false,
        2.. if classes.len() == students.len() => return Err(both_readings(&classes[0], looks)),
        2.. if !has_own
            && (sum(|found| found.lists.len() + found.unlikely.len()) > 1
                || sum(|found| found.pictures.len()) > 1) =>
        {
            true
        }
        _ => return Err(both_readings(folder, looks)),
    };
    Ok(is_class.then(|| StudentsIn { folder: folder.to_owned(), classes, found }))
}

/// Whether what was `found` in `folder` is that of several students: it lies in two of its folders
/// at least, and none in itself.
fn has_several(folder: &Path, found: &Found) -> bool {
    let tables = found.unlikely.iter().filter(|path| has_extension(path, &["csv"]));
    let lists: Vec<&PathBuf> = found.lists.iter().chain(tables).collect();
    let pictures = found.pictures.iter().filter(|path| is_of_camera(path) != Some(false));
    let files = if lists.is_empty() { pictures.collect() } else { lists };
    let inner = |file: &&PathBuf| -> Option<PathBuf> {
        let mut parts = file.strip_prefix(folder).ok()?.components();
        let first = parts.next()?;
        parts.next().map(|_| folder.join(first))
    };
    let folders: Option<BTreeSet<PathBuf>> = files.iter().map(inner).collect();
    folders.is_some_and(|folders| folders.iter().filter(|path| !is_part(path)).count() > 1)
}

fn stem(path: &Path) -> String {
    path.file_stem().unwrap_or_default().to_string_lossy().into_owned()
}

/// What `folder` could be: one submission or a class.
pub fn both_readings(folder: &Path, looks: &mut Looks) -> String {
    let children = Children::of(folder, looks);
    let folders = children.folders.iter().filter(|path| !is_part(path)).cloned();
    let students: Vec<PathBuf> = folders.chain(children.students().into_values()).collect();
    let names: Vec<String> = students.iter().take(3).map(|path| within(path, folder)).collect();
    format!(
        "{}: it could be one submission, or a class of {} students ({}{}): grade it with \
         --submission or --class",
        printable(&folder.display().to_string()),
        students.len(),
        names.join(", "),
        if students.len() > 3 { ", ..." } else { "" }
    )
}

/// The submissions of the class `folder`, and what in it is none.
pub fn students(folder: &Path, looks: &mut Looks) -> (Vec<PathBuf>, Vec<String>) {
    let children = Children::of(folder, looks);
    let mut students =
        [children.folders, children.others, children.lists, children.unlikely, children.pictures]
            .concat();
    students.sort();
    let hidden = left_out(folder, &children.hidden, "names with a dot are no submissions");
    let rest = left_out(folder, &children.rest, "no list, picture or folder");
    let own = left_out(folder, &children.own, WRITTEN);
    let too_much = format!(
        "there are more than {MOST_ENTRIES} files in it, or far too much to read, and these, \
         called like no list or picture, were not looked at"
    );
    let unseen = left_out(folder, &children.unseen, &too_much);
    (students, [hidden, rest, own, unseen].into_iter().flatten().collect())
}

/// That of the class `folder` these `paths` are no submissions, and why; none if there are none.
pub fn left_out(folder: &Path, paths: &[PathBuf], why: &str) -> Option<String> {
    const MOST_NAMED: usize = 5;
    let names = paths.iter().take(MOST_NAMED).map(|path| within(path, folder));
    let names = names.collect::<Vec<_>>().join(", ");
    let more = if paths.len() > MOST_NAMED { " and more" } else { "" };
    (!paths.is_empty()).then(|| format!("{}: left out: {names}{more}: {why}", folder.display()))
}
