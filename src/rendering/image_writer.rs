//! From colors to a picture: C++ `ImageWriter`, and the loop over pixels of `RayTracer::Run`.

use glam::Vec3;
use image::RgbImage;

use super::photon_mapping_renderer::PhotonMappingRenderer;
use crate::scene::camera::PerspectiveCamera;
use crate::scene::ray::Ray;

/// The picture of `width` x `height` pixels that `camera` takes, with one sample a pixel.
pub fn take_picture(
    renderer: &PhotonMappingRenderer,
    camera: &PerspectiveCamera,
    width: u32,
    height: u32,
) -> RgbImage {
    RgbImage::from_fn(width, height, |column, row| {
        let ray = camera_ray(camera, column, row, width, height);
        image::Rgb(to_bytes(renderer.compute_sample_color(&ray)))
    })
}

/// The ray through the upper left corner of a pixel. As in the framework, not through its middle.
pub fn camera_ray(
    camera: &PerspectiveCamera,
    column: u32,
    row: u32,
    width: u32,
    height: u32,
) -> Ray {
    camera.generate_ray_for_normalized_coordinates(
        column as f32 / width as f32,
        row as f32 / height as f32,
    )
}

/// Each channel times 255, clamped to [0, 255] and truncated. There is no gamma.
pub fn to_bytes(color: Vec3) -> [u8; 3] {
    (color * 255.0).clamp(Vec3::ZERO, Vec3::splat(255.0)).to_array().map(|channel| channel as u8)
}
