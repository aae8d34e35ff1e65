//! The oracle against what is known.
//!
//! The handout's figures come from an independent calculation, checked by Monte Carlo, but for the
//! last digit of N2 on the tall box (see `solve.rs`). The covariances come from 1e8 paths of an
//! independent tracer. Their standard error is about 7e-6.

use super::fixtures::{FLOOR, RIGHT_WALL, SHORT_BOX, TALL_BOX, cube, facet, handout};
use super::{Accuracy, Bounded, Emitter, Expectation, Facet, expect};
use glam::DVec3;
use std::sync::LazyLock;

/// That of the handout, which five threads computed.
static HANDOUT: LazyLock<Expectation> = LazyLock::new(|| {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(5).build().expect("threads start");
    let (facets, emitters) = handout();
    pool.install(|| quick(&facets, &emitters))
});

const SURFACES: [usize; 4] = [FLOOR, RIGHT_WALL, SHORT_BOX, TALL_BOX];
const FIRST: [f64; 4] = [0.041323923772, 0.132736677536, 0.016710788766, 0.045214549333];
const SECOND: [f64; 4] = [0.005324345, 0.009668818, 0.007977496, 0.010443311];
const THIRD: [f64; 4] = [0.00330447, 0.00449688, 0.00167178, 0.00153398];
const LATER: [f64; 4] = [0.0015426, 0.0017400, 0.0012759, 0.0011784];
const COVARIANCE: [[f64; 4]; 4] = [
    [11765e-6, 3796e-6, 3808e-6, 3701e-6],
    [3796e-6, 17550e-6, 3817e-6, 3560e-6],
    [3808e-6, 3817e-6, 12546e-6, 2858e-6],
    [3701e-6, 3560e-6, 2858e-6, 14647e-6],
];

fn check(what: &str, found: Bounded, expected: f64, digits: f64) {
    let distance = (found.value - expected).abs();
    assert!(distance <= found.error + digits, "{what}: {found:?} is {distance:e} off {expected}");
}

fn check_handout(result: &Expectation, covariance_digits: f64) {
    for (i, surface) in SURFACES.into_iter().enumerate() {
        check("N1", result.on_surface(surface, 1), FIRST[i], 1e-12);
        check("N2", result.on_surface(surface, 2), SECOND[i], 1e-9);
        check("N3", result.on_surface(surface, 3), THIRD[i], 3e-8);
        check("N4 and later", result.on_surface_from(surface, 4), LATER[i], 5e-7);
        for (j, other) in SURFACES.into_iter().enumerate() {
            check(
                "covariance",
                result.covariance[surface][other],
                COVARIANCE[i][j],
                covariance_digits,
            );
        }
    }
    check("stored", result.stored(), 0.0501580, 1.5e-6);
    check("spread", result.spread(), 1.985, 5e-4);
    check("scattered", result.scattered(), 0.16658, 5e-6);
    check("absorbed", result.absorbed(), 0.11957, 5e-6);
}

fn quick(facets: &[Facet], emitters: &[Emitter]) -> Expectation {
    expect(facets, emitters, Accuracy::Quick)
}

fn in_the_middle() -> Vec<Emitter> {
    vec![Emitter { position: DVec3::ZERO, share: 1.0 }]
}

fn all_numbers(result: &Expectation) -> impl Iterator<Item = f64> + '_ {
    let hits =
        result.facets.iter().flat_map(|facet| facet.hits.iter().chain(&facet.error)).copied();
    hits.chain(result.covariance.iter().flatten().flat_map(|entry| [entry.value, entry.error]))
}

#[test]
fn quick_answers_are_within_their_errors() {
    let result = &*HANDOUT;
    check_handout(result, 25e-6);
    assert!(result.on_surface_from(FLOOR, 4).error < 1e-5 && result.stored().error < 2e-4);
}

#[test]
fn first_hits_have_twelve_digits() {
    for (surface, expected) in SURFACES.into_iter().zip(FIRST) {
        assert!((HANDOUT.on_surface(surface, 1).value - expected).abs() < 1e-12);
    }
    assert!((HANDOUT.total(1).value - 0.235985939407).abs() < 1e-12);
}

