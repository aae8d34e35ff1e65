//! What the columns of somebody's list are called, and what is between them.

use photon_mapping::photon_list::COLUMNS;

use super::error::{Reason, start};
use super::record::{Columns, Value};

/// How other programs name the vectors of a photon: in front of a coordinate or a channel.
const VECTORS: [(&[&str], [&str; 3]); 3] = [
    (
        &["position", "pos", "points", "point", "coords", "coord", "location", "vertex", "p"],
        ["x", "y", "z"],
    ),
    (&["intensity"], ["r", "g", "b"]),
    (&["tolight", "tolightray", "tolightraydirection"], ["x", "y", "z"]),
];

/// No name of a column is longer.
const LONGEST_NAME: usize = 64;

/// How comments start, which may hold the names of the columns: NumPy, CloudCompare, MATLAB.
const COMMENTS: [&str; 3] = ["#", "//", "%"];

/// Columns that viewers of points add, which say nothing of photons.
const OF_VIEWERS: [&str; 8] = ["nx", "ny", "nz", "red", "green", "blue", "alpha", "quality"];
/// No more unknown columns are told.
const MOST_TOLD: usize = 8;

/// What positions are in: the scene's unit is the meter.
const METERS: [&str; 9] = [
    "m",
    "meter",
    "meters",
    "metre",
    "metres",
    "world",
    "world space",
    "world unit",
    "world units",
];

/// Which column each of a file's is.
#[derive(Debug)]
pub(super) struct Naming {
    /// Which columns there are.
    pub columns: Columns,
    /// For each of the file's columns, its place in [`COLUMNS`].
    pub places: Vec<Option<usize>>,
    /// What had to be guessed.
    pub note: Option<String>,
    /// Why the positions cannot be used, where they are in another unit than meters.
    pub other_unit: Option<Reason>,
}

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

impl Naming {
    /// Which columns a file has whose own are called `names`: by our names, else by the same ones
    /// in capitals, else by those of other programs. `Err` says what is missing or double.
    pub fn of(names: &[&str]) -> Result<Self, String> {
        // The columns that could be each of ours, and how well they are called so.
        let mut best: [(u8, Vec<usize>); COLUMNS.len()] = Default::default();
        for (at, name) in names.iter().enumerate() {
            let Some((place, level)) = place(name) else { continue };
            let (of_best, columns) = &mut best[place];
            if columns.is_empty() || level < *of_best {
                (*of_best, *columns) = (level, vec![at]);
            } else if level == *of_best {
                columns.push(at);
            }
        }
        let mut places = vec![None; names.len()];
        let mut guessed = Vec::new();
        let mut other_unit = None;
        for (place, (column, (level, found))) in COLUMNS.iter().zip(best).enumerate() {
            match found.as_slice() {
                [] if place < 3 => {
                    return Err(format!("expected the columns x, y and z, found no '{column}'"));
                }
                [] => {}
                [at] => {
                    places[*at] = Some(place);
                    if level > 0 {
                        guessed.push(format!("'{}' for {column}", start(names[*at])));
                    }
                    if place < 3 && other_unit.is_none() {
                        other_unit = without_unit(names[*at]).1.and_then(refused_unit);
                    }
                }
                _ => return Err(format!("expected each column once, found '{column}' twice")),
            }
        }
        let is_unknown =
            |(name, place): &(&&str, &Option<usize>)| place.is_none() && !OF_VIEWERS.contains(name);
        let unknown = names.iter().zip(&places).filter(is_unknown).map(|(name, _)| match *name {
            "" => "one without a name".to_owned(),
            name => format!("'{}'", start(name)),
        });
        let unknown: Vec<String> = unknown.take(MOST_TOLD).collect();
        let columns = Columns::at(&places);
        let mut incomplete = Vec::new();
        for (name, place) in names.iter().zip(&mut places) {
            let is_part = match place {
                Some(3..=5) => !columns.intensity,
                Some(6..=8) => !columns.to_light,
                _ => false,
            };
            if is_part {
                incomplete.push(format!("'{}'", start(name)));
                *place = None;
            }
        }
        let notes: Vec<String> = [
            ("taken", guessed),
            ("unknown, so not judged", unknown),
            ("without the other two of their three, so not judged", incomplete),
        ]
        .into_iter()
        .filter(|(_, names)| !names.is_empty())
        .map(|(what, names)| format!("{what}: {}", names.join(", ")))
        .collect();
        let note = (!notes.is_empty()).then(|| notes.join("; "));
        Ok(Self { columns, places, note, other_unit })
    }

    /// Adds `note` to what is told.
    pub fn tell(&mut self, note: String) {
        self.note = Some(match self.note.take() {
            None => note,
            Some(notes) => format!("{notes}; {note}"),
        });
    }
}

/// The place in [`COLUMNS`] of the column `name`; the second number is lower, the better it fits.
fn place(name: &str) -> Option<(usize, u8)> {
    if name.len() > LONGEST_NAME {
        return None;
    }
    if let Some(place) = COLUMNS.iter().position(|column| name == *column) {
        return Some((place, 0));
    }
    let (name, _) = without_unit(name);
    let same = COLUMNS.iter().position(|column| name.eq_ignore_ascii_case(column));
    same.map(|place| (place, 1)).or_else(|| Some((of_a_vector(name)?, 2)))
}

/// `x` and the unit `m` for `x (m)` and `x [m]`; what has an index in its brackets keeps them.
fn without_unit(name: &str) -> (&str, Option<&str>) {
    let unit = name.strip_suffix([')', ']']).and_then(|name| name.rsplit_once(['(', '[']));
    let is_index = |unit: &str| matches!(unit, "x" | "y" | "z" | "r" | "g" | "b" | "0" | "1" | "2");
    match unit {
        Some((name, unit)) if !is_index(&unit.to_ascii_lowercase()) => {
            (name.trim_end(), Some(unit.trim()))
        }
        _ => (name, None),
    }
}

/// Why positions in `unit` are refused, if they are not in meters.
fn refused_unit(unit: &str) -> Option<Reason> {
    let is_meters = METERS.iter().any(|meters| unit.eq_ignore_ascii_case(meters));
    let message = "expected x, y and z in meters ('m'), the scene's unit".to_owned();
    (!is_meters).then(|| Reason { message, found: Some(start(unit)) })
}

/// The place in [`COLUMNS`] of what `position.x`, `intensity[0]` or `toLightRay.direction.z` names.
fn of_a_vector(name: &str) -> Option<usize> {
    let name = name.to_ascii_lowercase();
    let name: String =
        name.trim_start_matches("photon").chars().filter(|c| !":._[]()- ".contains(*c)).collect();
    VECTORS.iter().enumerate().find_map(|(vector, (stems, letters))| {
        let mut stems = stems.iter();
        let rest = stems.find_map(|stem| name.strip_prefix(stem).filter(|rest| rest.len() == 1))?;
        let axis = [letters.as_slice(), &["x", "y", "z"], &["0", "1", "2"]]
            .iter()
            .find_map(|letters| letters.iter().position(|letter| *letter == rest))?;
        Some(3 * vector + axis)
    })
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
    let ends = move |letter: char| match separator {
        Some(separator) => letter == separator,
        None => letter.is_whitespace(),
    };
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
        let (cell, after) = match row[from..].find(ends) {
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
