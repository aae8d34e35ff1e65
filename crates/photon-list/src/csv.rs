//! Lists as comma-separated values, for everything that is not made for point clouds.

use std::fmt::Write as _;
use std::io::{BufRead, Read};
use std::path::Path;

use photon_mapping::photon_list::{COLUMNS, PhotonRecord};

use super::dialect::{Dialect, Naming};
use super::error::ListError;
use super::record::{ABSENT, Value, set};

/// A line longer than this is no row of a photon list.
const LONGEST_LINE: u64 = 65_536;
/// A file with more lines of nothing is no list.
const MOST_EMPTY_LINES: u64 = 1_000_000;

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

/// Reads the list in `input`, the contents of the file `path`: also with other separators than commas,
/// and without names of columns where there are just three.
pub(super) fn read(
    mut input: impl BufRead,
    path: &Path,
    mut on_record: impl FnMut(PhotonRecord) -> Result<(), ListError>,
) -> Result<Naming, ListError> {
    let start = input.fill_buf().map_err(|error| ListError::unreadable(path, error))?;
    if start.starts_with(b"\xff\xfe") || start.starts_with(b"\xfe\xff") {
        let message = "expected UTF-8 text, found UTF-16, as '>' of PowerShell writes it";
        return Err(ListError::malformed(path, message));
    }
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
    let mut first = next_line(&mut line)?;
    if first.is_none() {
        return Err(ListError::malformed(path, "the file is empty: it has no bytes at all"));
    }
    while let Some(number) = first.filter(|_| is_before_the_list(&line)) {
        if number > MOST_EMPTY_LINES {
            let message = format!("line {number}: expected fewer lines of comment");
            return Err(ListError::malformed(path, message));
        }
        first = next_line(&mut line)?;
    }
    let Some(first) = first else {
        return Err(ListError::malformed(path, "expected a photon list, found only comments"));
    };
    let dialect = Dialect::of(&line)
        .map_err(|message| ListError::malformed(path, format!("line {first}: {message}")))?;
    let places = &dialect.naming.places;
    let mut empty = 0;
    let mut at = if dialect.has_header { next_line(&mut line)? } else { Some(first) };
    while let Some(number) = at {
        let row = line.trim_start_matches('\u{feff}').trim();
        if row.is_empty() {
            empty += 1;
            if empty > MOST_EMPTY_LINES {
                let message = format!("line {number}: expected fewer empty lines");
                return Err(ListError::malformed(path, message));
            }
        } else {
            on_record(record(row, &dialect, places).map_err(|message| {
                ListError::malformed(path, format!("line {number}: {message}"))
            })?)?;
        }
        at = next_line(&mut line)?;
    }
    Ok(dialect.naming)
}

/// Whether a list could start like `start`, which may end within a line.
pub(super) fn is_start(start: &str) -> bool {
    let first = start.lines().find(|line| !is_before_the_list(line));
    first.is_some_and(|line| Dialect::of(line).is_ok())
}

/// Whether `line` is a comment, or the line that tells Excel what is between values: `#` may also come before the
/// names of the columns.
fn is_before_the_list(line: &str) -> bool {
    let line = line.trim_start_matches('\u{feff}').trim().trim_matches('"');
    line.to_ascii_lowercase().starts_with("sep=")
        || (line.starts_with('#') && Dialect::of(line).is_err())
}

fn record(row: &str, dialect: &Dialect, places: &[Option<usize>]) -> Result<PhotonRecord, String> {
    let mut record = ABSENT;
    let mut cells = dialect.cells(row);
    for (seen, place) in places.iter().enumerate() {
        let text = cells
            .next()
            .ok_or_else(|| format!("expected {} values, found {seen}", places.len()))?;
        if let Some(place) = *place {
            set(&mut record, place, Value::Text(&dialect.with_point(text))).ok_or_else(|| {
                let name = COLUMNS[place];
                let found = text.chars().take(40).collect::<String>();
                format!("expected a number for '{name}', found '{found}'")
            })?;
        }
    }
    match cells.count() {
        0 => Ok(record),
        more => Err(format!("expected {} values, found {}", places.len(), places.len() + more)),
    }
}
