//! Where a photon's numbers come from: the reference's generator, or a labeled extra.

use glam::Vec3;

use crate::sobol::SobolPath;
use photon_mapping::random::photon_random;
use photon_mapping::scene::point_light::PointLight;
use photon_mapping::scene::ray::Ray;

/// What gives the numbers of all photons.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Sampler {
    /// A ChaCha stream for every photon: the reference, to which all golden bits belong.
    #[default]
    ChaCha,
    /// An Owen-scrambled Sobol sequence of which every photon is a point. Its photons are not
    /// independent, so errors fall faster, and the laws of independent photons do not judge it.
    Sobol,
}

impl Sampler {
    /// The name on the command line and in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::ChaCha => "chacha",
            Self::Sobol => "sobol",
        }
    }

    /// The ray on which photon `photon` (counted over all lights, below 2^32) leaves `light` in the
    /// run with `seed`, and the numbers it draws from then on.
    pub fn start_photon(
        self,
        light: &PointLight,
        seed: u64,
        photon: u64,
    ) -> (Ray, impl FnMut() -> f32) {
        let mut rand = photon_random(seed, photon);
        let mut path = SobolPath::new(seed, photon);
        let photon_ray = match self {
            Self::ChaCha => light.generate_random_photon_ray(&mut rand),
            Self::Sobol => {
                let u1 = path.next_number();
                let u2 = path.next_number();
                Ray::new(light.position, sphere_direction(u1, u2))
            }
        };
        let numbers = move || match self {
            Self::ChaCha => rand(),
            Self::Sobol => path.next_number(),
        };
        (photon_ray, numbers)
    }
}

/// A unit vector evenly distributed over the sphere, from two numbers in [0, 1): the height is even
/// (Archimedes), and so is the azimuth. Rejection would take a number of numbers that is not known
/// in advance, and a point of the sequence has a fixed number of them.
fn sphere_direction(u1: f32, u2: f32) -> Vec3 {
    let z = 1.0 - 2.0 * u1;
    // 1 - z^2 without its cancellation near the poles.
    let r = 2.0 * (u1 * (1.0 - u1)).sqrt();
    let azimuth = 2.0 * std::f32::consts::PI * u2;
    Vec3::new(r * libm::cosf(azimuth), r * libm::sinf(azimuth), z).normalize()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sphere_directions_are_unit_and_balanced() {
        let light = PointLight { position: Vec3::ZERO, color: Vec3::ONE };
        let mut sum = [0.0_f64; 3];
        let mut squares = [0.0_f64; 3];
        for photon in 0..1 << 16 {
            let direction = Sampler::Sobol.start_photon(&light, 5, photon).0.ray_direction();
            assert!((direction.length() - 1.0).abs() < 1e-6);
            for axis in 0..3 {
                sum[axis] += f64::from(direction[axis]) / 65_536.0;
                squares[axis] += f64::from(direction[axis]).powi(2) / 65_536.0;
            }
        }
        assert!(sum.iter().all(|mean| mean.abs() < 1e-4), "{sum:?}");
        assert!(squares.iter().all(|mean| (mean - 1.0 / 3.0).abs() < 1e-4), "{squares:?}");
    }

    #[test]
    fn poles_are_finite() {
        assert_eq!(sphere_direction(0.0, 0.3), Vec3::Z);
        assert!(sphere_direction(1.0 - f32::EPSILON / 2.0, 0.3).is_normalized());
    }
}
