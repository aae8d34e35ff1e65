//! What is between the values of somebody's list, and whether names precede them.

use photon_mapping::photon_list::COLUMNS;

use super::naming::Naming;
use super::record::Value;

/// How comments start, which may hold the names of the columns: NumPy, CloudCompare, MATLAB.
const COMMENTS: [&str; 3] = ["#", "//", "%"];

/// How a list in text is written.
#[derive(Debug)]
pub(super) struct Dialect {
    /// Between two values; nothing where white space is.
    separator: Option<char>,
    /// Which column is which.
    pub naming: Naming,
    /// Whether the first line names the columns.
    pub has_header: bool,
}

/// `line` without what starts a comment, if it is one.
pub(super) fn commented(line: &str) -> Option<&str> {
    COMMENTS.iter().find_map(|mark| line.strip_prefix(mark)).filter(|_| !is_of_spreadsheet(line))
}

/// Whether `line` starts with what spreadsheets write for a number that is none: `#NUM!`, `#NAME?`,
/// `#N/A`.
fn is_of_spreadsheet(line: &str) -> bool {
    let first = line.split([',', ';', '\t', ' ']).next().unwrap_or_default();
    let is_called_so = first.ends_with(['!', '?']) || first == "#N/A";
    is_called_so && first.starts_with('#') && !first.contains(char::is_lowercase)
}

impl Dialect {
    /// The dialect of a list with the first line `line`. `Err` says what was expected.
    pub fn of(line: &str) -> Result<Self, String> {
        // A comma may also be part of a number, and anything part of a name.
        let separators = [';', '\t', ','].into_iter().filter(|separator| line.contains(*separator));
        let mut wrong = None;
        for separator in separators.map(Some).chain([None]) {
            match Self::separated(line, separator) {
                Ok(dialect) => return Ok(dialect),
                Err(message) => wrong = wrong.or(Some(message)),
            }
        }
        Err(wrong.expect("white space at least separates"))
    }

    fn separated(line: &str, separator: Option<char>) -> Result<Self, String> {
        let mut first: Vec<&str> = cells(line, separator).collect();
        while first.last().is_some_and(|name| name.is_empty()) {
            first.pop();
        }
        let is_number = |text: &&str| Value::Cell(text).float().is_some();
        let has_header = !first.iter().all(is_number);
        let mut naming = match first.len() {
            _ if has_header => Naming::of(&first)?,
            3 => Naming {
                note: Some("no names of columns: the three are taken for x, y and z".to_owned()),
                ..Naming::of(&COLUMNS[..3])?
            },
            count => {
                return Err(format!(
                    "expected the names of the columns, x, y and z among them, found {count} \
                     values (only a list of three columns can do without names)"
                ));
            }
        };
        let between = match separator {
            Some(',') => None,
            Some(';') => Some("semicolons between values"),
            Some(_) => Some("tabs between values"),
            None => Some("spaces between values"),
        };
        let notes: Vec<String> =
            between.map(str::to_owned).into_iter().chain(naming.note.take()).collect();
        naming.note = (!notes.is_empty()).then(|| notes.join("; "));
        Ok(Self { separator, naming, has_header })
    }

    /// Whether `row` has one value more than the header names, as R writes tables: its number.
    pub fn has_number(&self, row: &str) -> bool {
        let values: Vec<&str> = self.cells(row).take(self.naming.places.len() + 2).collect();
        self.has_header
            && values.len() == self.naming.places.len() + 1
            && values.last().is_some_and(|last| !last.is_empty())
            && matches!(values[0], "0" | "1")
    }

    /// Whether the number of `row` may be a value as well, if there is no other row: between commas
    /// and without quotes.
    pub fn is_doubtful_number(&self, row: &str) -> bool {
        self.separator.is_some_and(|letter| !letter.is_whitespace()) && !row.starts_with('"')
    }

    /// Whether `line`, which is white space, has the separators of a row.
    pub fn is_empty_row(&self, line: &str) -> bool {
        self.separator
            .is_some_and(|letter| line.matches(letter).count() >= self.naming.places.len() - 1)
    }

    /// The values of `row`.
    pub fn cells<'row>(&self, row: &'row str) -> impl Iterator<Item = &'row str> {
        cells(row, self.separator)
    }
}

/// The values of `row`, without white space and quotes around them. Any amount of white space is
/// one separator.
fn cells(row: &str, separator: Option<char>) -> impl Iterator<Item = &str> {
    let row = row.trim();
    // Some spreadsheets quote whole rows.
    let inner = row.strip_prefix('"').and_then(|row| row.strip_suffix('"'));
    let mut rest = Some(inner.filter(|inner| !inner.contains('"')).unwrap_or(row));
    std::iter::from_fn(move || {
        let row = rest?;
        let row = if separator.is_none() { row.trim_start() } else { row };
        if row.is_empty() && separator.is_none() {
            return None;
        }
        // A separator within quotes separates nothing.
        let quoted = row.trim_start_matches(' ').strip_prefix('"');
        let closing = quoted.and_then(|quoted| Some(row.len() - quoted.len() + quoted.find('"')?));
        let from = closing.unwrap_or_default();
        let end = match separator {
            Some(separator) => row[from..].find(separator),
            None => row[from..].find(char::is_whitespace),
        };
        let (cell, after) = match end {
            None => (row, None),
            Some(end) => {
                let end = from + end;
                let width = row[end..].chars().next().map_or(0, char::len_utf8);
                (&row[..end], Some(&row[end + width..]))
            }
        };
        rest = after;
        let cell = cell.trim();
        // Quotes alone are a value, but for the pair around nothing.
        let is_quotes = cell != "\"\"" && !cell.is_empty() && cell.bytes().all(|byte| byte == b'"');
        Some(if is_quotes { cell } else { cell.trim_matches('"') })
    })
}
