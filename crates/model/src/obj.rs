//! Model files: the part of Wavefront OBJ and MTL that a scene of diffuse triangles needs.
//!
//! Read are `v`, `vn`, `f`, `o`, `g`, `usemtl` and `mtllib`, and of a material `Kd`; everything else
//! is passed over. A model has y up; it is turned by +90 degrees about x as the framework does, so
//! that z is up in the scene. Our own reader, because the crates for OBJ do not say on which line a
//! file is wrong.

use std::collections::HashMap;
use std::io::Read;
use std::path::{Path, PathBuf};

use glam::{DVec3, Vec3};

use photon_mapping::scene::{Material, MeshObject};

/// A normal of the file that is farther than this from the face's own only chooses the side. The handout's are 3.6e-5
/// off at most.
const MOST_TURNED: f32 = 1e-3;

/// Numbers larger than this are refused: their products would not be finite.
const LARGEST_COORDINATE: f64 = 1e9;

/// A photon list numbers surfaces with 16 bits.
const MOST_MESH_OBJECTS: usize = 65_535;

/// What some editors put before the first line.
const BYTE_ORDER_MARK: char = '\u{feff}';

/// No model or material library is larger, in bytes.
const LARGEST_FILE: u64 = 1 << 31;

/// What a model file holds, in world space.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Model {
    /// One for every pair of object and material, in order of appearance.
    pub mesh_objects: Vec<MeshObject>,
    /// All triangles, those of a polygon in a fan about its first corner.
    pub triangles: Vec<ModelTriangle>,
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
    /// Its colour.
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
        source: std::io::Error,
    },
    /// A line is not what it should be.
    #[error("{}:{line}: {message}", path.display())]
    Malformed {
        /// The file.
        path: PathBuf,
        /// The line, counted from 1; the last line where something is missing at the end.
        line: usize,
        /// What was found and what was expected.
        message: String,
    },
}

