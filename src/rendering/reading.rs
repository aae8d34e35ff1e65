//! How the handout is read where it leaves something open.

use glam::Vec3;

/// What becomes of the tangent and bitangent of equations (7) and (8).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TangentBasis {
    /// Both have length 1: the scattered directions follow the cosine.
    Normalised,
    /// As the equations stand: t = n x (1, 0, 0) is shorter than 1 unless n is at a right angle to
    /// the x axis, and the lobe of directions is narrower than the cosine's.
    LetterOfTheHandout,
    /// Both have length 1, but t, b and n are the rows of the matrix instead of its columns. This is
    /// no fair reading: it is here so that it can be told from one.
    Transposed,
}

/// Where the scattered ray starts, seen from the point hit. Lengths are in scene units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Offset {
    /// As far along the normal as this hit needs: [`crate::scene::Scene::offset`].
    AsNeeded,
    /// At the point itself.
    None,
    /// This far along the normal.
    AlongNormal(f32),
    /// This far along the scattered direction.
    AlongDirection(f32),
}

impl Offset {
    /// How far off along its ray a start may be where an offset of `needed` is needed. Only the reference
    /// counts with it; half of the offset, so that the surface left behind is never within it.
    pub fn start_error(self, needed: f32) -> f32 {
        match self {
            Self::AsNeeded => 0.5 * needed,
            Self::None | Self::AlongNormal(_) | Self::AlongDirection(_) => 0.0,
        }
    }

    /// The start of a ray that leaves `point`, where the unit normal is `normal` and an offset of
    /// `needed` is needed, along the unit vector `direction`.
    pub fn start(self, point: Vec3, normal: Vec3, direction: Vec3, needed: f32) -> Vec3 {
        match self {
            Self::AsNeeded => point + needed * normal,
            Self::None => point,
            Self::AlongNormal(length) => point + length * normal,
            Self::AlongDirection(length) => point + length * direction,
        }
    }
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
    /// The reading of the reference: normalised, with the framework's offset of shadow rays where
    /// that is small enough.
    pub const REFERENCE: Self = Self {
        tangent_basis: TangentBasis::Normalised,
        fallback_threshold: 0.99,
        fallback_axis: Vec3::Y,
        offset: Offset::AsNeeded,
    };

    /// As the reference, but with t and b as equations (7) and (8) have them.
    pub const LETTER_OF_THE_HANDOUT: Self =
        Self { tangent_basis: TangentBasis::LetterOfTheHandout, ..Self::REFERENCE };
}
