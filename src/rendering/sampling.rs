//! Directions in the hemisphere around a normal: sampled in tangent space, then turned into world
//! space.

use glam::{Mat3, Vec3};

/// Above this absolute value of the dot product of the normal and the x axis, the frame is built
/// from the y axis. Of the scene's normals this is the right wall's alone: the next has 0.96.
pub const CLOSE_TO_PARALLEL: f32 = 0.99;

/// A unit direction in the hemisphere around the z axis, distributed as the cosine of its angle to
/// z (density z / pi over solid angle), from two numbers in [0, 1). Tangent space; equations (2) to
/// (6).
///
/// Its length is 1 up to rounding. `diffuse_reflection_ray` normalizes it after turning it.
pub fn sample_hemisphere(u1: f32, u2: f32) -> Vec3 {
    // Hemisphere Sampling
    let r = u1.sqrt();
    let theta = 2.0 * std::f32::consts::PI * u2;
    let x = r * libm::cosf(theta);
    let y = r * libm::sinf(theta);
    let z = (1.0 - u1).sqrt();
    Vec3::new(x, y, z)
}

/// The matrix from tangent space to world space: its columns are t, b and the unit vector `normal`.
/// Equations (7) and (8).
///
/// The columns are orthonormal, and t x b = n: the frame is right-handed.
pub fn tangent_frame(normal: Vec3) -> Mat3 {
    // Hemisphere Ray Transformation
    // The right wall's normal is (-1, 0, 0), and its dot product with the x axis is -1. Without the
    // absolute value, t and b would be zero there.
    let is_parallel = normal.dot(Vec3::X).abs() > CLOSE_TO_PARALLEL;
    let axis = if is_parallel { Vec3::Y } else { Vec3::X };
    // The cross product is shorter than 1 unless n is at a right angle to the axis. That of n and t
    // misses 1 by rounding alone.
    let tangent = normal.cross(axis).normalize();
    let bitangent = normal.cross(tangent).normalize();
    Mat3::from_cols(tangent, bitangent, normal)
}
