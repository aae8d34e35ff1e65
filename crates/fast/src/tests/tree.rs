//! The tree of large scenes never changes a hit.

use glam::Vec3;
use photon_mapping::random::photon_random;
use photon_mapping::scene::Acceleration;
use photon_mapping::scene::ray::Ray;
use photon_mapping::scene::triangle::{ShearedRay, Triangle};
use proptest::prelude::*;

use crate::lanes::width::Width;
use crate::tree::Tree;

fn brute_force(
    triangles: &[Triangle],
    ray: &Ray,
    of: impl Fn(&Triangle, f32) -> bool,
) -> Option<(usize, f32)> {
    let sheared = ShearedRay::new(ray);
    let all = triangles.iter().enumerate();
    let hits = all.filter_map(|(index, triangle)| {
        let t = triangle.intersect(&sheared)?;
        (t < ray.max_t && of(triangle, t)).then_some((index, t))
    });
    hits.reduce(|best, hit| if hit.1 < best.1 { hit } else { best })
}

/// A tree for every width of the processor's vectors.
fn trees(triangles: &[Triangle]) -> Vec<Tree> {
    let tree = |width| Tree::with_width(triangles, width);
    Width::available().into_iter().map(tree).collect()
}

fn triangle(vertices: [Vec3; 3]) -> Triangle {
    Triangle { vertices, normal: Vec3::Z, parent_mesh_object: 0, facet: 0 }
}

/// A normal at right angles to a ray now and then, and not that of any plane, as a file's need not
/// be.
fn normal() -> impl Strategy<Value = Vec3> {
    prop_oneof![
        Just(Vec3::X),
        Just(Vec3::NEG_Y),
        point().prop_map(|point| point.normalize_or(Vec3::Z))
    ]
}

/// A coordinate that other points often share.
fn coordinate() -> impl Strategy<Value = f32> {
    prop_oneof![(-5_i8..=5).prop_map(f32::from), -5.0_f32..5.0]
}

fn point() -> impl Strategy<Value = Vec3> {
    (coordinate(), coordinate(), coordinate()).prop_map(|(x, y, z)| Vec3::new(x, y, z))
}

/// In so many layers more boxes wait to be visited than ordinarily: those of the lower layers in
/// every node down to the leaf.
#[test]
fn the_tree_forgets_no_box_of_many() {
    let layer = |number: u16| {
        let [a, b, c] = [Vec3::new(-1.0, -1.0, 0.0), Vec3::X, Vec3::Y];
        triangle([a, b, c].map(|corner| corner + 0.01 * f32::from(number) * Vec3::Z))
    };
    let triangles: Vec<_> = (0..u16::MAX).map(layer).collect();
    let trees = trees(&triangles);
    for height in [-1.0, 0.0, 1.237, 47.11, 326.97, 655.345, 700.0] {
        for direction in [Vec3::Z, Vec3::NEG_Z] {
            let ray = Ray::new(Vec3::new(0.1, 0.05, height), direction);
            let all = |_: &Triangle, _| true;
            // As long as nothing is met, nothing is left out.
            let last = |triangle: &Triangle, _| triangle.vertices[0].z > 655.335;
            for tree in &trees {
                let found = tree.closest_of(&ray, &triangles, &all);
                assert_eq!(found, brute_force(&triangles, &ray, all), "{ray:?}");
                let found = tree.closest_of(&ray, &triangles, &last);
                assert_eq!(found, brute_force(&triangles, &ray, last), "{ray:?}");
            }
        }
    }
}

