//! The whole run, for which every section is needed: long paths, counts, places.

use crate::common::{
    LARGEST_BELOW_ONE, SECTIONS, closed_cube, deviations, handout, list, path_of_one_hit,
    trace_scripted,
};
use glam::{DVec3, Vec3};
use photon_mapping::photon_list::PhotonRecord;
use photon_mapping::random::photon_random;
use photon_mapping::rendering::photon_mapping_renderer::{PathVertex, PhotonMappingRenderer};
use photon_mapping::rendering::sampling::{sample_hemisphere, tangent_frame};
use photon_mapping::scene::numerics::LARGE_EPSILON;
use photon_mapping::scene::ray::{IntersectionState, Ray};
use proptest::prelude::*;

const LAST_SECTION: &str = SECTIONS[SECTIONS.len() - 1];

#[test]
fn a_photon_hits_a_surface_more_often_than_it_may_bounce() {
    let cube = closed_cube(1.0, 148, 1);
    let ray = Ray::new(Vec3::ZERO, Vec3::X);
    let stored = |remaining_bounces, numbers: &[f32]| {
        let mut path = path_of_one_hit();
        trace_scripted(LAST_SECTION, &cube, &ray, &mut path, remaining_bounces, numbers)
            .stored
            .len()
    };
    // At 0 the photon is stored, scatters, and is not traced further.
    assert_eq!(stored(0, &[0.5, 0.3, 0.4]), 1);
    assert_eq!(stored(1, &[0.5, 0.3, 0.4].repeat(2)), 2);
    assert_eq!(stored(1000, &[LARGEST_BELOW_ONE, 0.3, 0.4].repeat(1001)), 1001);
}

