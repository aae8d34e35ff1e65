//! The one configurable tracer: `trace_photon` of the port with its knobs out.
//!
//! With [`Reading::REFERENCE`] and [`Sampler::ChaCha`] it stores what the port stores, bit for bit;
//! a test holds it to that.

use std::ops::Range;

use glam::Vec3;
use photon_mapping::rendering::photon_mapping_renderer::{
    PathVertex, Photon, PhotonMappingRenderer,
};
use photon_mapping::rendering::sampling::sample_hemisphere;
use photon_mapping::scene::ray::{IntersectionState, Ray};

use crate::reading::Reading;
use crate::sampler::Sampler;

/// Traces the photons numbered `photons` as
/// [`PhotonMappingRenderer::generic_photon_map_generation`] does, but under `reading` and with the
/// numbers of `sampler`.
pub fn generic_photon_map_generation(
    renderer: &PhotonMappingRenderer,
    reading: &Reading,
    sampler: Sampler,
    photon_map: &mut Vec<Photon>,
    photons: Range<u64>,
    mut photon_done: impl FnMut(u64, &[PathVertex], &[Photon]),
) {
    let mut path = Vec::new();
    let lights = renderer.stored_scene.lights();
    for (light, of_light) in lights.iter().zip(renderer.photons_of_lights()) {
        let light_intensity = light.color / (of_light.end - of_light.start) as f32;
        for photon in of_light.start.max(photons.start)..of_light.end.min(photons.end) {
            let (photon_ray, mut rand) = sampler.start_photon(light, renderer.seed, photon);
            let stored_before = photon_map.len();
            path.clear();
            path.push(PathVertex::Light);
            trace_photon(
                renderer,
                reading,
                photon_map,
                photon_ray,
                light_intensity,
                &mut path,
                renderer.max_photon_bounces,
                &mut rand,
            );
            photon_done(photon, &path, &photon_map[stored_before..]);
        }
    }
}

/// Traces one photon as [`PhotonMappingRenderer::trace_photon`] does, but under `reading`.
#[allow(clippy::too_many_arguments, reason = "those of the port, and the reading")]
pub fn trace_photon(
    renderer: &PhotonMappingRenderer,
    reading: &Reading,
    photon_map: &mut Vec<Photon>,
    mut photon_ray: Ray,
    light_intensity: Vec3,
    path: &mut Vec<PathVertex>,
    max_bounces: i32,
    rand: &mut impl FnMut() -> f32,
) {
    let scene = &renderer.stored_scene;
    for _ in 0..=max_bounces {
        let mut state = IntersectionState::new();
        if !scene.trace(&photon_ray, Some(&mut state)) {
            return;
        }
        let intersection_point = state.intersection_point();
        if path.len() > 1 {
            photon_map.push(Photon {
                position: intersection_point,
                intensity: light_intensity,
                to_light_ray: Ray::new(intersection_point, -photon_ray.ray_direction()),
            });
        }
        path.push(PathVertex::Surface(state));

        let mesh_object = &scene.mesh_objects()[state.primitive(scene).parent_mesh_object];
        if rand() >= mesh_object.material.base_diffuse_reflection().max_element() {
            return;
        }
        let (u1, u2) = (rand(), rand());
        photon_ray = diffuse_reflection_ray(renderer, reading, &state, u1, u2);
    }
}

/// The ray of a photon that scatters at the hit of `state`, as
/// [`PhotonMappingRenderer::diffuse_reflection_ray`] gives it, but under `reading`.
pub fn diffuse_reflection_ray(
    renderer: &PhotonMappingRenderer,
    reading: &Reading,
    state: &IntersectionState,
    u1: f32,
    u2: f32,
) -> Ray {
    let scene = &renderer.stored_scene;
    let normal = state.compute_normal(scene);
    // If t and b are not unit vectors, the product is not one either.
    let direction = (reading.tangent_frame(normal) * sample_hemisphere(u1, u2)).normalize();
    let point = state.intersection_point();
    let needed = scene.offset(state.intersected_primitive, point, state.intersection_t);
    let start = reading.offset.start(point, normal, direction, needed);
    let mut ray = Ray::new(start, direction);
    ray.start_error = reading.offset.start_error(needed);
    ray
}
