//! The assignment's scene, camera and renderer: C++ `Assignment8.cpp`.

use glam::Vec3;

use crate::rendering::photon_map::PhotonMap;
use crate::rendering::photon_mapping_renderer::PhotonMappingRenderer;
use crate::scene::Scene;
use crate::scene::camera::PerspectiveCamera;
use crate::scene::cornell_box;
use crate::scene::point_light::PointLight;

/// The seed of the reference run.
pub const SEED: u64 = 148;
/// How many photons all lights emit together.
pub const PHOTON_COUNT: u64 = 1_000_000;
/// How often a photon may bounce.
pub const MAX_PHOTON_BOUNCES: i32 = 1000;
/// The width of the picture, in pixels.
pub const WIDTH: u32 = 640;
/// The height of the picture, in pixels.
pub const HEIGHT: u32 = 480;
/// How much of the scene the picture shows from top to bottom, in degrees.
const VERTICAL_FIELD_OF_VIEW: f32 = 26.6;

/// The stripped Cornell box with its light, near where the ceiling was. World space, z up.
pub fn create_scene() -> Scene {
    let light = PointLight { position: Vec3::new(0.01909, 0.0101, 1.77640), color: Vec3::ONE };
    let (mesh_objects, triangles) = cornell_box::load();
    Scene::new(mesh_objects, triangles, vec![light])
}

/// The camera in front of the box, for a picture of `width` x `height` pixels.
pub fn create_camera(width: u32, height: u32) -> PerspectiveCamera {
    PerspectiveCamera::new(
        Vec3::new(0.0, -4.1469, 0.73693),
        Vec3::Y,
        Vec3::Z,
        VERTICAL_FIELD_OF_VIEW,
        width as f32 / height as f32,
    )
}

/// The renderer with the framework's settings. Its photon map is still empty.
pub fn create_renderer(scene: Scene) -> PhotonMappingRenderer {
    PhotonMappingRenderer {
        stored_scene: scene,
        photon_count: PHOTON_COUNT,
        max_photon_bounces: MAX_PHOTON_BOUNCES,
        seed: SEED,
        diffuse_map: PhotonMap::default(),
    }
}
