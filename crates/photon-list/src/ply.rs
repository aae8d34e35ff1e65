//! Lists as PLY (Greg Turk's Polygon File Format), which MeshLab, CloudCompare and Blender open.

use std::fs::File;
use std::io::{BufRead, BufReader, Read};
use std::path::Path;

use photon_mapping::photon_list::PhotonRecord;

use super::dialect::Naming;
use super::error::ListError;
use super::record::{ABSENT, Value, set};

const LONGEST_HEADER_LINE: u64 = 4096;
const MOST_HEADER_LINES: usize = 10_000;

#[derive(Clone, Copy)]
enum Scalar {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

impl Scalar {
    fn named(name: &str) -> Option<Self> {
        Some(match name {
            "char" | "int8" => Self::I8,
            "uchar" | "uint8" => Self::U8,
            "short" | "int16" => Self::I16,
            "ushort" | "uint16" => Self::U16,
            "int" | "int32" => Self::I32,
            "uint" | "uint32" => Self::U32,
            "float" | "float32" => Self::F32,
            "double" | "float64" => Self::F64,
            _ => return None,
        })
    }

    fn bytes(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::I32 | Self::U32 | Self::F32 => 4,
            Self::F64 => 8,
        }
    }

    /// The value of as many bytes as the type has.
    fn value(self, bytes: &[u8], big_endian: bool) -> Value<'static> {
        let mut wide = [0; 8];
        wide[..bytes.len()].copy_from_slice(bytes);
        if big_endian {
            wide[..bytes.len()].reverse();
        }
        let whole = u64::from_le_bytes(wide);
        match self {
            Self::I8 => Value::Whole(i64::from(whole as i8)),
            Self::I16 => Value::Whole(i64::from(whole as i16)),
            Self::I32 => Value::Whole(i64::from(whole as i32)),
            Self::U8 | Self::U16 | Self::U32 => Value::Whole(whole as i64),
            Self::F32 => Value::Float(f32::from_bits(whole as u32)),
            Self::F64 => Value::Double(f64::from_bits(whole)),
        }
    }
}

struct Header {
    binary: bool,
    big_endian: bool,
    /// Whether nothing but the vertices follows.
    only_vertices: bool,
    comments: Vec<String>,
    count: u64,
    properties: Vec<(Scalar, String)>,
}

/// The comments in the header of the list `path`.
///
/// # Errors
/// When the file cannot be read or its header is not that of a list.
pub fn comments(path: &Path) -> Result<Vec<String>, ListError> {
    let file = File::open(path).map_err(|error| ListError::unreadable(path, error))?;
    Ok(read_header(&mut BufReader::new(file), path)?.comments)
}

