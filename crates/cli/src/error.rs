//! What the command line can fail with; each is one clear line.

use std::borrow::Cow;
use std::io;
use std::path::{Path, PathBuf};

use model::obj::ModelError;
use photon_list::error::ListError;

/// Why a command could not be carried out.
#[derive(Debug, thiserror::Error)]
pub enum CliError {
    /// A model could not be read.
    #[error(transparent)]
    Model(#[from] ModelError),
    /// A photon list could not be read.
    #[error(transparent)]
    List(#[from] ListError),
    /// A file could not be read.
    #[error("{}: cannot be read: {source}", path.display())]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// A file or folder could not be written.
    #[error("{}: cannot be written: {source}", path.display())]
    Unwritable {
        /// The file or folder.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// An argument does not fit the others.
    #[error("{0}")]
    Argument(String),
    /// Standard output could not be written.
    #[error("standard output cannot be written: {0}")]
    Output(io::Error),
}

impl CliError {
    /// `path` could not be read because of `source`.
    pub fn unreadable(path: &Path, source: io::Error) -> Self {
        Self::Unreadable { path: path.to_owned(), source }
    }

    /// `path` could not be written because of `source`.
    pub fn unwritable(path: &Path, source: io::Error) -> Self {
        Self::Unwritable { path: path.to_owned(), source }
    }
}

/// Prints `text` to standard output. That its reader has closed it is the reader's choice, no
/// error.
///
/// # Errors
/// When standard output cannot be written.
pub fn print(text: &str) -> Result<(), CliError> {
    match print_whole(text) {
        Err(CliError::Output(error)) if error.kind() == io::ErrorKind::BrokenPipe => Ok(()),
        printed => printed,
    }
}

/// As [`print()`], for what must not get lost in silence.
///
/// # Errors
/// When standard output cannot be written, also because its reader has closed it.
pub fn print_whole(text: &str) -> Result<(), CliError> {
    let mut output = io::stdout().lock();
    io::Write::write_all(&mut output, escaped(text).as_bytes())
        .and_then(|()| io::Write::flush(&mut output))
        .map_err(CliError::Output)
}

/// `text` without letters that move the cursor, hide or turn others round: as `\u001b`, which means
/// the same in JSON.
pub fn escaped(text: &str) -> Cow<'_, str> {
    let is_odd = |letter: char| {
        (letter.is_control() && !"\n\t".contains(letter)) || grading::text::is_invisible(letter)
    };
    if !text.contains(is_odd) {
        return Cow::Borrowed(text);
    }
    let mut escaped = String::new();
    for letter in text.chars() {
        if is_odd(letter) {
            let units = letter.encode_utf16(&mut [0; 2]).to_vec();
            units.iter().for_each(|unit| escaped += &format!("\\u{unit:04x}"));
        } else {
            escaped.push(letter);
        }
    }
    Cow::Owned(escaped)
}
