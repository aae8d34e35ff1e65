//! Reading lists, whoever wrote them.

use std::fs::File;
use std::io::{self, BufRead, BufReader, Read};
use std::path::Path;

use photon_mapping::photon_list::PhotonRecord;

use super::dialect::Naming;
use super::error::ListError;
use super::record::Columns;
use super::{csv, ply};

/// A list of five million records, in as many digits as floats can have, is shorter than this.
const MOST_BYTES: u64 = 1 << 30;
/// So much of a file is looked at to see whether it is a list.
const LONGEST_START: u64 = 4096;

/// A list in memory.
#[derive(Clone, Debug, PartialEq)]
pub struct PhotonList {
    /// What the list has besides positions; other columns of its records are
    /// [`super::record::ABSENT`].
    pub columns: Columns,
    /// The records, in the file's order.
    pub records: Vec<PhotonRecord>,
}

/// Reads the list `path` into memory.
///
/// # Errors
/// When the file cannot be read or is not a list.
pub fn load(path: &Path) -> Result<PhotonList, ListError> {
    let mut records = Vec::new();
    let columns = read(path, |record| records.push(record))?;
    Ok(PhotonList { columns, records })
}

/// Reads the list `path` into memory if it is a file of no more than `most` records, in bounded time and
/// memory whatever it holds; also gives what had to be guessed about it.
///
/// # Errors
/// When the file cannot be read, is not a list, or is too long.
pub fn load_at_most(path: &Path, most: usize) -> Result<(PhotonList, Option<String>), ListError> {
    // To open a pipe would be to wait for its other end.
    let about = std::fs::metadata(path).map_err(|error| ListError::unreadable(path, error))?;
    if !about.is_file() {
        return Err(ListError::malformed(path, "expected a file, found a folder, pipe or device"));
    }
    if about.len() > MOST_BYTES {
        let (found, most) = (about.len() >> 20, MOST_BYTES >> 20);
        let message = format!("expected a list of at most {most} MiB, found {found}");
        return Err(ListError::malformed(path, message));
    }
    let mut records = Vec::new();
    let naming = read_until(path, MOST_BYTES, |record| {
        if records.len() == most {
            return Err(ListError::malformed(path, format!("expected at most {most} records")));
        }
        records.push(record);
        Ok(())
    })?;
    Ok((PhotonList { columns: naming.columns, records }, naming.note))
}

/// Whether the file `path` starts like a list.
///
/// # Errors
/// When the file cannot be read.
pub fn starts_like_a_list(path: &Path) -> io::Result<bool> {
    let mut start = Vec::new();
    File::open(path)?.take(LONGEST_START).read_to_end(&mut start)?;
    // It may end within a letter.
    let text = start.utf8_chunks().next().map_or("", |chunk| chunk.valid());
    Ok(is_ply(&start) || csv::is_start(text))
}

/// Reads the list `path`, PLY or text as its first bytes tell, and hands over record after record.
/// It may have any of the columns of [`photon_mapping::photon_list::COLUMNS`], in any order, if x, y and z are
/// among them; other columns are passed over.
///
/// # Errors
/// When the file cannot be read or is not a list.
pub fn read(path: &Path, mut on_record: impl FnMut(PhotonRecord)) -> Result<Columns, ListError> {
    let naming = read_until(path, u64::MAX, |record| {
        on_record(record);
        Ok(())
    })?;
    Ok(naming.columns)
}

/// As [`read`], up to the first error of `on_record`, or byte `most`.
fn read_until(
    path: &Path,
    most: u64,
    on_record: impl FnMut(PhotonRecord) -> Result<(), ListError>,
) -> Result<Naming, ListError> {
    let unreadable = |error| ListError::unreadable(path, error);
    let file = File::open(path).map_err(unreadable)?.take(most);
    let mut input = BufReader::with_capacity(1 << 20, file);
    if is_ply(input.fill_buf().map_err(unreadable)?) {
        ply::read(input, path, on_record)
    } else {
        csv::read(input, path, on_record)
    }
}

fn is_ply(start: &[u8]) -> bool {
    start.starts_with(b"ply\n") || start.starts_with(b"ply\r\n")
}
