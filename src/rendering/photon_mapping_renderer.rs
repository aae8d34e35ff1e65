//! The photon mapping renderer: C++ `PhotonMappingRenderer.cpp`, where the assignment is solved.

use std::ops::Range;

use glam::Vec3;

use super::backward_renderer::BackwardRenderer;
use super::photon::Photon;
use super::photon_map::PhotonMap;
use super::reading::Reading;
use super::sampler::Sampler;
use super::sampling::{sample_hemisphere, tangent_frame};
use crate::scene::Scene;
use crate::scene::intersection_state::IntersectionState;
use crate::scene::lights::point_light::PointLight;
use crate::scene::ray::Ray;

/// Half the edge of the cube around a point in which a photon turns the point red, in scene units.
pub const PHOTON_DOT_RADIUS: f32 = 0.003;

/// One element of a photon's path. The handout's path is a vector of characters whose length alone
/// matters; this one also remembers what happened, for those who look on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PathVertex {
    /// The photon leaves its light.
    Light,
    /// The photon hits a surface.
    Surface(IntersectionState),
}

/// Shoots photons from the lights into the scene, stores where they land, and shows them.
#[derive(Clone, Debug)]
pub struct PhotonMappingRenderer {
    /// The scene, with its lights.
    pub stored_scene: Scene,
    /// How many photons all lights send out together.
    pub photon_count: u64,
    /// How often a photon may bounce at most.
    pub max_photon_bounces: i32,
    /// The key of all random numbers.
    pub seed: u64,
    /// How the handout is read where it leaves something open.
    pub reading: Reading,
    /// What gives the random numbers.
    pub sampler: Sampler,
    /// The photons stored by [`Self::initialize_renderer`].
    pub diffuse_map: PhotonMap,
}

impl PhotonMappingRenderer {
    /// Fills the photon map: C++ `InitializeRenderer`.
    pub fn initialize_renderer(&mut self) {
        let mut photon_map = Vec::new();
        let all_photons = 0..self.emitted();
        self.generic_photon_map_generation(&mut photon_map, all_photons, |_, _, _| ());
        self.diffuse_map = PhotonMap::new(photon_map.iter().map(|photon| photon.position));
    }

    /// Shoots the photons numbered `photons`, counted over all lights in order, and adds to
    /// `photon_map` those that are stored: C++ `GenericPhotonMapGeneration`.
    ///
    /// After each photon, `look_on` is shown its number, its path, and what it stored. The photon
    /// stored at `path[k]`, k >= 2, had bounced k - 1 times.
    pub fn generic_photon_map_generation(
        &self,
        photon_map: &mut Vec<Photon>,
        photons: Range<u64>,
        mut look_on: impl FnMut(u64, &[PathVertex], &[Photon]),
    ) {
        let mut path = Vec::new();
        let mut first_of_light = 0;
        for (light, light_photons) in
            self.stored_scene.lights().iter().zip(self.photons_per_light())
        {
            let light_intensity = light.color / light_photons as f32;
            let of_light = first_of_light..first_of_light + light_photons;
            for photon in of_light.start.max(photons.start)..of_light.end.min(photons.end) {
                let (photon_ray, mut rand) = self.sampler.start_photon(light, self.seed, photon);
                let stored_before = photon_map.len();
                path.clear();
                path.push(PathVertex::Light);
                self.trace_photon(
                    photon_map,
                    &photon_ray,
                    light_intensity,
                    &mut path,
                    self.max_photon_bounces,
                    &mut rand,
                );
                look_on(photon, &path, &photon_map[stored_before..]);
            }
            first_of_light = of_light.end;
        }
    }