/// Reads the model `path` and the material libraries beside it.
///
/// # Errors
/// When a file cannot be read or a line is malformed; the error names file and line.
pub fn load(path: &Path) -> Result<Model, ModelError> {
    let text = read(path)?;
    let mut reader = Reader::new(path);
    reader.read_model(&text, |name| {
        let library = path.with_file_name(name);
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
    Reader::new(Path::new("model"))
        .read_model(text, |name| read_library(name).map(|text| (PathBuf::from(name), text)))
}

fn read(path: &Path) -> Result<String, ModelError> {
    let unreadable = |source| ModelError::Unreadable { path: path.to_owned(), source };
    let mut bytes = Vec::new();
    let file = std::fs::File::open(path).map_err(unreadable)?;
    file.take(LARGEST_FILE).read_to_end(&mut bytes).map_err(unreadable)?;
    if bytes.len() as u64 == LARGEST_FILE {
        return Err(unreadable(std::io::Error::other("larger than 2 GiB")));
    }
    String::from_utf8(bytes).map_err(|error| ModelError::Malformed {
        path: path.to_owned(),
        line: 1 + error.as_bytes()[..error.utf8_error().valid_up_to()]
            .iter()
            .filter(|byte| **byte == b'\n')
            .count(),
        message: "not UTF-8 text".to_owned(),
    })
}

/// The place in a file that is being read, for errors.
struct Place {
    path: PathBuf,
    line: usize,
}

impl Place {
    fn error(&self, message: impl Into<String>) -> ModelError {
        ModelError::Malformed { path: self.path.clone(), line: self.line, message: message.into() }
    }
}

struct Reader {
    place: Place,
    vertices: Vec<DVec3>,
    normals: Vec<Vec3>,
    materials: HashMap<String, Material>,
    object: String,
    material: Option<String>,
    mesh_of: HashMap<(String, String), usize>,
    facets_of_mesh: Vec<usize>,
    model: Model,
}

impl Reader {
    fn new(path: &Path) -> Self {
        Self {
            place: Place { path: path.to_owned(), line: 1 },
            vertices: Vec::new(),
            normals: Vec::new(),
            materials: HashMap::new(),
            object: "unnamed".to_owned(),
            material: None,
            mesh_of: HashMap::new(),
            facets_of_mesh: Vec::new(),
            model: Model::default(),
        }
    }

    fn read_model(
        &mut self,
        text: &str,
        read_library: impl Fn(&str) -> Result<(PathBuf, String), ModelError>,
    ) -> Result<Model, ModelError> {
        let text = text.trim_start_matches(BYTE_ORDER_MARK);
        for (index, line) in text.lines().enumerate() {
            self.place.line = index + 1;
            let line = line.split('#').next().unwrap_or_default();
            let (keyword, rest) = split_keyword(line);
            match keyword {
                "v" => self.vertices.push(turn(self.vector(keyword, rest)?)),
                "vn" => {
                    let normal = turn(self.vector(keyword, rest)?).as_vec3();
                    let unit = normal.try_normalize();
                    self.normals.push(unit.ok_or_else(|| {
                        self.place.error("expected a normal longer than zero after 'vn'")
                    })?);
                }
                "f" => self.face(rest)?,
                "o" | "g" if !rest.is_empty() => self.object = rest.to_owned(),
                "usemtl" => {
                    if !self.materials.contains_key(rest) {
                        return Err(self.place.error(format!(
                            "material '{rest}' is in no material library read so far"
                        )));
                    }
                    self.material = Some(rest.to_owned());
                }
                "mtllib" => {
                    let (path, text) = read_library(rest)?;
                    read_materials(&path, &text, &mut self.materials)?;
                }
                _ => {}
            }
        }
        if self.model.triangles.is_empty() {
            let degenerate: usize = self.facets_of_mesh.iter().sum();
            let found = match degenerate {
                0 => "found none".to_owned(),
                _ => format!("found only degenerate ones ({degenerate})"),
            };
            let expected = "expected at least one face with an area ('f')";
            return Err(self.place.error(format!("{expected}, {found}")));
        }
        Ok(std::mem::take(&mut self.model))
    }

    fn vector(&self, keyword: &str, rest: &str) -> Result<DVec3, ModelError> {
        numbers(&self.place, keyword, rest, -LARGEST_COORDINATE..=LARGEST_COORDINATE)
    }

    fn face(&mut self, rest: &str) -> Result<(), ModelError> {
        let corners = rest
            .split_whitespace()
            .map(|corner| self.corner(corner))
            .collect::<Result<Vec<_>, _>>()?;
        if corners.len() < 3 {
            return Err(self
                .place
                .error(format!("expected at least 3 corners after 'f', found {}", corners.len())));
        }
        let mesh = self.mesh()?;
        let facet = self.facets_of_mesh[mesh];
        self.facets_of_mesh[mesh] += 1;
        let first_normal = corners[0].1;
        let file_normal = first_normal.filter(|_| corners.iter().all(|c| c.1 == first_normal));
        for k in 1..corners.len() - 1 {
            let vertices = [corners[0].0, corners[k].0, corners[k + 1].0];
            let [a, b, c] = vertices;
            // A triangle without area can be hit by no ray and has no normal.
            let Some(plane_normal) = (b - a).cross(c - a).try_normalize() else { continue };
            // Corners with different normals ask for a smooth surface, which no scene here needs:
            // such a face is as flat as it is built.
            let of_plane = plane_normal.as_vec3();
            let normal = match file_normal {
                Some(normal) if normal.distance(of_plane) <= MOST_TURNED => normal,
                Some(normal) if normal.distance(-of_plane) <= MOST_TURNED => normal,
                Some(normal) if normal.dot(of_plane) < 0.0 => -of_plane,
                _ => of_plane,
            };
            let triangle = ModelTriangle { vertices, normal, parent_mesh_object: mesh, facet };
            self.model.triangles.push(triangle);
        }
        Ok(())
    }

    /// The position of a corner such as `7`, `7/1`, `7//3` or `-1/2/3`, and its normal if it has one.
    fn corner(&self, corner: &str) -> Result<(DVec3, Option<Vec3>), ModelError> {
        let mut indices = corner.split('/');
        let vertex = indices.next().unwrap_or_default();
        let position = *self.element(&self.vertices, vertex, "vertex")?;
        let _texture_coordinates = indices.next();
        let normal = match indices.next() {
            None | Some("") => None,
            Some(index) => Some(*self.element(&self.normals, index, "normal")?),
        };
        Ok((position, normal))
    }

    fn element<'a, T>(&self, all: &'a [T], index: &str, what: &str) -> Result<&'a T, ModelError> {
        let number: i64 = index.parse().map_err(|_| {
            self.place.error(format!("expected the number of a {what} in 'f', found '{index}'"))
        })?;
        let position = if number < 0 { all.len() as i64 + number } else { number - 1 };
        usize::try_from(position).ok().and_then(|position| all.get(position)).ok_or_else(|| {
            self.place.error(format!("{what} {number} does not exist: {} so far", all.len()))
        })
    }

    fn mesh(&mut self) -> Result<usize, ModelError> {
        let Some(material_name) = self.material.clone() else {
            return Err(self.place.error("expected a 'usemtl' line before the first face"));
        };
        let material = self.materials[&material_name];
        let key = (self.object.clone(), material_name);
        if let Some(mesh) = self.mesh_of.get(&key) {
            return Ok(*mesh);
        }
        let mesh = self.model.mesh_objects.len();
        if mesh > MOST_MESH_OBJECTS {
            let message = format!("expected at most {MOST_MESH_OBJECTS} objects with a material");
            return Err(self.place.error(message));
        }
        let name_is_taken = self.model.mesh_objects.iter().any(|mesh| mesh.name == key.0);
        let name = if name_is_taken { format!("{}:{}", key.0, key.1) } else { key.0.clone() };
        self.mesh_of.insert(key, mesh);
        self.facets_of_mesh.push(0);
        self.model.mesh_objects.push(MeshObject { name, material });
        Ok(mesh)
    }
}

