//! The picture in lanes, to the bytes of [`image_writer::take_picture`].

use glam::Vec3;
use rayon::prelude::*;

use super::closest_hit::{Closest, GROUP, Hits, NONE, Rays, SharedCorners};
use super::width::Width;
use photon_mapping::rendering::backward_renderer::light_towards;
use photon_mapping::rendering::image_writer;
use photon_mapping::rendering::photon_mapping_renderer::{
    PHOTON_DOT_RADIUS, PhotonMappingRenderer,
};
use photon_mapping::scene::camera::PerspectiveCamera;
use photon_mapping::scene::ray::IntersectionState;
use photon_mapping::scene::ray::Ray;

/// Every so many pixels, one is computed by the port too.
const PIXELS_BETWEEN_CHECKS: usize = 101;

/// A picture, and whether lanes and port agree on it.
#[derive(Clone, Debug)]
pub struct CheckedPicture {
    /// The picture.
    pub picture: image::RgbImage,
    /// Column and row of a pixel on which lanes and port differ. The whole picture is then the
    /// port's.
    pub difference: Option<(u32, u32)>,
}

/// The picture of `width` x `height` pixels that `camera` takes, on all threads, with vectors of
/// `lanes`. `row_done` is called after every row, on any thread.
///
/// Scenes that are too large for lanes go through the port, and so do all pixels where a sample of
/// the lanes' pixels differs from the port's.
pub fn take_picture(
    renderer: &PhotonMappingRenderer,
    lanes: Width,
    camera: &PerspectiveCamera,
    width: u32,
    height: u32,
    row_done: impl Fn() + Sync,
) -> CheckedPicture {
    let camera_ray = |column: usize, row: usize| {
        image_writer::camera_ray(camera, column as u32, row as u32, width, height)
    };
    let of_port = |ray: &Ray| image_writer::to_bytes(renderer.compute_sample_color(ray));
    let take_with_port = || {
        let mut picture = image::RgbImage::new(width, height);
        let rows = picture.par_chunks_exact_mut(3 * width as usize).enumerate();
        rows.for_each(|(row, pixels)| {
            for (column, pixel) in pixels.chunks_exact_mut(3).enumerate() {
                pixel.copy_from_slice(&of_port(&camera_ray(column, row)));
            }
            row_done();
        });
        picture
    };
    if renderer.stored_scene.triangles().len() > super::MOST_TRIANGLES {
        return CheckedPicture { picture: take_with_port(), difference: None };
    }
    let corners = SharedCorners::new(&renderer.stored_scene);
    let mut picture = image::RgbImage::new(width, height);
    picture.par_chunks_exact_mut(3 * width as usize).enumerate().for_each_init(
        || PictureTracer {
            renderer,
            lanes,
            corners: &corners,
            rays: Rays::default(),
            hits: Hits::default(),
        },
        |tracer, (row, pixels)| {
            for (group, pixels) in pixels.chunks_mut(3 * GROUP).enumerate() {
                let ray = |pixel: usize| camera_ray(group * GROUP + pixel, row);
                let camera_rays: Vec<_> = (0..pixels.len() / 3).map(ray).collect();
                let colors = tracer.sample_colors(&camera_rays);
                for (pixel, color) in pixels.chunks_exact_mut(3).zip(colors) {
                    pixel.copy_from_slice(&image_writer::to_bytes(color));
                }
            }
            row_done();
        },
    );
    let checked = (0..width as usize * height as usize).step_by(PIXELS_BETWEEN_CHECKS);
    let difference = checked
        .map(|pixel| (pixel % width as usize, pixel / width as usize))
        .find(|(column, row)| {
            let of_lanes = picture.get_pixel(*column as u32, *row as u32).0;
            of_lanes != of_port(&camera_ray(*column, *row))
        })
        .map(|(column, row)| (column as u32, row as u32));
    if difference.is_some() {
        picture = take_with_port();
    }
    CheckedPicture { picture, difference }
}

struct PictureTracer<'a> {
    renderer: &'a PhotonMappingRenderer,
    lanes: Width,
    corners: &'a SharedCorners,
    rays: Rays,
    hits: Hits,
}

impl PictureTracer<'_> {
    /// What [`PhotonMappingRenderer::compute_sample_color`] gives for each of at most [`GROUP`]
    /// rays.
    fn sample_colors(&mut self, camera_rays: &[Ray]) -> Vec<Vec3> {
        let scene = &self.renderer.stored_scene;
        let states = self.trace(camera_rays);
        let hits = || states.iter().enumerate().filter_map(|(p, s)| Some((p, s.as_ref()?)));
        let mut colors = vec![Vec3::ZERO; camera_rays.len()];
        for light in scene.lights() {
            let (lit, shadow_rays): (Vec<_>, Vec<_>) = hits()
                .filter_map(|(pixel, state)| {
                    let (shadow_ray, color) = light_towards(scene, state, light);
                    (color != Vec3::ZERO).then_some(((pixel, color), shadow_ray))
                })
                .unzip();
            for ((pixel, color), obstacle) in lit.into_iter().zip(self.trace(&shadow_rays)) {
                // Any obstacle before the light hides it, so the closest one does.
                if obstacle.is_none() {
                    colors[pixel] += color;
                }
            }
        }
        for (pixel, state) in hits() {
            let point = state.intersection_point();
            if self.renderer.diffuse_map.any_within_cube(point, PHOTON_DOT_RADIUS) {
                colors[pixel] += Vec3::X;
            }
        }
        colors
    }

    /// What [`photon_mapping::scene::Scene::trace`] gives for each of at most [`GROUP`] rays.
    fn trace(&mut self, rays: &[Ray]) -> Vec<Option<IntersectionState>> {
        if rays.is_empty() {
            return Vec::new();
        }
        for (lane, ray) in rays.iter().enumerate() {
            self.rays.set(lane, ray);
        }
        let Self { renderer, lanes, corners, rays: columns, hits } = self;
        lanes.run(Closest { scene: corners, rays: columns, hits });
        hits.settle(&renderer.stored_scene, columns, rays.len());
        rays.iter()
            .enumerate()
            .map(|(lane, ray)| {
                let (t, triangle) = (hits.t[lane], hits.triangle[lane]);
                (triangle != NONE && t < ray.max_t).then_some(IntersectionState {
                    intersection_ray: *ray,
                    intersection_t: t,
                    intersected_primitive: triangle as usize,
                })
            })
            .collect()
    }
}
