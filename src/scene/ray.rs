//! A ray: where it starts and where it goes.

use glam::Vec3;

/// A half line in the scene's space, or the part of it before `max_t`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    position: Vec3,
    direction: Vec3,
    /// Nothing at this distance or beyond is met; infinite unless the ray ends somewhere.
    pub max_t: f32,
    /// By how much rounding may have moved the start; 0 unless set. A triangle that faces the ray is met up to
    /// this far behind the start, and one that shows its back only where the start is deeper below it.
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

    /// Where the ray starts.
    pub fn position(&self) -> Vec3 {
        self.position
    }

    /// The unit vector along which the ray goes: C++ `Ray::GetRayDirection()`.
    pub fn ray_direction(&self) -> Vec3 {
        self.direction
    }

    /// Moves the start: C++ `Ray::SetRayPosition`.
    pub fn set_ray_position(&mut self, position: Vec3) {
        self.position = position;
    }

    /// Turns the ray to the unit vector `direction`: C++ `Ray::SetRayDirection`.
    pub fn set_ray_direction(&mut self, direction: Vec3) {
        self.direction = direction;
    }
}
