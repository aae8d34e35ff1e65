//! From the lines of a model to its triangles.

use std::collections::{HashMap, HashSet};
use std::path::{Path, PathBuf};

use glam::{DVec3, Vec3};

use super::keywords::{REFUSED, THIN, WITHOUT_AREA, normal, starts, vertex};
use super::lines::{ObjLine, ObjPlace, lines};
use super::materials::{Materials, read_libraries};
use super::polygon::{MOST_CORNERS, off_plane, triangulate};
use super::{Flaw, Model, ModelError, ModelTriangle};
use photon_mapping::scene::{Material, MeshObject};

/// A normal of the file that is farther than this from the face's own only chooses the side. The
/// handout's are 3.6e-5 off at most.
const MOST_TURNED: f32 = 1e-3;

/// A photon list numbers surfaces with 16 bits.
const MOST_MESH_OBJECTS: usize = 65_535;

/// More kinds of lines than this that are left out are not told apart.
const MOST_NOTES: usize = 20;

/// A value of the file, or what is wrong with it: no face need use it.
type ObjValue<T> = Result<T, Box<Flaw>>;

struct ObjReader<Library> {
    place: ObjPlace,
    read_library: Library,
    vertices: Vec<ObjValue<DVec3>>,
    normals: Vec<ObjValue<Vec3>>,
    materials: Materials,
    object: String,
    /// The name that `usemtl` gives, and its line.
    material: Option<(String, usize)>,
    /// That of faces from here on, if one was there already.
    mesh: Option<usize>,
    mesh_of: HashMap<(String, String), usize>,
    names: HashSet<String>,
    facets_of_mesh: Vec<usize>,
    /// For each keyword that was left out its first line and how many there are.
    left_out: Vec<(String, usize, usize)>,
    model: Model,
}

/// Reads the model `path`, which holds `text`; `read_library` gives a material library by its name.
pub fn read_model(
    path: &Path,
    text: &str,
    read_library: impl Fn(&str) -> Result<(PathBuf, String), ModelError>,
) -> Result<Model, ModelError> {
    let mut reader = ObjReader {
        place: ObjPlace::new(path),
        read_library,
        vertices: Vec::new(),
        normals: Vec::new(),
        materials: Materials::default(),
        object: "unnamed".to_owned(),
        material: None,
        mesh: None,
        mesh_of: HashMap::new(),
        names: HashSet::new(),
        facets_of_mesh: Vec::new(),
        left_out: Vec::new(),
        model: Model::default(),
    };
    for line in lines(text, starts) {
        reader.place.line = line.number;
        reader.line(line)?;
    }
    reader.finish()
}

impl<Library: Fn(&str) -> Result<(PathBuf, String), ModelError>> ObjReader<Library> {
    fn line(&mut self, line: ObjLine) -> Result<(), ModelError> {
        match line.keyword.as_str() {
            "v" => self.vertices.push(self.value(vertex(&line))),
            "vn" => self.normals.push(self.value(normal(&line))),
            // `fo` is the word of the format's first version.
            "f" | "fo" => self.face(&line)?,
            "o" | "g" => {
                // `#` in the middle may be part of the name, and nothing depends on its end.
                if !line.rest.is_empty() && !line.rest.starts_with("# ") {
                    self.object = line.rest;
                    self.mesh = None;
                }
            }
            "usemtl" => {
                self.material = Some((line.rest, line.number));
                self.mesh = None;
            }
            "mtllib" => {
                let Self { place, materials, read_library, .. } = self;
                read_libraries(&line.rest, place, materials, &*read_library)?;
            }
            keyword if WITHOUT_AREA.contains(&keyword) => {}
            keyword if REFUSED.contains(&keyword) => {
                let message = format!("expected faces ('f'), found '{keyword}', which is not read");
                return Err(self.place.flaw(message).into());
            }
            keyword => {
                let is_number = |word: &str| word.parse::<f64>().is_ok() || word.contains('/');
                let is_data = line.words().next().is_some() && line.words().all(is_number);
                if is_data && !THIN.contains(&keyword) {
                    let message = format!("expected a keyword of OBJ, found '{keyword}'");
                    return Err(self.place.flaw(message).into());
                }
                self.leave_out(line);
            }
        }
        Ok(())
    }

    fn value<T>(&self, value: Result<T, String>) -> ObjValue<T> {
        value.map_err(|message| Box::new(self.place.flaw(message)))
    }

    fn leave_out(&mut self, line: ObjLine) {
        let known = self.left_out.iter().position(|(keyword, ..)| *keyword == line.keyword);
        if let Some(known) = known {
            self.left_out[known].2 += 1;
        } else if self.left_out.len() < MOST_NOTES {
            self.left_out.push((line.keyword, line.number, 1));
        }
    }

