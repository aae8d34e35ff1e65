//! The handout's scene in other sizes and places.

use std::fmt::Write as _;

use glam::DVec3;

use model::obj::{self, ModelLight};
use photon_mapping::assignment8;
use photon_mapping::scene::Scene;
use photon_mapping::scene::point_light::PointLight;
use photon_mapping::scene::triangle::Triangle;

/// Where the scene is put.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Displacement {
    /// All lengths times this.
    Scaled(f64),
    /// This far along each of the three axes, in scene units.
    Moved(f64),
}

impl Displacement {
    /// All places of the report.
    pub fn all() -> Vec<Self> {
        let scales = [1e-4, 1e-3, 1e-2, 1e-1, 1.0, 1e1, 1e2, 1e3, 1e4];
        let moves = [1e1, 1e2, 1e3, 1e4, 1e5];
        scales.into_iter().map(Self::Scaled).chain(moves.into_iter().map(Self::Moved)).collect()
    }

    fn apply(self, point: DVec3) -> DVec3 {
        match self {
            Self::Scaled(factor) => point * factor,
            Self::Moved(distance) => point + DVec3::splat(distance),
        }
    }
}

/// A coordinate of the model file, before rounding to f32.
fn figures(point: glam::Vec3) -> DVec3 {
    let figure =
        |float: f32| float.to_string().parse().expect("what a float prints as is a number");
    DVec3::from_array(point.to_array().map(figure))
}

/// The scene with its coordinates put in `place` and then rounded to f32, as in a program that
/// takes a model as it is.
pub fn as_it_comes(place: Displacement) -> Scene {
    let scene = assignment8::create_scene();
    let put = |point| place.apply(figures(point)).as_vec3();
    let triangles = scene
        .triangles()
        .iter()
        .map(|triangle| Triangle { vertices: triangle.vertices.map(put), ..*triangle });
    let lights = scene
        .lights()
        .iter()
        .map(|light| PointLight { position: put(light.position), color: light.color });
    Scene::new(scene.mesh_objects().to_vec(), triangles.collect(), lights.collect())
}

/// The scene in `place`, written as a model file and read the way the program reads a user's model.
pub fn as_loaded(place: Displacement) -> Scene {
    let scene = assignment8::create_scene();
    let (text, materials) = model_text(&scene, place);
    let model = obj::parse(&text, |_| Ok(materials.clone())).expect("the text is well formed");
    let lights = scene.lights().iter().map(|light| ModelLight {
        position: place.apply(figures(light.position)),
        color: light.color,
    });
    model::place(model, &lights.collect::<Vec<_>>()).0
}

/// The model in `place` as OBJ, y up, and its materials.
fn model_text(scene: &Scene, place: Displacement) -> (String, String) {
    let mut text = String::from("mtllib materials\n");
    let mut materials = String::new();
    for (number, mesh_object) in scene.mesh_objects().iter().enumerate() {
        let name = &mesh_object.name;
        let diffuse = mesh_object.material.base_diffuse_reflection();
        let _ = writeln!(materials, "newmtl {name}\nKd {} {} {}", diffuse.x, diffuse.y, diffuse.z);
        let _ = writeln!(text, "o {name}\nusemtl {name}");
        let of_mesh: Vec<_> =
            scene.triangles().iter().filter(|t| t.parent_mesh_object == number).collect();
        for fan in of_mesh.chunk_by(|a, b| a.facet == b.facet) {
            let normal = fan[0].normal;
            let mut corners = vec![fan[0].vertices[0], fan[0].vertices[1]];
            corners.extend(fan.iter().map(|triangle| triangle.vertices[2]));
            // The loader turns y up into z up: (x, y, z) becomes (x, -z, y).
            for corner in &corners {
                let point = place.apply(figures(*corner));
                let _ = writeln!(text, "v {} {} {}", point.x, point.z, 0.0 - point.y);
            }
            let _ = writeln!(text, "vn {} {} {}", normal.x, normal.z, 0.0 - normal.y);
            text += "f";
            (0..corners.len()).for_each(|k| {
                let _ = write!(text, " -{}//-1", corners.len() - k);
            });
            text += "\n";
        }
    }
    (text, materials)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scene_in_its_own_place_is_itself() {
        let scene = assignment8::create_scene();
        assert_eq!(as_it_comes(Displacement::Scaled(1.0)).triangles(), scene.triangles());
        let loaded = as_loaded(Displacement::Scaled(1.0));
        assert_eq!(loaded.lights(), scene.lights());
        for (loaded, known) in loaded.triangles().iter().zip(scene.triangles()) {
            assert_eq!(loaded.vertices, known.vertices);
            assert!((loaded.normal - known.normal).length() < 1e-6);
            let names = |t: &Triangle| (t.parent_mesh_object, t.facet);
            assert_eq!(names(loaded), names(known));
        }
    }
}
