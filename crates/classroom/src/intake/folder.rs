//! What a folder holds: lists and pictures, found by their contents.

use std::ffi::OsString;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use photon_mapping::assignment8::{HEIGHT, WIDTH};

use super::WRITTEN;
use super::contents::same_contents;
use super::looks::{Looks, LooksLike, MOST_ENTRIES, Spent};
use super::names::is_litter;
use grading::picture::kinds;
use grading::text::printable;
use photon_list::reader::Look;

/// So many levels of a folder are searched: the course's framework has 9.
const MOST_LEVELS: usize = 6;
/// A folder with more names than this in it is not sorted.
const MOST_NAMES: usize = 1_000_000;
/// So many files are named in one note.
const MOST_NAMED: usize = 5;

/// What a folder holds.
#[derive(Default)]
pub struct Found {
    /// Photon lists.
    pub lists: Vec<PathBuf>,
    /// Lists that can hardly be of photons.
    pub unlikely: Vec<PathBuf>,
    /// Called like a list, without being one.
    pub would_be_lists: Vec<PathBuf>,
    /// Pictures of all formats.
    pub pictures: Vec<PathBuf>,
    /// Documents, which may have a picture in them.
    documents: Vec<PathBuf>,
    /// What was left out, and why.
    pub notes: Vec<String>,
    /// Whether something could not be read.
    pub is_partial: bool,
    /// What was left out because its name starts with a dot.
    hidden: Vec<PathBuf>,
    /// Those of them that have a list or a picture.
    hidden_submissions: Vec<PathBuf>,
    spent: Spent,
}

/// The list and the picture of a folder.
pub type Choice = (Option<PathBuf>, Option<PathBuf>);

impl Found {
    /// What is in `folder`, the highest levels first, and of each level what is called like a list
    /// or a picture.
    pub fn search(folder: &Path, looks: &Looks) -> io::Result<Self> {
        let mut found = Self::default();
        found.search_below(folder, looks)?;
        let root = fs::canonicalize(folder)?;
        found.hidden.sort();
        for path in found.hidden.clone() {
            if found.spent.has_all_bytes() {
                break;
            }
            // Within what is left of the same limits.
            let mut inner = Self { spent: found.spent, ..Self::default() };
            let mut folders = Vec::new();
            let mut searched = inner.sort(&path, folder, &root, &mut folders, looks);
            if let [hidden] = folders.as_slice() {
                searched = inner.search_below(hidden, looks);
            }
            found.spent = inner.spent;
            if searched.is_ok() && inner.is_something() {
                found.hidden_submissions.push(path);
            }
        }
        Ok(found)
    }

    fn search_below(&mut self, folder: &Path, looks: &Looks) -> io::Result<()> {
        let found = self;
        let root = fs::canonicalize(folder)?;
        let mut level = vec![folder.to_owned()];
        let mut is_cut = false;
        for depth in 0..=MOST_LEVELS {
            let mut next = Vec::new();
            for inner in std::mem::take(&mut level) {
                let names = match names(&inner) {
                    Err(error) if depth == 0 => return Err(error),
                    Err(error) => {
                        found.is_partial = true;
                        let name = within(&inner, folder);
                        found.notes.push(format!("{name} cannot be read: {error}"));
                        continue;
                    }
                    Ok(names) => names,
                };
                for name in names {
                    if found.spent.is_all() {
                        is_cut = true;
                        break;
                    }
                    found.spent.add_entry();
                    let path = inner.join(&name);
                    if name.to_string_lossy().starts_with('.') {
                        found.hidden.push(path);
                        continue;
                    }
                    if let Err(error) = found.sort(&path, folder, &root, &mut next, looks) {
                        found.is_partial |= error.kind() != io::ErrorKind::NotFound;
                        let name = within(&path, folder);
                        found.notes.push(format!("{name} cannot be read: {error}"));
                    }
                }
            }
            level = next;
        }
        if is_cut || !level.is_empty() {
            found.notes.push(format!(
                "there are more than {MOST_ENTRIES} files or {MOST_LEVELS} levels in it, or far \
                 too much to read, and the rest was not searched"
            ));
        }
        Ok(())
    }

