//! What the targets share: an input as a file, since the readers read files.

use std::path::Path;

use photon_list::reader::{load, load_at_most, look};

/// A folder in memory, where there is one.
const MEMORY: &str = "/dev/shm";

/// Calls `read` with a file called `name` that holds `data`.
pub fn with_file<T>(name: &str, data: &[u8], read: impl FnOnce(&Path) -> T) -> T {
    let parent = if Path::new(MEMORY).is_dir() { MEMORY.into() } else { std::env::temp_dir() };
    let folder = tempfile::tempdir_in(parent).expect("a folder can be made");
    let path = folder.path().join(name);
    std::fs::write(&path, data).expect("a file can be written");
    read(&path)
}

/// Reads the list in `data` as every verb does. What `compare` reads, `grade` reads, too, and the
/// same.
pub fn read_list(data: &[u8]) {
    with_file("list", data, |path| {
        let _ = look(path);
        let strict = load(path);
        let lenient = load_at_most(path, 10_000);
        if let (Ok(strict), Ok((lenient, notes))) = (&strict, &lenient) {
            assert!(notes.left_out.is_empty());
            assert_eq!(format!("{strict:?}"), format!("{lenient:?}"));
        }
        if let (Ok(strict), Err(_)) = (&strict, &lenient) {
            assert!(strict.records.len() > 10_000);
        }
    });
}
