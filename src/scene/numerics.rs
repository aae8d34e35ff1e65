//! Where rounding matters: how a ray starts on a surface, and which of two close hits counts.
//!
//! Nobody needs this file to understand photon mapping. In exact arithmetic a scattered ray would
//! start at the point hit, and [`Scene::trace`] would give the triangle with the smallest t > 0.
//! `docs/numerics.md` has the reasons and the measurements.

use glam::Vec3;

use super::Scene;
use super::ray::{IntersectionState, Ray};
use super::triangle::{ShearedRay, Triangle};

/// The framework's offset of a ray that leaves a surface, along the normal, in world units.
pub const LARGE_EPSILON: f32 = 1e-5;

/// Where every triangle has an edge as long as this, rays start [`LARGE_EPSILON`] above the
/// surface. The handout's triangles all do: their longest edges are at least 0.85.
const ORDINARY_EDGE: f32 = 0.5;

/// Two hits closer than this many rounding errors count as the same point for a grazing ray.
const NEAR: f32 = 64.0;

/// A point on a thin triangle is rounded as coarsely as on a larger one, up to this many times.
const THINNEST: f32 = 16.0;

/// What a scene's rounding depends on, computed once.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Rounding {
    /// For every triangle the length that rounds the points on it.
    sizes: Vec<f32>,
    /// An offset that is small beside every triangle.
    epsilon: f32,
}

impl Rounding {
    pub(super) fn new(triangles: &[Triangle]) -> Self {
        let edges = || triangles.iter().map(Triangle::longest_edge);
        let epsilon = LARGE_EPSILON * (edges().fold(ORDINARY_EDGE, f32::min) / ORDINARY_EDGE);
        let sizes = triangles.iter().zip(edges()).map(|(triangle, edge)| {
            let thinness = edge / (2.0 * triangle.width());
            edge * thinness.min(THINNEST)
        });
        Self { sizes: sizes.collect(), epsilon }
    }
}

impl Scene {
    /// A ray that leaves the surface hit in `state` along the unit vector `direction`.
    ///
    /// The handout names no offset. Without one, two in five scattered photons hit the triangle
    /// they leave, because the point hit is rounded. So the ray starts [`Self::offset`] above
    /// the surface, where the framework starts its shadow rays.
    pub fn spawn_ray(&self, state: &IntersectionState, direction: Vec3) -> Ray {
        let (start, offset) = self.spawn_point(state);
        let mut ray = Ray::new(start, direction);
        // Half of the offset, so that the surface left behind is never within the error.
        ray.start_error = 0.5 * offset;
        ray
    }

    /// The point of `state`, moved off its surface along the normal, and how far it was moved.
    pub fn spawn_point(&self, state: &IntersectionState) -> (Vec3, f32) {
        let point = state.intersection_point();
        let offset = self.offset(state.intersected_primitive, point, state.intersection_t);
        (point + offset * state.compute_normal(self), offset)
    }

    /// How far along the normal a ray starts that leaves `triangle` at `point`, hit by a ray at the
    /// distance `t`: always [`LARGE_EPSILON`] in the handout's scene.
    ///
    /// Where a scene has much smaller triangles, the offset shrinks in proportion to the smallest,
    /// but never below what rounding may have done to the point: a few units in the last place
    /// of the lengths it was computed from.
    pub fn offset(&self, triangle: usize, point: Vec3, t: f32) -> f32 {
        self.rounding.epsilon.max(self.rounding_at(triangle, point, t))
    }

    fn rounding_at(&self, triangle: usize, point: Vec3, t: f32) -> f32 {
        let lengths = point.abs().max_element() + 2.0 * t + self.rounding.sizes[triangle];
        2.0 * f32::EPSILON * lengths
    }

    /// Whether `ray` meets anything before its `max_t`.
    pub(super) fn any_hit(&self, ray: &Ray) -> bool {
        match &self.acceleration {
            Some(acceleration) => acceleration.any(ray, &self.triangles),
            None => self.closest_of(ray, |_, _| true).is_some(),
        }
    }

    /// The closest hit of `ray` before its `max_t`: a triangle and the distance. A back yields to
    /// the front beside it, because only rounding can have put the back first.
    pub(super) fn closest_hit(&self, ray: &Ray) -> Option<(usize, f32)> {
        let (triangle, t, is_front) = match &self.acceleration {
            Some(acceleration) => acceleration.closest(ray, &self.triangles)?,
            None => {
                let (triangle, t) = self.closest_of(ray, |_, _| true)?;
                (triangle, t, self.triangles[triangle].faces(ray.ray_direction()))
            }
        };
        if is_front {
            return Some((triangle, t));
        }
        self.front_beside(ray, triangle, t).or(Some((triangle, t)))
    }

    /// The front that `ray` really met where rounding gives it a back at the distance `t` on
    /// `triangle`; `None` where it met the back.
    ///
    /// A ray that touches the edge of a solid enters and leaves at once, and the back may seem to
    /// come first: then a front at the same place shares a corner or its plane. A ray that
    /// grazes the surface below which it started may have a [`Ray::start_error`] that is too
    /// short: then that front is within the error of the start.
    fn front_beside(&self, ray: &Ray, triangle: usize, t: f32) -> Option<(usize, f32)> {
        let (back, direction) = (&self.triangles[triangle], ray.ray_direction());
        let rounding = self.rounding_at(triangle, ray.ray_position(t), t);
        let mut near = *ray;
        near.max_t = ray.max_t.min(t + NEAR * rounding);
        near.start_error = NEAR * ray.start_error;
        let is_beside = |front: &Triangle, t: f32| {
            let depth_of_start = t * direction.dot(front.normal);
            front.faces(direction)
                && if t > 0.0 {
                    back.touches(front, 0.25 * rounding)
                } else {
                    depth_of_start <= ray.start_error
                }
        };
        match &self.acceleration {
            Some(acceleration) => acceleration.closest_of(&near, &self.triangles, &is_beside),
            None => self.closest_of(&near, is_beside),
        }
    }

    /// The closest of the hits of `ray` before its `max_t` that `accepts` takes, by testing every
    /// triangle whose mesh object it can meet.
    fn closest_of(
        &self,
        ray: &Ray,
        accepts: impl Fn(&Triangle, f32) -> bool,
    ) -> Option<(usize, f32)> {
        let sheared_ray = ShearedRay::new(ray);
        let reciprocal = ray.ray_direction().recip();
        let mut closest = None;
        let mut closest_t = ray.max_t;
        for bounds in &self.bounds {
            if !bounds.can_be_met(ray, reciprocal, closest_t) {
                continue;
            }
            for index in bounds.triangles.clone() {
                let triangle = &self.triangles[index];
                if let Some(t) = triangle.intersect(&sheared_ray)
                    && t < closest_t
                    && accepts(triangle, t)
                {
                    (closest, closest_t) = (Some((index, t)), t);
                }
            }
        }
        closest
    }
}
