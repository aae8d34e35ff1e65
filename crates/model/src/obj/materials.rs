//! Materials by name, as the libraries of a model define them.

use std::collections::HashMap;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use glam::Vec3;

use super::lines::{ObjLine, ObjPlace, lines, numbers};
use super::{Flaw, ModelError};

/// A response this far outside of 0 to 1 is the rounding of the end it is close to.
const ROUNDING: f64 = 1e-6;

/// More words than this are no list of material libraries.
const MOST_WORDS: usize = 64;

/// What a library says of a material.
pub struct Definition {
    /// The diffuse response.
    pub response: Result<Vec3, Flaw>,
    /// Where a texture asks for more than the response.
    pub texture: Option<Flaw>,
    has_response: bool,
}

/// The materials of all libraries read so far.
#[derive(Default)]
pub struct Materials {
    /// The files.
    pub libraries: Vec<PathBuf>,
    by_name: HashMap<String, Definition>,
    /// The names that end in what may be a comment, by what stands before it.
    commented: HashMap<String, Vec<String>>,
}

impl Materials {
    /// Adds those of the library `path`, which holds `text`. What is wrong with a material is in
    /// its definition: no face need use it.
    ///
    /// # Errors
    /// When a response is no material's.
    pub fn read(&mut self, path: &Path, text: &str) -> Result<(), Flaw> {
        self.libraries.push(path.to_owned());
        let mut place = ObjPlace::new(path);
        let mut current = String::new();
        let starts = |word: &str| matches!(word, "newmtl" | "Ka" | "Kd" | "Ks" | "illum");
        for line in lines(text, starts) {
            place.line = line.number;
            match line.keyword.as_str() {
                "newmtl" => {
                    self.define(&line.rest, &place);
                    current = line.rest;
                }
                "Kd" => {
                    let message = "expected a 'newmtl' line before 'Kd'";
                    let material = self.by_name.get_mut(&current);
                    material.ok_or_else(|| place.flaw(message))?.respond(&line, &current, &place);
                }
                "map_Kd" => {
                    if let Some(material) = self.by_name.get_mut(&current) {
                        let message = format!(
                            "the texture ('map_Kd') of material '{current}' is left out: its 'Kd' \
                             is used"
                        );
                        material.texture = Some(place.flaw(message));
                    }
                }
                _ => {}
            }
        }
        Ok(())
    }

    /// What is wrong with a material.
    pub fn first_flaw(&self) -> Option<Flaw> {
        let flaws = self.by_name.values().filter_map(|material| material.response.as_ref().err());
        flaws.min_by_key(|flaw| (&flaw.path, flaw.line)).cloned()
    }

    fn define(&mut self, name: &str, place: &ObjPlace) {
        if self.by_name.contains_key(name) {
            return;
        }
        let message = format!("expected a diffuse response ('Kd') for material '{name}'");
        let response = Err(place.flaw(message));
        let definition = Definition { response, texture: None, has_response: false };
        self.by_name.insert(name.to_owned(), definition);
        if let Some((before, _)) = at_comment(name) {
            self.commented.entry(before.to_owned()).or_default().push(name.to_owned());
        }
    }

    /// The material that `usemtl` calls `name`, and its whole name. `#` may be part of a name or
    /// start a comment in both places, so the whole names come first.
    ///
    /// # Errors
    /// When there is none, or several could be meant.
    pub fn find(&self, name: &str) -> Result<(&str, &Definition), String> {
        let before = at_comment(name);
        let mut names = vec![name];
        names.extend(before.map(|(before, _)| before));
        if let Some(found) = names.iter().find_map(|name| self.by_name.get_key_value(*name)) {
            return Ok((found.0, found.1));
        }
        let is_spaced = before.is_some_and(|(_, comment)| comment.starts_with("# "));
        let stem = before.filter(|_| is_spaced).map_or(name, |(before, _)| before);
        match self.commented.get(stem).map(Vec::as_slice) {
            Some([only]) if stem == name || only[stem.len()..].trim_start().starts_with("# ") => {
                Ok((only, &self.by_name[only]))
            }
            Some([first, second, ..]) => {
                Err(format!("material '{name}' could be '{first}' or '{second}'"))
            }
            _ => Err(format!("material '{name}' is in no material library read so far")),
        }
    }
}