    /// Puts `path` where it belongs; folders go to `folders`.
    fn sort(
        &mut self,
        path: &Path,
        folder: &Path,
        root: &Path,
        folders: &mut Vec<PathBuf>,
        looks: &Looks,
    ) -> io::Result<()> {
        let of_file = fs::symlink_metadata(path)?.file_type();
        if of_file.is_symlink() {
            // What a link within the folder leads to is found without it.
            if !fs::canonicalize(path).is_ok_and(|target| target.starts_with(root)) {
                self.notes
                    .push(format!("the link {} leads out of the folder", within(path, folder)));
            }
        } else if of_file.is_dir() {
            folders.push(path.to_owned());
        } else if !of_file.is_file() {
            self.notes.push(format!("{} is neither a file nor a folder", within(path, folder)));
        } else {
            let seen = looks.at(path)?;
            self.spent.add_bytes(path, seen);
            let path = path.to_owned();
            match seen {
                LooksLike::Own => {
                    let name = within(&path, folder);
                    self.notes.push(format!("left out: {name}: {WRITTEN}"));
                }
                LooksLike::Packed(kind) => {
                    let name = within(&path, folder);
                    self.notes.push(format!("{name} is packed ({kind}): unpack it first"));
                }
                LooksLike::Picture => self.pictures.push(path),
                LooksLike::Document => self.documents.push(path),
                LooksLike::Text(Look::List) => self.lists.push(path),
                LooksLike::Text(Look::Unlikely) => self.unlikely.push(path),
                LooksLike::Text(Look::Other) if is_called_a_list(&path) => {
                    self.would_be_lists.push(path);
                }
                LooksLike::Text(Look::Other) => {}
            }
        }
        Ok(())
    }

    /// Whether there is anything that a student may have handed in.
    pub fn is_something(&self) -> bool {
        !self.lists.is_empty() || !self.pictures.is_empty() || !self.unlikely.is_empty()
    }

    /// The list and the picture that are meant; what is left out is noted. `Err` says that several
    /// could be.
    pub fn choose(mut self, folder: &Path) -> (Result<Choice, String>, Vec<String>) {
        let mut notes = std::mem::take(&mut self.notes);
        let mut left_out = Vec::new();
        if !self.lists.is_empty() {
            left_out = self.unlikely;
        } else if self.pictures.is_empty() {
            self.lists = self.unlikely;
        } else if !self.unlikely.is_empty() {
            let names = names_of(&self.unlikely, folder);
            notes.push(format!(
                "left out: {names}: of too few rows, far from the scene, or a mesh, so no photon \
                 list"
            ));
        }
        if self.lists.is_empty() && self.would_be_lists.len() == 1 {
            // Its reader says what is wrong with it.
            self.lists = self.would_be_lists;
        }
        if self.lists.is_empty() && self.pictures.is_empty() {
            // The reader of pictures says what to hand in instead.
            self.pictures = self.documents;
            if self.pictures.is_empty() {
                self.hidden_submissions = self.hidden;
            }
        }
        if !self.hidden_submissions.is_empty() {
            let names = names_of(&self.hidden_submissions, folder);
            notes.push(format!("left out: {names}: names with a dot are no part of it"));
        }
        let list = choice("photon lists", self.lists, left_out, folder, &mut notes, |_| false);
        let is_of_camera = |path: &PathBuf| is_of_camera(path) == Some(true);
        let picture =
            choice("pictures", self.pictures, Vec::new(), folder, &mut notes, is_of_camera);
        let choice = match (list, picture) {
            (Ok(list), Ok(picture)) => Ok((list, picture)),
            (Ok(Some(list)), Err(problem)) => {
                notes.push(problem);
                Ok((Some(list), None))
            }
            (Err(problem), Ok(Some(picture))) => {
                notes.push(problem);
                Ok((None, Some(picture)))
            }
            (Err(problem), _) | (_, Err(problem)) => Err(problem),
        };
        (choice, notes)
    }
}

