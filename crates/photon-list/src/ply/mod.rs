//! Lists as PLY (Greg Turk's Polygon File Format), which MeshLab, CloudCompare and Blender open.
//!
//! This is our own reader because the crates for PLY read a whole file into maps of values, name no
//! line that is wrong, and cannot skip what stands before the vertices.

mod header;
mod scalar;

use std::io::{self, BufRead, Read};
use std::path::Path;

use photon_mapping::photon_list::PhotonRecord;

use super::error::{At, ListError, Reason, start};
use super::naming::Naming;
use super::reader::{Input, open};
use super::record::{ABSENT, Rows, Value};
use super::text::Lines;
use header::{Element, Encoding, Property};
pub(super) use header::{Header, is_magic};

/// The comments in the header of the list `path`.
///
/// # Errors
/// When the file cannot be read or its header is not that of a list.
pub fn comments(path: &Path) -> Result<Vec<String>, ListError> {
    match open(path, u64::MAX)? {
        Input::Ply(_, header) => Ok(header.comments),
        Input::Text(..) => Err(ListError::in_line(path, 1, "expected a PLY list")),
    }
}

/// Reads what follows `header`.
pub(super) fn read(
    lines: &mut Lines<impl BufRead>,
    header: &Header,
    rows: &mut Rows<impl FnMut(PhotonRecord) -> Result<bool, ListError>>,
) -> Result<Naming, ListError> {
    let path = lines.path;
    let vertex = header.elements.iter().find(|element| element.name == "vertex");
    let vertex = vertex.expect("the header has been read");
    // A list within a row is no column of ours, whatever its name.
    let name = |property: &Property| match property.count {
        None => property.name.clone(),
        Some(_) => format!("list {}", property.name),
    };
    let names: Vec<String> = vertex.properties.iter().map(name).collect();
    let naming = Naming::of(&names.iter().map(String::as_str).collect::<Vec<_>>());
    let mut naming = naming.map_err(|message| ListError::malformed(path, message))?;
    if let Some(reason) = naming.other_unit.take() {
        return Err(ListError::malformed(path, reason));
    }
    header.not_read().into_iter().for_each(|note| naming.tell(note));
    for element in &header.elements {
        let places = (element.name == "vertex").then_some(naming.places.as_slice());
        let wants_more = match header.encoding {
            Encoding::Ascii => read_ascii(lines, element, places, rows)?,
            Encoding::Binary { big_endian } => {
                read_binary(lines, element, big_endian, places, rows)?
            }
        };
        if !wants_more {
            return Ok(naming);
        }
    }
    let count = vertex.count;
    let (more, what) = match header.encoding {
        Encoding::Ascii => {
            let mut more = 0_u64;
            while let Some((_, line)) = lines.next()? {
                more += u64::from(!line.trim().is_empty());
            }
            (more, "rows")
        }
        Encoding::Binary { .. } => {
            let more = io::copy(&mut lines.input, &mut io::sink());
            let more = more.map_err(|error| ListError::unreadable(path, error))?;
            (more, "bytes ('merge' joins lists)")
        }
    };
    if more == 0 {
        return Ok(naming);
    }
    let message =
        format!("expected the end of the file after {count} photons, found more: {more} {what}");
    Err(ListError::malformed(path, message))
}

fn truncated(path: &Path, element: &Element, found: u64) -> ListError {
    let what = if element.name == "vertex" { "photons" } else { "rows behind the photons" };
    let expected = element.count;
    ListError::malformed(path, format!("expected {expected} {what}, found {found}: truncated?"))
}

