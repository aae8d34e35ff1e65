//! Rays side by side.

use glam::Vec3;

use photon_mapping::scene::ray::Ray;

/// How many rays a kernel call follows. What it keeps of two dozen corners fits a first-level
/// cache.
pub const GROUP: usize = 32;

/// A number for every ray.
pub type GroupLanes = [f32; GROUP];

/// Rays, by coordinate.
#[derive(Clone, Debug)]
pub struct Rays {
    /// Where they start.
    pub origin: [GroupLanes; 3],
    /// Where they go: unit vectors.
    pub direction: [GroupLanes; 3],
    /// [`Ray::start_error`].
    pub start_error: GroupLanes,
    /// [`Ray::max_t`], which only `Hits::settle` minds.
    pub max_t: GroupLanes,
}

impl Default for Rays {
    fn default() -> Self {
        Self {
            origin: [[0.0; GROUP]; 3],
            direction: [[1.0; GROUP]; 3],
            start_error: [0.0; GROUP],
            max_t: [f32::INFINITY; GROUP],
        }
    }
}

impl Rays {
    /// Puts `ray` into `lane`.
    pub fn set(&mut self, lane: usize, ray: &Ray) {
        for axis in 0..3 {
            self.origin[axis][lane] = ray.position()[axis];
            self.direction[axis][lane] = ray.ray_direction()[axis];
        }
        (self.start_error[lane], self.max_t[lane]) = (ray.start_error, ray.max_t);
    }

    /// The ray in `lane`.
    pub fn ray(&self, lane: usize) -> Ray {
        let origin = Vec3::from_array([0, 1, 2].map(|c| self.origin[c][lane]));
        let mut ray = Ray::new(origin, self.direction(lane));
        (ray.start_error, ray.max_t) = (self.start_error[lane], self.max_t[lane]);
        ray
    }

    /// The unit vector in `lane`.
    pub fn direction(&self, lane: usize) -> Vec3 {
        Vec3::from_array([0, 1, 2].map(|c| self.direction[c][lane]))
    }
}
