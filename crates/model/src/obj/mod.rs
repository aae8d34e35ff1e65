//! Model files: the part of Wavefront OBJ and MTL that a scene of diffuse triangles needs.
//!
//! Of a model this reads vertices, normals, faces, objects, groups and material libraries; of a
//! material only `Kd`. Everything else either has no area (`l`, `p`, curves) or does not change a
//! diffuse triangle, and what a reader may miss is in [`Model::notes`]. Surfaces other than faces
//! are refused. A model has y up; it is turned by +90 degrees about x as the framework does, so
//! that z is up in the scene.
//!
//! This is our own reader because the crates for OBJ do not name the line that is wrong and skip
//! what they do not know. Polygons are cut by `earcut`, and `encoding_rs` decodes the text.

mod keywords;
mod lines;
mod materials;
mod polygon;
mod reader;

use std::fs::File;
use std::io::{self, Read};
use std::path::{Path, PathBuf};

use glam::{DVec3, Vec3};

use photon_mapping::scene::MeshObject;

/// No model or material library is larger, in bytes.
const LARGEST_FILE: u64 = 1 << 31;

/// What a model file holds, in world space.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Model {
    /// One for every pair of object and material, in order of appearance.
    pub mesh_objects: Vec<MeshObject>,
    /// All triangles: those of a convex polygon are a fan about its first corner.
    pub triangles: Vec<ModelTriangle>,
    /// What was left out, a line each, with file and line.
    pub notes: Vec<String>,
    /// The material libraries that were read.
    pub libraries: Vec<PathBuf>,
}

/// A triangle as the model file has it, in world space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ModelTriangle {
    /// The corners, not yet rounded to f32.
    pub vertices: [DVec3; 3],
    /// The unit normal.
    pub normal: Vec3,
    /// Which of [`Model::mesh_objects`] it belongs to.
    pub parent_mesh_object: usize,
    /// Which face of that mesh object it is part of.
    pub facet: usize,
}

/// A light for a model, in world space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ModelLight {
    /// Where it stands, not yet rounded to f32.
    pub position: DVec3,
    /// Its color.
    pub color: Vec3,
}

/// Why a model could not be read.
#[derive(Debug, thiserror::Error)]
pub enum ModelError {
    /// A file could not be read at all.
    #[error("{}: cannot be read: {source}", path.display())]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// A line is not what it should be.
    #[error(transparent)]
    Malformed(#[from] Flaw),
    /// A material library could not be read.
    #[error("{source} (the material library of {}:{line})", path.display())]
    Library {
        /// The model.
        path: PathBuf,
        /// Its line that names the library.
        line: usize,
        /// What is wrong with the library.
        source: Box<ModelError>,
    },
}

/// What is wrong with a line.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{}:{line}: {message}", path.display())]
pub struct Flaw {
    /// The file.
    pub path: PathBuf,
    /// The line, counted from 1; the last line where something is missing at the end.
    pub line: usize,
    /// What was found and what was expected.
    pub message: String,
}

/// Reads the model `path` and its material libraries.
///
/// # Errors
/// When a file cannot be read or a line is malformed; the error names file and line.
pub fn load(path: &Path) -> Result<Model, ModelError> {
    let text = read(path)?;
    reader::read_model(path, &text, |name| {
        let library = path.with_file_name(name);
        // To open a pipe would be to wait for its other end.
        let about = std::fs::metadata(&library);
        if about.is_ok_and(|about| !about.is_file()) {
            let source = io::Error::other("expected a file, found a folder, pipe or device");
            return Err(ModelError::Unreadable { path: library, source });
        }
        read(&library).map(|text| (library, text))
    })
}

/// Reads a model from `text`; `read_library` gives the text of a material library by its name.
///
/// # Errors
/// As [`load`].
pub fn parse(
    text: &str,
    read_library: impl Fn(&str) -> Result<String, ModelError>,
) -> Result<Model, ModelError> {
    reader::read_model(Path::new("model"), text, |name| {
        read_library(name).map(|text| (PathBuf::from(name), text))
    })
}

fn read(path: &Path) -> Result<String, ModelError> {
    let unreadable = |source| ModelError::Unreadable { path: path.to_owned(), source };
    let mut bytes = Vec::new();
    let file = File::open(path).map_err(unreadable)?;
    file.take(LARGEST_FILE).read_to_end(&mut bytes).map_err(unreadable)?;
    if bytes.len() as u64 == LARGEST_FILE {
        return Err(unreadable(io::Error::other("larger than 2 GiB")));
    }
    let text = lines::decode(bytes);
    match text.find('\0') {
        None => Ok(text),
        Some(at) => {
            let line = lines::ends_before(&text[..at]) + 1;
            let message = "expected text, found a zero byte".to_owned();
            Err(Flaw { path: path.to_owned(), line, message }.into())
        }
    }
}
