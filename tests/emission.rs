//! Photon Emission: `PointLight::generate_random_photon_ray`.

use crate::common::{assert_mean, draws, is_unit, light};
use glam::Vec3;
use photon_mapping::random::photon_random;
use proptest::prelude::*;

proptest! {
    #![proptest_config(ProptestConfig::with_cases(20_000))]

    #[test]
    fn emitted_rays_start_at_the_light_and_are_unit(seed: u64, photon: u64) {
        let ray = light().generate_random_photon_ray(&mut photon_random(seed, photon));
        prop_assert!(is_unit(ray.ray_direction()));
        prop_assert_eq!(ray.position(), light().position);
    }
}

/// The direction of a photon that draws `numbers`.
fn direction(numbers: &[f32]) -> Vec3 {
    light().generate_random_photon_ray(&mut draws(numbers)).ray_direction()
}

#[test]
fn numbers_become_x_y_and_z_from_minus_one_to_one() {
    assert_eq!(direction(&[0.75, 0.5, 0.5]), Vec3::X);
    assert_eq!(direction(&[0.5, 0.25, 0.5]), Vec3::NEG_Y);
    assert_eq!(direction(&[0.5, 0.5, 0.875]), Vec3::Z);
}

#[test]
fn three_draws_that_give_the_zero_vector_are_drawn_again() {
    let drawn_again = direction(&[0.5, 0.5, 0.5, 0.5, 0.5, 0.75]);
    assert_eq!(drawn_again, Vec3::Z, "the center has no direction");
}

#[test]
fn squared_length_exactly_one_is_accepted() {
    assert_eq!(direction(&[0.0, 0.5, 0.5]), Vec3::NEG_X, "the sphere itself belongs to the ball");
}

#[test]
fn squared_length_just_above_one_is_rejected() {
    let drawn_again = direction(&[0.0, 0.5, 0.501, 0.5, 0.0, 0.5]);
    assert_eq!(drawn_again, Vec3::NEG_Y, "a point outside the sphere is drawn again");
}

#[test]
fn emitted_directions_are_uniform_on_the_sphere() {
    let directions: Vec<_> = (0..400_000)
        .map(|photon| {
            let ray = light().generate_random_photon_ray(&mut photon_random(7, photon));
            ray.ray_direction().as_dvec3()
        })
        .collect();
    for axis in 0..3 {
        let other = (axis + 1) % 3;
        let of = |power: i32| directions.iter().map(move |d| d[axis].powi(power));
        let mixed = directions.iter().map(|d| d[axis] * d[other]);
        assert_mean(of(1), 0.0, "x, y or z");
        assert_mean(of(2), 1.0 / 3.0, "x^2, y^2 or z^2");
        // A direction from the whole cube has 0.1802.
        assert_mean(of(4), 1.0 / 5.0, "x^4, y^4 or z^4");
        assert_mean(mixed, 0.0, "xy, yz or zx");
    }
}
