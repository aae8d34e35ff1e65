//! Bounding boxes: which mesh objects a ray can meet. They save time and change no hit.
//!
//! The triangle test places each corner up to 6 roundings off, each at most 2^-24 of the largest
//! distance M along an axis from the ray's start to a corner. So a box that is larger by 2^-19 M on
//! each side holds every hit that the test can find, with room for the roundings of the box test
//! itself (Ize, *Robust BVH Ray Traversal*, JCGT 2013).

use std::ops::Range;

use glam::Vec3;

use super::ray::Ray;
use super::triangle::Triangle;

/// The slack of a box in units of M: 2^-19.
const SLACK: f32 = 1.0 / 524_288.0;

/// The triangles of one mesh object that follow each other, in a box.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Bounds {
    /// Which of the scene's triangles.
    pub(super) triangles: Range<usize>,
    low: Vec3,
    high: Vec3,
}

impl Bounds {
    /// The boxes of `triangles`, in order.
    pub(super) fn of_mesh_objects(triangles: &[Triangle]) -> Vec<Self> {
        let mut first = 0;
        let is_same_mesh =
            |a: &Triangle, b: &Triangle| a.parent_mesh_object == b.parent_mesh_object;
        let of_mesh = triangles.chunk_by(is_same_mesh).map(|of_mesh| {
            let corners = || of_mesh.iter().flat_map(|triangle| triangle.vertices);
            first += of_mesh.len();
            Self {
                triangles: first - of_mesh.len()..first,
                low: corners().fold(Vec3::INFINITY, Vec3::min),
                high: corners().fold(Vec3::NEG_INFINITY, Vec3::max),
            }
        });
        of_mesh.collect()
    }

    /// Whether `ray`, with the reciprocal of its direction, can meet a triangle of the box before
    /// the distance `max_t`.
    pub(super) fn can_be_met(&self, ray: &Ray, reciprocal: Vec3, max_t: f32) -> bool {
        let (low, high) = (self.low - ray.position(), self.high - ray.position());
        let slack = SLACK * low.abs().max(high.abs()).max_element();
        let (a, b) = ((low - slack) * reciprocal, (high + slack) * reciprocal);
        // `min` and `max` pass over NaN, which stands for a ray within the plane of a side.
        let enters = a.x.min(b.x).max(a.y.min(b.y)).max(a.z.min(b.z));
        let leaves = a.x.max(b.x).min(a.y.max(b.y)).min(a.z.max(b.z));
        let near = slack + ray.start_error;
        enters <= leaves + near && enters <= max_t + near && leaves >= -near
    }
}
