//! What keeps a submission from being checked at all.

use std::io;
use std::path::PathBuf;

use crate::find::{LIGHT, RENDERER};

/// No fault of a student.
#[derive(Debug, thiserror::Error)]
pub enum CheckError {
    /// There is no C++ compiler.
    #[error(
        "no C++ compiler was found: install one (apt-get install g++, or xcode-select --install), \
         or name one in the environment variable CXX"
    )]
    NoCompiler,
    /// The compiler does not find glm.
    #[error(
        "the compiler does not find glm: install it (apt-get install libglm-dev, or brew install \
         glm), or name its folder with --glm PATH"
    )]
    NoGlm,
    /// The stand-in itself does not compile.
    #[error("{compiler} cannot compile the stand-in for the framework: {message}")]
    Kit {
        /// The compiler.
        compiler: String,
        /// Its first error.
        message: String,
    },
    /// A path does not exist or cannot be read.
    #[error("{}: cannot be read: {source}", path.display())]
    Unreadable {
        /// The path.
        path: PathBuf,
        /// Why.
        source: io::Error,
    },
    /// A folder has several submissions in it.
    #[error(
        "{}: {LIGHT} and {RENDERER} are in several folders ({folders}): say --class, or name one \
         folder",
        path.display()
    )]
    Ambiguous {
        /// The path.
        path: PathBuf,
        /// The folders that have both files.
        folders: String,
    },
    /// The working folder cannot be written, or a program cannot be started.
    #[error("{what}: {source}")]
    Io {
        /// What was tried.
        what: String,
        /// Why it failed.
        source: io::Error,
    },
}

impl CheckError {
    pub(crate) fn io(what: impl Into<String>) -> impl FnOnce(io::Error) -> Self {
        let what = what.into();
        move |source| Self::Io { what, source }
    }
}
