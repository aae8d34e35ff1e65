//! Counts the photons of a list that lie on no surface of the scene.

use glam::Vec3;
use photon_mapping::scene::Scene;
use photon_mapping::scene::ray::Ray;

/// So far along an axis a surface may be from a photon on it, where a scene has an extent of 2 to
/// 4: positions with two decimals are on it, too.
const LEEWAY: f32 = 0.02;
/// If most of so many photons lie on surfaces, the list is in the axes and units of the scene.
const PROBES: u64 = 1000;

/// How many photons lie off all surfaces.
#[derive(Debug, Default)]
pub struct OffSurfaces {
    seen: u64,
    off: u64,
}

impl OffSurfaces {
    /// Counts the photon at `position`, in the space of `scene`.
    pub fn add(&mut self, scene: &Scene, position: Vec3) {
        if self.seen >= PROBES && !self.is_most() {
            return;
        }
        self.seen += 1;
        self.off += u64::from(!is_on_surface(scene, position));
    }

    /// The number of photons off all surfaces, if most are.
    pub fn most(&self) -> Option<u64> {
        self.is_most().then_some(self.off)
    }

    fn is_most(&self) -> bool {
        2 * self.off > self.seen
    }
}

/// Whether a surface passes by `position`: one of the axes meets it there.
fn is_on_surface(scene: &Scene, position: Vec3) -> bool {
    position.is_finite()
        && Vec3::AXES.iter().any(|axis| {
            let mut ray = Ray::new(position - LEEWAY * *axis, *axis);
            ray.max_t = 2.0 * LEEWAY;
            scene.trace(&ray, None)
        })
}
