//! Small files that the grader names: policies, rosters, summaries.

use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

use super::error::CliError;
use photon_list::reader::refuse_pipe;

/// More bytes than this no such file has.
const MOST_BYTES: u64 = 64 << 20;

/// The bytes of the file `path`.
///
/// # Errors
/// When it cannot be read, is too large, or is a pipe whose other end may never come.
pub fn bytes(path: &Path) -> Result<Vec<u8>, CliError> {
    refuse_pipe(path)?;
    let unreadable = |error| CliError::unreadable(path, error);
    let mut bytes = Vec::new();
    let file = File::open(path).map_err(unreadable)?;
    file.take(MOST_BYTES + 1).read_to_end(&mut bytes).map_err(unreadable)?;
    match bytes.len() as u64 > MOST_BYTES {
        true => Err(unreadable(io::Error::other("expected a file of at most 64 MiB"))),
        false => Ok(bytes),
    }
}

/// The text of the file `path`, without the mark that some editors put first.
///
/// # Errors
/// Those of [`bytes`], and when it is not UTF-8.
pub fn text(path: &Path) -> Result<String, CliError> {
    let not_text = || io::Error::other("expected UTF-8 text");
    let text = String::from_utf8(bytes(path)?);
    let text = text.map_err(|_| CliError::unreadable(path, not_text()))?;
    Ok(text.strip_prefix('\u{feff}').map(str::to_owned).unwrap_or(text))
}
