//! The header of a PLY file.

use std::collections::HashSet;
use std::io::BufRead;

use super::scalar::Scalar;
use crate::error::{ListError, Reason, start};
use crate::text::Lines;
use crate::units::refused_in_comment;

/// A header has a line for each surface, of which there are 65,536 at most.
const MOST_LINES: u64 = 100_000;

/// Elements of meshes and viewers, which say nothing of photons.
const OF_VIEWERS: [&str; 6] = ["face", "tristrips", "edge", "camera", "material", "user"];
/// No more other elements are told.
const MOST_TOLD: usize = 8;

/// How the values behind the header are written.
#[derive(Clone, Copy, Debug)]
pub enum Encoding {
    Ascii,
    Binary { big_endian: bool },
}

/// A column of an element.
#[derive(Debug)]
pub struct Property {
    pub name: String,
    pub scalar: Scalar,
    /// The type of the number of values, where there is more than one.
    pub count: Option<Scalar>,
}

/// Rows of one kind.
#[derive(Debug)]
pub struct Element {
    pub name: String,
    pub count: u64,
    pub properties: Vec<Property>,
}

/// What a file contains.
#[derive(Debug)]
pub struct Header {
    pub encoding: Encoding,
    pub comments: Vec<String>,
    pub elements: Vec<Element>,
}

/// Whether `line` is the first line of a PLY file.
pub fn is_magic(line: &str) -> bool {
    line.trim().eq_ignore_ascii_case("ply")
}

impl Header {
    /// Reads the header behind the line `ply`.
    pub fn read(lines: &mut Lines<impl BufRead>) -> Result<Self, ListError> {
        let path = lines.path;
        let mut encoding = None;
        let mut elements: Vec<Element> = Vec::new();
        let mut names = HashSet::new();
        let mut comments = Vec::new();
        let mut last = 1;
        while let Some((number, line)) = lines.next()? {
            last = number;
            let error = |reason: Reason| ListError::in_line(path, number, reason);
            if number > MOST_LINES {
                let message = format!("expected a header of under {MOST_LINES} lines");
                return Err(error(message.into()));
            }
            let line = line.trim();
            let words: Vec<&str> = line.split_whitespace().collect();
            let keyword = words.first().copied().unwrap_or_default().to_ascii_lowercase();
            match (keyword.as_str(), words.get(1..).unwrap_or_default()) {
                ("comment" | "obj_info", _) => {
                    let text = line[keyword.len()..].trim();
                    // Surfaces may be called anything.
                    let unit = refused_in_comment(text).filter(|_| !text.starts_with("surface "));
                    if let Some(reason) = unit {
                        return Err(error(reason));
                    }
                    if keyword == "comment" {
                        comments.push(text.to_owned());
                    }
                }
                ("", _) => {}
                ("format", _) if encoding.is_some() => {
                    let found = Some(start(line));
                    let message = "expected one line with the format".to_owned();
                    return Err(error(Reason { message, found }));
                }
                ("format", [name, ..]) => {
                    encoding = Some(match name.to_ascii_lowercase().as_str() {
                        "ascii" => Encoding::Ascii,
                        "binary_little_endian" => Encoding::Binary { big_endian: false },
                        "binary_big_endian" => Encoding::Binary { big_endian: true },
                        _ => {
                            return Err(error(
                                "expected a format that PLY knows, such as ascii".into(),
                            ));
                        }
                    });
                }
                ("element", [name, count]) => {
                    let name = name.to_ascii_lowercase();
                    if !names.insert(name.clone()) {
                        let message = "expected each element once".to_owned();
                        return Err(error(Reason { message, found: Some(start(&name)) }));
                    }
                    let count = count.parse().map_err(|_| {
                        let message = "expected how many rows the element has".to_owned();
                        error(Reason { message, found: Some(start(count)) })
                    })?;
                    elements.push(Element { name, count, properties: Vec::new() });
                }
                ("property", property) if !elements.is_empty() => {
                    let property = Property::of(property).map_err(error)?;
                    elements.last_mut().expect("not empty").properties.push(property);
                }
                ("end_header", _) => {
                    let expected = "expected 'format' and 'element vertex' before 'end_header'";
                    let encoding = encoding.ok_or_else(|| error(expected.into()))?;
                    if !elements.iter().any(|element| element.name == "vertex") {
                        return Err(error(expected.into()));
                    }
                    return Ok(Self { encoding, comments, elements });
                }
                _ => return Err(error("expected a line of a PLY header".into())),
            }
        }
        let message = "expected 'end_header' before the end of the file";
        Err(ListError::in_line(path, last, message))
    }

    /// The elements besides the vertices that may hold data of photons, and how many rows they
    /// have; `None` where there are no such elements.
    pub fn not_read(&self) -> Option<String> {
        let others = self.elements.iter().filter(|element| {
            let is_known = OF_VIEWERS.contains(&element.name.as_str());
            element.name != "vertex" && !is_known && element.count > 0
        });
        let told = others
            .take(MOST_TOLD)
            .map(|element| format!("'{}' ({} rows)", start(&element.name), element.count));
        let told: Vec<String> = told.collect();
        (!told.is_empty())
            .then(|| format!("elements other than 'vertex', so not judged: {}", told.join(", ")))
    }

    /// Whether the vertices are the corners of faces.
    pub fn is_mesh(&self) -> bool {
        self.elements.iter().any(|element| {
            matches!(element.name.as_str(), "face" | "tristrips" | "edge") && element.count > 0
        })
    }
}

impl Property {
    /// What the words behind `property` say.
    fn of(words: &[&str]) -> Result<Self, Reason> {
        let scalar = |name: &str| {
            let found = Some(start(name));
            let message = "expected a type that PLY knows".to_owned();
            Scalar::named(&name.to_ascii_lowercase()).ok_or(Reason { message, found })
        };
        match words {
            [kind, name] => {
                Ok(Self { name: (*name).to_owned(), scalar: scalar(kind)?, count: None })
            }
            [list, count, kind, name] if list.eq_ignore_ascii_case("list") => {
                let count = scalar(count)?;
                if !count.is_whole() {
                    return Err("expected a type of whole numbers for the length of a list".into());
                }
                let name = (*name).to_owned();
                Ok(Self { name, scalar: scalar(kind)?, count: Some(count) })
            }
            _ => Err("expected a type and a name of a property".into()),
        }
    }
}
