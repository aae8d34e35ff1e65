//! The one place that writes files. A plain file appears whole or not at all: it is written beside
//! its place, then renamed. Devices, pipes and files that a shell has opened are written to at the
//! end.

mod interrupt;
mod unfinished;

use std::fs::{self, File, OpenOptions};
use std::io::{self, Seek, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

use tempfile::NamedTempFile;

use super::error::CliError;
use classroom::written::is_own;
pub use interrupt::remove_unfinished_files_on_interrupt;
pub use unfinished::temporary_folder;

/// Files that are read, which no output may replace.
static INPUTS: Mutex<Vec<Identity>> = Mutex::new(Vec::new());

/// Identifies a file, whatever its name.
#[cfg(unix)]
type Identity = (u64, u64);
#[cfg(not(unix))]
type Identity = PathBuf;

/// Folders of submissions, in which no output may replace anything but what this program wrote.
static SUBMISSIONS: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

/// Endings of file names that no folder is likely to have.
const FILE_EXTENSIONS: [&str; 10] =
    ["csv", "htm", "html", "json", "md", "obj", "ply", "png", "txt", "zip"];

/// From now on no output may replace a file of `paths`.
pub fn protect<P: AsRef<Path>>(paths: impl IntoIterator<Item = P>) {
    let files = paths.into_iter().filter(|path| path.as_ref().is_file());
    let files: Vec<Identity> = files.filter_map(|path| identity(path.as_ref())).collect();
    lock(&INPUTS).extend(files);
}

/// From now on outputs may replace the files `paths`, which are not read after all.
pub fn release<P: AsRef<Path>>(paths: impl IntoIterator<Item = P>) {
    let files: Vec<Identity> =
        paths.into_iter().filter_map(|path| identity(path.as_ref())).collect();
    lock(&INPUTS).retain(|input| !files.contains(input));
}

/// From now on no output may replace a file in the `folders` of submissions but what this program
/// wrote.
pub fn protect_folders(folders: &[PathBuf]) {
    let folders = folders.iter().filter(|folder| folder.is_dir());
    lock(&SUBMISSIONS).extend(folders.filter_map(|folder| fs::canonicalize(folder).ok()));
}

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// The folder `path` for several files. It is created with the first of them.
///
/// # Errors
/// When it is a file, or has the name of one.
pub fn folder(path: &Path) -> Result<&Path, CliError> {
    refuse_dash(path)?;
    let expected = |found: &str| {
        let path = path.display();
        let advice = "write --out FOLDER, or --out FOLDER/ for a new one";
        CliError::Argument(format!("--out {path}: expected a folder, found {found}: {advice}"))
    };
    if path.is_dir() || path.to_string_lossy().ends_with(std::path::is_separator) {
        return Ok(path);
    }
    if path.symlink_metadata().is_ok() {
        return Err(expected("a file"));
    }
    let extension = path.extension().unwrap_or_default().to_ascii_lowercase();
    match FILE_EXTENSIONS.iter().any(|known| extension == *known) {
        true => Err(expected("the name of a file")),
        false => Ok(path),
    }
}

/// Writes `contents` to the file `path`.
///
/// # Errors
/// If it cannot be written. The old file is then still there.
pub fn write(path: &Path, contents: impl AsRef<[u8]>) -> Result<(), CliError> {
    let mut file = OutputFile::create(path)?;
    let written = file.file().write_all(contents.as_ref());
    written.map_err(|error| CliError::unwritable(path, error))?;
    file.persist()
}

/// A file that is being written.
pub struct OutputFile {
    path: PathBuf,
    place: Destination,
}

/// Where the bytes go.
enum Destination {
    /// Into a file beside `target`, which it then replaces.
    Beside { file: NamedTempFile, target: PathBuf },
    /// Into a file without a name, then into the device or pipe at the path.
    Through(File),
}

impl OutputFile {
    /// Starts the file `path`, and creates its folder if there is none.
    ///
    /// # Errors
    /// When the folder cannot be made or written to, or `path` cannot be replaced.
    pub fn create(path: &Path) -> Result<Self, CliError> {
        refuse_dash(path)?;
        let unwritable = |error| CliError::unwritable(path, error);
        let place = match fs::metadata(path) {
            Ok(about) if about.is_dir() => {
                return Err(unwritable(io::ErrorKind::IsADirectory.into()));
            }
            Ok(about) if !about.is_file() || is_of_system(path) => {
                Destination::Through(tempfile::tempfile().map_err(unwritable)?)
            }
            Ok(about) => {
                refuse_protected(path)?;
                if about.permissions().readonly() {
                    let error = io::Error::new(io::ErrorKind::PermissionDenied, "it is read-only");
                    return Err(unwritable(error));
                }
                // Whoever may not write to the file may not replace it.
                OpenOptions::new().write(true).open(path).map_err(unwritable)?;
                let target = fs::canonicalize(path).map_err(unwritable)?;
                let file = beside(&target)?;
                keep_owner(file.as_file(), &about);
                file.as_file().set_permissions(about.permissions()).map_err(unwritable)?;
                Destination::Beside { file, target }
            }
            Err(_) => {
                let target = link_target(path).map_err(unwritable)?;
                Destination::Beside { file: beside(&target)?, target }
            }
        };
        Ok(Self { path: path.to_owned(), place })
    }

    /// The path of the finished file.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// What is written to.
    pub fn file(&mut self) -> &mut File {
        match &mut self.place {
            Destination::Beside { file, .. } => file.as_file_mut(),
            Destination::Through(file) => file,
        }
    }

    /// Puts the file in its place.
    ///
    /// # Errors
    /// If it cannot be renamed or written. The old file is then still there.
    pub fn persist(self) -> Result<(), CliError> {
        let Self { path, place } = self;
        let written = match place {
            Destination::Beside { file, target } => {
                file.persist(target).map(drop).map_err(|error| error.error)
            }
            Destination::Through(mut file) => file.rewind().and_then(|()| {
                let mut output = OpenOptions::new().write(true).open(&path)?;
                io::copy(&mut file, &mut output)?;
                output.flush()
            }),
        };
        written.map_err(|error| CliError::unwritable(&path, error))
    }
}

/// Refuses `-`, which others take for standard output and files may be called.
fn refuse_dash(path: &Path) -> Result<(), CliError> {
    match path == Path::new("-") {
        false => Ok(()),
        true => {
            let message = "--out -: expected a name, found '-': write /dev/stdout for standard \
                           output, or ./- for a file of this name";
            Err(CliError::Argument(message.to_owned()))
        }
    }
}

/// Whether `path` is a name of an open file, such as `/dev/stdout`.
fn is_of_system(path: &Path) -> bool {
    path.starts_with("/dev") || path.starts_with("/proc")
}

/// Refuses to replace the file `path` if it is read, or handed in.
///
/// # Errors
/// When it may not be replaced.
pub fn refuse_protected(path: &Path) -> Result<(), CliError> {
    if is_of_system(path) {
        return Ok(());
    }
    let refused = |found: &str| {
        let message = format!("--out {}: expected another file, found {found}", path.display());
        Err(CliError::Argument(message))
    };
    if identity(path).is_some_and(|output| lock(&INPUTS).contains(&output)) {
        return refused("one that is read");
    }
    let Ok(target) = fs::canonicalize(path) else { return Ok(()) };
    match lock(&SUBMISSIONS).iter().any(|folder| target.starts_with(folder)) && !is_own(&target) {
        true => refused("one in the folder of a submission"),
        false => Ok(()),
    }
}

#[cfg(unix)]
fn identity(path: &Path) -> Option<Identity> {
    use std::os::unix::fs::MetadataExt as _;
    fs::metadata(path).ok().map(|about| (about.dev(), about.ino()))
}

#[cfg(not(unix))]
fn identity(path: &Path) -> Option<Identity> {
    fs::canonicalize(path).ok()
}

/// The target of a symlink at `path` that does not exist yet; else `path` itself.
fn link_target(path: &Path) -> io::Result<PathBuf> {
    const MOST_LINKS: usize = 40;
    let mut target = path.to_owned();
    for _ in 0..MOST_LINKS {
        match fs::read_link(&target) {
            Ok(next) => target = folder_of(&target).join(next),
            Err(_) => return Ok(target),
        }
    }
    Err(io::Error::other("expected a file, found a link to itself"))
}

fn folder_of(path: &Path) -> &Path {
    path.parent().filter(|folder| *folder != Path::new("")).unwrap_or(Path::new("."))
}

/// Starts a file in the folder of `target`, and creates the folder if there is none.
fn beside(target: &Path) -> Result<NamedTempFile, CliError> {
    let folder = folder_of(target);
    fs::create_dir_all(folder).map_err(|error| CliError::unwritable(folder, error))?;
    unfinished::remove_stale(folder);
    unfinished::start(folder).map_err(|error| CliError::unwritable(target, error))
}

/// Gives `file` the owner of the one it replaces, where the system allows that.
#[cfg(unix)]
fn keep_owner(file: &File, about: &fs::Metadata) {
    use std::os::unix::fs::MetadataExt as _;
    let _ = std::os::unix::fs::fchown(file, Some(about.uid()), Some(about.gid()));
}

#[cfg(not(unix))]
fn keep_owner(_: &File, _: &fs::Metadata) {}
