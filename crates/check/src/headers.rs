//! Headers that no folder has where they are included: those in another folder of the submission,
//! those written with other letters (`common\scene\Scene.h`), and those that nobody needs.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use crate::error::CheckError;
use crate::kit::{Kit, write};

/// Deep enough for every `../` in an include.
const DEPTH: &str = "1/2/3/4/5/6/7/8";

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
}

impl Headers {
    pub(crate) fn new(kit: &Kit, workshop: &Path, handed_in: &[PathBuf]) -> Self {
        let mut ours = files_below(&workshop.join("submission"));
        ours.extend(files_below(&kit.path().join("standin")));
        let (workshop, handed_in) = (workshop.to_owned(), handed_in.to_vec());
        Self { workshop, ours, handed_in, written: BTreeMap::new() }
    }

    /// The folder where the compiler looks last: with the headers that were found, or with all of
    /// them empty. A header of the framework itself may not fit the stand-in, and not be needed.
    pub(crate) fn folder(&self, with_found: bool) -> PathBuf {
        self.workshop.join(if with_found { "others" } else { "empty" }).join(DEPTH)
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

    /// Whether any header was found in another place.
    pub(crate) fn any_found(&self) -> bool {
        self.written.values().any(Option::is_some)
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
        if Path::new(name).is_absolute() || ups > DEPTH.split('/').count() {
            return Ok(false);
        }
        let text = found.map(|found| format!("#include \"{}\"\n", found.display()));
        write(&self.folder(true).join(name), text.unwrap_or_default().as_bytes())?;
        write(&self.folder(false).join(name), b"")?;
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

fn files_below(folder: &Path) -> Vec<PathBuf> {
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
