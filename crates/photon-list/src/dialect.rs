//! What the columns of somebody's list are called, and what is between them.

use std::borrow::Cow;

use photon_mapping::photon_list::COLUMNS;

use super::record::{Columns, Value};

/// How other programs name the vectors of a photon: in front of a coordinate or a channel.
const VECTORS: [(&[&str], [&str; 3]); 3] = [
    (&["position", "pos"], ["x", "y", "z"]),
    (&["intensity"], ["r", "g", "b"]),
    (&["tolight", "tolightray", "tolightraydirection"], ["x", "y", "z"]),
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
    /// Which columns a file has whose own are called `names`: by our names, else by the same ones in
    /// capitals, else by those of the assignment's C++. `Err` says what is missing or double.
    pub fn of(names: &[&str]) -> Result<Self, String> {
        let mut places = vec![None; names.len()];
        let mut guessed = Vec::new();
        for (place, column) in COLUMNS.iter().enumerate() {
            let levels: [&dyn Fn(&str) -> bool; 3] =
                [&|name| name == *column, &|name| name.eq_ignore_ascii_case(column), &|name| {
                    of_a_vector(name) == Some(place)
                }];
            let called = |level: &&dyn Fn(&str) -> bool| -> Vec<usize> {
                (0..names.len()).filter(|at| level(names[*at])).collect()
            };
            let found = levels.iter().map(called).find(|found| !found.is_empty());
            match found.unwrap_or_default().as_slice() {
                [] if place < 3 => {
                    return Err(format!("expected the columns x, y and z, found no '{column}'"));
                }
                [] => {}
                [at] => {
                    places[*at] = Some(place);
                    if names[*at] != *column {
                        guessed.push(format!("'{}' for {column}", names[*at]));
                    }
                }
                _ => return Err(format!("expected each column once, found '{column}' twice")),
            }
        }
        let note = (!guessed.is_empty()).then(|| format!("taken: {}", guessed.join(", ")));
        Ok(Self { columns: Columns::at(&places), places, note })
    }
}

/// The place in [`COLUMNS`] of what `position.x`, `intensity[0]` or `toLightRay.direction.z` names.
fn of_a_vector(name: &str) -> Option<usize> {
    let name = name.to_ascii_lowercase();
    let name: String =
        name.trim_start_matches("photon").chars().filter(|c| !"._[]- ".contains(*c)).collect();
    VECTORS.iter().enumerate().find_map(|(vector, (stems, letters))| {
        let mut stems = stems.iter();
        let rest = stems.find_map(|stem| name.strip_prefix(stem).filter(|rest| rest.len() == 1))?;
        let axis = [letters.as_slice(), &["x", "y", "z"], &["0", "1", "2"]]
            .iter()
            .find_map(|letters| letters.iter().position(|letter| *letter == rest))?;
        Some(3 * vector + axis)
    })
}

impl Dialect {
    /// The dialect of a list with the first line `line`. `Err` says what was expected.
    pub fn of(line: &str) -> Result<Self, String> {
        // As NumPy writes the names of columns.
        let line = line.trim_start_matches('\u{feff}').trim().trim_start_matches('#').trim();
        // A comma may also be part of a number.
        let separator = [';', '\t', ','].into_iter().find(|separator| line.contains(*separator));
        let first: Vec<&str> = cells(line, separator).collect();
        let is_number = |text: &&str| Value::Text(&with_point(text, separator)).float().is_some();
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

    /// `text` with a decimal point, where it may have a decimal comma.
    pub fn with_point<'row>(&self, text: &'row str) -> Cow<'row, str> {
        with_point(text, self.separator)
    }

    /// The values of `row`.
    pub fn cells<'row>(&self, row: &'row str) -> impl Iterator<Item = &'row str> {
        cells(row, self.separator)
    }
}

fn with_point(text: &str, separator: Option<char>) -> Cow<'_, str> {
    if separator == Some(',') || !text.contains(',') {
        Cow::Borrowed(text)
    } else {
        Cow::Owned(text.replacen(',', ".", 1))
    }
}

fn cells(row: &str, separator: Option<char>) -> impl Iterator<Item = &str> {
    let is_between = move |letter: char| match separator {
        Some(separator) => letter == separator,
        None => letter.is_whitespace(),
    };
    // Any amount of white space is one separator.
    row.split(is_between)
        .filter(move |text| separator.is_some() || !text.is_empty())
        .map(|text| text.trim().trim_matches('"'))
}
