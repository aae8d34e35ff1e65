//! Names the format of files that are no photon lists.

use std::path::Path;

use grading::picture::kinds::{self, Kind};
use photon_list::error::ListError;
use photon_list::reader::{self, PhotonList};

/// Formats that the page of a grade does not name: where their first letters stand, and these.
const OTHERS: [(usize, &[u8], &str); 7] = [
    (257, b"ustar", "a tar archive"),
    (0, b"\x93NUMPY", "a NumPy array"),
    (0, b"\x89HDF\r\n\x1a\n", "an HDF5 file"),
    (0, b"MATLAB 5.0", "a MATLAB file"),
    (0, b"PAR1", "a Parquet file"),
    (0, b"SQLite format 3\0", "an SQLite database"),
    (0, b"\x7fELF", "a program"),
];

/// Reads the list `path`, as [`reader::load`] does.
///
/// # Errors
/// Those of [`reader::load`]; they name the format of a file that is no list.
pub fn load_list(path: &Path) -> Result<PhotonList, ListError> {
    reader::load(path).map_err(named)
}

/// `error`, or which other format its file has.
pub fn named(error: ListError) -> ListError {
    let ListError::Malformed { path, .. } = &error else { return error };
    match other_format(path) {
        None => error,
        Some(found) => ListError::malformed(path, format!("expected a photon list, found {found}")),
    }
}

/// Which format the file `path` has, if it is one that no photon list has.
pub fn other_format(path: &Path) -> Option<String> {
    // What a pipe has given once it does not give again.
    let start = path.is_file().then(|| kinds::start(path).ok()).flatten()?;
    let is_other = |(at, magic, _): &&(usize, &[u8], &str)| {
        start.get(*at..).is_some_and(|start| start.starts_with(magic))
    };
    if let Some((_, _, name)) = OTHERS.iter().find(is_other) {
        return Some((*name).to_owned());
    }
    let text = start.trim_ascii_start();
    Some(match kinds::kind(&start, path) {
        Some(Kind::Packed("xz")) => "an xz archive".to_owned(),
        Some(Kind::Packed(name)) => format!("a {name} archive"),
        Some(Kind::Picture(name)) => format!("a picture ({name})"),
        Some(Kind::Document(name)) => format!("a document ({name})"),
        None if text.starts_with(b"{") || text.starts_with(b"[") => "JSON".to_owned(),
        None => return None,
    })
}
