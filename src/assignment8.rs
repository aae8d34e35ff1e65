//! The assignment's scene, camera and renderer: C++ `Assignment8.cpp`.

use glam::{DVec3, Vec3};

use crate::rendering::photon_map::PhotonMap;
use crate::rendering::photon_mapping_renderer::PhotonMappingRenderer;
use crate::rendering::reading::Reading;
use crate::rendering::sampler::Sampler;
use crate::scene::Scene;
use crate::scene::camera::PerspectiveCamera;
use crate::scene::obj::{self, ModelLight};

/// The seed of the reference run.
pub const SEED: u64 = 148;
/// How many photons the framework sends out.
pub const PHOTON_COUNT: u64 = 1_000_000;
/// How often a photon may bounce in the framework.
pub const MAX_PHOTON_BOUNCES: i32 = 1000;
/// The width of the picture, in pixels.
pub const WIDTH: u32 = 640;
/// The height of the picture, in pixels.
pub const HEIGHT: u32 = 480;

/// The stripped Cornell box with its light.
pub fn create_scene() -> Scene {
    let model = obj::parse(include_str!("assignment8/cornell_box.obj"), |_| {
        Ok(include_str!("assignment8/cornell_box.mtl").to_owned())
    })
    .expect("the model that is part of the program is well formed");
    Scene::from_model(model, &[create_light()])
}

/// The one light, near where the ceiling was.
pub fn create_light() -> ModelLight {
    ModelLight { position: DVec3::new(0.01909, 0.0101, 1.77640), color: Vec3::ONE }
}

/// The camera in front of the box, for a picture of `width` x `height` pixels.
pub fn create_camera(width: u32, height: u32) -> PerspectiveCamera {
    PerspectiveCamera::new(
        Vec3::new(0.0, -4.1469, 0.73693),
        Vec3::Y,
        Vec3::Z,
        26.6,
        width as f32 / height as f32,
    )
}

/// The renderer with the framework's settings; its photon map is still empty.
pub fn create_renderer(scene: Scene) -> PhotonMappingRenderer {
    PhotonMappingRenderer {
        stored_scene: scene,
        photon_count: PHOTON_COUNT,
        max_photon_bounces: MAX_PHOTON_BOUNCES,
        seed: SEED,
        reading: Reading::REFERENCE,
        sampler: Sampler::ChaCha,
        diffuse_map: PhotonMap::default(),
    }
}