    /// Follows one photon until it leaves the scene, is absorbed, or has bounced too often: C++
    /// `TracePhoton`.
    ///
    /// `light_intensity` is stored with it; `path` has one element for the light and one for every
    /// surface hit so far. The order of draws from `rand` is the roulette's number at every hit,
    /// then, if the photon scatters, u1 and u2.
    pub fn trace_photon(
        &self,
        photon_map: &mut Vec<Photon>,
        photon_ray: &Ray,
        light_intensity: Vec3,
        path: &mut Vec<PathVertex>,
        remaining_bounces: i32,
        rand: &mut impl FnMut() -> f32,
    ) {
        // Photon Storage
        if remaining_bounces < 0 {
            return;
        }
        let mut state = IntersectionState::new();
        if !self.stored_scene.trace(photon_ray, Some(&mut state)) {
            return;
        }

        let intersection_point = state.intersection_ray.ray_position(state.intersection_t);
        if path.len() > 1 {
            photon_map.push(Photon {
                position: intersection_point,
                intensity: light_intensity,
                to_light_ray: Ray::new(intersection_point, -photon_ray.ray_direction()),
            });
        }
        path.push(PathVertex::Surface(state));

        // Photon Scattering/Absorption
        let hit_mesh_object = &self.stored_scene.mesh_objects()
            [state.primitive(&self.stored_scene).parent_mesh_object];
        let diffuse_response = hit_mesh_object.material.base_diffuse_reflection();
        let probability_of_reflection = diffuse_response.max_element();
        if rand() >= probability_of_reflection {
            return;
        }

        // Hemisphere Sampling
        let u1 = rand();
        let u2 = rand();
        let tangent_space_direction = sample_hemisphere(u1, u2);

        // Hemisphere Ray Transformation
        let normal = state.compute_normal(&self.stored_scene);
        let tangent_to_world = tangent_frame(normal, &self.reading);
        // The sample has length 1; t and b that have not, as in the letter of the handout, change it.
        let world_direction = (tangent_to_world * tangent_space_direction).normalize();

        // The handout names no offset. Without one, two in five scattered photons would hit the
        // triangle they leave, so they start where the framework starts its shadow rays.
        let needed = self.stored_scene.offset(
            state.intersected_primitive,
            intersection_point,
            state.intersection_t,
        );
        let start = self.reading.offset.start(intersection_point, normal, world_direction, needed);
        let mut diffuse_reflection_ray = Ray::new(start, world_direction);
        diffuse_reflection_ray.start_error = self.reading.offset.start_error(needed);
        self.trace_photon(
            photon_map,
            &diffuse_reflection_ray,
            light_intensity,
            path,
            remaining_bounces - 1,
            rand,
        );
    }

    /// The colour that `camera_ray` sees: direct light, and red where a photon is near: C++
    /// `ComputeSampleColor`.
    pub fn compute_sample_color(&self, camera_ray: &Ray) -> Vec3 {
        let mut state = IntersectionState::new();
        if !self.stored_scene.trace(camera_ray, Some(&mut state)) {
            return Vec3::ZERO;
        }
        let mut color = BackwardRenderer::new(&self.stored_scene).compute_sample_color(&state);
        if self.diffuse_map.any_within_cube(state.intersection_point(), PHOTON_DOT_RADIUS) {
            color += Vec3::X;
        }
        color
    }

    /// How many photons each light sends out: its part of the brightness of all lights, truncated.
    ///
    /// As in the framework, the product is formed in f32; counts beyond 2^24, which f32 cannot
    /// tell apart, in f64.
    pub fn photons_per_light(&self) -> Vec<u64> {
        let brightness = |light: &PointLight| light.color.length();
        let lights = self.stored_scene.lights();
        let total = lights.iter().map(brightness).fold(0.0, |sum, brightness| sum + brightness);
        let share_of = |light| {
            let share = brightness(light) / total;
            if self.photon_count <= 1 << 24 {
                (share * self.photon_count as f32) as u64
            } else {
                (f64::from(share) * self.photon_count as f64) as u64
            }
        };
        lights.iter().map(share_of).collect()
    }

    /// How many photons all lights really send out; by the truncation, it may be a few less than
    /// [`Self::photon_count`].
    pub fn emitted(&self) -> u64 {
        self.photons_per_light().iter().sum()
    }
}