fn read_materials(
    path: &Path,
    text: &str,
    materials: &mut HashMap<String, Material>,
) -> Result<(), ModelError> {
    let mut place = Place { path: path.to_owned(), line: 0 };
    let mut current: Option<(String, usize)> = None;
    let without_response = |current: Option<(String, usize)>, materials: &HashMap<_, _>| {
        let (name, line) = current?;
        (!materials.contains_key(&name)).then(|| {
            Place { path: path.to_owned(), line }
                .error(format!("expected a diffuse response ('Kd') for material '{name}'"))
        })
    };
    for (index, line) in text.trim_start_matches(BYTE_ORDER_MARK).lines().enumerate() {
        place.line = index + 1;
        let (keyword, rest) = split_keyword(line.split('#').next().unwrap_or_default());
        match keyword {
            "newmtl" => {
                if let Some(error) = without_response(current.take(), materials) {
                    return Err(error);
                }
                current = Some((rest.to_owned(), place.line));
            }
            "Kd" => {
                let Some((name, _)) = &current else {
                    return Err(place.error("expected a 'newmtl' line before 'Kd'"));
                };
                let diffuse = numbers(&place, "Kd", rest, 0.0..=1.0)?;
                materials.insert(name.clone(), Material::new(diffuse.as_vec3()));
            }
            _ => {}
        }
    }
    match without_response(current, materials) {
        Some(error) => Err(error),
        None => Ok(()),
    }
}

fn split_keyword(line: &str) -> (&str, &str) {
    let line = line.trim();
    match line.split_once(char::is_whitespace) {
        Some((keyword, rest)) => (keyword, rest.trim_start()),
        None => (line, ""),
    }
}

/// The first three numbers of `rest`; OBJ allows a fourth, which is passed over.
fn numbers(
    place: &Place,
    keyword: &str,
    rest: &str,
    range: std::ops::RangeInclusive<f64>,
) -> Result<DVec3, ModelError> {
    let mut words = rest.split_whitespace();
    let mut next = || {
        let word = words.next().unwrap_or_default();
        let expected = || {
            let (low, high) = (range.start(), range.end());
            let found =
                if word.is_empty() { "nothing more".to_owned() } else { format!("'{word}'") };
            place.error(format!(
                "expected three numbers from {low} to {high} after '{keyword}', found {found}"
            ))
        };
        let number: f64 = word.parse().map_err(|_| expected())?;
        if range.contains(&number) { Ok(number) } else { Err(expected()) }
    };
    Ok(DVec3::new(next()?, next()?, next()?))
}

/// From y up to z up: +90 degrees about x.
fn turn(model: DVec3) -> DVec3 {
    DVec3::new(model.x, 0.0 - model.z, model.y)
}
