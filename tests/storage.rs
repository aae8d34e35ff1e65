//! Photon Storage: what `trace_photon` stores, where, and when it ends.

mod common;

use common::{closed_cube, deviations, handout, list, trace_scripted};
use glam::{DVec3, Vec3};
use photon_mapping::photon_list::PhotonRecord;
use photon_mapping::rendering::photon_mapping_renderer::{PathVertex, PhotonMappingRenderer};
use photon_mapping::scene::ray::{IntersectionState, Ray};
use proptest::prelude::*;

/// A path of a photon that has hit one surface.
fn path_of_one_hit() -> Vec<PathVertex> {
    vec![PathVertex::Light, PathVertex::Surface(IntersectionState::new())]
}

#[test]
fn a_photon_straight_from_the_light_is_not_stored() {
    let cube = closed_cube(0.5, 148, 1);
    let ray = Ray::new(Vec3::ZERO, Vec3::X);
    let mut path = vec![PathVertex::Light];
    assert!(trace_scripted(&cube, &ray, &mut path, 1000, &[0.9]).is_empty());
    assert_eq!(path.len(), 2, "the path grows all the same");
}

#[test]
fn a_photon_that_has_bounced_is_stored_where_it_hits() {
    let cube = closed_cube(0.5, 148, 1);
    let direction = Vec3::new(0.6, 0.0, 0.8);
    let ray = Ray::new(Vec3::new(0.1, 0.2, 0.0), direction);
    let stored = trace_scripted(&cube, &ray, &mut path_of_one_hit(), 1000, &[0.9]);
    let [photon] = stored[..] else { panic!("expected one photon, found {stored:?}") };
    // Exactly the point hit, not the point 1e-5 above it from which a photon goes on.
    assert_eq!(photon.position, ray.ray_position(1.25));
    assert_eq!(photon.position.z, 1.0);
    assert_eq!(photon.intensity, Vec3::new(0.25, 0.5, 1.0));
    assert_eq!(photon.to_light_ray.position(), photon.position);
    assert_eq!(photon.to_light_ray.ray_direction(), -direction);
}

#[test]
fn a_path_ends_when_remaining_bounces_is_less_than_zero() {
    let cube = closed_cube(1.0, 148, 1);
    let ray = Ray::new(Vec3::ZERO, Vec3::X);
    let stored = |remaining_bounces, numbers: &[f32]| {
        trace_scripted(&cube, &ray, &mut path_of_one_hit(), remaining_bounces, numbers).len()
    };
    assert_eq!(stored(-1, &[]), 0);
    // At 0 the photon is stored, scatters, and is not traced further.
    assert_eq!(stored(0, &[0.5, 0.3, 0.4]), 1);
    assert_eq!(stored(1, &[0.5, 0.3, 0.4, 0.5, 0.3, 0.4]), 2);
    assert_eq!(stored(1000, &[0.5, 0.3, 0.4].repeat(1001)), 1001);
}

#[test]
fn a_photon_that_meets_nothing_is_not_stored() {
    let handout = handout(148, 1);
    let up = Ray::new(Vec3::new(0.0, 0.0, 3.0), Vec3::Z);
    assert!(trace_scripted(&handout, &up, &mut path_of_one_hit(), 1000, &[]).is_empty());
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
