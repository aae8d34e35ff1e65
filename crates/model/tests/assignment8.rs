//! The model file of the assignment.

use glam::{DVec3, Vec3};
use model::obj::{self, ModelLight};
use model::place;
use model::placement::Placement;
use photon_mapping::assignment8;

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