#[test]
fn a_cube_shares_its_hits_evenly_in_a_geometric_series() {
    let result = quick(&cube(0.6), &in_the_middle());
    for face in 0..6 {
        assert!((result.on_surface(face, 1).value - 1.0 / 6.0).abs() < 1e-14);
        for bounce in 2..20 {
            let expected = 0.6f64.powi(bounce as i32 - 1) / 6.0;
            check("face of the cube", result.on_surface(face, bounce), expected, 1e-13);
        }
    }
    check("all hits", result.total_from(1), 2.5, 1e-12);
    // The number of hits of a path is geometric: variance P / (1 - P)^2, and not storing the first
    // changes nothing.
    check("variance", result.variance(), 0.6 / 0.16, 1e-9);
}

#[test]
fn a_closed_box_keeps_its_series_wherever_the_light() {
    let light = [Emitter { position: DVec3::new(0.7, -0.2, 0.4), share: 1.0 }];
    let result = quick(&cube(0.725), &light);
    for bounce in 1..30 {
        let expected = 0.725f64.powi(bounce - 1);
        let found = result.total(bounce as usize);
        check("closed box", found, expected, 1e-12);
        assert!((found.value - expected).abs() < 2e-5 * expected, "{bounce}: {found:?}");
    }
}

#[test]
fn a_lone_floor_is_hit_once() {
    let floor = cube(0.7).swap_remove(5);
    let result = quick(&[floor], &in_the_middle());
    assert!((result.total(1).value - 1.0 / 6.0).abs() < 1e-14);
    assert_eq!(result.stored().value, 0.0);
}

#[test]
fn hits_from_behind_scatter_to_the_normals_side() {
    let sheet = |surface: usize, half: f64, z: f64, up: f64| {
        let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
        let vertices = corners.iter().map(|&(x, y)| DVec3::new(half * x, half * y, z)).collect();
        facet(surface, vertices, DVec3::new(0.0, 0.0, z - up), 1.0)
    };
    let below = [Emitter { position: DVec3::new(0.1, 0.2, -0.5), share: 1.0 }];
    let above = [Emitter { position: DVec3::new(0.1, 0.2, 0.5), share: 1.0 }];
    // Lit from either side, the first sheet scatters up only.
    let mut ceiling = sheet(1, 3.0, 1.0, 1.0);
    ceiling.survival = 0.0;
    let pair = [sheet(0, 1.0, 0.0, 1.0), ceiling.clone()];
    let (from_below, from_above) = (quick(&pair, &below), quick(&pair, &above));
    let (behind, front) = (from_below.on_surface(1, 2), from_above.on_surface(1, 2));
    check("second hit", behind, front.value, front.error);
    assert!(behind.value > 0.1);
    // What meets the ceiling from below goes on up, all into a lid that fills its sky.
    ceiling.survival = 1.0;
    let lid = sheet(2, 3000.0, 1.5, -1.0);
    let stack = [sheet(0, 1.0, 0.0, 1.0), ceiling, lid];
    let result = quick(&stack, &above);
    check("third hit", result.on_surface(2, 3), result.on_surface(1, 2).value, 1e-5);
}

#[test]
fn facets_without_area_change_nothing() {
    let (mut facets, emitters) = handout();
    let (nan, big) = (DVec3::new(0.0, f64::NAN, 0.0), DVec3::splat(f64::INFINITY));
    for vertices in [
        vec![],
        vec![DVec3::ZERO, DVec3::X],
        vec![DVec3::X; 4],
        vec![DVec3::ZERO, DVec3::X, 2.0 * DVec3::X, 3.0 * DVec3::X],
        vec![DVec3::ZERO, DVec3::X, nan],
        vec![DVec3::ZERO, DVec3::X, big],
    ] {
        facets.push(Facet { surface: 9, vertices, normal: DVec3::ZERO, survival: f64::NAN });
    }
    let after = quick(&facets, &emitters);
    assert_eq!(after.facets[..12], HANDOUT.facets[..]);
    assert!(all_numbers(&after).all(f64::is_finite));
    assert_eq!(after.on_surface_from(9, 1), Bounded::default());
}

