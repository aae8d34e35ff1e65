//! What files look like, each looked at once, and not more of a folder than any submission has.

use std::collections::HashMap;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use crate::written::is_own_start;
use grading::picture::kinds::{self, Kind, kind};
use photon_list::reader::{LONGEST_START, Look, look};

/// So many files of a folder are looked at: the course's framework has 4,433.
pub const MOST_ENTRIES: usize = 10_000;
/// So many bytes are read to see which files are lists.
const MOST_LOOKED_AT: u64 = 100_000_000;

/// What a file looks like.
#[derive(Clone, Copy)]
pub enum LooksLike {
    /// This program wrote it.
    Own,
    /// Packed with the program of this name.
    Packed(&'static str),
    Picture,
    Document,
    Text(Look),
}

/// What the files of folders look like that are looked at for several reasons.
#[derive(Default)]
pub struct Looks(HashMap<PathBuf, LooksLike>);

impl Looks {
    /// What the file `path` looks like.
    ///
    /// # Errors
    /// When it cannot be read.
    pub fn at(&self, path: &Path) -> io::Result<LooksLike> {
        self.0.get(path).map_or_else(|| looks_like(path), |seen| Ok(*seen))
    }

    /// The same, which is kept.
    pub fn keep(&mut self, path: &Path) -> io::Result<LooksLike> {
        let seen = self.at(path)?;
        self.0.insert(path.to_owned(), seen);
        Ok(seen)
    }
}

fn looks_like(path: &Path) -> io::Result<LooksLike> {
    #[cfg(test)]
    tests::COUNT.set(tests::COUNT.get() + 1);
    let start = kinds::start(path)?;
    Ok(match kind(&start, path) {
        _ if is_own_start(&start) => LooksLike::Own,
        Some(Kind::Packed(kind)) => LooksLike::Packed(kind),
        Some(Kind::Picture(_)) => LooksLike::Picture,
        Some(Kind::Document(_)) => LooksLike::Document,
        None => LooksLike::Text(look(path)?),
    })
}

/// How much of a folder was looked at.
#[derive(Clone, Copy, Default)]
pub struct Spent {
    entries: usize,
    bytes: u64,
}

impl Spent {
    /// Whether no more is looked at.
    pub fn is_all(self) -> bool {
        self.entries >= MOST_ENTRIES || self.has_all_bytes()
    }

    /// The same, however few entries there were.
    pub fn has_all_bytes(self) -> bool {
        self.bytes > MOST_LOOKED_AT
    }

    pub fn add_entry(&mut self) {
        self.entries += 1;
    }

    /// Adds what was read of the file `path`.
    pub fn add_bytes(&mut self, path: &Path, seen: LooksLike) {
        if let LooksLike::Text(_) = seen {
            self.bytes += fs::metadata(path).map_or(0, |about| about.len().min(LONGEST_START));
        }
    }
}

#[cfg(test)]
mod tests {
    use std::cell::Cell;

    use super::*;
    use crate::intake::{Collected, Folders, collect};

    thread_local! {
        /// How often a file was looked at.
        pub static COUNT: Cell<usize> = const { Cell::new(0) };
    }

    fn name(at: usize) -> String {
        format!("student {at}.{}", ["csv", "png", "txt"][at % 3])
    }

    /// What is collected in a class of one `student`, or of single files where that is nothing, and
    /// how often one of the `files` is looked at, of `bytes` each.
    fn collected(student: &str, how: Folders, files: usize, bytes: usize) -> (Collected, usize) {
        let own = format!("looks-{}-{files}-{how:?}-{student}", std::process::id());
        let class = std::env::temp_dir().join(own);
        let folder = class.join(student);
        fs::create_dir_all(&folder).unwrap();
        let first = folder.join(name(0));
        fs::write(&first, "#".repeat(bytes)).unwrap();
        (1..files).for_each(|at| fs::hard_link(&first, folder.join(name(at))).unwrap());
        COUNT.set(0);
        let collected = collect(std::slice::from_ref(&class), how);
        fs::remove_dir_all(&class).unwrap();
        (collected, COUNT.get())
    }

    #[test]
    fn each_file_is_looked_at_once() {
        for student in ["", "amy"] {
            for how in [Folders::Clear, Folders::Class, Folders::Submission] {
                let (_, count) = collected(student, how, 30, 100);
                assert_eq!(count, 30, "{how:?} '{student}'");
            }
        }
    }

    #[test]
    fn no_more_is_looked_at_than_a_submission_has() {
        let most = usize::try_from(MOST_LOOKED_AT / LONGEST_START).unwrap() + 1;
        let files = most + 300;
        let (collected, count) = collected("", Folders::Class, files, 1 << 16);
        assert_eq!(count, most);
        let graded = |end: &str| {
            collected.handed_in.iter().filter(|one| one.submission.name.ends_with(end)).count()
        };
        assert_eq!(graded(".csv"), files.div_ceil(3), "each list gets a grade");
        // Those that were looked at are no pictures.
        let mut names: Vec<String> = (0..files).map(name).collect();
        names.sort();
        let unseen = names[most..].iter().filter(|name| name.ends_with(".png")).count();
        assert_eq!(graded(".png"), unseen);
        assert_eq!(graded(".txt"), 0);
        let is_told = |note: &String| note.ends_with("were not looked at");
        assert!(collected.notes.iter().any(is_told), "{:?}", collected.notes);
    }
}
