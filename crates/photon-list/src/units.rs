//! The units that somebody's positions are in: the scene's is the meter.

use super::error::{Reason, start};

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
/// Other units that stand behind a name without brackets, or in a comment.
const OTHERS: [&str; 29] = [
    "mm",
    "cm",
    "dm",
    "km",
    "um",
    "nm",
    "in",
    "inch",
    "inches",
    "ft",
    "foot",
    "feet",
    "yd",
    "yards",
    "px",
    "pixel",
    "pixels",
    "millimeter",
    "millimeters",
    "millimetre",
    "millimetres",
    "centimeter",
    "centimeters",
    "centimetre",
    "centimetres",
    "kilometer",
    "kilometers",
    "micrometer",
    "micrometers",
];
/// What stands between a name and its unit, besides brackets.
const BETWEEN: [char; 7] = ['_', '.', '/', ':', '-', '|', ' '];

fn is_meters(unit: &str) -> bool {
    METERS.iter().any(|meters| unit.eq_ignore_ascii_case(meters))
}

fn is_unit(unit: &str) -> bool {
    is_meters(unit) || OTHERS.iter().any(|other| unit.eq_ignore_ascii_case(other))
}

/// `x` and the unit `m` for `x (m)` and `x [m]`; what has an index in its brackets keeps them.
pub fn without_brackets(name: &str) -> Option<(&str, &str)> {
    let (name, unit) = name.strip_suffix([')', ']', '}'])?.rsplit_once(['(', '[', '{'])?;
    let unit = unit.trim();
    let is_index = ["x", "y", "z", "r", "g", "b", "0", "1", "2"]
        .iter()
        .any(|index| unit.eq_ignore_ascii_case(index));
    (!is_index).then_some((name.trim_end(), unit))
}

/// The same for `x_mm`, `x.mm`, `x in mm`, `xmm` and `mm_x`. The name may be any.
pub fn without_word(name: &str) -> Option<(&str, &str)> {
    let behind = name.rsplit_once(BETWEEN).filter(|(_, unit)| is_unit(unit));
    let before = name.split_once(BETWEEN).map(|(unit, name)| (name, unit));
    // Inputs are called so.
    let is_input = |unit: &str| unit.eq_ignore_ascii_case("in");
    let joined = name.split_at_checked(1).filter(|(_, unit)| unit.len() > 1);
    let (name, unit) = behind
        .or_else(|| before.filter(|(_, unit)| is_unit(unit) && !is_input(unit)))
        .or_else(|| joined.filter(|(_, unit)| is_unit(unit) && !is_input(unit)))?;
    let name = name.trim_end_matches(BETWEEN);
    let in_unit = name.rsplit_once(BETWEEN).filter(|(_, word)| word.eq_ignore_ascii_case("in"));
    Some((in_unit.map_or(name, |(name, _)| name), unit))
}

/// Why positions in `unit` are refused, if they are not in meters.
pub fn refused(unit: &str) -> Option<Reason> {
    let message = "expected x, y and z in meters ('m'), the scene's unit".to_owned();
    (!is_meters(unit)).then(|| Reason { message, found: Some(start(unit)) })
}

/// The same of the unit that `comment` tells: behind the word 'units', or right behind 'in'.
pub fn refused_in_comment(comment: &str) -> Option<Reason> {
    let is = |word: &str, other: &str| word.eq_ignore_ascii_case(other);
    let words = comment.split(|letter: char| !letter.is_alphanumeric());
    let words: Vec<&str> = words.filter(|word| !word.is_empty()).collect();
    let is_told = |word: &&&str| is_unit(word) && !is(word, "in");
    let names_units = |word: &&str| is(word, "unit") || is(word, "units");
    let behind = words.iter().position(names_units).map(|at| &words[at + 1..]);
    let behind = behind.and_then(|words| words.iter().find(is_told));
    let pairs = || words.windows(2).filter(|pair| is(pair[0], "in")).map(|pair| &pair[1]);
    refused(behind.or_else(|| pairs().find(is_told))?)
}
