//! Directions over a surface: sampled in tangent space, then turned into world space.

use glam::{Mat3, Vec3};

use super::reading::{Reading, TangentBasis};

/// A direction over the z axis, distributed as the cosine of its angle to it (density z / pi over
/// solid angle), from two numbers in [0, 1). Equations (2) to (6).
pub fn sample_hemisphere(u1: f32, u2: f32) -> Vec3 {
    let r = u1.sqrt();
    let theta = 2.0 * std::f32::consts::PI * u2;
    let x = r * libm::cosf(theta);
    let y = r * libm::sinf(theta);
    let z = (1.0 - u1).sqrt();
    Vec3::new(x, y, z)
}

/// The matrix that turns tangent space into world space, with columns t, b and the unit vector
/// `normal`. Equations (7) and (8).
///
/// With [`TangentBasis::Normalised`] the columns are orthonormal for every unit normal, and
/// t x b = n always: the frame is right-handed.
pub fn tangent_frame(normal: Vec3, reading: &Reading) -> Mat3 {
    // The absolute value: the right wall's normal is (-1, 0, 0), whose dot product with the x axis
    // is -1. Without it t and b would be zero there.
    let is_parallel = normal.dot(Vec3::X).abs() > reading.fallback_threshold;
    let axis = if is_parallel { reading.fallback_axis } else { Vec3::X };
    let mut tangent = normal.cross(axis);
    if reading.tangent_basis != TangentBasis::LetterOfTheHandout {
        tangent = tangent.normalize();
    }
    let mut bitangent = normal.cross(tangent);
    if reading.tangent_basis != TangentBasis::LetterOfTheHandout {
        bitangent = bitangent.normalize();
    }
    let columns = Mat3::from_cols(tangent, bitangent, normal);
    if reading.tangent_basis == TangentBasis::Transposed { columns.transpose() } else { columns }
}
