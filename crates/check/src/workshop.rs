//! The folder in which a submission is compiled and run.

use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use crate::error::CheckError;
use crate::find::{
    CppSubmission, LIGHT, LIGHT_FOLDER, RENDERER, RENDERER_FOLDER, beside, read_source,
};
use crate::headers::Headers;
use crate::kit::{Kit, write};
use crate::sandbox::{Exit, Limits, Program, RunOutcome, on_clock, search_path};

/// The signal for processor time that is used up.
const SIGXCPU: i32 = 24;
/// The compiler's memory, in MiB.
const MEMORY: u64 = 3 << 10;

/// A submission in the folder in which it is compiled and run.
#[derive(Debug)]
pub struct Workshop<'kit> {
    pub(crate) kit: &'kit Kit,
    folder: tempfile::TempDir,
    /// Folders of copies, and where the originals lie.
    pub(crate) originals: Vec<(PathBuf, PathBuf)>,
    /// The folder of all that was handed in.
    pub(crate) root: Option<PathBuf>,
    headers: Mutex<Headers>,
    pub(crate) time: Duration,
}

impl<'kit> Workshop<'kit> {
    /// Copies the two files, and the headers and sources beside them, to where the framework has
    /// them.
    ///
    /// # Errors
    /// When a file cannot be copied.
    pub fn new(
        kit: &'kit Kit,
        light: &Path,
        renderer: &Path,
        submission: &CppSubmission,
        time: Duration,
    ) -> Result<Self, CheckError> {
        let folder = kit.work_folder()?;
        let mut originals = Vec::new();
        for (file, name, home) in
            [(light, LIGHT, LIGHT_FOLDER), (renderer, RENDERER, RENDERER_FOLDER)]
        {
            let place = folder.path().join("submission").join(home);
            let unreadable = |source| CheckError::Unreadable { path: file.to_owned(), source };
            for other in beside(file) {
                let other_name = other.file_name().unwrap_or_default();
                // Neither of the two may stand where the other belongs.
                if other_name != LIGHT && other_name != RENDERER {
                    // What cannot be read is missed by the compiler, if it is needed.
                    if let Ok(content) = read_source(&other) {
                        write(&place.join(other_name), &content)?;
                    }
                }
            }
            write(&place.join(name), &read_source(file).map_err(unreadable)?)?;
            let original = file.parent().unwrap_or(Path::new("")).to_owned();
            originals.push((place, original));
        }
        let headers = Mutex::new(Headers::new(kit, folder.path(), &submission.headers));
        let root = submission.root.as_ref().and_then(|root| fs::canonicalize(root).ok());
        Ok(Self { kit, folder, originals, root, headers, time })
    }

    /// The folder.
    pub fn path(&self) -> &Path {
        self.folder.path()
    }

    /// The headers that are included, were not handed in, and are no part of the stand-in.
    pub fn missing_headers(&self) -> Vec<String> {
        self.headers().missing()
    }

    pub(crate) fn headers(&self) -> MutexGuard<'_, Headers> {
        self.headers.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Runs the compiler, or what it starts.
    pub(crate) fn run(&self, command: Vec<OsString>) -> Result<RunOutcome, CheckError> {
        let (processor, time) = (self.time, on_clock(self.time));
        let limits = Limits { time, processor, memory: MEMORY, file_blocks: 1 << 19 };
        let environment = vec![
            ("PATH".to_owned(), search_path(&self.kit.compiler)),
            ("LC_ALL".to_owned(), "C".into()),
            ("TMPDIR".to_owned(), self.path().into()),
        ];
        let program =
            Program { command, folder: self.path().to_owned(), environment, writes: true };
        let mut outcome = program.run(limits, |_| Some(time))?;
        // GCC says so of the process that it started; clang crashes.
        let is_signal = outcome.ending == Exit::Signal(SIGXCPU);
        if is_signal || outcome.printed.to_lowercase().contains("time limit exceeded") {
            outcome.ending = Exit::TimeOut;
        }
        Ok(outcome)
    }
}
