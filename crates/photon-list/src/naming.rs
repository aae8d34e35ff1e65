//! What the columns of somebody's list are called.

use photon_mapping::photon_list::COLUMNS;

use super::error::{Reason, start};
use super::record::Columns;
use super::units::{refused, without_brackets, without_word};

/// How other programs name the vectors of a photon: in front of a coordinate or a channel.
const VECTORS: [(&[&str], [&str; 3]); 3] = [
    (
        &["position", "pos", "points", "point", "coords", "coord", "location", "vertex", "p"],
        ["x", "y", "z"],
    ),
    (&["intensity"], ["r", "g", "b"]),
    (&["tolight", "tolightray", "tolightraydirection"], ["x", "y", "z"]),
];

/// What ends the name of a coordinate of any vector.
const AXES: [[&str; 3]; 2] = [["x", "y", "z"], ["0", "1", "2"]];

/// No name of a column is longer.
const LONGEST_NAME: usize = 64;

/// Columns that viewers of points add, which say nothing of photons.
const OF_VIEWERS: [&str; 8] = ["nx", "ny", "nz", "red", "green", "blue", "alpha", "quality"];
/// No more unknown columns are told.
const MOST_TOLD: usize = 8;

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
                        other_unit = without_unit(names[*at]).1.and_then(refused);
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
    place_of_plain(without_unit(name).0)
}

/// The same of a `name` without a unit, in capitals or not.
fn place_of_plain(name: &str) -> Option<(usize, u8)> {
    let same = COLUMNS.iter().position(|column| name.eq_ignore_ascii_case(column));
    same.map(|place| (place, 1)).or_else(|| Some((of_a_vector(name)?, 2)))
}

/// The name and the unit of a column; a unit without brackets stands beside the name of a
/// coordinate alone.
fn without_unit(name: &str) -> (&str, Option<&str>) {
    let is_coordinate = |(name, _): &(&str, &str)| matches!(place_of_plain(name), Some((..=2, _)));
    let split = || without_word(name).filter(is_coordinate);
    match without_brackets(name).or_else(split) {
        Some((name, unit)) => (name, Some(unit)),
        None => (name, None),
    }
}

/// The place in [`COLUMNS`] of what `position.x`, `intensity[0]` or `toLightRay.direction.z` names.
fn of_a_vector(name: &str) -> Option<usize> {
    let is_left_out = |letter: char| ":._[]()- ".contains(letter);
    // Most columns of a wide list end otherwise.
    let end = name.trim_end_matches(is_left_out).chars().next_back()?.to_ascii_lowercase();
    let of_vectors = VECTORS.iter().map(|(_, letters)| letters);
    if !of_vectors.chain(&AXES).flatten().any(|letter| letter.starts_with(end)) {
        return None;
    }
    let name = name.to_ascii_lowercase();
    let name: String =
        name.trim_start_matches("photon").chars().filter(|letter| !is_left_out(*letter)).collect();
    VECTORS.iter().enumerate().find_map(|(vector, (stems, letters))| {
        let mut stems = stems.iter();
        let rest = stems.find_map(|stem| name.strip_prefix(stem).filter(|rest| rest.len() == 1))?;
        let axis = [letters]
            .into_iter()
            .chain(&AXES)
            .find_map(|letters| letters.iter().position(|letter| *letter == rest))?;
        Some(3 * vector + axis)
    })
}
