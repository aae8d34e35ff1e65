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

#[cfg(test)]
mod tests {
    use glam::Vec3;
    use photon_mapping::assignment8;

    use super::*;

    #[test]
    fn the_model_file_is_the_scene_of_the_assignment() {
        let model = obj::parse(include_str!("../assets/cornell_box.obj"), |_| {
            Ok(include_str!("../assets/cornell_box.mtl").to_owned())
        });
        let light = ModelLight { position: DVec3::new(0.01909, 0.0101, 1.77640), color: Vec3::ONE };
        let (scene, placement) = place(model.unwrap(), &[light]);
        let expected = assignment8::create_scene();
        assert_eq!(scene.mesh_objects(), expected.mesh_objects());
        assert_eq!(scene.triangles(), expected.triangles());
        assert_eq!(scene.lights(), expected.lights());
        assert_eq!(placement, Placement::WORLD);
    }
}
