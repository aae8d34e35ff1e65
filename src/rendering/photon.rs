//! A stored photon: C++ `Photon.h`.

use glam::Vec3;

use crate::scene::ray::Ray;

/// What is known of a photon where it was stored.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Photon {
    /// The point hit, in the scene's space.
    pub position: Vec3,
    /// The light's colour divided by the number of photons it sent out. The roulette does not
    /// change it, as the handout has it: right for the dots, not for radiance.
    pub intensity: Vec3,
    /// From the point hit back to where the photon came from.
    pub to_light_ray: Ray,
}