    fn face(&mut self, line: &ObjLine) -> Result<(), ModelError> {
        let corners: Vec<_> =
            line.words().map(|corner| self.corner(corner)).collect::<Result<_, _>>()?;
        if corners.len() < 3 {
            let message = format!("expected at least 3 corners after 'f', found {}", corners.len());
            return Err(self.place.flaw(message).into());
        }
        let mesh = self.mesh()?;
        let facet = self.facets_of_mesh[mesh];
        self.facets_of_mesh[mesh] += 1;
        let (positions, normals): (Vec<DVec3>, Vec<Option<Vec3>>) = corners.into_iter().unzip();
        let file_normal = normals[0].filter(|_| normals.iter().all(|other| *other == normals[0]));
        let Some(triangles) = triangulate(&positions) else {
            let message = format!(
                "expected a face whose edges do not cross, of at most {MOST_CORNERS} corners if it \
                 is not convex"
            );
            return Err(self.place.flaw(message).into());
        };
        if let Some(off) = off_plane(&positions) {
            let message = format!("expected a flat face, found a corner {off:.6} off its plane");
            return Err(self.place.flaw(message).into());
        }
        for triangle in triangles {
            let vertices = triangle.map(|corner| positions[corner]);
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

    /// The position of a corner such as `7`, `7/1`, `7//3` or `-1/2/3`, and its normal if it has
    /// one.
    fn corner(&self, corner: &str) -> Result<(DVec3, Option<Vec3>), Flaw> {
        let mut indices = corner.splitn(3, '/');
        let vertex = indices.next().unwrap_or_default();
        let position = *self.element(&self.vertices, vertex, "vertex")?;
        match indices.next() {
            None | Some("") => {}
            Some(index) => _ = self.number(index, "texture coordinate")?,
        }
        let normal = match indices.next() {
            None | Some("") => None,
            Some(index) => Some(*self.element(&self.normals, index, "normal")?),
        };
        Ok((position, normal))
    }

    fn number(&self, index: &str, what: &str) -> Result<i64, Flaw> {
        index.parse().map_err(|_| {
            self.place.flaw(format!("expected the number of a {what} in 'f', found '{index}'"))
        })
    }

    fn element<'a, T>(
        &self,
        all: &'a [ObjValue<T>],
        index: &str,
        what: &str,
    ) -> Result<&'a T, Flaw> {
        let number = self.number(index, what)?;
        let position = if number < 0 { all.len() as i64 + number } else { number - 1 };
        let value = usize::try_from(position).ok().and_then(|position| all.get(position));
        let value = value.ok_or_else(|| {
            self.place.flaw(format!("{what} {number} does not exist: {} so far", all.len()))
        })?;
        value.as_ref().map_err(|flaw| (**flaw).clone())
    }

    fn mesh(&mut self) -> Result<usize, Flaw> {
        if let Some(mesh) = self.mesh {
            return Ok(mesh);
        }
        let Some((name, line)) = &self.material else {
            return Err(self.place.flaw("expected a 'usemtl' line before the first face"));
        };
        let (name, material) = self.materials.find(name).map_err(|message| Flaw {
            path: self.place.path.clone(),
            line: *line,
            message,
        })?;
        let response = material.response.clone()?;
        let key = (self.object.clone(), name.to_owned());
        let mesh = match self.mesh_of.get(&key) {
            Some(mesh) => *mesh,
            None => {
                let mesh = self.model.mesh_objects.len();
                if mesh > MOST_MESH_OBJECTS {
                    let message =
                        format!("expected at most {MOST_MESH_OBJECTS} objects with a material");
                    return Err(self.place.flaw(message));
                }
                if let Some(texture) = &material.texture {
                    let note = texture.to_string();
                    if !self.model.notes.contains(&note) {
                        self.model.notes.push(note);
                    }
                }
                let mut name = key.0.clone();
                if !self.names.insert(name.clone()) {
                    name = format!("{}:{}", key.0, key.1);
                }
                self.mesh_of.insert(key, mesh);
                self.facets_of_mesh.push(0);
                let material = Material::new(response);
                self.model.mesh_objects.push(MeshObject { name, material });
                mesh
            }
        };
        self.mesh = Some(mesh);
        Ok(mesh)
    }

    fn finish(mut self) -> Result<Model, ModelError> {
        if self.model.triangles.is_empty() {
            let degenerate: usize = self.facets_of_mesh.iter().sum();
            if let Some(flaw) = self.first_flaw().filter(|_| degenerate == 0) {
                return Err(flaw.into());
            }
            let found = match degenerate {
                0 => "found none".to_owned(),
                _ => format!("found only degenerate ones ({degenerate})"),
            };
            let expected = "expected at least one face with an area ('f')";
            return Err(self.place.flaw(format!("{expected}, {found}")).into());
        }
        for (keyword, line, count) in self.left_out {
            self.place.line = line;
            let message = match count {
                1 => format!("'{keyword}' is left out"),
                _ => format!("'{keyword}' is left out, here and {} more times", count - 1),
            };
            self.model.notes.push(self.place.flaw(message).to_string());
        }
        self.model.libraries = self.materials.libraries;
        Ok(self.model)
    }

    /// What is wrong in a file without faces, which is hardly meant to have none.
    fn first_flaw(&self) -> Option<Flaw> {
        let of_vertices = self.vertices.iter().filter_map(|value| value.as_ref().err());
        let of_normals = self.normals.iter().filter_map(|value| value.as_ref().err());
        let flaw = of_vertices.chain(of_normals).min_by_key(|flaw| flaw.line);
        let (name, line) = self.material.clone().unwrap_or_default();
        let of_use = || self.materials.find(&name).err().filter(|_| line > 0);
        let of_use = || Some(Flaw { path: self.place.path.clone(), line, message: of_use()? });
        flaw.map(|flaw| (**flaw).clone()).or_else(of_use).or_else(|| self.materials.first_flaw())
    }
}
