//! A light without extent that shines evenly to all sides: C++ `PointLight.cpp`.

use glam::Vec3;

use crate::scene::ray::Ray;

/// A point light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointLight {
    /// Where it stands, in the scene's space: C++ `SceneObject::GetPosition()`.
    pub position: Vec3,
    /// Its colour; the photons it sends out share it evenly: C++ `Light::GetLightColor()`.
    pub color: Vec3,
}

impl PointLight {
    /// A ray from the light in a direction evenly distributed over the sphere.
    ///
    /// `rand` gives numbers in [0, 1), where the C++ scales the integer of `rand()`. The order of
    /// draws is x, y, z for every try.
    pub fn generate_random_photon_ray(&self, rand: &mut impl FnMut() -> f32) -> Ray {
        // Photon Emission
        let direction = loop {
            let x = 2.0 * rand() - 1.0;
            let y = 2.0 * rand() - 1.0;
            let z = 2.0 * rand() - 1.0;
            let length_squared = x * x + y * y + z * z;
            // The handout rejects only what lies outside of the sphere. The point in its very
            // centre has no direction either: normalised, it would be NaN.
            if length_squared <= 1.0 && length_squared > 0.0 {
                break Vec3::new(x, y, z);
            }
        };
        Ray::new(self.position, direction.normalize())
    }
}