#[test]
fn no_bounce_and_one_bounce_allowed() {
    let limited =
        |max_photon_bounces| PhotonMappingRenderer { max_photon_bounces, ..handout(148, 20_000) };
    let all = list(&handout(148, 20_000));
    let first_bounces: Vec<_> = all.iter().filter(|record| record.bounce == 1).copied().collect();
    assert!(list(&limited(0)).is_empty());
    assert_eq!(list(&limited(1)), first_bounces);
    assert!(first_bounces.len() < all.len());
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn paths_keep_their_limit(
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
}

#[test]
fn intensity_is_the_light_shared_among_its_photons() {
    let list = list(&handout(8, 50_000));
    let is_right = |record: &PhotonRecord| record.intensity.to_array() == [1.0 / 50_000.0; 3];
    assert!(!list.is_empty() && list.iter().all(is_right));
}

#[test]
fn photons_lie_on_planes_arrive_in_front_and_never_twice_on_one() {
    let renderer = handout(7, 1_000_000);
    let scene = &renderer.stored_scene;
    let mut photon_map = Vec::new();
    let mut surfaces = 0;
    renderer.generic_photon_map_generation(
        &mut photon_map,
        0..1_000_000,
        |photon, path, stored| {
            let mut last_plane: Option<(DVec3, f64)> = None;
            for (number, vertex) in path[1..].iter().enumerate() {
                let PathVertex::Surface(state) = vertex else { unreachable!() };
                let triangle = state.primitive(scene);
                let [a, b, c] = triangle.vertices.map(|vertex| vertex.as_dvec3());
                let normal = (b - a).cross(c - a).normalize();
                let distance = normal.dot(state.intersection_point().as_dvec3() - a).abs();
                assert!(distance < 1e-6, "photon {photon} is {distance} off its plane");
                let cosine = -state.intersection_ray.ray_direction().dot(triangle.normal);
                assert!(cosine > 0.0, "photon {photon} came from behind");
                if number > 0 {
                    assert_eq!(stored[number - 1].position, state.intersection_point());
                }
                let plane = (normal, normal.dot(a));
                let same = |last: (DVec3, f64)| {
                    last.0.dot(plane.0).abs() > 1.0 - 1e-9 && (last.1 - plane.1).abs() < 1e-9
                };
                assert!(!last_plane.is_some_and(same), "photon {photon} hit one plane twice");
                last_plane = Some(plane);
                surfaces += 1;
            }
        },
    );
    assert!(surfaces > 280_000);
}

/// First, second and third hits per emitted photon on shortBox, rightWall, tallBox and floor, in
/// closed form and by cubature in f64. The oracle's tests hold them to its table.
const HITS: [[f64; 3]; 4] = [
    [0.016710788766, 0.007977496, 0.00167178],
    [0.132736677536, 0.009668818, 0.00449688],
    [0.045214549333, 0.010443311, 0.00153398],
    [0.041323923772, 0.005324345, 0.00330447],
];

#[test]
fn hits_by_surface_and_bounce_are_as_expected() {
    let emitted = 4_000_000;
    let renderer = handout(2, emitted);
    let mut hits = [[0; 3]; 4];
    let mut photon_map = Vec::new();
    renderer.generic_photon_map_generation(&mut photon_map, 0..emitted, |_, path, _| {
        for (bounce, vertex) in path[1..].iter().take(3).enumerate() {
            let PathVertex::Surface(state) = vertex else { unreachable!() };
            hits[state.primitive(&renderer.stored_scene).parent_mesh_object][bounce] += 1;
        }
    });
    for (surface, expected) in HITS.iter().enumerate() {
        for (bounce, probability) in expected.iter().enumerate() {
            let z = deviations(hits[surface][bounce], emitted, *probability);
            assert!(z.abs() < 4.0, "surface {surface}, bounce {bounce}: {z:.1} deviations");
        }
    }
}

#[test]
fn floor_inside_the_boxes_stays_empty() {
    let short = [(0.53, -0.75), (0.70, -0.17), (0.13, 0.0), (-0.05, -0.57)];
    let tall = [(-0.53, -0.09), (0.04, 0.09), (-0.14, 0.67), (-0.71, 0.49)];
    let is_inside = |record: &PhotonRecord| {
        let point = record.position.as_dvec3();
        [short, tall].iter().any(|corners| {
            (0..4).all(|k| {
                let ((ax, ay), (bx, by)) = (corners[k], corners[(k + 1) % 4]);
                let (dx, dy): (f64, f64) = (bx - ax, by - ay);
                (dx * (point.y - ay) - dy * (point.x - ax)) / f64::hypot(dx, dy) > 1e-6
            })
        })
    };
    let list = list(&handout(148, 1_000_000));
    let floor: Vec<_> = list.iter().filter(|record| record.surface == 3).collect();
    assert!(floor.len() > 9_000);
    assert_eq!(floor.into_iter().filter(|record| is_inside(record)).count(), 0);
}

#[test]
fn hits_in_a_closed_cube_form_a_geometric_series() {
    let (albedo, emitted) = (0.75_f64, 400_000);
    let cube = closed_cube(albedo as f32, 5, emitted);
    let mut hits = [[0_u64; 12]; 6];
    cube.generic_photon_map_generation(&mut Vec::new(), 0..emitted, |_, path, _| {
        for (bounce, vertex) in path[1..].iter().take(12).enumerate() {
            let PathVertex::Surface(state) = vertex else { unreachable!() };
            hits[state.primitive(&cube.stored_scene).parent_mesh_object][bounce] += 1;
        }
    });
    for bounce in 0..12 {
        let total: u64 = hits.iter().map(|surface| surface[bounce]).sum();
        let probability = albedo.powi(bounce as i32);
        if bounce == 0 {
            assert_eq!(total, emitted, "nothing leaves a closed cube");
        } else {
            let z = deviations(total, emitted, probability);
            assert!(z.abs() < 4.0, "bounce {bounce}: {z:.1} deviations");
        }
        // The light is in the middle, so each of the six faces gets a sixth.
        for surface in hits {
            let z = deviations(surface[bounce], emitted, probability / 6.0);
            assert!(z.abs() < 4.0, "bounce {bounce}: {z:.1} deviations");
        }
    }
}

/// Photons that start within 1e-4 of the edge at which the short box's front meets the floor, half
/// of them on the box and half on the floor, in all directions of the hemisphere. Every other pair
/// starts within twice the rounding of a point, so that half of those lie on the wrong side of the
/// edge: no rule could decide where directions along the other surface go, so they are left out.
#[test]
fn photons_scattered_where_a_box_meets_the_floor_stay_outside() {
    let scene = handout(148, 1).stored_scene;
    let front = Vec3::new(-0.2964, -0.9551, 0.0).normalize();
    let (a, b) = (Vec3::new(0.53, -0.75, 0.0), Vec3::new(-0.05, -0.57, 0.0));
    let mut on_floor = 0;
    for k in 0..400_000_u32 {
        let mut rand = photon_random(99, u64::from(k));
        let edge = a.lerp(b, rand());
        let is_rounded = k % 4 < 2;
        let away = if is_rounded { 2e-7 * (2.0 * rand() - 1.0) } else { 1e-4 * rand() };
        let on_box = k % 2 == 0;
        let (normal, other) = if on_box { (front, Vec3::Z) } else { (Vec3::Z, front) };
        let point = edge + away * other;
        let direction = (tangent_frame(normal) * sample_hemisphere(rand(), rand())).normalize();
        if is_rounded && direction.dot(other).abs() < 0.05 {
            continue;
        }
        let mut ray = Ray::new(point + LARGE_EPSILON * normal, direction);
        ray.start_error = 0.5 * LARGE_EPSILON;
        let mut state = IntersectionState::new();
        let is_met = scene.trace(&ray, Some(&mut state));
        let may_miss = !is_rounded || direction.dot(other) > 0.0;
        assert!(is_met || may_miss, "{point} towards {direction} slips through");
        if is_met {
            let hit = state.intersection_point();
            assert!(direction.dot(state.compute_normal(&scene)) < 0.0, "{point} to {hit}");
            let mesh_object = state.primitive(&scene).parent_mesh_object;
            if scene.mesh_objects()[mesh_object].name == "floor" {
                on_floor += 1;
                // The box is on the other side of the plane of its front.
                assert!((hit - a).dot(front) > -1e-6, "{point} to {hit}");
            }
        }
    }
    assert!(on_floor > 50_000, "only {on_floor} came to the floor");
}

/// The reflected ray is the frame times the sample, unit, and starts 1e-5 above the surface.
#[test]
fn reflected_rays_start_above_the_surface() {
    let renderer = handout(3, 20_000);
    let scene = &renderer.stored_scene;
    let mut hits = 0;
    renderer.generic_photon_map_generation(&mut Vec::new(), 0..20_000, |photon, path, _| {
        let mut rand = photon_random(4, photon);
        for vertex in &path[1..] {
            let PathVertex::Surface(state) = vertex else { unreachable!() };
            let (u1, u2) = (rand(), rand());
            let ray = renderer.diffuse_reflection_ray(state, u1, u2);
            let normal = state.compute_normal(scene);
            let expected = (tangent_frame(normal) * sample_hemisphere(u1, u2)).normalize();
            assert_eq!(ray.ray_direction(), expected);
            let start = state.intersection_point() + LARGE_EPSILON * normal;
            assert_eq!(ray.position(), start, "photon {photon}");
            hits += 1;
        }
    });
    assert!(hits > 5_000, "{hits}");
}
