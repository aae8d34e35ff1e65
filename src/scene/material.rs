//! What a surface does with light: here, diffuse reflection alone.

use glam::Vec3;

/// A purely diffuse material.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Material {
    diffuse: Vec3,
}

impl Material {
    /// A material that reflects the fraction `diffuse`, each channel in [0, 1].
    pub fn new(diffuse: Vec3) -> Self {
        Self { diffuse }
    }

    /// The diffuse response d, before any light is considered: C++
    /// `Material::GetBaseDiffuseReflection()`.
    pub fn base_diffuse_reflection(&self) -> Vec3 {
        self.diffuse
    }
}
