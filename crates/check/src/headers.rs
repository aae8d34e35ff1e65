//! Headers that no folder has where they are included: those in another folder of the submission,
//! those written with other letters (`common\scene\Scene.h`), and those that nobody needs.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use crate::error::CheckError;
use crate::kit::{Kit, write};

/// Deep enough for every `../` in an include.
const FOLDER: &str = "others/1/2/3/4/5/6/7/8";

/// Headers that stand where the compiler looks last.
#[derive(Debug)]
pub(crate) struct Headers {
    /// The folder of the submission's copies and of the headers written here.
    workshop: PathBuf,
    /// The headers beside the two files, and the stand-in's.
    ours: Vec<PathBuf>,
    /// All headers that were handed in, wherever they lie.
    handed_in: Vec<PathBuf>,
    /// The headers written, and where each was found, if it was.
    written: BTreeMap<String, Option<PathBuf>>,
    /// Those that were found, and emptied.
    given_up: BTreeSet<String>,
}

impl Headers {
    pub(crate) fn new(kit: &Kit, workshop: &Path, handed_in: &[PathBuf]) -> Self {
        let mut ours = files_below(&workshop.join("submission"));
        ours.extend(files_below(&kit.path().join("standin")));
        let (workshop, handed_in) = (workshop.to_owned(), handed_in.to_vec());
        let (written, given_up) = Default::default();
        Self { workshop, ours, handed_in, written, given_up }
    }

    /// The folder where the compiler looks last.
    pub(crate) fn folder(&self) -> PathBuf {
        self.workshop.join(FOLDER)
    }

    /// Writes a header for each of `names`: one that includes the file with this name, wherever it
    /// lies, or an empty one. Answers whether any is new.
    pub(crate) fn supply(&mut self, names: Vec<String>) -> Result<bool, CheckError> {
        let mut any_new = false;
        for name in names {
            if self.written.contains_key(&name) {
                continue;
            }
            let found = self.find(&name);
            if self.write(&name, found.as_deref())? {
                self.written.insert(name, found);
                any_new = true;
            }
        }
        Ok(any_new)
    }

    /// Empties the header in which the compiler met its first error, if it is one that was found:
    /// a header of the framework itself may not fit the stand-in, and not be needed. Answers
    /// whether there is one. `printed` is what the compiler says up to that error, in `file`.
    pub(crate) fn give_up(&mut self, printed: &str, file: &str) -> Result<bool, CheckError> {
        let place = |found: &Path| {
            let found = found.to_string_lossy();
            // The compiler names the includes that lead to the error, the nearest first.
            if found == file { Some(0) } else { printed.find(&*found).map(|at| at + 1) }
        };
        let places = self.written.iter().filter(|(name, _)| !self.given_up.contains(*name));
        let places = places.filter_map(|(name, found)| Some((place(found.as_ref()?)?, name)));
        let Some((_, name)) = places.min() else { return Ok(false) };
        let name = name.clone();
        self.write(&name, None)?;
        Ok(self.given_up.insert(name))
    }

    /// The headers that were found nowhere.
    pub(crate) fn missing(&self) -> Vec<String> {
        let missing = self.written.iter().filter(|(_, found)| found.is_none());
        missing.map(|(name, _)| name.clone()).collect()
    }

    /// Whether a header that was handed in mentions `word`.
    pub(crate) fn mention(&self, word: &str) -> bool {
        let mentions = |path: &PathBuf| {
            fs::read(path).is_ok_and(|text| String::from_utf8_lossy(&text).contains(word))
        };
        self.handed_in.iter().any(mentions)
    }

    /// The file whose path has the most last parts in common with `name`, whatever their case.
    fn find(&self, name: &str) -> Option<PathBuf> {
        let mut best = (0, None);
        for path in self.ours.iter().chain(&self.handed_in) {
            let common = common_parts(&path.to_string_lossy(), name);
            if common > best.0 {
                best = (common, Some(path));
            }
        }
        let found = fs::canonicalize(best.1?).ok()?;
        (!found.to_string_lossy().contains(['"', '\n'])).then_some(found)
    }

    /// Whether it could be written: not outside of the folder.
    fn write(&self, name: &str, found: Option<&Path>) -> Result<bool, CheckError> {
        let ups = name.split('/').filter(|part| *part == "..").count();
        if Path::new(name).is_absolute() || ups >= FOLDER.split('/').count() {
            return Ok(false);
        }
        let text = found.map(|found| format!("#include \"{}\"\n", found.display()));
        write(&self.folder().join(name), text.unwrap_or_default().as_bytes())?;
        Ok(true)
    }
}

fn common_parts(path: &str, name: &str) -> usize {
    let parts = |path: &str| -> Vec<String> {
        let parts = path.split(['/', '\\']).filter(|part| ![".", "..", ""].contains(part));
        parts.rev().map(str::to_lowercase).collect()
    };
    let (path, name) = (parts(path), parts(name));
    path.iter().zip(&name).take_while(|(a, b)| a == b).count()
}

pub(crate) fn files_below(folder: &Path) -> Vec<PathBuf> {
    let mut files = Vec::new();
    for path in fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path()) {
        if path.is_dir() {
            files.extend(files_below(&path));
        } else {
            files.push(path);
        }
    }
    files.sort();
    files
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_compared_from_their_end() {
        assert_eq!(common_parts("/a/common/Scene/Scene.h", "common\\scene\\scene.h"), 3);
        assert_eq!(common_parts("/a/utils.h", "../../common/utils.h"), 1);
        assert_eq!(common_parts("/a/utils.h", "util.h"), 0);
    }
}
