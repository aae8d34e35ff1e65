//! Reading lists, whoever wrote them.

use std::fs::File;
use std::io::{BufRead, BufReader};
use std::path::Path;

use super::error::ListError;
use super::record::{Columns, PhotonRecord};
use super::{csv, ply};

/// A list in memory.
#[derive(Clone, Debug, PartialEq)]
pub struct PhotonList {
    /// What the list has besides positions; other columns of its records are
    /// [`PhotonRecord::ABSENT`].
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

/// Reads the list `path` into memory if it has no more than `most` records, whatever its size.
///
/// # Errors
/// When the file cannot be read, is not a list, or has more records.
pub fn load_at_most(path: &Path, most: usize) -> Result<PhotonList, ListError> {
    let mut records = Vec::new();
    let columns = read_until(path, |record| {
        records.push(record);
        if records.len() > most {
            return Err(ListError::malformed(path, format!("expected at most {most} records")));
        }
        Ok(())
    })?;
    Ok(PhotonList { columns, records })
}

/// Reads the list `path`, CSV or PLY as its first bytes tell, and hands over record after record.
/// It may have any of the columns of [`super::record::COLUMNS`], in any order, if x, y and z are
/// among them; other columns are passed over.
///
/// # Errors
/// When the file cannot be read or is not a list.
pub fn read(path: &Path, mut on_record: impl FnMut(PhotonRecord)) -> Result<Columns, ListError> {
    read_until(path, |record| {
        on_record(record);
        Ok(())
    })
}

/// As [`read`], up to the first error of `on_record`.
fn read_until(
    path: &Path,
    on_record: impl FnMut(PhotonRecord) -> Result<(), ListError>,
) -> Result<Columns, ListError> {
    let unreadable = |error| ListError::unreadable(path, error);
    let mut input = BufReader::with_capacity(1 << 20, File::open(path).map_err(unreadable)?);
    let start = input.fill_buf().map_err(unreadable)?;
    if start.starts_with(b"ply\n") || start.starts_with(b"ply\r\n") {
        ply::read(input, path, on_record)
    } else {
        csv::read(input, path, on_record)
    }
}
