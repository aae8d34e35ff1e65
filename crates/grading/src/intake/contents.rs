//! Which files are the same, byte by byte.

use std::fs::{self, File};
use std::io::{self, Read};
use std::path::PathBuf;

use sha2::{Digest, Sha256};

/// Larger files are not held against each other: no picture of the assignment is larger.
const MOST_COMPARED: u64 = 1 << 25;

/// How many bytes a file has, and their SHA-256.
pub type Contents = (u64, [u8; 32]);

/// The contents of those `files` that are as long as another one: no others can be the same.
pub fn contents(files: &[Option<PathBuf>]) -> Vec<Option<Contents>> {
    let length = |file: &Option<PathBuf>| Some(fs::metadata(file.as_ref()?).ok()?.len());
    let lengths: Vec<Option<u64>> = files.iter().map(length).collect();
    let contents = |at: usize| {
        let length = lengths[at].filter(|length| *length <= MOST_COMPARED)?;
        let is_alone = lengths.iter().filter(|other| **other == Some(length)).count() == 1;
        if is_alone {
            return None;
        }
        let file = File::open(files[at].as_ref()?).ok()?;
        let mut hash = Sha256::new();
        let mut input = io::BufReader::with_capacity(1 << 16, file.take(MOST_COMPARED));
        loop {
            let bytes = io::BufRead::fill_buf(&mut input).ok()?;
            if bytes.is_empty() {
                break;
            }
            hash.update(bytes);
            let read = bytes.len();
            io::BufRead::consume(&mut input, read);
        }
        Some((length, hash.finalize().into()))
    };
    (0..files.len()).map(contents).collect()
}

/// Whether all of `files` are the same.
pub fn same_contents(files: &[PathBuf]) -> bool {
    let contents = contents(&files.iter().cloned().map(Some).collect::<Vec<_>>());
    contents[0].is_some() && contents.iter().all(|other| *other == contents[0])
}
