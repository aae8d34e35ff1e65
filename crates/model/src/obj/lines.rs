//! The text of a model file, line by line.

use std::iter::Peekable;
use std::ops::RangeInclusive;
use std::path::{Path, PathBuf};

use glam::DVec3;

use super::Flaw;

/// The text in `bytes`, in the encodings that photon lists may have: UTF-16 with or without a byte
/// order mark, UTF-8, or else Windows-1252, in which any two names that differ stay different.
pub fn decode(bytes: Vec<u8>) -> String {
    let utf16 = match bytes.as_slice() {
        [1..=255, 0, 1..=255, 0, ..] => Some(encoding_rs::UTF_16LE),
        [0, 1..=255, 0, 1..=255, ..] => Some(encoding_rs::UTF_16BE),
        _ => None,
    };
    if let Some(encoding) = utf16 {
        return encoding.decode_without_bom_handling(&bytes).0.into_owned();
    }
    if let Some((encoding, mark)) = encoding_rs::Encoding::for_bom(&bytes) {
        return encoding.decode_without_bom_handling(&bytes[mark..]).0.into_owned();
    }
    String::from_utf8(bytes)
        .unwrap_or_else(|error| encoding_rs::WINDOWS_1252.decode(error.as_bytes()).0.into_owned())
}

/// The line ends in `text`, which end a line as LF, CR LF or CR.
pub fn ends_before(text: &str) -> usize {
    text.matches(['\n', '\r']).count() - text.matches("\r\n").count()
}

/// A line of a file, with all that continue it.
pub struct ObjLine {
    /// Counted from 1.
    pub number: usize,
    /// The first word.
    pub keyword: String,
    /// What follows it, without white space around it; may end in a comment.
    pub rest: String,
}

impl ObjLine {
    /// The words after the keyword, up to a comment.
    pub fn words(&self) -> impl Iterator<Item = &str> {
        // Within a word there is no comment: `1.#IND` is a number.
        self.rest.split_whitespace().take_while(|word| !word.starts_with('#'))
    }
}

/// The lines of `text` that are neither empty nor a comment. `starts` tells which words start a
/// line of this format.
pub fn lines(text: &str, starts: impl Fn(&str) -> bool) -> impl Iterator<Item = ObjLine> {
    let text = text.trim_start_matches('\u{feff}');
    let mut rows = rows(text).enumerate().peekable();
    std::iter::from_fn(move || {
        loop {
            let (index, row) = rows.next()?;
            let row = row.trim();
            if row.is_empty() || row.starts_with('#') {
                continue;
            }
            let row = continued(row, &mut rows, &starts);
            let (keyword, rest) = row.split_once(char::is_whitespace).unwrap_or((&row, ""));
            let [keyword, rest] = [keyword, rest.trim()].map(str::to_owned);
            return Some(ObjLine { number: index + 1, keyword, rest });
        }
    })
}

fn rows(text: &str) -> impl Iterator<Item = &str> {
    let mut rest = Some(text);
    std::iter::from_fn(move || {
        let text = rest?;
        let Some(end) = text.find(['\n', '\r']) else {
            rest = None;
            return Some(text);
        };
        let width = if text[end..].starts_with("\r\n") { 2 } else { 1 };
        rest = Some(&text[end + width..]);
        Some(&text[..end])
    })
}

/// `row` with the rows after it that a `\` at the end joins to it. A name may end in a `\` too:
/// then a keyword follows, which starts a line of its own.
fn continued<'a>(
    row: &str,
    rows: &mut Peekable<impl Iterator<Item = (usize, &'a str)>>,
    starts: impl Fn(&str) -> bool,
) -> String {
    let mut line = row.to_owned();
    while line.ends_with('\\') {
        let starts_anew = |row: &str| row.split_whitespace().next().is_some_and(&starts);
        let Some((_, next)) = rows.next_if(|(_, row)| !starts_anew(row)) else { break };
        line.pop();
        line.push(' ');
        line += next.trim();
    }
    line
}

/// The place in a file that is being read, for errors.
pub struct ObjPlace {
    pub path: PathBuf,
    pub line: usize,
}

impl ObjPlace {
    pub fn new(path: &Path) -> Self {
        Self { path: path.to_owned(), line: 1 }
    }

    pub fn flaw(&self, message: impl Into<String>) -> Flaw {
        Flaw { path: self.path.clone(), line: self.line, message: message.into() }
    }
}

/// The first three of `words`, numbers within `range` but for `rounding`; `Err` says what was
/// found.
pub fn numbers<'a>(
    words: &mut impl Iterator<Item = &'a str>,
    keyword: &str,
    range: RangeInclusive<f64>,
    rounding: f64,
) -> Result<DVec3, String> {
    let (low, high) = (*range.start(), *range.end());
    let mut next = || {
        let word = words.next().unwrap_or_default();
        let is_within = |number: &f64| (low - rounding..=high + rounding).contains(number);
        let number = word.parse().ok().filter(is_within);
        number.map(|number: f64| number.clamp(low, high)).ok_or_else(|| {
            let found =
                if word.is_empty() { "nothing more".to_owned() } else { format!("'{word}'") };
            format!("expected three numbers from {low} to {high} after '{keyword}', found {found}")
        })
    };
    Ok(DVec3::new(next()?, next()?, next()?))
}
