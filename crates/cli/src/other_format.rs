//! Reads lists, names the format of files that are none, and tells what of a list is not used.

use std::io::{self, Write as _};
use std::path::Path;

use super::error::escaped;
use grading::picture::kinds;
use photon_list::error::ListError;
use photon_list::reader::{self, PhotonList};

/// Reads the list `path` into memory; the text says what was guessed or passed over.
///
/// # Errors
/// Those of [`reader::read`]; they name the format of a file that is no list.
pub fn load_list(path: &Path) -> Result<(PhotonList, Option<String>), ListError> {
    let mut records = Vec::new();
    let (columns, note) = reader::read(path, |record| records.push(record)).map_err(named)?;
    Ok((PhotonList { columns, records }, note))
}

/// Tells people `note` on the list `path`.
pub fn tell(path: &Path, note: Option<String>) {
    if let Some(note) = note {
        let note = format!("{}: {note}", path.display());
        // Where that cannot be written, the output must do.
        let _ = writeln!(io::stderr(), "note: {}", escaped(&note));
    }
}

/// `error`, or which other format its file has.
pub fn named(error: ListError) -> ListError {
    let ListError::Malformed { path, start, .. } = &error else { return error };
    match kinds::other_format(start, path) {
        None => error,
        Some(found) => ListError::malformed(path, format!("expected a photon list, found {found}")),
    }
}

/// Which format the file `path` has, if it is one that no photon list has.
pub fn other_format(path: &Path) -> Option<String> {
    // What a pipe has given once it does not give again.
    let start = path.is_file().then(|| kinds::start(path).ok()).flatten()?;
    kinds::other_format(&start, path)
}