impl Definition {
    /// Takes the response of `line`; two that differ leave none.
    fn respond(&mut self, line: &ObjLine, name: &str, place: &ObjPlace) {
        let response = response(line).map_err(|message| place.flaw(message));
        let differs = self.has_response && self.response.is_ok() && self.response != response;
        self.response =
            match differs {
                true => Err(place
                    .flaw(format!("expected one 'Kd' for material '{name}', found another one"))),
                false => response,
            };
        self.has_response = true;
    }
}

fn response(line: &ObjLine) -> Result<Vec3, String> {
    let words: Vec<&str> = line.words().collect();
    let mut words = match words.as_slice() {
        [gray] => vec![*gray; 3],
        _ => words,
    }
    .into_iter();
    let response = numbers(&mut words, "Kd", 0.0..=1.0, ROUNDING)?;
    match words.next() {
        None => Ok(response.as_vec3()),
        Some(word) => Err(format!("expected three numbers after 'Kd', found also '{word}'")),
    }
}

/// What stands before the white space and `#` in `name`, and what follows from there.
fn at_comment(name: &str) -> Option<(&str, &str)> {
    let mut marks = name.match_indices('#').map(|(at, _)| name.split_at(at));
    let (before, comment) = marks.find(|(before, _)| before.ends_with(char::is_whitespace))?;
    Some((before.trim_end(), comment))
}

/// Reads the material libraries that `names` lists. A name may have spaces in it, so the most
/// words that name a file do.
pub fn read_libraries(
    names: &str,
    place: &ObjPlace,
    materials: &mut Materials,
    read: impl Fn(&str) -> Result<(PathBuf, String), ModelError>,
) -> Result<(), ModelError> {
    let in_library = |source: ModelError| ModelError::Library {
        path: place.path.clone(),
        line: place.line,
        source: Box::new(source),
    };
    if names.is_empty() {
        return Err(place.flaw("expected the name of a file after 'mtllib'").into());
    }
    let mut rest = names;
    while !rest.is_empty() {
        let mut ends: Vec<usize> = vec![rest.len()];
        let spaces = rest.match_indices(char::is_whitespace).map(|(at, _)| at);
        ends.extend(spaces.take(MOST_WORDS).collect::<Vec<_>>().into_iter().rev());
        let mut absent = None;
        let mut found = None;
        for end in ends {
            match library(rest[..end].trim(), &read) {
                Ok(library) => {
                    found = Some((library, end));
                    break;
                }
                Err(error) if is_absent(&error) => absent = absent.or(Some(error)),
                Err(error) => return Err(in_library(error)),
            }
        }
        match (found, absent) {
            (Some(((path, text), end)), _) => {
                let read = materials.read(&path, &text);
                read.map_err(|flaw| in_library(flaw.into()))?;
                rest = rest[end..].trim_start();
            }
            (None, Some(_)) if rest != names && rest.starts_with('#') => break,
            (None, Some(error)) => return Err(in_library(error)),
            (None, None) => break,
        }
    }
    Ok(())
}

/// The library `name`, which may be quoted or have the separators of Windows.
fn library(
    name: &str,
    read: impl Fn(&str) -> Result<(PathBuf, String), ModelError>,
) -> Result<(PathBuf, String), ModelError> {
    let name = name.trim_matches('"');
    read(name).or_else(|error| match name.contains('\\') {
        true if is_absent(&error) => read(&name.replace('\\', "/")).map_err(|_| error),
        _ => Err(error),
    })
}

/// Whether a file is not there, or cannot be by its name.
fn is_absent(error: &ModelError) -> bool {
    let ModelError::Unreadable { source, .. } = error else { return false };
    let kinds = [ErrorKind::NotFound, ErrorKind::NotADirectory, ErrorKind::InvalidFilename];
    kinds.contains(&source.kind())
}
