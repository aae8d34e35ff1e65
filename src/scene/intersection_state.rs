//! What a ray met.

use glam::Vec3;

use super::{Scene, ray::Ray, triangle::Triangle};

/// The answer of [`Scene::trace`]: the ray that was traced and the closest triangle it met.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct IntersectionState {
    /// The ray that was traced.
    pub intersection_ray: Ray,
    /// The distance along it; the point is `intersection_ray.ray_position(intersection_t)`.
    pub intersection_t: f32,
    /// Index into [`Scene::triangles`] of the triangle met.
    pub intersected_primitive: usize,
}

impl IntersectionState {
    /// A state before anything was met.
    pub fn new() -> Self {
        Self {
            intersection_ray: Ray::new(Vec3::ZERO, Vec3::Z),
            intersection_t: f32::INFINITY,
            intersected_primitive: usize::MAX,
        }
    }

    /// The triangle met.
    pub fn primitive<'scene>(&self, scene: &'scene Scene) -> &'scene Triangle {
        &scene.triangles()[self.intersected_primitive]
    }

    /// The point met, in the scene's space.
    pub fn intersection_point(&self) -> Vec3 {
        self.intersection_ray.ray_position(self.intersection_t)
    }

    /// The unit normal there, as the model file has it: it is not turned towards the ray.
    pub fn compute_normal(&self, scene: &Scene) -> Vec3 {
        self.primitive(scene).normal
    }
}

impl Default for IntersectionState {
    fn default() -> Self {
        Self::new()
    }
}
