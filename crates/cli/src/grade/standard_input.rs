//! A submission that comes from standard input.

use std::fs::File;
use std::io::{self, Read as _};
use std::path::{Path, PathBuf};

use crate::error::CliError;
use crate::output::temporary_folder;
use classroom::intake::HandedIn;
use grading::text::printable;
use photon_list::reader::MOST_BYTES;

/// The name of standard input on the command line.
pub const STANDARD_INPUT: &str = "-";

/// Standard input as a file, if `-` is named.
pub struct StandardInput(Option<tempfile::TempDir>);

impl StandardInput {
    /// Reads it, if `paths` name it.
    ///
    /// # Errors
    /// When it cannot be read or kept.
    pub fn read(paths: &[PathBuf]) -> Result<Self, CliError> {
        let path = Path::new(STANDARD_INPUT);
        if !paths.iter().any(|named| named == path) {
            return Ok(Self(None));
        }
        let unreadable = |error| CliError::unreadable(path, error);
        let folder = temporary_folder().map_err(unreadable)?;
        let mut file = File::create(folder.path().join(STANDARD_INPUT)).map_err(unreadable)?;
        io::copy(&mut io::stdin().lock().take(MOST_BYTES + 1), &mut file).map_err(unreadable)?;
        Ok(Self(Some(folder)))
    }

    fn file(&self) -> Option<PathBuf> {
        Some(self.0.as_ref()?.path().join(STANDARD_INPUT))
    }

    /// `paths`, with the file in place of `-`.
    pub fn in_place_of_name(&self, paths: &[PathBuf]) -> Vec<PathBuf> {
        let file = |path: &PathBuf| self.file().filter(|_| path == Path::new(STANDARD_INPUT));
        paths.iter().map(|path| file(path).unwrap_or_else(|| path.clone())).collect()
    }

    /// Calls the file `-` in all that is said of `handed_in`.
    pub fn name(&self, handed_in: &mut [HandedIn]) {
        let Some(file) = self.file() else { return };
        let name = printable(&file.display().to_string());
        for one in handed_in {
            let texts = std::iter::once(&mut one.submission.name).chain(&mut one.twins);
            texts.for_each(|text| *text = text.replace(&name, STANDARD_INPUT));
        }
    }
}
