//! Scenes from model files: Wavefront OBJ, placed where f32 is precise.

pub mod facets;
pub mod obj;
pub mod placement;

use glam::DVec3;
use photon_mapping::scene::Scene;
use photon_mapping::scene::point_light::PointLight;
use photon_mapping::scene::triangle::Triangle;

use obj::{Model, ModelLight};
use placement::Placement;

/// The scene of `model` with `lights`, both in world space, and where it stands in the world.
pub fn place(model: Model, lights: &[ModelLight]) -> (Scene, Placement) {
    let corners = model.triangles.iter().flat_map(|triangle| triangle.vertices);
    let placement = Placement::around(corners, lights.iter().map(|light| light.position));
    let place = |point: DVec3| placement.to_scene(point);
    let triangles = model.triangles.iter().map(|triangle| Triangle {
        vertices: triangle.vertices.map(place),
        normal: triangle.normal,
        parent_mesh_object: triangle.parent_mesh_object,
        facet: triangle.facet,
    });
    let lights = lights
        .iter()
        .map(|light| PointLight { position: place(light.position), color: light.color });
    let scene = Scene::new(model.mesh_objects, triangles.collect(), lights.collect());
    (scene, placement)
}