/// Where all of a triangle lies along a line through the ray, but for rounding, all of its edge
/// functions may round to zero, and their exact signs decide.
#[test]
fn slivers_are_met_as_the_exact_signs_say() {
    let mut met = 0;
    for number in 0..4000 {
        let mut random = photon_random(3, number);
        let mut sliver = || {
            let along = Vec3::new(random() - 0.5, random() - 0.5, 0.0);
            let mut corner = || (random() - 0.5) * along + random() * Vec3::Z;
            triangle([corner(), corner(), corner()])
        };
        let triangles: Vec<_> = (0..12).map(|_| sliver()).collect();
        let ray = Ray::new(Vec3::new(0.0, 0.0, -1.0), Vec3::Z);
        let all = |_: &Triangle, _| true;
        let expected = brute_force(&triangles, &ray, all);
        met += usize::from(expected.is_some());
        for tree in trees(&triangles) {
            assert_eq!(tree.closest_of(&ray, &triangles, &all), expected, "{number}");
        }
    }
    assert!(met > 1000, "{met}");
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, ..ProptestConfig::default() })]

    #[test]
    fn the_tree_knows_which_side_is_met(
        corners in prop::collection::vec(([point(), point(), point()], normal()), 1..200),
        rays in prop::collection::vec((point(), point()), 40),
    ) {
        let with_normal = |(corners, normal)| Triangle { normal, ..triangle(corners) };
        let triangles: Vec<_> = corners.into_iter().map(with_normal).collect();
        let trees = trees(&triangles);
        for (origin, target) in rays {
            for direction in [(target - origin).normalize_or(Vec3::Y), Vec3::Z] {
                for start_error in [0.0, 0.01] {
                    let mut ray = Ray::new(origin, direction);
                    ray.start_error = start_error;
                    let hit = brute_force(&triangles, &ray, |_, _| true);
                    let expected = hit.map(|(at, t)| (at, t, triangles[at].faces(direction)));
                    for tree in &trees {
                        prop_assert_eq!(tree.closest(&ray, &triangles), expected);
                    }
                }
            }
        }
    }

    #[test]
    fn the_tree_finds_what_testing_all_finds(
        corners in prop::collection::vec([point(), point(), point()], 1..200),
        shrink in prop_oneof![Just(1.0_f32), Just(0.1)],
        shift in prop_oneof![Just(0.0_f32), Just(1e4)],
        rays in prop::collection::vec((point(), point(), 0.1_f32..20.0), 40),
    ) {
        let triangles: Vec<_> = corners
            .iter()
            .map(|[a, b, c]| {
                let near = |corner: &Vec3| *a + shrink * (*corner - *a) + Vec3::splat(shift);
                triangle([near(a), near(b), near(c)])
            })
            .collect();
        let trees = trees(&triangles);
        for (place, (origin, target, max_t)) in rays.iter().enumerate() {
            let origin = *origin + Vec3::splat(shift);
            // Every other ray aims at a corner or at the middle of an edge.
            let aim = match triangles.get(place / 2) {
                Some(triangle) if place % 4 == 0 => triangle.vertices[0],
                Some(Triangle { vertices: [a, b, _], .. }) if place % 4 == 2 => 0.5 * (*a + *b),
                _ => *target + Vec3::splat(shift),
            };
            let Some(direction) = (aim - origin).try_normalize() else {
                continue;
            };
            // Some start just behind a triangle.
            let origin = match triangles.get(place) {
                Some(Triangle { vertices: [a, b, c], .. }) if place % 5 == 0 => {
                    (*a + *b + *c) / 3.0 + 0.005 * direction
                }
                _ => origin,
            };
            let mut ray = Ray::new(origin, direction);
            let all = |_: &Triangle, _| true;
            let front = |triangle: &Triangle, _| triangle.faces(direction);
            for start_error in [0.0, 0.01] {
                (ray.max_t, ray.start_error) = (f32::INFINITY, start_error);
                let whole = brute_force(&triangles, &ray, all);
                let endless = ray;
                // Also an end just behind the hit.
                let beyond = whole.map_or(1.0, |(_, t)| t.next_up());
                for max_t in [*max_t, beyond] {
                    ray.max_t = max_t;
                    let closest = brute_force(&triangles, &ray, all);
                    let closest_front = brute_force(&triangles, &ray, front);
                    for tree in &trees {
                        prop_assert_eq!(tree.closest_of(&endless, &triangles, &all), whole);
                        prop_assert_eq!(tree.closest_of(&ray, &triangles, &all), closest);
                        prop_assert_eq!(tree.any(&ray, &triangles), closest.is_some());
                        let found = tree.closest_of(&ray, &triangles, &front);
                        prop_assert_eq!(found, closest_front);
                    }
                }
            }
        }
    }
}
