//! Where a model's scene is traced: about the origin, and at the size of the handout's scene.

use glam::{DVec3, Vec3};
use photon_mapping::scene::camera::PerspectiveCamera;

/// A scene is traced with its largest extent from half of this up to, but not with, this. The
/// handout's scene has 2.03, so it is traced as it stands.
const LARGEST_EXTENT: f64 = 4.0;

/// A light farther away than this many extents counts for the size: a point hit from afar is
/// rounded as coarsely as its distance asks for.
const FAR_LIGHT: f64 = 8.0;

/// From world space to the space in which a scene is traced, and back: a shift, then a power of
/// two.
///
/// The framework's lengths, 1e-5 to start a ray and 0.003 for a dot, are right for a scene about
/// the size of the handout's and about the origin. Moved by 1e5, the rounding of a coordinate
/// swallows such an offset, and a photon meets the surface it leaves; shrunk by 1e4, the offset
/// leaps over the boxes. So a model is not traced where it stands, but where these lengths are
/// right. Scaling by a power of two rounds nothing, and the shift is done in f64, before the
/// coordinates are rounded to f32.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placement {
    origin: DVec3,
    scale: f64,
}

impl Placement {
    /// The space of the scene is the world.
    pub const WORLD: Self = Self { origin: DVec3::ZERO, scale: 1.0 };

    /// The frame for a scene with these corners and lights, in world space; all finite.
    pub fn around(
        corners: impl Iterator<Item = DVec3> + Clone,
        lights: impl Iterator<Item = DVec3> + Clone,
    ) -> Self {
        let low = corners.clone().fold(DVec3::INFINITY, DVec3::min);
        let high = corners.fold(DVec3::NEG_INFINITY, DVec3::max);
        let middle = (low + high) / 2.0;
        let distances = lights.map(|light| (light - middle).abs().max_element());
        let extent = (high - low).max_element().max(distances.fold(0.0, f64::max) / FAR_LIGHT);
        if !(extent.is_finite() && extent > 0.0) {
            return Self::WORLD;
        }
        let mut scale = 1.0;
        while extent * scale >= LARGEST_EXTENT {
            scale /= 2.0;
        }
        while extent * scale < LARGEST_EXTENT / 2.0 {
            scale *= 2.0;
        }
        // In whole steps, so that a scene that is already about the origin stays where it is.
        let step = LARGEST_EXTENT / scale;
        let origin = (middle / step).round() * step;
        Self { origin, scale }
    }

    /// A point of the world in the space of the scene.
    pub fn to_scene(&self, world: DVec3) -> Vec3 {
        ((world - self.origin) * self.scale).as_vec3()
    }

    /// A point of the scene in world space, rounded to f32 once: by up to half a unit in the last
    /// place of each world coordinate.
    pub fn to_world(&self, scene: Vec3) -> Vec3 {
        if *self == Self::WORLD {
            return scene;
        }
        (scene.as_dvec3() / self.scale + self.origin).as_vec3()
    }

    /// `camera`, which stands in world space, in the space of the scene.
    pub fn camera(&self, camera: PerspectiveCamera) -> PerspectiveCamera {
        PerspectiveCamera { position: self.to_scene(camera.position.as_dvec3()), ..camera }
    }

    /// A length in the space of the scene as a length in world space.
    pub fn length_to_world(&self, scene: f32) -> f32 {
        (f64::from(scene) / self.scale) as f32
    }
}