/// The names in `folder`, those that a submission has first, and those with a dot last, which
/// systems leave: .DS_Store, ._photons.csv, .git.
fn names(folder: &Path) -> io::Result<Vec<OsString>> {
    let mut names = Vec::new();
    for entry in fs::read_dir(folder)?.take(MOST_NAMES) {
        names.push(entry?.file_name());
    }
    names.retain(|name| !is_litter(Path::new(name)));
    names.sort_by_cached_key(|name| {
        let path = PathBuf::from(name);
        let is_likely = is_called_a_list(&path) || has_extension(&path, &["png"]);
        let is_hidden = name.to_string_lossy().starts_with('.');
        (is_hidden, !is_usual(&path), !is_likely, name.clone())
    });
    Ok(names)
}

/// Whether the PNG `path` has the size of the handout's camera, if it tells its size.
pub fn is_of_camera(path: &Path) -> Option<bool> {
    Some(kinds::png_size(&kinds::start(path).ok()?)? == (WIDTH, HEIGHT))
}

/// Whether `path` is called as this program and the handout call it.
fn is_usual(path: &Path) -> bool {
    let stem = path.file_stem().unwrap_or_default().to_ascii_lowercase();
    ["photons", "assignment8"].iter().any(|usual| stem == *usual)
}

pub fn is_called_a_list(path: &Path) -> bool {
    has_extension(path, &["csv", "ply"])
}

/// Whether the name of `path` ends in one of `extensions`, in capitals or not.
pub fn has_extension(path: &Path, extensions: &[&str]) -> bool {
    let extension = path.extension().unwrap_or_default().to_ascii_lowercase();
    extensions.iter().any(|known| extension == *known)
}

/// The one of several `files` that is meant: the one called as usual, the highest if there are
/// more; else any, if they are all the same; else the only one that `is_likely`. What is left out
/// is noted, with `left_out`.
fn choice(
    what: &str,
    mut files: Vec<PathBuf>,
    mut left_out: Vec<PathBuf>,
    folder: &Path,
    notes: &mut Vec<String>,
    is_likely: impl Fn(&PathBuf) -> bool,
) -> Result<Option<PathBuf>, String> {
    if files.len() + left_out.len() < 2 {
        return Ok(files.pop());
    }
    let only = |of: Vec<usize>| if let [only] = of[..] { Some(only) } else { None };
    let places = |is_one: &dyn Fn(&PathBuf) -> bool| -> Vec<usize> {
        (0..files.len()).filter(|at| is_one(&files[*at])).collect()
    };
    let depth = |path: &PathBuf| path.components().count();
    let highest = files.iter().filter(|path| is_usual(path)).map(depth).min();
    let usual = places(&|path| is_usual(path) && Some(depth(path)) == highest);
    let is_same = files.len() > 1 && same_contents(&files);
    let chosen = match files.len() {
        1 => Some(0),
        _ => only(usual).or(is_same.then_some(0)).or_else(|| only(places(&|path| is_likely(path)))),
    };
    let Some(chosen) = chosen else {
        let (names, all) = (names_of(&files, folder), files.len());
        return Err(format!(
            "there are {all} {what} in it ({names}), of which one is expected, or one of them \
             called photons or assignment8"
        ));
    };
    let chosen = files.remove(chosen);
    files.append(&mut left_out);
    let same = if is_same { ", which is the same" } else { "" };
    notes.push(format!(
        "of several {what}, {} is judged, and left out: {}{same}",
        within(&chosen, folder),
        names_of(&files, folder)
    ));
    Ok(Some(chosen))
}

/// The names of some of `files`.
fn names_of(files: &[PathBuf], folder: &Path) -> String {
    let names: Vec<String> =
        files.iter().take(MOST_NAMED).map(|path| within(path, folder)).collect();
    let more = if files.len() > MOST_NAMED { " and more" } else { "" };
    names.join(", ") + more
}

/// The name of `path` in `folder`.
pub fn within(path: &Path, folder: &Path) -> String {
    printable(&path.strip_prefix(folder).unwrap_or(path).display().to_string())
}
