//! A point light: C++ `PointLight.cpp`.

use glam::Vec3;

use super::ray::Ray;

/// A light without extent that shines evenly to all sides.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointLight {
    /// Where it stands, in world space: C++ `SceneObject::GetPosition()`.
    pub position: Vec3,
    /// Its color, which its photons share evenly: C++ `Light::GetLightColor()`.
    pub color: Vec3,
}

impl PointLight {
    /// A ray from the light in a direction that is uniform on the sphere: C++
    /// `GenerateRandomPhotonRay`.
    ///
    /// `rand` gives numbers in [0, 1), where the C++ scales the integer of `rand()`. Every try
    /// draws x, y and z, in this order. The center has no direction, and is drawn again.
    pub fn generate_random_photon_ray(&self, rand: &mut impl FnMut() -> f32) -> Ray {
        // Photon Emission
        let direction = loop {
            let x = 2.0 * rand() - 1.0;
            let y = 2.0 * rand() - 1.0;
            let z = 2.0 * rand() - 1.0;
            let length_squared = x * x + y * y + z * z;
            // The handout rejects only points outside the sphere. The center has no direction
            // either: normalized, it would be NaN.
            if length_squared <= 1.0 && length_squared > 0.0 {
                break Vec3::new(x, y, z);
            }
        };
        Ray::new(self.position, direction.normalize())
    }
}
