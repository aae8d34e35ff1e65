//! Hemisphere Sampling: `sample_hemisphere`.

use crate::common::{LARGEST_BELOW_ONE, assert_mean, is_unit, uniform};
use glam::Vec3;
use photon_mapping::random::photon_random;
use photon_mapping::rendering::sampling::sample_hemisphere;
use proptest::prelude::*;

proptest! {
    #![proptest_config(ProptestConfig::with_cases(20_000))]

    #[test]
    fn samples_are_unit_and_above_the_surface(u1 in uniform(), u2 in uniform()) {
        let direction = sample_hemisphere(u1, u2);
        prop_assert!(is_unit(direction) && direction.z > 0.0);
    }
}

#[test]
fn u1_of_zero_is_the_normal() {
    assert_eq!(sample_hemisphere(0.0, 0.3), Vec3::Z);
}

#[test]
fn the_largest_u1_stays_above_the_surface() {
    for u2 in [0.0, 0.25, 0.3, LARGEST_BELOW_ONE] {
        let direction = sample_hemisphere(LARGEST_BELOW_ONE, u2);
        assert!((direction.z - 2.44e-4).abs() < 1e-6 && direction.is_normalized(), "{direction}");
    }
}

#[test]
fn the_equations_hold_for_known_numbers() {
    // r = 1/2 and z = sqrt(3)/2; theta is 0, a quarter and a half of a turn.
    let half_root_of_three = 0.75_f32.sqrt();
    for (u2, x, y) in [(0.0, 0.5, 0.0), (0.25, 0.0, 0.5), (0.5, -0.5, 0.0)] {
        let expected = Vec3::new(x, y, half_root_of_three);
        let found = sample_hemisphere(0.25, u2);
        assert!(
            found.distance(expected) < 1e-7,
            "u1 = 0.25, u2 = {u2}: expected {expected}, found {found}"
        );
    }
}

/// 400,000 samples with the random numbers of `seed`.
fn samples(seed: u64) -> Vec<glam::DVec3> {
    let sample = |photon| {
        let mut rand = photon_random(seed, photon);
        sample_hemisphere(rand(), rand()).as_dvec3()
    };
    (0..400_000).map(sample).collect()
}

#[test]
fn samples_follow_the_cosine() {
    let directions = samples(8);
    let z = |power: i32| directions.iter().map(move |d| d.z.powi(power));
    // A uniform hemisphere has 1/2 and 1/3.
    assert_mean(z(1), 2.0 / 3.0, "z");
    assert_mean(z(2), 1.0 / 2.0, "z^2");
    for axis in 0..2 {
        assert_mean(directions.iter().map(|d| d[axis]), 0.0, "x or y");
        assert_mean(directions.iter().map(|d| d[axis].powi(2)), 0.25, "x^2 or y^2");
        assert_mean(directions.iter().map(|d| d[axis] * d.z), 0.0, "xz or yz");
    }
}

#[test]
fn sin_squared_is_uniform() {
    let mut values: Vec<f64> = samples(9).iter().map(|d| 1.0 - d.z.powi(2)).collect();
    values.sort_by(f64::total_cmp);
    let count = values.len() as f64;
    let distance = values.iter().enumerate().map(|(rank, value)| {
        ((rank as f64 + 1.0) / count - value).abs().max((value - rank as f64 / count).abs())
    });
    let largest = distance.fold(0.0, f64::max);
    // Kolmogorov: above 2.2 / sqrt(n) once in 8,000 samples. A uniform hemisphere is off by 0.25.
    assert!(largest < 2.2 / count.sqrt(), "Kolmogorov-Smirnov distance {largest}");
}
