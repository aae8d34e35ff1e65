//! Files that are being written, beside their places.

use std::collections::HashSet;
use std::fs::{self, File, TryLockError};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard};

use tempfile::{NamedTempFile, TempDir};

use crate::error::escaped;

const PREFIX: &str = ".unfinished-";
/// How many letters follow it.
const RANDOM: usize = 6;

/// Those of this process.
static UNFINISHED: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

/// Folders in which those of other processes were looked for.
static SEARCHED: Mutex<Option<HashSet<PathBuf>>> = Mutex::new(None);

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(|poisoned| poisoned.into_inner())
}

/// Starts a file in `folder`, locked as long as it is being written.
pub fn start(folder: &Path) -> io::Result<NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(PREFIX).rand_bytes(RANDOM);
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    loop {
        // The list is held from before the file exists until it is known, so that no interrupt
        // falls in between.
        let mut unfinished = lock(&UNFINISHED);
        let file = builder.tempfile_in(folder)?;
        // Where a file system has no locks, nobody can take this file for a stale one.
        let _ = file.as_file().try_lock();
        // Another process may have found it before it was locked.
        if file.path().exists() {
            unfinished.push(file.path().to_owned());
            return Ok(file);
        }
    }
}

/// A folder for what is only read by this process, and removed when it ends.
pub fn temporary_folder() -> io::Result<TempDir> {
    let mut unfinished = lock(&UNFINISHED);
    let folder = tempfile::tempdir()?;
    unfinished.push(folder.path().to_owned());
    Ok(folder)
}

/// Removes the unfinished files and temporary folders of this process. After that, none can be
/// started.
pub fn remove_own() -> MutexGuard<'static, Vec<PathBuf>> {
    let unfinished = lock(&UNFINISHED);
    for path in unfinished.iter() {
        let _ = fs::remove_file(path).or_else(|_| fs::remove_dir_all(path));
    }
    unfinished
}

/// Removes the files that killed processes left in `folder`, and reports them.
pub fn remove_stale(folder: &Path) {
    if !lock(&SEARCHED).get_or_insert_default().insert(folder.to_owned()) {
        return;
    }
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        let name = entry.file_name();
        let letters = name.to_str().and_then(|name| name.strip_prefix(PREFIX));
        let is_ours = letters.is_some_and(|letters| {
            letters.len() == RANDOM && letters.bytes().all(|byte| byte.is_ascii_alphanumeric())
        });
        if is_ours && entry.file_type().is_ok_and(|kind| kind.is_file()) && is_stale(&entry.path())
        {
            let path = entry.path();
            if fs::remove_file(&path).is_ok() {
                let path = path.display().to_string();
                eprintln!("note: removed {}, which a killed run has left", escaped(&path));
            }
        }
    }
}

/// Whether no process writes to `path`.
fn is_stale(path: &Path) -> bool {
    let Ok(file) = File::open(path) else { return false };
    !matches!(file.try_lock(), Err(TryLockError::WouldBlock | TryLockError::Error(_)))
}
