//! What a ray meets, where rounding could decide: edges, planes, starts, slivers.

use crate::common::{handout, scene_of, square};
use glam::Vec3;
use photon_mapping::random::photon_random;
use photon_mapping::scene::ray::{IntersectionState, Ray};
use photon_mapping::scene::triangle::{ShearedRay, Triangle};
use proptest::prelude::*;

/// The triangle that a ray from `from` towards `to` meets.
fn met(triangles: &[Triangle], from: Vec3, to: Vec3) -> Option<usize> {
    let mut state = IntersectionState::new();
    let ray = Ray::new(from, (to - from).normalize());
    scene_of(triangles).trace(&ray, Some(&mut state)).then_some(state.intersected_primitive)
}

#[test]
fn ray_through_a_diagonal() {
    let square = square(0.0);
    for k in -99..=99 {
        let on_diagonal = Vec3::new(k as f32 / 100.0, k as f32 / 100.0, 0.0);
        let straight = on_diagonal + Vec3::Z;
        assert_eq!(met(&square, straight, on_diagonal), Some(0), "both meet it, the first counts");
        for from in [Vec3::new(0.3, -0.7, 2.0), Vec3::new(-5.0, 0.1, 0.01)] {
            assert!(
                met(&square, from, on_diagonal).is_some(),
                "{from} to {on_diagonal} slips through"
            );
        }
    }
}

#[test]
fn ray_through_an_edge_or_a_vertex() {
    let near = square(0.0);
    for target in [Vec3::new(1.0, 0.3, 0.0), Vec3::new(1.0, 1.0, 0.0), Vec3::new(-1.0, -1.0, 0.0)] {
        let hit = met(&near, target + Vec3::Z, target);
        assert!(hit.is_some(), "the border belongs to the triangle");
    }
}

#[test]
fn ray_in_the_plane_of_a_triangle() {
    for from in [Vec3::new(-3.0, 0.2, 0.0), Vec3::new(0.5, 0.2, 0.0)] {
        assert_eq!(met(&square(0.0), from, from + Vec3::new(1.0, 0.1, 0.0)), None);
    }
}

#[test]
fn triangle_slightly_behind_the_start() {
    let start = Vec3::new(0.2, -0.3, 1e-7);
    assert_eq!(met(&square(0.0), start, start + Vec3::Z), None);
    assert_eq!(met(&square(0.0), start, start - Vec3::Z), Some(0));
}

/// Rounding may put a start behind a surface that it is on: where a wall meets the floor, a little
/// below.
#[test]
fn triangle_behind_the_start_by_its_rounding() {
    let scene = scene_of(&square(0.0));
    let met = |height: f32, direction: Vec3, start_error: f32| {
        let mut ray = Ray::new(Vec3::new(0.2, -0.3, height), direction.normalize());
        ray.start_error = start_error;
        let mut state = IntersectionState::new();
        scene.trace(&ray, Some(&mut state)).then_some(state.intersection_t)
    };
    let (up, down) = (Vec3::new(0.3, 0.1, 1.0), Vec3::new(0.3, 0.1, -1.0));
    let t = met(-1e-7, down, 1e-6).expect("the floor is not left through its face");
    assert!(t < 0.0 && t > -2e-7, "{t}");
    assert_eq!(met(0.0, down, 1e-6), Some(0.0));
    assert_eq!(met(-1e-7, up, 1e-6), None, "and its back is not met from so near");
    assert!(met(-1e-5, up, 1e-6).is_some());
    assert_eq!(met(-1e-5, down, 1e-6), None);
    for height in [0.0, -1e-7] {
        assert_eq!(met(height, down, 0.0), None, "no error, no mercy");
    }
}

/// A sheet seen from behind hides what lies close behind it and faces the ray.
#[test]
fn back_hides_a_front_close_behind_it() {
    for gap in [1e-6, 1e-5, 3e-5, 1e-4] {
        let other = square(gap).map(|triangle| Triangle { normal: Vec3::NEG_Z, ..triangle });
        let sheets = [square(0.0), other].concat();
        for target in [Vec3::ZERO, Vec3::new(0.3, -0.2, 0.0), Vec3::new(0.99, 0.99, 0.0)] {
            let met = met(&sheets, target - Vec3::Z, target).expect("it is met");
            assert!(met < 2, "{gap}: {met}");
        }
    }
    let [a, b] = square(0.0);
    let turned = [a, b].map(|triangle| Triangle { normal: Vec3::NEG_Z, ..triangle });
    // Two sheets in one place that look opposite ways are one with two sides.
    for (sheets, from_above) in
        [([a, b, turned[0], turned[1]], 0), ([turned[0], turned[1], a, b], 2)]
    {
        let target = Vec3::new(0.3, -0.2, 0.0);
        assert_eq!(met(&sheets, target + Vec3::Z, target), Some(from_above));
        assert_eq!(met(&sheets, target - Vec3::Z, target), Some(2 - from_above));
    }
    // As where a box stands on a floor.
    let bottom = square(0.0).map(|triangle| Triangle {
        vertices: triangle.vertices.map(|corner| 0.4 * corner),
        normal: Vec3::NEG_Z,
        ..triangle
    });
    let sheets = [square(0.0), bottom].concat();
    for k in 0..1000 {
        let target = Vec3::new(0.3, 1e-4 * k as f32, 0.0);
        let from = Vec3::new(0.1, -0.2, -0.7);
        assert!(met(&sheets, from, target).is_some_and(|met| met >= 2), "{target}");
    }
}

