//! Hemisphere Ray Transformation: `tangent_frame` and `diffuse_reflection_ray`.

use crate::common::{handout, is_unit, light, unit_normal};
use glam::Vec3;
use photon_mapping::assignment8;
use photon_mapping::random::photon_random;
use photon_mapping::rendering::sampling::{sample_hemisphere, tangent_frame};
use photon_mapping::scene::ray::IntersectionState;
use proptest::prelude::*;

proptest! {
    #![proptest_config(ProptestConfig::with_cases(20_000))]

    #[test]
    fn frames_are_orthonormal_and_right_handed(normal in unit_normal()) {
        let frame = tangent_frame(normal);
        let [t, b] = [frame.x_axis, frame.y_axis];
        prop_assert!(frame.is_finite() && is_unit(t) && is_unit(b));
        let (t, b, n) = (t.as_dvec3(), b.as_dvec3(), normal.as_dvec3());
        prop_assert!(t.dot(b).abs() < 3e-7 && t.dot(n).abs() < 3e-7 && b.dot(n).abs() < 3e-7);
        prop_assert!((t.cross(b) - n).length() < 5e-7);
        prop_assert_eq!(frame.z_axis, normal);
    }

    #[test]
    fn world_directions_keep_their_height_over_the_surface(
        normal in unit_normal(), other in unit_normal()
    ) {
        let local = other.with_z(other.z.abs().max(1e-3)).normalize();
        let direction = (tangent_frame(normal) * local).normalize();
        let cosine = direction.as_dvec3().dot(normal.as_dvec3());
        prop_assert!(cosine > 0.0 && (cosine - f64::from(local.z)).abs() < 3e-7);
    }
}

/// Checks in f64 that the frame over `normal` is orthonormal and right-handed.
fn assert_orthonormal(normal: Vec3) {
    let frame = tangent_frame(normal);
    let [t, b, n] = [frame.x_axis, frame.y_axis, frame.z_axis].map(|axis| axis.as_dvec3());
    let errors = [
        t.length() - 1.0,
        b.length() - 1.0,
        t.dot(b),
        t.dot(n),
        b.dot(n),
        (t.cross(b) - n).length(),
    ];
    assert!(
        errors.iter().all(|error| error.abs() < 3e-7),
        "n = {normal}: expected unit vectors at right angles with t x b = n; found t = {t}, b = {b}"
    );
}

#[test]
fn normal_exactly_along_x_takes_another_axis() {
    for normal in [Vec3::X, Vec3::NEG_X, Vec3::new(1.0, 1e-23, 0.0), Vec3::new(-1.0, 0.0, 1e-23)] {
        assert_orthonormal(normal);
    }
}

#[test]
fn normal_next_to_x_has_a_precise_frame() {
    for x in [1.0_f32, -1.0] {
        for tilt in [1e-7_f32, -1e-7, 1e-4, 0.1, 0.141, 0.142] {
            let along_x = x * (1.0 - tilt * tilt).sqrt();
            for normal in [Vec3::new(along_x, tilt, 0.0), Vec3::new(along_x, 0.0, tilt)] {
                assert_orthonormal(normal);
            }
        }
    }
}

#[test]
fn t_is_n_cross_x_and_b_is_n_cross_t() {
    let normal = Vec3::new(0.6, 0.0, 0.8);
    let frame = tangent_frame(normal);
    assert!(frame.x_axis.distance(Vec3::Y) < 1e-7, "t: {}", frame.x_axis);
    assert!(frame.y_axis.distance(normal.cross(Vec3::Y)) < 1e-7, "b: {}", frame.y_axis);
    assert!((frame * Vec3::X).distance(Vec3::Y) < 1e-7, "t, b and n are the columns");
}

#[test]
fn box_sides_keep_the_cosine() {
    let scene = assignment8::create_scene();
    let sides = scene.triangles().iter().filter(|triangle| triangle.normal.x.abs() > 0.95);
    let sides: Vec<_> = sides.filter(|triangle| triangle.normal.x.abs() < 0.97).collect();
    assert_eq!(sides.len(), 8, "two triangles on each of four sides");
    for side in sides {
        assert_orthonormal(side.normal);
        let frame = tangent_frame(side.normal);
        for (x, y) in [(0.6, 0.0), (0.0, 0.6), (-0.6, 0.0), (0.0, -0.6)] {
            let direction = (frame * Vec3::new(x, y, 0.8)).normalize();
            let cosine = direction.dot(side.normal);
            assert!((cosine - 0.8).abs() < 3e-7, "{cosine} over {}", side.normal);
        }
    }
}

#[test]
fn the_reflected_ray_leaves_in_the_frame_of_its_surface() {
    let renderer = handout(148, 1);
    let scene = &renderer.stored_scene;
    let mut hits = 0;
    for photon in 0..5000 {
        let mut rand = photon_random(148, photon);
        let mut state = IntersectionState::new();
        if !scene.trace(&light().generate_random_photon_ray(&mut rand), Some(&mut state)) {
            continue;
        }
        hits += 1;
        let (u1, u2) = (rand(), rand());
        let direction = renderer.diffuse_reflection_ray(&state, u1, u2).ray_direction();
        let [t, b, n] = {
            let frame = tangent_frame(state.compute_normal(scene));
            [frame.x_axis, frame.y_axis, frame.z_axis]
        };
        let in_the_frame = Vec3::new(direction.dot(t), direction.dot(b), direction.dot(n));
        let expected = sample_hemisphere(u1, u2).normalize();
        assert!(
            in_the_frame.distance(expected) < 1e-6,
            "the reflected ray along t, b and n: expected {expected}, found {in_the_frame}"
        );
    }
    assert!(hits > 1000, "{hits}");
}
