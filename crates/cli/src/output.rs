//! Files that appear whole or not at all: written beside their place, then renamed.

use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::Mutex;

use tempfile::NamedTempFile;

use super::error::CliError;

static UNFINISHED: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

/// On Ctrl-C and its like, removes the files being written and ends with the exit code that shells
/// expect.
pub fn remove_unfinished_files_on_interrupt() {
    // Without the handler an interrupt would leave a temporary file behind, nothing worse: no
    // reason to give up.
    let _ = ctrlc::set_handler(|| {
        let unfinished = UNFINISHED.lock().unwrap_or_else(|poisoned| poisoned.into_inner());
        for path in unfinished.iter() {
            let _ = fs::remove_file(path);
        }
        std::process::exit(130);
    });
}

/// A file that is being written.
pub struct OutputFile {
    path: PathBuf,
    file: NamedTempFile,
}

impl OutputFile {
    /// Starts the file `path`, whose folder is made if need be.
    ///
    /// # Errors
    /// When the folder cannot be made or written to.
    pub fn create(path: &Path) -> Result<Self, CliError> {
        let folder = match path.parent() {
            Some(folder) if folder != Path::new("") => folder,
            _ => Path::new("."),
        };
        fs::create_dir_all(folder).map_err(|error| CliError::unwritable(folder, error))?;
        if path.is_dir() {
            let error = io::Error::from(io::ErrorKind::IsADirectory);
            return Err(CliError::unwritable(path, error));
        }
        let mut builder = tempfile::Builder::new();
        builder.prefix(".unfinished-");
        #[cfg(unix)]
        builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
        // The lock is held from before the file exists until it is known, so that no interrupt
        // falls in between.
        let mut unfinished = UNFINISHED.lock().unwrap_or_else(|poisoned| poisoned.into_inner());
        let file =
            builder.tempfile_in(folder).map_err(|error| CliError::unwritable(path, error))?;
        unfinished.push(file.path().to_owned());
        Ok(Self { path: path.to_owned(), file })
    }

    /// Where the file will stand.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// What is written to.
    pub fn file(&mut self) -> &mut File {
        self.file.as_file_mut()
    }

    /// Puts the file in its place.
    ///
    /// # Errors
    /// When it cannot be renamed; what stood in its place is then still there.
    pub fn persist(self) -> Result<(), CliError> {
        let Self { path, file } = self;
        file.persist(&path).map(|_| ()).map_err(|error| CliError::unwritable(&path, error.error))
    }
}