/// At an edge of a box that stands out against what lies behind it, a ray enters and leaves at
/// once: it meets the face that looks at it.
#[test]
fn edge_of_a_box_is_met_from_the_front() {
    let scene = handout(148, 1).stored_scene;
    let boxes = scene.triangles().iter().filter(|triangle| triangle.parent_mesh_object < 2);
    let boxes: Vec<_> = boxes.collect();
    let mut from_behind = 0;
    for k in 0..1_000_000_u64 {
        let mut rand = photon_random(98, k);
        let Triangle { vertices, .. } = boxes[k as usize % boxes.len()];
        let corner = (rand() * 3.0) as usize;
        let target = vertices[corner].lerp(vertices[(corner + 1) % 3], rand());
        let from = Vec3::new(1.6 * rand() - 0.8, 1.6 * rand() - 0.8, 1.4 + 0.3 * rand());
        let direction = (target - from).normalize();
        let mut state = IntersectionState::new();
        // Beside a box, a ray may leave through the open front.
        if !scene.trace(&Ray::new(from, direction), Some(&mut state)) {
            continue;
        }
        // A face seen so much from the side may look either way by the rounding of its corners.
        from_behind += u32::from(direction.dot(state.compute_normal(&scene)) > 1e-5);
    }
    assert_eq!(from_behind, 0);
}

#[test]
fn duplicated_triangles_count_once() {
    let [a, b] = square(0.0);
    let from = Vec3::new(0.4, 0.1, 1.0);
    let single = met(&[a, b], from, Vec3::ZERO);
    assert_eq!(met(&[a, b, a, b], from, Vec3::ZERO), single);
}

#[test]
fn sliver_triangles() {
    let sliver = Triangle {
        vertices: [Vec3::ZERO, Vec3::X, Vec3::new(0.5, 1e-6, 0.0)],
        normal: Vec3::Z,
        parent_mesh_object: 0,
        facet: 0,
    };
    let inside = Vec3::new(0.5, 5e-7, 0.0);
    assert_eq!(met(&[sliver], inside + Vec3::Z, inside), Some(0));
    let beside = Vec3::new(0.5, 2e-6, 0.0);
    assert_eq!(met(&[sliver], beside + Vec3::Z, beside), None);
    let ray = Ray::new(inside + 1e-6 * Vec3::Z, Vec3::X);
    assert!(sliver.intersect(&ShearedRay::new(&ray)).is_none(), "parallel to it");
}

/// Coordinates that points often share, so that rays meet corners, edges and boxes exactly.
fn point() -> impl Strategy<Value = Vec3> {
    let coordinate = || prop_oneof![(-3_i8..=3).prop_map(f32::from), -3.0_f32..3.0];
    (coordinate(), coordinate(), coordinate()).prop_map(|(x, y, z)| Vec3::new(x, y, z))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1000))]

    /// The boxes around mesh objects leave out no triangle that a ray meets.
    #[test]
    fn bounding_boxes_change_no_hit(
        corners in prop::collection::vec(([point(), point(), point()], 0_usize..4), 1..40),
        shrink in prop_oneof![Just(1.0_f32), Just(1e-3)],
        shift in prop_oneof![Just(0.0_f32), Just(1e3)],
        rays in prop::collection::vec((point(), point(), 0.1_f32..10.0), 40),
    ) {
        let near = |point: Vec3| shrink * point + Vec3::splat(shift);
        let triangles: Vec<_> = corners
            .into_iter()
            .map(|(corners, parent_mesh_object)| {
                let vertices = corners.map(near);
                Triangle { vertices, normal: Vec3::Z, parent_mesh_object, facet: 0 }
            })
            .collect();
        let scene = scene_of(&triangles);
        for (place, (origin, target, max_t)) in rays.into_iter().enumerate() {
            let target = triangles.get(place).map_or(near(target), |aim| aim.vertices[place % 3]);
            let origin = near(origin);
            // Downwards only: a front needs no second look.
            let mut direction = (target - origin).normalize_or(Vec3::NEG_Z);
            direction.z = -direction.z.abs();
            let mut ray = Ray::new(origin, direction);
            (ray.max_t, ray.start_error) = (max_t, [0.0, 1e-3][place % 2]);
            let sheared_ray = ShearedRay::new(&ray);
            let hits = triangles.iter().enumerate().filter_map(|(index, triangle)| {
                Some((index, triangle.intersect(&sheared_ray).filter(|t| *t < ray.max_t)?))
            });
            let closest = hits.reduce(|best, hit| if hit.1 < best.1 { hit } else { best });
            let mut state = IntersectionState::new();
            let is_met = scene.trace(&ray, Some(&mut state));
            let met = is_met.then_some((state.intersected_primitive, state.intersection_t));
            prop_assert_eq!(met, closest);
            prop_assert_eq!(scene.trace(&ray, None), is_met);
        }
    }
}
