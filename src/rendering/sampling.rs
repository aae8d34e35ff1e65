//! Directions over a surface: sampled in tangent space, then turned into world space.

use glam::{Mat3, Vec3};

/// How close to 1 the absolute dot product of the normal and the x axis may come before the y axis
/// takes the x axis's place.
pub const FALLBACK_THRESHOLD: f32 = 0.99;

/// Whether the tangent and bitangent of equations (7) and (8) are normalised.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum TangentBasis {
    /// Both have length 1: the scattered directions follow the cosine.
    #[default]
    Normalised,
    /// As the equations stand: t = n x (1, 0, 0) is shorter than 1 unless n is at a right angle to
    /// the x axis, and the lobe of directions is narrower than the cosine's.
    LetterOfTheHandout,
}

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
pub fn tangent_frame(normal: Vec3, basis: TangentBasis) -> Mat3 {
    // The absolute value: the right wall's normal is (-1, 0, 0), whose dot product with the x axis
    // is -1. Without it t and b would be zero there.
    let axis = if normal.dot(Vec3::X).abs() > FALLBACK_THRESHOLD { Vec3::Y } else { Vec3::X };
    let mut tangent = normal.cross(axis);
    if basis == TangentBasis::Normalised {
        tangent = tangent.normalize();
    }
    let mut bitangent = normal.cross(tangent);
    if basis == TangentBasis::Normalised {
        bitangent = bitangent.normalize();
    }
    Mat3::from_cols(tangent, bitangent, normal)
}
