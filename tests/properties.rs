//! What holds for any numbers: directions, frames, paths.


use fixtures::{closed_cube, handout};
use glam::Vec3;
use photon_mapping::random::photon_random;
use photon_mapping::rendering::photon_mapping_renderer::{PathVertex, PhotonMappingRenderer};
use variants::reading::Reading;
use photon_mapping::rendering::sampling::{sample_hemisphere, tangent_frame};
use proptest::prelude::*;

fn is_unit(vector: Vec3) -> bool {
    (vector.as_dvec3().length() - 1.0).abs() < 3e-7
}

/// Unit vectors anywhere, and, half of them, within a hair of the x axis.
fn unit_normal() -> impl Strategy<Value = Vec3> {
    let anywhere = (any::<u64>()).prop_map(|seed| {
        let light = fixtures::light();
        light.generate_random_photon_ray(&mut photon_random(seed, 0)).ray_direction()
    });
    let near_x = (any::<bool>(), 0_i32..30, 0_i32..30, any::<bool>(), any::<bool>()).prop_map(
        |(negative, y, z, y_negative, z_negative)| {
            let sign = |negative| if negative { -1.0_f32 } else { 1.0 };
            let tiny =
                |exponent: i32| if exponent == 0 { 0.0 } else { 0.5 / (1 << exponent) as f32 };
            let y = sign(y_negative) * tiny(y);
            Vec3::new(sign(negative), y, sign(z_negative) * tiny(z)).normalize()
        },
    );
    prop_oneof![anywhere, near_x]
}

