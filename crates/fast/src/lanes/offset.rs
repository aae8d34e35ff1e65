//! Where a scattered ray starts.

use glam::Vec3;

/// Where the scattered ray starts, seen from the point hit. Lengths are in scene units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Offset {
    /// As far along the normal as this hit needs:
    /// [`Scene::offset`](photon_mapping::scene::Scene::offset).
    AsNeeded,
    /// At the point itself.
    None,
    /// This far along the normal.
    AlongNormal(f32),
    /// This far along the scattered direction.
    AlongDirection(f32),
}

impl Offset {
    /// How far off along its ray a start may be where an offset of `needed` is needed. Only the
    /// reference counts with it; half of the offset, so that the surface left behind is never
    /// within it.
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
