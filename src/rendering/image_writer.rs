//! From colours to bytes: C++ `ImageWriter`.

use glam::Vec3;
use rayon::prelude::*;

use super::photon_mapping_renderer::PhotonMappingRenderer;
use crate::scene::camera::PerspectiveCamera;
use crate::scene::ray::Ray;

/// The picture of `width` x `height` pixels that `camera` takes: one sample a pixel, through the
/// pixel's upper left corner as in the framework, not through its middle. `row_done` is called after
/// every row, on any thread.
pub fn take_picture(
    renderer: &PhotonMappingRenderer,
    camera: &PerspectiveCamera,
    width: u32,
    height: u32,
    row_done: impl Fn() + Sync,
) -> image::RgbImage {
    let mut picture = image::RgbImage::new(width, height);
    picture.par_chunks_exact_mut(3 * width as usize).enumerate().for_each(|(row, pixels)| {
        for (column, pixel) in pixels.chunks_exact_mut(3).enumerate() {
            let camera_ray = camera_ray(camera, column as u32, row as u32, width, height);
            pixel.copy_from_slice(&to_bytes(renderer.compute_sample_color(&camera_ray)));
        }
        row_done();
    });
    picture
}

/// The ray through the upper left corner of a pixel.
pub(crate) fn camera_ray(
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

/// Each channel times 255, cut off at 0 and 255 and truncated; no gamma.
pub(crate) fn to_bytes(color: Vec3) -> [u8; 3] {
    (color * 255.0).clamp(Vec3::ZERO, Vec3::splat(255.0)).to_array().map(|channel| channel as u8)
}