#[test]
fn strange_scenes_give_finite_answers() {
    let (facets, emitters) = handout();
    assert!(quick(&[], &emitters).facets.is_empty());
    assert_eq!(quick(&facets, &[]).total_from(1).value, 0.0);
    let on_the_wall = [Emitter { position: DVec3::new(1.0, 0.1, 0.5), share: 1.0 }];
    let nowhere = [Emitter { position: DVec3::splat(f64::NAN), share: 1.0 }];
    let at_a_corner = [Emitter { position: DVec3::new(0.53, -0.75, 0.6), share: 1.0 }];
    let sliver =
        vec![DVec3::new(0.0, 0.0, 1.3), DVec3::new(0.5, 0.0, 1.3), DVec3::new(0.5, 5e-7, 1.3)];
    let mut crossed = facets.clone();
    crossed.push(facet(4, sliver, DVec3::ZERO, 0.5));
    crossed.push(facet(
        5,
        vec![DVec3::new(-0.9, -0.9, 0.1), DVec3::new(0.9, -0.5, 0.3), DVec3::Z],
        DVec3::ZERO,
        0.5,
    ));
    for (facets, emitters) in [
        (&facets, &on_the_wall[..]),
        (&facets, &nowhere),
        (&facets, &at_a_corner),
        (&crossed, &emitters),
    ] {
        assert!(all_numbers(&quick(facets, emitters)).all(f64::is_finite));
    }
}

#[test]
fn duplicates_count_once() {
    let (facets, emitters) = handout();
    let doubled: Vec<Facet> = facets.iter().chain(&facets).cloned().collect();
    let (once, twice) = (&*HANDOUT, quick(&doubled, &emitters));
    for surface in SURFACES {
        assert!(
            (twice.on_surface(surface, 1).value - once.on_surface(surface, 1).value).abs() < 1e-12
        );
        let (found, expected) =
            (twice.on_surface_from(surface, 2), once.on_surface_from(surface, 2));
        check("doubled", found, expected.value, expected.error);
    }
    assert!(twice.facets[12..].iter().all(|facet| facet.from(1).value == 0.0));
}

#[test]
fn units_and_place_do_not_matter() {
    let (facets, emitters) = handout();
    for (scale, shift, digits) in [(1e-4, 0.0, 1e-12), (1e4, 0.0, 1e-12), (1.0, 1e5, 1e-9)] {
        let shift = DVec3::new(shift, -shift, 0.7 * shift);
        let mut moved = facets.clone();
        moved
            .iter_mut()
            .flat_map(|facet| &mut facet.vertices)
            .for_each(|vertex| *vertex = *vertex * scale + shift);
        let lights: Vec<Emitter> = emitters
            .iter()
            .map(|light| Emitter { position: light.position * scale + shift, ..*light })
            .collect();
        let after = quick(&moved, &lights);
        for (after, before) in after.facets.iter().zip(&HANDOUT.facets) {
            for bounce in 1..30 {
                let difference = after.hit(bounce).value - before.hit(bounce).value;
                assert!(
                    difference.abs() < digits,
                    "scale {scale}, bounce {bounce}: {difference:e}"
                );
            }
        }
    }
}

#[test]
fn emitters_add_up() {
    let (facets, emitters) = handout();
    let (whole, light) = (&*HANDOUT, emitters[0]);
    let other = Emitter { position: DVec3::new(-0.3, -0.8, 0.9), share: 0.25 };
    let both = quick(&facets, &[Emitter { share: 0.75, ..light }, other]);
    let alone = quick(&facets, &[Emitter { share: 1.0, ..other }]);
    for surface in SURFACES {
        for bounce in 1..6 {
            let [whole, both, alone] =
                [whole, &both, &alone].map(|result| result.on_surface(surface, bounce));
            let expected = 0.75 * whole.value + 0.25 * alone.value;
            check("two emitters", both, expected, whole.error + alone.error);
        }
    }
}

#[test]
fn threads_do_not_matter() {
    let (facets, emitters) = handout();
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a thread starts");
    assert_eq!(pool.install(|| quick(&facets, &emitters)), *HANDOUT);
}
