//! Lists as comma-separated values, for everything that is not made for point clouds.
//!
//! This is our own reader because the crates for CSV do not read the dialects of other programs:
//! white space between values, names of columns in a comment, counts of rows, decimal commas.

use std::fmt::Write as _;
use std::io::BufRead;
use std::path::Path;

use photon_mapping::photon_list::{COLUMNS, PhotonRecord};

use super::dialect::{Dialect, commented};
use super::error::{At, ListError};
use super::naming::Naming;
use super::record::{ABSENT, Rows, Value};
use super::text::Lines;
use super::units::refused_in_comment;

/// In so many bytes of comments the names of columns are looked for: that takes longer than reading
/// them.
const MOST_IN_COMMENTS: usize = 16_384;

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

/// What a list in text starts with.
pub(super) struct TextStart {
    dialect: Dialect,
    /// The first row, where no names precede it.
    first: Option<(u64, String)>,
    /// How many rows a line says there are, and which line.
    count: Option<(u64, u64)>,
    /// How many bytes of comments were read.
    comments: usize,
}

/// Reads up to the first row from line `next` on: also with other separators than commas, and
/// without names of columns where there are just three.
pub(super) fn start(
    lines: &mut Lines<impl BufRead>,
    mut next: Option<(u64, String)>,
) -> Result<TextStart, ListError> {
    let path = lines.path;
    let mut of_comment = None;
    let mut comments = 0;
    let mut count = None;
    let is_empty = next.is_none();
    while let Some((number, line)) = next {
        let row = line.trim();
        if let Some(comment) = commented(row) {
            comments += comment.len();
            if comments <= MOST_IN_COMMENTS {
                refuse_commented_unit(path, number, comment)?;
                let dialect = Dialect::of(comment.trim()).ok();
                refuse_other_unit(path, number, dialect.as_ref())?;
                of_comment = dialect.filter(|dialect| dialect.has_header).or(of_comment);
            }
        } else if let (None, Ok(rows)) = (count, row.parse()) {
            count = Some((rows, number));
        } else if !row.is_empty() && !tells_separator(row) {
            let (dialect, first) = match (Dialect::of(row), of_comment) {
                (Ok(dialect), _) if dialect.has_header => (dialect, None),
                (_, Some(dialect)) | (Ok(dialect), None) => (dialect, Some((number, line))),
                (Err(message), None) => return Err(ListError::in_line(path, number, message)),
            };
            refuse_other_unit(path, number, Some(&dialect))?;
            return Ok(TextStart { dialect, first, count, comments });
        }
        next = lines.next()?.map(|(number, line)| (number, line.into_owned()));
    }
    let dialect = of_comment.ok_or_else(|| match is_empty {
        true => ListError::malformed(path, "the file is empty: it has nothing but white space"),
        false => ListError::malformed(path, "expected a photon list, found only comments"),
    })?;
    Ok(TextStart { dialect, first: None, count, comments })
}

/// Refuses the names in line `number` where they say that positions are not in meters.
fn refuse_other_unit(path: &Path, number: u64, dialect: Option<&Dialect>) -> Result<(), ListError> {
    match dialect.and_then(|dialect| dialect.naming.other_unit.clone()) {
        None => Ok(()),
        Some(reason) => Err(ListError::in_line(path, number, reason)),
    }
}

/// The same of a comment.
fn refuse_commented_unit(path: &Path, number: u64, comment: &str) -> Result<(), ListError> {
    match refused_in_comment(comment) {
        None => Ok(()),
        Some(reason) => Err(ListError::in_line(path, number, reason)),
    }
}

/// Whether `line` tells Excel what is between values.
fn tells_separator(line: &str) -> bool {
    let line = line.trim_matches('"').as_bytes();
    line.get(..4).is_some_and(|start| start.eq_ignore_ascii_case(b"sep="))
}

