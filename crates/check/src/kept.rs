//! The kit in the user's folder for what programs keep: the next run need not compile it again.

use std::fs::{self, File};
use std::hash::{DefaultHasher, Hash, Hasher as _};
use std::io;
use std::os::unix::fs::{DirBuilderExt as _, MetadataExt as _, PermissionsExt as _};
use std::path::{Path, PathBuf};
use std::time::{Duration, SystemTime};

use crate::kit::{ASSETS, PREFIX, write_assets};

/// What is not used for so long is removed.
const OLD: Duration = Duration::from_secs(30 * 24 * 60 * 60);

/// `$XDG_CACHE_HOME`, else `~/.cache`. Elsewhere than on Linux, no filter keeps a submission from
/// writing there.
pub(crate) fn users_folder() -> Option<PathBuf> {
    let folder = |name: &str| {
        let folder = std::env::var_os(name).map(PathBuf::from);
        folder.filter(|folder| cfg!(target_os = "linux") && folder.is_absolute())
    };
    folder("XDG_CACHE_HOME").or_else(|| Some(folder("HOME")?.join(".cache")))
}

/// A kit in `parent` for compilers and headers that `key` tells apart, locked against removal;
/// nothing where it cannot be kept, or is not as this user wrote it.
pub(crate) fn kept(parent: &Path, key: impl Hash) -> Option<(PathBuf, File)> {
    let mut hasher = DefaultHasher::new();
    (parent, key, ASSETS).hash(&mut hasher);
    let folder = parent.join(format!("{PREFIX}{:016x}", hasher.finish()));
    if !folder.exists() {
        remove_unused(parent, OLD);
        // It fails where it is there already.
        let _ = fs::DirBuilder::new().mode(0o700).create(parent);
        let owner_only = fs::Permissions::from_mode(0o700);
        let mut new = tempfile::Builder::new();
        let new = new.prefix(PREFIX).permissions(owner_only).tempdir_in(parent).ok()?;
        write_assets(new.path()).ok()?;
        // It fails where another process was faster.
        let _ = fs::rename(new.path(), &folder);
    }
    let lock = File::open(&folder).ok()?;
    lock.lock_shared().ok()?;
    let about = fs::symlink_metadata(&folder).ok()?;
    let user = rustix::process::geteuid().as_raw();
    let is_own = about.is_dir() && about.uid() == user && about.mode() & 0o077 == 0;
    let is_whole = |(path, content): &(&str, &str)| {
        fs::read(folder.join(path)).is_ok_and(|found| found == content.as_bytes())
    };
    if !is_own || !ASSETS.iter().all(is_whole) {
        return None;
    }
    lock.set_modified(SystemTime::now()).ok()?;
    Some((folder, lock))
}

/// Writes the file `path` whole or not at all: `make` writes it under another name. Nothing is
/// written where that answers no.
pub(crate) fn make_whole(
    path: &Path,
    make: impl FnOnce(&Path) -> io::Result<bool>,
) -> io::Result<()> {
    let new = tempfile::NamedTempFile::new_in(path.parent().unwrap_or(Path::new("")))?;
    if make(new.path())? {
        // A file that is empty after the system crashed would be taken for a whole one.
        File::open(new.path())?.sync_all()?;
        new.persist(path)?;
    }
    Ok(())
}

/// Removes the kits in `parent` that no process locks, and that nobody used for as long as `age`.
pub(crate) fn remove_unused(parent: &Path, age: Duration) {
    let user = rustix::process::geteuid().as_raw();
    for entry in fs::read_dir(parent).into_iter().flatten().flatten() {
        let is_ours = entry.file_name().to_string_lossy().starts_with(PREFIX)
            && fs::symlink_metadata(entry.path()).is_ok_and(|about| {
                let unused = about.modified().ok().and_then(|modified| modified.elapsed().ok());
                about.is_dir() && about.uid() == user && unused.is_some_and(|unused| unused > age)
            });
        if is_ours && File::open(entry.path()).is_ok_and(|folder| folder.try_lock().is_ok()) {
            // What cannot be removed now is tried again by the next run.
            let _ = fs::remove_dir_all(entry.path());
        }
    }
}

#[cfg(test)]
mod tests {
    use std::ffi::OsString;

    use super::*;
    use crate::kit::write;

    const YOUNG: Duration = Duration::from_secs(60);

    /// What another user could have written, or what is not whole, is not used.
    #[test]
    fn a_kit_is_kept_for_the_next_run() {
        let parent = tempfile::tempdir().expect("a folder");
        let first = || kept(parent.path(), "a compiler").map(|(folder, _)| folder);
        let folder = first().expect("it is kept");
        assert_eq!(first(), Some(folder.clone()));
        assert_ne!(kept(parent.path(), "another").expect("it is kept").0, folder);
        assert!(kept(&folder.join("nosuch/nosuch"), "a compiler").is_none());
        let set_mode = |mode| fs::set_permissions(&folder, fs::Permissions::from_mode(mode));
        for mode in [0o770, 0o707] {
            set_mode(mode).expect("can be set");
            assert_eq!(first(), None, "{mode:o}");
        }
        set_mode(0o700).expect("can be set");
        assert_eq!(first(), Some(folder.clone()));
        fs::write(folder.join(ASSETS[1].0), "").expect("can be written");
        assert_eq!(first(), None);
        fs::remove_dir_all(&folder).expect("can be removed");
        std::os::unix::fs::symlink(parent.path(), &folder).expect("a link");
        assert_eq!(first(), None);
    }

    #[test]
    fn files_are_made_whole_or_not_at_all() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("harness.o");
        let make = |fails: bool| {
            make_whole(&path, |new| fs::write(new, "half").map(|()| !fails)).expect("can be made");
            fs::read_dir(folder.path()).expect("a folder").count()
        };
        assert_eq!(make(true), 0);
        assert_eq!(make(false), 1);
    }

    #[test]
    fn only_folders_that_a_killed_process_left_are_removed() {
        let parent = tempfile::tempdir().expect("a folder");
        let at = |name: &str| parent.path().join(name);
        let outside = tempfile::tempdir().expect("a folder");
        for name in [&format!("{PREFIX}old"), &format!("{PREFIX}locked"), "other"] {
            write(&at(name).join("submission-1/a.o"), b"").expect("can be written");
        }
        std::os::unix::fs::symlink(outside.path(), at("photon-mapping-check-link"))
            .expect("a link");
        let now = std::time::SystemTime::now();
        for entry in fs::read_dir(parent.path()).expect("a folder").flatten() {
            let folder = File::open(entry.path()).expect("a folder");
            folder.set_modified(now - 2 * YOUNG).expect("can be set");
        }
        write(&at("photon-mapping-check-young").join("plan.txt"), b"").expect("can be written");
        let lock = File::open(at("photon-mapping-check-locked")).expect("a folder");
        lock.lock().expect("can be locked");
        remove_unused(parent.path(), YOUNG);
        let left = fs::read_dir(parent.path()).expect("a folder").flatten();
        let mut left: Vec<_> = left.map(|entry| entry.file_name()).collect();
        left.sort();
        let names = ["check-link", "check-locked", "check-young"];
        let names = names.map(|name| format!("photon-mapping-{name}"));
        assert_eq!(left[1..], names.map(OsString::from));
        assert!(left[0] == "other" && outside.path().is_dir());
        // Closing is not enough: a compiler that another test starts may hold a copy for a moment.
        lock.unlock().expect("can be unlocked");
        remove_unused(parent.path(), YOUNG);
        assert!(!at("photon-mapping-check-locked").exists());
    }
}
