//! Whether a folder is a class, and who is in it.

use std::fs;
use std::path::{Path, PathBuf};

use super::folder::{Found, has_extension, within};
use grading::picture::kinds::{self, Kind, kind};
use photon_list::reader::{Look, look};

/// What students call the folders in their own.
const PARTS: [&str; 34] = [
    "assets",
    "assignment8",
    "bin",
    "build",
    "cmake",
    "code",
    "data",
    "debug",
    "doc",
    "docs",
    "external",
    "figures",
    "framework",
    "images",
    "include",
    "lib",
    "media",
    "models",
    "out",
    "output",
    "outputs",
    "photons",
    "pictures",
    "release",
    "render",
    "renders",
    "report",
    "result",
    "results",
    "scenes",
    "screenshots",
    "source",
    "src",
    "textures",
];

/// Whether a name is that of a part of a submission, and not of a student's.
fn is_part(path: &Path) -> bool {
    let name = path.file_name().unwrap_or_default().to_string_lossy().to_lowercase();
    let course = ["assignment", "cs148", "photon"];
    PARTS.contains(&name.as_str()) || course.iter().any(|word| name.contains(word))
}

/// What lies in a folder itself.
#[derive(Default)]
struct Children {
    folders: Vec<PathBuf>,
    /// Links and archives, which are submissions of a class, too.
    others: Vec<PathBuf>,
    lists: Vec<PathBuf>,
    pictures: Vec<PathBuf>,
    rest: Vec<PathBuf>,
    hidden: Vec<PathBuf>,
}

impl Children {
    fn of(folder: &Path) -> Self {
        let mut children = Self::default();
        let mut paths: Vec<PathBuf> = fs::read_dir(folder)
            .into_iter()
            .flatten()
            .filter_map(|entry| Some(entry.ok()?.path()))
            .collect();
        paths.sort();
        for path in paths {
            let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
            let start = || kinds::start(&path).unwrap_or_default();
            let place = if name.starts_with('.') {
                &mut children.hidden
            } else if path.is_symlink() || is_called_packed(&path) {
                &mut children.others
            } else if path.is_dir() {
                &mut children.folders
            } else if !path.is_file() {
                &mut children.rest
            } else if matches!(kind(&start(), &path), Some(Kind::Picture(_))) {
                &mut children.pictures
            } else if has_extension(&path, &["csv", "ply"])
                || look(&path).is_ok_and(|look| look != Look::Other)
            {
                &mut children.lists
            } else {
                &mut children.rest
            };
            place.push(path);
        }
        children
    }
}

/// Spreadsheets and documents are packed too, but are not called so.
fn is_called_packed(path: &Path) -> bool {
    has_extension(path, &["zip", "gz", "tgz", "xz", "7z", "rar", "bz2", "zst", "tar"])
}

/// Whether `folder` is a class: it has no list or picture itself, but at least two folders that are
/// not called like parts of a submission have, together more than one submission can. `Err` names
/// both readings where it could be either.
pub fn is_class(folder: &Path) -> Result<bool, String> {
    let Children { folders, lists, pictures, .. } = Children::of(folder);
    let has_own = !lists.is_empty() || !pictures.is_empty();
    let named: Vec<&PathBuf> = folders.iter().filter(|path| !is_part(path)).collect();
    let found = |path: &&PathBuf| Found::search(path).ok().filter(Found::is_something);
    let students: Vec<Found> = named.iter().filter_map(found).collect();
    let sum = |count: fn(&Found) -> usize| students.iter().map(count).sum::<usize>();
    let lists = sum(|found| found.lists.len() + found.unlikely.len());
    match students.len() {
        0 => Ok(false),
        1 if has_own || named.len() == 1 => Ok(false),
        // Beside its own list or picture, other pictures are those of a program.
        2.. if has_own && sum(|found| found.lists.len()) == 0 => Ok(false),
        2.. if !has_own && (lists > 1 || sum(|found| found.pictures.len()) > 1) => Ok(true),
        _ => Err(both_readings(folder)),
    }
}

/// What `folder` could be: one submission or a class.
pub fn both_readings(folder: &Path) -> String {
    let folders = Children::of(folder).folders;
    let named: Vec<&PathBuf> = folders.iter().filter(|path| !is_part(path)).collect();
    let names: Vec<String> = named.iter().take(3).map(|path| within(path, folder)).collect();
    format!(
        "{}: it could be one submission, or a class of {} students ({}{}): grade it with \
         --submission or --class",
        folder.display(),
        named.len(),
        names.join(", "),
        if named.len() > 3 { ", ..." } else { "" }
    )
}

/// The submissions of the class `folder`, and what in it is none.
pub fn students(folder: &Path) -> (Vec<PathBuf>, Vec<String>) {
    let children = Children::of(folder);
    let mut students =
        [children.folders, children.others, children.lists, children.pictures].concat();
    students.sort();
    let hidden = left_out(folder, &children.hidden, "names with a dot are no submissions");
    let rest = left_out(folder, &children.rest, "no list, picture or folder");
    (students, hidden.into_iter().chain(rest).collect())
}

/// That of the class `folder` these `paths` are no submissions, and why; none if there are none.
pub fn left_out(folder: &Path, paths: &[PathBuf], why: &str) -> Option<String> {
    const MOST_NAMED: usize = 5;
    let names = paths.iter().take(MOST_NAMED).map(|path| within(path, folder));
    let names = names.collect::<Vec<_>>().join(", ");
    let more = if paths.len() > MOST_NAMED { " and more" } else { "" };
    (!paths.is_empty()).then(|| format!("{}: left out: {names}{more}: {why}", folder.display()))
}
