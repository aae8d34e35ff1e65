//! Lists as comma-separated values, for everything that is not made for point clouds.

use std::fmt::Write as _;
use std::io::{BufRead, Read};
use std::path::Path;

use super::error::ListError;
use super::record::{COLUMNS, Columns, PhotonRecord, Value};

/// A line longer than this is no row of a photon list.
const LONGEST_LINE: u64 = 65_536;

/// The first line: the names of the columns.
pub fn header() -> String {
    COLUMNS.join(",") + "\n"
}

/// Adds the line of `record` to `text`. Floats have as few digits as bring back the same bits.
pub fn push_line(text: &mut String, record: &PhotonRecord) {
    for vector in [record.position, record.intensity, record.to_light] {
        for float in vector.to_array() {
            write!(text, "{float:?},").expect("a string takes everything");
        }
    }
    let PhotonRecord { photon, bounce, surface, .. } = record;
    writeln!(text, "{photon},{bounce},{surface}").expect("a string takes everything");
}

/// Reads the list in `input`, the contents of the file `path`.
pub(super) fn read(
    mut input: impl BufRead,
    path: &Path,
    mut on_record: impl FnMut(PhotonRecord) -> Result<(), ListError>,
) -> Result<Columns, ListError> {
    let mut line = String::new();
    let mut number = 0;
    let mut next_line = |line: &mut String| {
        line.clear();
        number += 1;
        let length =
            input.by_ref().take(LONGEST_LINE).read_line(line).map_err(|error| {
                match error.kind() {
                    std::io::ErrorKind::InvalidData => {
                        ListError::malformed(path, format!("line {number}: expected text"))
                    }
                    _ => ListError::unreadable(path, error),
                }
            })?;
        if length as u64 == LONGEST_LINE {
            let message = format!("line {number}: expected at most {LONGEST_LINE} bytes in a line");
            return Err(ListError::malformed(path, message));
        }
        Ok((length > 0).then_some(number))
    };
    if next_line(&mut line)?.is_none() {
        return Err(ListError::malformed(path, "expected a photon list, found an empty file"));
    }
    let names = line.trim_start_matches('\u{feff}').trim().split(',').map(cell);
    let (columns, places) = Columns::of(names)
        .map_err(|message| ListError::malformed(path, format!("line 1: {message}")))?;
    while let Some(number) = next_line(&mut line)? {
        let row = line.trim();
        if row.is_empty() {
            continue;
        }
        let mut record = PhotonRecord::ABSENT;
        let mut cells = 0;
        for (text, place) in row.split(',').map(cell).zip(&places) {
            cells += 1;
            if let Some(place) = *place {
                record.set(place, Value::Text(text)).ok_or_else(|| {
                    let name = COLUMNS[place];
                    let found = text.chars().take(40).collect::<String>();
                    let message =
                        format!("line {number}: expected a number for '{name}', found '{found}'");
                    ListError::malformed(path, message)
                })?;
            }
        }
        if cells < places.len() || row.split(',').nth(places.len()).is_some() {
            let found = row.split(',').count();
            let expected = places.len();
            let message = format!("line {number}: expected {expected} values, found {found}");
            return Err(ListError::malformed(path, message));
        }
        on_record(record)?;
    }
    Ok(columns)
}

fn cell(text: &str) -> &str {
    text.trim().trim_matches('"')
}
