//! The photon mapping renderer: C++ `PhotonMappingRenderer.cpp`, where the assignment is solved.

use std::ops::Range;

use glam::Vec3;

use super::backward_renderer;
use super::photon_map::PhotonMap;
use super::sampling::{sample_hemisphere, tangent_frame};
use crate::random::photon_random;
use crate::scene::Scene;
use crate::scene::point_light::PointLight;
use crate::scene::ray::{IntersectionState, Ray};

/// Half the edge of the cube around a point in which a photon turns the point red, in world units.
pub const PHOTON_DOT_RADIUS: f32 = 0.003;

/// A stored photon: C++ `Photon.h`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Photon {
    /// The point hit, in world space.
    pub position: Vec3,
    /// The light's color divided by the number of photons it emits. As the handout asks, the
    /// roulette does not change it: right for the dots, wrong for radiance.
    pub intensity: Vec3,
    /// From the point hit back to where the photon came from.
    pub to_light_ray: Ray,
}

/// One element of a photon's path. Only the length of the handout's path matters. This one also
/// remembers each hit, for the photon list and for `explain`.
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
    /// How many photons all lights emit together.
    pub photon_count: u64,
    /// How often a photon may bounce at most.
    pub max_photon_bounces: i32,
    /// The seed of all random numbers.
    pub seed: u64,
    /// Where the photons were stored.
    pub diffuse_map: PhotonMap,
}

impl PhotonMappingRenderer {
    /// Fills the photon map: C++ `InitializeRenderer`. `photon_done` is called as
    /// [`Self::generic_photon_map_generation`] calls it.
    pub fn initialize_renderer(&mut self, photon_done: impl FnMut(u64, &[PathVertex], &[Photon])) {
        let mut photon_map = Vec::new();
        let all_photons = 0..self.emitted();
        self.generic_photon_map_generation(&mut photon_map, all_photons, photon_done);
        self.diffuse_map = PhotonMap::new(photon_map.iter().map(|photon| photon.position));
    }

    /// Shoots the photons numbered `photons`, counted over all lights in order, and adds those that
    /// are stored to `photon_map`: C++ `GenericPhotonMapGeneration`.
    ///
    /// After each photon, `photon_done` gets its number, its path, and what it stored. The photon
    /// stored at `path[k]`, k >= 2, has bounced k - 1 times.
    pub fn generic_photon_map_generation(
        &self,
        photon_map: &mut Vec<Photon>,
        photons: Range<u64>,
        mut photon_done: impl FnMut(u64, &[PathVertex], &[Photon]),
    ) {
        let mut path = Vec::new();
        for (light, of_light) in self.stored_scene.lights().iter().zip(self.photons_of_lights()) {
            let light_intensity = light.color / (of_light.end - of_light.start) as f32;
            for photon in of_light.start.max(photons.start)..of_light.end.min(photons.end) {
                let mut rand = photon_random(self.seed, photon);
                let photon_ray = light.generate_random_photon_ray(&mut rand);
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
                photon_done(photon, &path, &photon_map[stored_before..]);
            }
        }
    }

    /// Traces one photon until it leaves the scene, is absorbed, or has bounced too often: C++
    /// `TracePhoton`.
    ///
    /// `path` has one element for the light and one for every surface hit so far. The order of
    /// draws from `rand` is the roulette's number at every hit, then, if the photon scatters,
    /// u1 and u2.
    pub fn trace_photon(
        &self,
        photon_map: &mut Vec<Photon>,
        photon_ray: &Ray,
        light_intensity: Vec3,
        path: &mut Vec<PathVertex>,
        remaining_bounces: i32,
        rand: &mut impl FnMut() -> f32,
    ) {
        let mut state = IntersectionState::new();

        // Photon Storage
        if remaining_bounces < 0 {
            return;
        }
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
        let hit_primitive = state.primitive(&self.stored_scene);
        let hit_mesh_object = &self.stored_scene.mesh_objects()[hit_primitive.parent_mesh_object];
        let diffuse_response = hit_mesh_object.material.base_diffuse_reflection();
        let probability_of_reflection = diffuse_response.max_element();
        if rand() >= probability_of_reflection {
            return;
        }
        let (u1, u2) = (rand(), rand());
        let diffuse_reflection_ray = self.diffuse_reflection_ray(&state, u1, u2);
        self.trace_photon(
            photon_map,
            &diffuse_reflection_ray,
            light_intensity,
            path,
            remaining_bounces - 1,
            rand,
        );
    }

    /// The ray of a photon that scatters at the hit of `state`, from two numbers in [0, 1).
    pub fn diffuse_reflection_ray(&self, state: &IntersectionState, u1: f32, u2: f32) -> Ray {
        // Hemisphere Sampling
        let tangent_space_direction = sample_hemisphere(u1, u2);

        // Hemisphere Ray Transformation
        let normal = state.compute_normal(&self.stored_scene);
        let world_space_direction = tangent_frame(normal) * tangent_space_direction;
        // The handout names no offset. `spawn_ray` has one, and says why.
        self.stored_scene.spawn_ray(state, world_space_direction.normalize())
    }

    /// The color that `camera_ray` sees, direct light plus red where a photon is near: C++
    /// `ComputeSampleColor`.
    pub fn compute_sample_color(&self, camera_ray: &Ray) -> Vec3 {
        let mut state = IntersectionState::new();
        if !self.stored_scene.trace(camera_ray, Some(&mut state)) {
            return Vec3::ZERO;
        }
        let mut color = backward_renderer::compute_sample_color(&self.stored_scene, &state);
        if self.diffuse_map.any_within_cube(state.intersection_point(), PHOTON_DOT_RADIUS) {
            color += Vec3::X;
        }
        color
    }

    /// The photons of each light, as a range of their numbers. A light's part of all photons is its
    /// part of the brightness of all lights.
    ///
    /// As in the framework, a count is truncated and the product is formed in f32. Counts above
    /// 2^24, which f32 cannot tell apart, take f64.
    pub fn photons_of_lights(&self) -> Vec<Range<u64>> {
        let brightness = |light: &PointLight| light.color.length();
        let lights = self.stored_scene.lights();
        let total = lights.iter().map(brightness).fold(0.0, |sum, brightness| sum + brightness);
        let mut first = 0;
        let mut of_light = |light| {
            let share = brightness(light) / total;
            let count = if self.photon_count <= 1 << 24 {
                (share * self.photon_count as f32) as u64
            } else {
                (f64::from(share) * self.photon_count as f64) as u64
            };
            first += count;
            first - count..first
        };
        lights.iter().map(&mut of_light).collect()
    }

    /// How many photons all lights emit. After truncation, this may be a few less than
    /// [`Self::photon_count`].
    pub fn emitted(&self) -> u64 {
        self.photons_of_lights().last().map_or(0, |photons| photons.end)
    }
}
