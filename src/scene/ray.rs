//! A ray, and what it met.

use glam::Vec3;

use super::Scene;
use super::triangle::Triangle;

/// A half line in world space, or the part of it before `max_t`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    position: Vec3,
    direction: Vec3,
    /// The ray meets nothing at this distance or beyond. Infinite by default.
    pub max_t: f32,
    /// How far rounding may have moved the start. See [`Scene::spawn_ray`]; 0 by default.
    pub start_error: f32,
}

impl Ray {
    /// A ray from `position` along the unit vector `direction`, without an end.
    pub fn new(position: Vec3, direction: Vec3) -> Self {
        Self { position, direction, max_t: f32::INFINITY, start_error: 0.0 }
    }

    /// The point at distance `t` from the start: C++ `Ray::GetRayPosition(t)`.
    pub fn ray_position(&self, t: f32) -> Vec3 {
        self.position + t * self.direction
    }

    /// Where the ray starts: C++ `Ray::GetPosition()`.
    pub fn position(&self) -> Vec3 {
        self.position
    }

    /// The unit vector along which the ray goes: C++ `Ray::GetRayDirection()`.
    pub fn ray_direction(&self) -> Vec3 {
        self.direction
    }
}

/// The answer of [`Scene::trace`]: the ray that was traced and the closest triangle it met.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct IntersectionState {
    /// The ray that was traced.
    pub intersection_ray: Ray,
    /// The distance along it.
    pub intersection_t: f32,
    /// The index of the triangle met in [`Scene::triangles`].
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

    /// The point met, in world space.
    pub fn intersection_point(&self) -> Vec3 {
        self.intersection_ray.ray_position(self.intersection_t)
    }

    /// The unit normal of the model there. It is never turned towards the ray.
    pub fn compute_normal(&self, scene: &Scene) -> Vec3 {
        self.primitive(scene).normal
    }
}

impl Default for IntersectionState {
    fn default() -> Self {
        Self::new()
    }
}