/// Reads the rows behind `start`.
pub(super) fn read(
    lines: &mut Lines<impl BufRead>,
    start: TextStart,
    rows: &mut Rows<impl FnMut(PhotonRecord) -> Result<bool, ListError>>,
) -> Result<Naming, ListError> {
    let path = lines.path;
    let TextStart { mut dialect, first, mut count, mut comments } = start;
    let mut records = 0;
    let mut number_of_row: Option<Option<u64>> = None;
    let mut empty = 0_u64;
    let mut first_empty = None;
    let mut doubtful = None;
    let mut row = |number: u64, line: &str| -> Result<bool, ListError> {
        let (whole, line) = (line, line.trim());
        let is_empty_row = line.is_empty() && dialect.is_empty_row(whole);
        if line.is_empty() && !is_empty_row {
            return Ok(true);
        }
        if let Some(comment) = commented(line) {
            comments = comments.saturating_add(comment.len());
            if comments <= MOST_IN_COMMENTS {
                refuse_commented_unit(path, number, comment)?;
            }
            return Ok(true);
        }
        if let (0, None, Ok(rows)) = (records, count, line.parse()) {
            count = Some((rows, number));
            return Ok(true);
        }
        let next = number_of_row.get_or_insert_with(|| {
            let has_number = dialect.has_number(line);
            doubtful = (has_number && dialect.is_doubtful_number(line)).then_some(number);
            has_number.then(|| u64::from(line.trim_matches('"').starts_with('1')))
        });
        let record = match is_empty_row {
            true => None,
            false => record(path, line, (number, *next), &dialect, rows)?,
        };
        let Some(record) = record else {
            empty += 1;
            first_empty = first_empty.or(Some(number));
            return Ok(true);
        };
        // pandas writes nothing for NaN; spreadsheets write empty rows, but at the end.
        if let Some(line) = first_empty {
            return Err(ListError::in_line(
                path,
                line,
                "expected a photon, found only empty values",
            ));
        }
        *next = next.map(|next| next + 1);
        records += 1;
        (rows.on_record)(record)
    };
    let mut wants_more = match first {
        Some((number, line)) => row(number, &line)?,
        None => true,
    };
    while wants_more {
        let Some((number, line)) = lines.next()? else { break };
        wants_more = row(number, &line)?;
    }
    let expected = dialect.naming.places.len();
    if let (Some(line), 1) = (doubtful, records) {
        return Err(other_number(path, line, expected, expected + 1));
    }
    if let Some(Some(_)) = number_of_row {
        dialect.naming.tell("the first value of each row is taken for its number".to_owned());
    }
    if let Some(line) = first_empty {
        let rows = if empty == 1 { "row" } else { "rows" };
        let note = format!("{empty} {rows} of only empty values, from line {line} on");
        dialect.naming.tell(note);
    }
    match count {
        Some((expected, line)) if wants_more && expected != records => {
            let message = format!("expected {expected} photons, found {records}");
            Err(ListError::in_line(path, line, message))
        }
        _ => Ok(dialect.naming),
    }
}

fn other_number(path: &Path, line: u64, expected: usize, found: usize) -> ListError {
    ListError::in_line(path, line, format!("expected {expected} values, found {found}"))
}

/// The record in `row`, which is line `number` and starts with its own `number_of_row` if there is
/// one; none where all values are empty.
fn record(
    path: &Path,
    row: &str,
    (number, number_of_row): (u64, Option<u64>),
    dialect: &Dialect,
    rows: &mut Rows<impl FnMut(PhotonRecord) -> Result<bool, ListError>>,
) -> Result<Option<PhotonRecord>, ListError> {
    let mut record = ABSENT;
    let mut cells = dialect.cells(row);
    if let Some(expected) = number_of_row
        && cells.next().and_then(|cell| cell.parse().ok()) != Some(expected)
    {
        let names = dialect.naming.places.len();
        let message = format!(
            "expected {expected}, the number of the row, as the first of {} values: the header \
             has {names} names",
            names + 1
        );
        return Err(ListError::in_line(path, number, message));
    }
    let places = &dialect.naming.places;
    let other_number = |found: usize| other_number(path, number, places.len(), found);
    for (seen, place) in places.iter().enumerate() {
        let text = cells.next().ok_or_else(|| other_number(seen))?;
        let Some(place) = *place else { continue };
        if text.is_empty() && dialect.cells(row).all(str::is_empty) {
            return Ok(None);
        }
        rows.set(&mut record, place, Value::Cell(text), At::Line(number))?;
    }
    // A separator at the end of a row is not followed by a value.
    match cells.enumerate().filter(|(_, text)| !text.is_empty()).last() {
        None => Ok(Some(record)),
        Some((last, _)) => Err(other_number(places.len() + last + 1)),
    }
}
