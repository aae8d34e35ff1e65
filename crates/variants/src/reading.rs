//! How the handout is read where it leaves something open.

use fast::lanes::offset::Offset;
use glam::{Mat3, Vec3};
use photon_mapping::rendering::sampling::CLOSE_TO_PARALLEL;

/// What becomes of the tangent and bitangent of equations (7) and (8).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TangentBasis {
    /// Both have length 1: the scattered directions follow the cosine.
    Normalized,
    /// As the equations stand: t = n x (1, 0, 0) is shorter than 1 unless n is at a right angle to
    /// the x axis, and the lobe of directions is narrower than the cosine's.
    LetterOfTheHandout,
    /// Both have length 1, but t, b and n are the rows of the matrix instead of its columns. This
    /// is no fair reading: it is here so that it can be told from one.
    Transposed,
}

/// One reading of the handout.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reading {
    /// What becomes of t and b.
    pub tangent_basis: TangentBasis,
    /// How close to 1 the absolute dot product of the normal and the x axis may come before
    /// `fallback_axis` takes the x axis's place.
    pub fallback_threshold: f32,
    /// The unit vector that takes the x axis's place.
    pub fallback_axis: Vec3,
    /// Where the scattered ray starts.
    pub offset: Offset,
}

impl Reading {
    /// The reading of the reference: normalized, with the framework's offset of shadow rays where
    /// that is small enough.
    pub const REFERENCE: Self = Self {
        tangent_basis: TangentBasis::Normalized,
        fallback_threshold: CLOSE_TO_PARALLEL,
        fallback_axis: Vec3::Y,
        offset: Offset::AsNeeded,
    };

    /// As the reference, but with t and b as equations (7) and (8) have them.
    pub const LETTER_OF_THE_HANDOUT: Self =
        Self { tangent_basis: TangentBasis::LetterOfTheHandout, ..Self::REFERENCE };
}

impl Default for Reading {
    fn default() -> Self {
        Self::REFERENCE
    }
}

impl Reading {
    /// The matrix from tangent space to world space at a surface with the unit vector `normal`.
    pub fn tangent_frame(&self, normal: Vec3) -> Mat3 {
        let is_parallel = normal.dot(Vec3::X).abs() > self.fallback_threshold;
        let axis = if is_parallel { self.fallback_axis } else { Vec3::X };
        let normalize = |vector: Vec3| match self.tangent_basis {
            TangentBasis::LetterOfTheHandout => vector,
            _ => vector.normalize(),
        };
        let tangent = normalize(normal.cross(axis));
        let bitangent = normalize(normal.cross(tangent));
        let columns = Mat3::from_cols(tangent, bitangent, normal);
        if self.tangent_basis == TangentBasis::Transposed { columns.transpose() } else { columns }
    }
}
