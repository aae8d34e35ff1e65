//! Hard cases of size and place: the whole scene scaled or moved, closed meshes, coordinates that are
//! no numbers.

mod common;

use std::ops::Range;

use common::{handout, light, list, moved_handout};
use glam::{DVec3, Vec3};
use photon_mapping::accuracy::table::ExpectedTable;
use photon_mapping::random::photon_random;
use photon_mapping::rendering::photon_mapping_renderer::{PathVertex, PhotonMappingRenderer};
use photon_mapping::scene::Scene;
use photon_mapping::scene::intersection_state::IntersectionState;
use photon_mapping::scene::ray::Ray;
use photon_mapping::scene::triangle::{ShearedRay, Triangle};
use proptest::prelude::*;
use rayon::prelude::*;

/// What happened on the paths of some photons, judged in f64.
#[derive(Debug, Default, PartialEq)]
struct Judgement {
    rays: u64,
    stored: Vec<u64>,
    /// Hits on the plane that the photon had just left.
    self_hits: u64,
    /// Hits from behind: every surface of the handout's scene is closed or faces all others.
    leaks: u64,
}

fn judge(renderer: &PhotonMappingRenderer, photons: Range<u64>) -> Judgement {
    let scene = &renderer.stored_scene;
    let planes: Vec<(DVec3, f64)> = scene
        .triangles()
        .iter()
        .map(|triangle| {
            let [a, b, c] = triangle.vertices.map(|vertex| vertex.as_dvec3());
            let normal = (b - a).cross(c - a).normalize();
            // Some quads of the model wind against their normal.
            let normal = normal * normal.dot(triangle.normal.as_dvec3()).signum();
            (normal, normal.dot(a))
        })
        .collect();
    let mut judgement = Judgement { stored: vec![0; 4], ..Judgement::default() };
    let mut photon_map = Vec::new();
    renderer.generic_photon_map_generation(&mut photon_map, photons, |_, path, _| {
        judgement.rays += path.len() as u64;
        let mut left: Option<(DVec3, f64)> = None;
        for (bounce, vertex) in path[1..].iter().enumerate() {
            let PathVertex::Surface(state) = vertex else { unreachable!() };
            let plane = planes[state.intersected_primitive];
            let direction = state.intersection_ray.ray_direction().as_dvec3();
            judgement.leaks += u64::from(direction.dot(plane.0) >= 0.0);
            judgement.self_hits += u64::from(left.is_some_and(|left| {
                left.0.dot(plane.0) > 1.0 - 1e-6 && (left.1 - plane.1).abs() < 1e-6
            }));
            left = Some(plane);
            if bounce > 0 {
                judgement.stored[state.primitive(scene).parent_mesh_object] += 1;
            }
        }
    });
    judgement
}

fn judge_in_parallel(renderer: &PhotonMappingRenderer, count: u64) -> Judgement {
    const PIECE: u64 = 50_000;
    let pieces = (0..count.div_ceil(PIECE)).into_par_iter();
    let judged: Vec<_> = pieces
        .map(|piece| judge(renderer, piece * PIECE..count.min((piece + 1) * PIECE)))
        .collect();
    let mut all = Judgement { stored: vec![0; 4], ..Judgement::default() };
    for judgement in judged {
        all.rays += judgement.rays;
        all.self_hits += judgement.self_hits;
        all.leaks += judgement.leaks;
        all.stored.iter_mut().zip(judgement.stored).for_each(|(sum, stored)| *sum += stored);
    }
    all
}

/// Traces `count` photons and holds them against the oracle of the unmoved scene.
fn check(scale: f64, shift: DVec3, seed: u64, count: u64) {
    let judgement = judge_in_parallel(&moved_handout(scale, shift, seed, count), count);
    assert_eq!((judgement.self_hits, judgement.leaks), (0, 0), "scale {scale}, shift {shift}");
    assert!(judgement.rays >= count);
    let expected = ExpectedTable::of_assignment8();
    for (surface, row) in expected.surfaces.iter().enumerate() {
        let deviation = (expected.covariance[surface][surface] * count as f64).sqrt();
        let z = (judgement.stored[surface] as f64 - row.stored * count as f64) / deviation;
        assert!(z.abs() < 4.0, "scale {scale}, shift {shift}: {} is {z:.1} off", row.name);
    }
}