/// Reads the rows of `element`, which are photons if there are `places` for its properties; gives
/// whether more is wanted.
fn read_ascii(
    lines: &mut Lines<impl BufRead>,
    element: &Element,
    places: Option<&[Option<usize>]>,
    rows: &mut Rows<impl FnMut(PhotonRecord) -> Result<bool, ListError>>,
) -> Result<bool, ListError> {
    let path = lines.path;
    // Rows of nothing would take no bytes, but time.
    let count = if element.properties.is_empty() { 0 } else { element.count };
    let mut found = 0;
    while found < count {
        let Some((number, line)) = lines.next()? else {
            return Err(truncated(path, element, found));
        };
        let mut words = line.split_whitespace();
        let Some(first) = words.next() else { continue };
        let Some(places) = places else {
            found += 1;
            continue;
        };
        let mut words = std::iter::once(first).chain(words);
        let mut record = ABSENT;
        let wrong = |message: String| ListError::in_line(path, number, message);
        for (property, place) in element.properties.iter().zip(places) {
            let missing = || wrong(format!("expected a value for '{}'", property.name));
            let word = words.next().ok_or_else(missing)?;
            if let Some(place) = *place {
                rows.set(&mut record, place, Value::Text(word), At::Line(number))?;
            } else if property.count.is_some() {
                let other = || {
                    let message = format!("expected the length of the list '{}'", property.name);
                    ListError::in_line(path, number, Reason { message, found: Some(start(word)) })
                };
                let length: usize = word.parse().map_err(|_| other())?;
                if length > 0 && words.nth(length - 1).is_none() {
                    return Err(missing());
                }
            }
        }
        if words.next().is_some() {
            let expected = element.properties.len();
            return Err(wrong(format!("expected {expected} values, found more")));
        }
        found += 1;
        if !(rows.on_record)(record)? {
            return Ok(false);
        }
    }
    Ok(true)
}

/// As [`read_ascii`], for binary rows.
fn read_binary(
    lines: &mut Lines<impl BufRead>,
    element: &Element,
    big_endian: bool,
    places: Option<&[Option<usize>]>,
    rows: &mut Rows<impl FnMut(PhotonRecord) -> Result<bool, ListError>>,
) -> Result<bool, ListError> {
    let path = lines.path;
    let count = if element.properties.is_empty() { 0 } else { element.count };
    let has_lists = element.properties.iter().any(|property| property.count.is_some());
    let width: usize = element.properties.iter().map(|property| property.scalar.bytes()).sum();
    let mut row = vec![0; width];
    for number in 0..count {
        let missing = |error: io::Error| match error.kind() {
            io::ErrorKind::UnexpectedEof => truncated(path, element, number),
            _ => ListError::unreadable(path, error),
        };
        if !has_lists {
            lines.input.read_exact(&mut row).map_err(missing)?;
        }
        let mut record = ABSENT;
        let mut from = 0;
        for (at, property) in element.properties.iter().enumerate() {
            let width = property.scalar.bytes();
            if let Some(count) = property.count {
                let mut length = [0; 8];
                let length = &mut length[..count.bytes()];
                lines.input.read_exact(length).map_err(missing)?;
                let Value::Whole(length) = count.value(length, big_endian) else {
                    unreachable!("the header has whole numbers alone for lengths")
                };
                let length = u64::try_from(length).map_err(|_| {
                    let message = format!("expected the length of the list '{}'", property.name);
                    let reason = Reason { message, found: Some(length.to_string()) };
                    ListError::at(path, At::Row(number + 1), reason)
                })?;
                let bytes = length * width as u64;
                let skipped = io::copy(&mut lines.input.by_ref().take(bytes), &mut io::sink());
                if skipped.map_err(missing)? < bytes {
                    return Err(truncated(path, element, number));
                }
                continue;
            }
            if has_lists {
                lines.input.read_exact(&mut row[from..from + width]).map_err(missing)?;
            }
            if let Some(place) = places.and_then(|places| places[at]) {
                let value = property.scalar.value(&row[from..from + width], big_endian);
                rows.set(&mut record, place, value, At::Row(number + 1))?;
            }
            from += width;
        }
        if places.is_some() && !(rows.on_record)(record)? {
            return Ok(false);
        }
    }
    Ok(true)
}
