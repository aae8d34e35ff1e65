//! The picture in lanes: the bytes of [`image_writer::take_picture`].

use glam::Vec3;
use rayon::prelude::*;

use super::closest_hit::{Closest, GROUP, Hits, NONE, Rays, SharedCorners};
use super::width::Width;
use crate::rendering::backward_renderer::BackwardRenderer;
use crate::rendering::image_writer;
use crate::rendering::photon_mapping_renderer::{PHOTON_DOT_RADIUS, PhotonMappingRenderer};
use crate::scene::camera::PerspectiveCamera;
use crate::scene::intersection_state::IntersectionState;
use crate::scene::ray::Ray;

/// The picture of `width` x `height` pixels that `camera` takes, with vectors of `lanes`. A scene
/// that is too large for lanes is left to [`image_writer::take_picture`], whose steps these are, a
/// group of pixels at a time.
pub fn take_picture(
    renderer: &PhotonMappingRenderer,
    lanes: Width,
    camera: &PerspectiveCamera,
    width: u32,
    height: u32,
    row_done: impl Fn() + Sync,
) -> image::RgbImage {
    if renderer.stored_scene.triangles().len() > super::MOST_TRIANGLES {
        return image_writer::take_picture(renderer, camera, width, height, row_done);
    }
    let corners = SharedCorners::new(&renderer.stored_scene);
    let mut picture = image::RgbImage::new(width, height);
    picture.par_chunks_exact_mut(3 * width as usize).enumerate().for_each_init(
        || Tracer {
            renderer,
            lanes,
            corners: &corners,
            rays: Rays::default(),
            hits: Hits::default(),
        },
        |tracer, (row, pixels)| {
            for (group, pixels) in pixels.chunks_mut(3 * GROUP).enumerate() {
                let ray = |pixel: usize| {
                    let column = (group * GROUP + pixel) as u32;
                    image_writer::camera_ray(camera, column, row as u32, width, height)
                };
                let camera_rays: Vec<_> = (0..pixels.len() / 3).map(ray).collect();
                let colors = tracer.sample_colors(&camera_rays);
                for (pixel, color) in pixels.chunks_exact_mut(3).zip(colors) {
                    pixel.copy_from_slice(&image_writer::to_bytes(color));
                }
            }
            row_done();
        },
    );
    picture
}

struct Tracer<'a> {
    renderer: &'a PhotonMappingRenderer,
    lanes: Width,
    corners: &'a SharedCorners,
    rays: Rays,
    hits: Hits,
}

impl Tracer<'_> {
    /// What [`PhotonMappingRenderer::compute_sample_color`] gives for each of at most [`GROUP`] rays.
    fn sample_colors(&mut self, camera_rays: &[Ray]) -> Vec<Vec3> {
        let scene = &self.renderer.stored_scene;
        let states = self.trace(camera_rays);
        let hits = || states.iter().enumerate().filter_map(|(p, s)| Some((p, s.as_ref()?)));
        let mut colors = vec![Vec3::ZERO; camera_rays.len()];
        let direct_light = BackwardRenderer::new(scene);
        for light in scene.lights() {
            let (lit, shadow_rays): (Vec<_>, Vec<_>) = hits()
                .filter_map(|(pixel, state)| {
                    let (shadow_ray, color) = direct_light.light_towards(light, state);
                    Some(((pixel, color?), shadow_ray))
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

    /// What [`crate::scene::Scene::trace`] gives for each of at most [`GROUP`] rays.
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