#[test]
fn whole_scene_scaled() {
    for scale in [1e-4, 1e-3, 0.1, 10.0, 1e3, 1e4] {
        check(scale, DVec3::ZERO, 21, 1_000_000);
    }
}

#[test]
fn whole_scene_moved() {
    for distance in [1e4, 1e5] {
        for direction in [DVec3::X, DVec3::NEG_Y, DVec3::Z, DVec3::ONE] {
            check(1.0, distance * direction, 22, 300_000);
        }
    }
}

#[test]
fn whole_scene_moved_far_and_scaled() {
    check(1e-4, DVec3::new(100.0, -37.0, 5.0), 23, 1_000_000);
    check(1e4, DVec3::new(-1e5, 1e5, 3e4), 24, 1_000_000);
}

/// Beside the numbers of the tests above, 10^8 rays each: `cargo test --release -- --ignored`.
#[test]
#[ignore = "takes many minutes"]
fn no_self_hit_and_no_leak_in_a_hundred_million_rays() {
    for (scale, shift) in [
        (1.0, DVec3::ZERO),
        (1e-4, DVec3::ZERO),
        (1e-2, DVec3::ZERO),
        (1e2, DVec3::ZERO),
        (1e4, DVec3::ZERO),
        (1.0, 1e4 * DVec3::ONE),
        (1.0, 1e5 * DVec3::ONE),
    ] {
        check(scale, shift, 25, 100_000_000);
        println!("scale {scale}, shift {shift}: no self-hit and no leak");
    }
}

/// The bound on what moving does: nothing to the paths, and to a position in the list at most half a
/// unit in the last place of its world coordinates.
#[test]
fn moving_rounds_positions_once() {
    let at_home = list(&handout(26, 100_000));
    for distance in [1e4, 1e5] {
        let shift = DVec3::splat(distance);
        let moved = list(&moved_handout(1.0, shift, 26, 100_000));
        assert_eq!(at_home.len(), moved.len());
        let half_unit = f64::from((distance as f32).next_up() - distance as f32) / 2.0;
        for (here, there) in at_home.iter().zip(&moved) {
            assert_eq!((here.photon, here.bounce), (there.photon, there.bounce));
            let distance = there.position.as_dvec3() - shift - here.position.as_dvec3();
            assert!(distance.abs().max_element() <= half_unit * 1.001, "{here:?} {there:?}");
            assert!((here.to_light - there.to_light).length() < 1e-6);
        }
    }
}

#[test]
fn handout_is_traced_where_it_stands() {
    let scene = handout(1, 1).stored_scene;
    assert_eq!(*scene.frame(), photon_mapping::scene::frame::Frame::WORLD);
    assert_eq!(light().position, Vec3::new(0.01909, 0.0101, 1.77640));
}

