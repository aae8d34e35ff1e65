//! What can go wrong with a photon list.

use std::io;
use std::path::{Path, PathBuf};

/// No more letters than this of what was found are told.
const MOST_TOLD: usize = 40;

/// Why a list could not be read or written.
#[derive(Debug, thiserror::Error)]
pub enum ListError {
    /// The file could not be opened or read.
    #[error("{}: cannot be read: {source}", path.display())]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// The list has more records than are read.
    #[error("{}: expected at most {most} records", path.display())]
    TooLong {
        /// The file.
        path: PathBuf,
        /// How many are read.
        most: usize,
    },
    /// The file is not a list.
    #[error("{}: {reason}", path.display())]
    Malformed {
        /// The file.
        path: PathBuf,
        /// Where, and what was expected and found.
        reason: Reason,
        /// How the file starts, from which other formats can be told; nothing where it was not
        /// read from its start on.
        start: Vec<u8>,
    },
}

/// Why a file is not a list.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Reason {
    /// Where, and what was expected.
    pub message: String,
    /// The contents that were found there.
    pub found: Option<String>,
}

/// Where something is in a file, counted from 1.
#[derive(Clone, Copy, Debug)]
pub(super) enum At {
    Line(u64),
    /// Binary files have no lines.
    Row(u64),
}

/// As much of `text` as is told of what a file contains.
pub(super) fn start(text: &str) -> String {
    text.chars().take(MOST_TOLD).collect()
}

impl From<String> for Reason {
    fn from(message: String) -> Self {
        Self { message, found: None }
    }
}

impl From<&str> for Reason {
    fn from(message: &str) -> Self {
        message.to_owned().into()
    }
}

impl std::fmt::Display for Reason {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match &self.found {
            None => write!(formatter, "{}", self.message),
            Some(found) => write!(formatter, "{}, found '{found}'", self.message),
        }
    }
}

impl ListError {
    pub(super) fn unreadable(path: &Path, source: io::Error) -> Self {
        Self::Unreadable { path: path.to_owned(), source }
    }

    pub(super) fn in_line(path: &Path, line: u64, reason: impl Into<Reason>) -> Self {
        Self::at(path, At::Line(line), reason.into())
    }

    pub(super) fn at(path: &Path, at: At, reason: Reason) -> Self {
        let message = match at {
            At::Line(line) => format!("line {line}: {}", reason.message),
            At::Row(row) => format!("row {row}: {}", reason.message),
        };
        Self::malformed(path, Reason { message, ..reason })
    }

    /// `path` is no list: `message` says where, what was expected, and what was found.
    pub fn malformed(path: &Path, message: impl Into<Reason>) -> Self {
        Self::Malformed { path: path.to_owned(), reason: message.into(), start: Vec::new() }
    }

    /// The same of a file that starts with `bytes`.
    pub(super) fn starting_with(mut self, bytes: Vec<u8>) -> Self {
        if let Self::Malformed { start, .. } = &mut self {
            *start = bytes;
        }
        self
    }
}