/// The numbers a generator can give.
fn uniform() -> impl Strategy<Value = f32> {
    (0_u32..1 << 24).prop_map(|k| k as f32 / 16_777_216.0)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(20_000))]

    #[test]
    fn emitted_directions_are_unit(seed: u64, photon: u64) {
        let light = fixtures::light();
        let ray = light.generate_random_photon_ray(&mut photon_random(seed, photon));
        prop_assert!(is_unit(ray.ray_direction()));
        prop_assert_eq!(ray.position(), light.position);
    }

    #[test]
    fn hemisphere_directions_are_unit_and_above(u1 in uniform(), u2 in uniform()) {
        let direction = sample_hemisphere(u1, u2);
        prop_assert!(is_unit(direction) && direction.z > 0.0);
    }

    #[test]
    fn scattered_directions_are_above_the_surface(
        normal in unit_normal(), u1 in uniform(), u2 in uniform(), letter: bool
    ) {
        let reading = if letter { Reading::LETTER_OF_THE_HANDOUT } else { Reading::REFERENCE };
        let local = sample_hemisphere(u1, u2);
        let direction = (tangent_frame(normal, &reading) * local).normalize();
        prop_assert!(is_unit(direction));
        let cosine = direction.as_dvec3().dot(normal.as_dvec3());
        prop_assert!(cosine > 0.0);
        prop_assert!(letter || (cosine - f64::from(local.z)).abs() < 3e-7);
    }

    #[test]
    fn frames_are_orthonormal_and_right_handed(normal in unit_normal()) {
        let frame = tangent_frame(normal, &Reading::REFERENCE);
        let [t, b] = [frame.x_axis, frame.y_axis];
        prop_assert!(frame.is_finite() && is_unit(t) && is_unit(b));
        let (t, b, n) = (t.as_dvec3(), b.as_dvec3(), normal.as_dvec3());
        prop_assert!(t.dot(b).abs() < 3e-7 && t.dot(n).abs() < 3e-7 && b.dot(n).abs() < 3e-7);
        prop_assert!((t.cross(b) - n).length() < 5e-7);
        prop_assert_eq!(frame.z_axis, normal);
    }

    #[test]
    fn uniform_numbers_stay_below_one(seed: u64, photon: u64) {
        let mut rand = photon_random(seed, photon);
        for _ in 0..40 {
            let number = rand();
            prop_assert!((0.0..1.0).contains(&number));
            prop_assert_eq!((number * 16_777_216.0).fract(), 0.0);
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn paths_and_bounces_keep_their_limit(
        seed: u64, albedo in 0.0_f32..=1.0, max_photon_bounces in 0..30
    ) {
        let renderer =
            PhotonMappingRenderer { max_photon_bounces, ..closed_cube(albedo, seed, 50) };
        let mut photon_map = Vec::new();
        let mut paths = 0;
        renderer.generic_photon_map_generation(&mut photon_map, 0..50, |_, path, stored| {
            paths += 1;
            assert_eq!(path[0], PathVertex::Light);
            assert!(path.len() <= max_photon_bounces as usize + 2);
            // In a closed cube every photon hits at least once, and all hits but that are stored.
            assert_eq!(stored.len(), path.len() - 2);
            assert!(path[1..].iter().all(|vertex| matches!(vertex, PathVertex::Surface(_))));
        });
        prop_assert_eq!(paths, 50);
    }

    #[test]
    fn adjoining_ranges_make_the_whole(seed: u64, mut cuts in prop::collection::vec(0_u64..3000, 0..5)) {
        let renderer = handout(seed, 3000);
        cuts.extend([0, 3000]);
        cuts.sort_unstable();
        let pieces = cuts.windows(2).flat_map(|cut| {
            variants::trace::trace_piece(&renderer, cut[0]..cut[1])
        });
        prop_assert_eq!(pieces.collect::<Vec<_>>(), fixtures::list(&renderer));
    }
}

/// Mean of `value` over `count` samples, and its distance from `expected` in standard errors.
fn standard_errors(values: impl Iterator<Item = f64>, expected: f64) -> f64 {
    let (mut count, mut sum, mut squares) = (0.0, 0.0, 0.0);
    for value in values {
        count += 1.0;
        sum += value;
        squares += value * value;
    }
    let mean = sum / count;
    let error = ((squares / count - mean * mean) / count).sqrt();
    (mean - expected) / error
}

#[test]
fn moments_of_emission() {
    let light = fixtures::light();
    let directions: Vec<_> = (0..400_000)
        .map(|photon| {
            light
                .generate_random_photon_ray(&mut photon_random(7, photon))
                .ray_direction()
                .as_dvec3()
        })
        .collect();
    for axis in 0..3 {
        let other = (axis + 1) % 3;
        let of = |power: i32| directions.iter().map(move |d| d[axis].powi(power));
        assert!(standard_errors(of(1), 0.0).abs() < 4.0);
        assert!(standard_errors(of(2), 1.0 / 3.0).abs() < 4.0);
        // A direction from the unrejected cube has E[x^4] = 0.1834 and fails here.
        assert!(standard_errors(of(4), 1.0 / 5.0).abs() < 4.0);
        let mixed = directions.iter().map(|d| d[axis] * d[other]);
        assert!(standard_errors(mixed, 0.0).abs() < 4.0);
    }
}

#[test]
fn moments_of_scattering() {
    let directions: Vec<_> = (0..400_000)
        .map(|photon| {
            let mut rand = photon_random(8, photon);
            sample_hemisphere(rand(), rand()).as_dvec3()
        })
        .collect();
    let z = |power: i32| directions.iter().map(move |d| d.z.powi(power));
    assert!(standard_errors(z(1), 2.0 / 3.0).abs() < 4.0, "a uniform hemisphere has 1/2");
    assert!(standard_errors(z(2), 1.0 / 2.0).abs() < 4.0, "a uniform hemisphere has 1/3");
    for axis in 0..2 {
        assert!(standard_errors(directions.iter().map(|d| d[axis]), 0.0).abs() < 4.0);
        assert!(standard_errors(directions.iter().map(|d| d[axis].powi(2)), 0.25).abs() < 4.0);
        let with_height = directions.iter().map(|d| d[axis] * d.z);
        assert!(
            standard_errors(with_height, 0.0).abs() < 4.0,
            "azimuth and height are independent"
        );
    }
}

#[test]
fn sin_squared_of_scattering_is_uniform() {
    let mut values: Vec<f64> = (0..400_000)
        .map(|photon| {
            let mut rand = photon_random(9, photon);
            1.0 - f64::from(sample_hemisphere(rand(), rand()).z).powi(2)
        })
        .collect();
    values.sort_by(f64::total_cmp);
    let count = values.len() as f64;
    let distance = values.iter().enumerate().map(|(rank, value)| {
        ((rank as f64 + 1.0) / count - value).abs().max((value - rank as f64 / count).abs())
    });
    let largest = distance.fold(0.0, f64::max);
    // Kolmogorov: above 2.2 / sqrt(n) once in 8,000 samples. A uniform hemisphere is off by 0.25.
    assert!(largest < 2.2 / count.sqrt(), "Kolmogorov-Smirnov distance {largest}");
}