/// A closed mesh of 20 * 4^`level` triangles about the origin, each corner at the distance that `radius`
/// gives for its number.
fn closed_mesh(level: u32, radius: impl Fn(usize) -> f32) -> Vec<Triangle> {
    let golden = (1.0 + 5.0_f64.sqrt()) / 2.0;
    let mut corners: Vec<DVec3> = Vec::new();
    for (long, short) in [(golden, 1.0), (golden, -1.0), (-golden, 1.0), (-golden, -1.0)] {
        corners.push(DVec3::new(0.0, short, long));
        corners.push(DVec3::new(short, long, 0.0));
        corners.push(DVec3::new(long, 0.0, short));
    }
    let mut faces: Vec<[usize; 3]> = Vec::new();
    for a in 0..12 {
        for b in a + 1..12 {
            for c in b + 1..12 {
                let edges = [(a, b), (b, c), (c, a)].map(|(p, q)| corners[p].distance(corners[q]));
                if edges.iter().all(|edge| (edge - 2.0).abs() < 1e-9) {
                    faces.push([a, b, c]);
                }
            }
        }
    }
    assert_eq!(faces.len(), 20);
    for _ in 0..level {
        let mut middles = std::collections::BTreeMap::new();
        let mut finer = Vec::new();
        for [a, b, c] in faces {
            let mut middle = |p: usize, q: usize| {
                *middles.entry((p.min(q), p.max(q))).or_insert_with(|| {
                    corners.push((corners[p] + corners[q]) / 2.0);
                    corners.len() - 1
                })
            };
            let (ab, bc, ca) = (middle(a, b), middle(b, c), middle(c, a));
            finer.extend([[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]);
        }
        faces = finer;
    }
    let corners: Vec<Vec3> = corners
        .iter()
        .enumerate()
        .map(|(number, corner)| corner.normalize().as_vec3() * radius(number))
        .collect();
    faces
        .iter()
        .map(|face| Triangle {
            vertices: face.map(|corner| corners[corner]),
            normal: Vec3::Z,
            parent_mesh_object: 0,
            facet: 0,
        })
        .collect()
}

#[test]
fn rays_through_shared_edges_and_vertices() {
    let triangles = closed_mesh(0, |_| 1.0);
    let scene = Scene::new(Vec::new(), triangles.clone(), Vec::new());
    (0..10_000_000_u64).into_par_iter().for_each(|number| {
        let mut rand = photon_random(31, number);
        let triangle = &triangles[number as usize % triangles.len()];
        let corner = (number / triangles.len() as u64) as usize % 3;
        let (a, b) = (triangle.vertices[corner], triangle.vertices[(corner + 1) % 3]);
        // Every fourth ray goes to a corner, the others anywhere on an edge.
        let target = if number.is_multiple_of(4) { a } else { a.lerp(b, rand()) };
        let from = 0.8 * Vec3::new(rand() - 0.5, rand() - 0.5, rand() - 0.5);
        let ray = Ray::new(from, (target - from).normalize());
        let mut state = IntersectionState::new();
        assert!(scene.trace(&ray, Some(&mut state)), "lost: from {from} to {target}");
        // Those at the edge or corner may all answer, but from one place: no second surface behind.
        let sheared_ray = ShearedRay::new(&ray);
        for (index, other) in triangles.iter().enumerate() {
            if let Some(t) = other.intersect(&sheared_ray) {
                assert!(t - state.intersection_t < 2e-6, "double: from {from} to {target}");
                let is_first = t > state.intersection_t || index >= state.intersected_primitive;
                assert!(is_first, "of two at one distance, the first counts");
            }
        }
    });
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(100))]

    #[test]
    fn random_closed_meshes_leak_nothing(seed: u64, level in 0_u32..3, roughness in 0.0_f32..0.9) {
        let radius = |number: usize| 1.0 - roughness * photon_random(seed, number as u64)();
        let triangles = closed_mesh(level, radius);
        let scene = Scene::new(Vec::new(), triangles.clone(), Vec::new());
        for number in 0..5_000_u64 {
            let mut rand = photon_random(seed ^ 1, number);
            let triangle = &triangles[number as usize % triangles.len()];
            let [a, b, c] = triangle.vertices;
            // The mesh can be seen whole from its centre; rays go anywhere, to edges and to corners.
            let direction = match number % 3 {
                0 => light().generate_random_photon_ray(&mut rand).ray_direction(),
                1 => a.lerp(b, rand()).normalize(),
                _ => c.normalize(),
            };
            prop_assert!(scene.trace(&Ray::new(Vec3::ZERO, direction), Some(&mut IntersectionState::new())));
        }
    }
}