/// Reads the list in `input`, the contents of the file `path`, whose first line has been found to
/// be `ply`.
pub(super) fn read(
    mut input: impl BufRead,
    path: &Path,
    mut on_record: impl FnMut(PhotonRecord) -> Result<(), ListError>,
) -> Result<Naming, ListError> {
    let header = read_header(&mut input, path)?;
    let names: Vec<_> = header.properties.iter().map(|(_, name)| name.as_str()).collect();
    let naming = Naming::of(&names).map_err(|message| ListError::malformed(path, message))?;
    let places = &naming.places;
    let mut row = vec![0; header.properties.iter().map(|(scalar, _)| scalar.bytes()).sum()];
    let mut line = String::new();
    for number in 0..header.count {
        let truncated = || {
            let expected = header.count;
            let message = format!("expected {expected} photons, found {number}: truncated?");
            ListError::malformed(path, message)
        };
        let mut record = ABSENT;
        let wrong = |name: &str| {
            let message = format!("photon {number} of the list: expected a number for '{name}'");
            ListError::malformed(path, message)
        };
        if header.binary {
            input.read_exact(&mut row).map_err(|error| match error.kind() {
                std::io::ErrorKind::UnexpectedEof => truncated(),
                _ => ListError::unreadable(path, error),
            })?;
            let mut rest = row.as_slice();
            for ((scalar, name), place) in header.properties.iter().zip(places) {
                let (bytes, after) = rest.split_at(scalar.bytes());
                rest = after;
                if let Some(place) = *place {
                    set(&mut record, place, scalar.value(bytes, header.big_endian))
                        .ok_or_else(|| wrong(name))?;
                }
            }
        } else {
            if read_line(&mut input, path, &mut line)? == 0 {
                return Err(truncated());
            }
            let mut words = line.split_whitespace();
            for ((_, name), place) in header.properties.iter().zip(places) {
                let word = words.next().ok_or_else(|| wrong(name))?;
                if let Some(place) = *place {
                    set(&mut record, place, Value::Text(word)).ok_or_else(|| wrong(name))?;
                }
            }
        }
        on_record(record)?;
    }
    let rest = input.fill_buf().map_err(|error| ListError::unreadable(path, error))?;
    if header.only_vertices && header.binary && !rest.is_empty() {
        let count = header.count;
        let message = format!(
            "expected the end of the file after {count} photons, found more ('merge' joins lists)"
        );
        return Err(ListError::malformed(path, message));
    }
    Ok(naming)
}

fn read_header(input: &mut impl BufRead, path: &Path) -> Result<Header, ListError> {
    let mut line = String::new();
    let mut format = None;
    let mut count = None;
    let mut in_vertex = false;
    let mut only_vertices = true;
    let mut properties = Vec::new();
    let mut comments = Vec::new();
    for number in 1..=MOST_HEADER_LINES {
        let error = |message: &str| ListError::malformed(path, format!("line {number}: {message}"));
        if read_line(input, path, &mut line)? == 0 {
            return Err(error("expected 'end_header' before the end of the file"));
        }
        let words: Vec<&str> = line.split_whitespace().collect();
        match words.as_slice() {
            ["comment", ..] => {
                let comment = line.trim_start().trim_start_matches("comment").trim();
                comments.push(comment.to_owned());
            }
            ["ply"] | ["obj_info", ..] | [] => {}
            ["format", name, _] => {
                format = Some(match *name {
                    "binary_little_endian" => (true, false),
                    "binary_big_endian" => (true, true),
                    "ascii" => (false, false),
                    _ => return Err(error("expected a format that PLY knows, such as ascii")),
                });
            }
            ["element", "vertex", number] => {
                count = Some(number.parse().map_err(|_| error("expected a count of vertices"))?);
                in_vertex = true;
            }
            ["element", ..] => {
                if count.is_none() {
                    return Err(error("expected the vertices to be the first element"));
                }
                in_vertex = false;
                only_vertices = false;
            }
            ["property", kind, name] if in_vertex => {
                let scalar = Scalar::named(kind);
                let scalar = scalar.ok_or_else(|| error("expected a type that PLY knows"))?;
                properties.push((scalar, (*name).to_owned()));
            }
            ["property", ..] if !in_vertex => {}
            ["end_header"] => {
                let (Some((binary, big_endian)), Some(count)) = (format, count) else {
                    return Err(error(
                        "expected 'format' and 'element vertex' before 'end_header'",
                    ));
                };
                let header =
                    Header { binary, big_endian, only_vertices, comments, count, properties };
                return Ok(header);
            }
            _ => return Err(error("expected a line of a PLY header of plain properties")),
        }
    }
    Err(ListError::malformed(path, format!("expected a header of under {MOST_HEADER_LINES} lines")))
}

fn read_line(input: &mut impl BufRead, path: &Path, line: &mut String) -> Result<usize, ListError> {
    line.clear();
    input.take(LONGEST_HEADER_LINE).read_line(line).map_err(|error| match error.kind() {
        std::io::ErrorKind::InvalidData => ListError::malformed(path, "expected text"),
        _ => ListError::unreadable(path, error),
    })
}
