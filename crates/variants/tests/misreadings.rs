//! The table of misreadings, and what each of them does.

use std::collections::HashSet;

use glam::Vec3;
use photon_mapping::photon_list::PhotonRecord;
use photon_mapping::rendering::sampling::sample_hemisphere;
use variants::hypotheses::{BOUNCE_OFF_BY_ONE, misreadings};
use variants::misreadings::{Numbers, directions, table};
use variants::pairs::pairs;
use variants::reading::{Reading, TangentBasis};
use variants::variation::{Hemisphere, Simulation, Transformation, Variation};

const EMITTED: u64 = 20_000;

fn stored(variation: Variation, max_bounces: i32) -> Vec<PhotonRecord> {
    Simulation::new(variation, 5, EMITTED, max_bounces).trace(0..EMITTED)
}

#[test]
fn the_documentation_has_the_table() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/misreadings.md");
    let kept = std::fs::read_to_string(path).expect("docs/misreadings.md is there");
    assert!(kept == table(), "run the example 'misreadings' of this package and write it there");
}

#[test]
fn every_way_has_a_key_of_its_own() {
    let mut keys = HashSet::new();
    for hypothesis in [misreadings(), pairs()].concat() {
        assert!(keys.insert(hypothesis.key()), "{}", hypothesis.title);
    }
}

#[test]
fn every_misreading_stores_something_else_than_the_reference() {
    for hypothesis in misreadings() {
        let max_bounces = if hypothesis.id == BOUNCE_OFF_BY_ONE { 3 } else { 1000 };
        let positions = |variation| -> HashSet<[u32; 3]> {
            let records = stored(variation, max_bounces).into_iter();
            records.map(|record| record.position.to_array().map(f32::to_bits)).collect()
        };
        let others = positions(hypothesis.variation);
        let reference = positions(Variation::default());
        assert_ne!(others, reference, "{}", hypothesis.title);
        assert!(others.len() > 5, "{}", hypothesis.title);
    }
}

#[test]
fn the_plain_variation_is_the_reference_on_the_slow_path_too() {
    let traced = |seed: u64| {
        let simulation = Simulation::new(Variation::default(), seed, EMITTED, 1000);
        simulation
            .trace_one_by_one(0..2000, |photon| photon_mapping::random::photon_random(seed, photon))
    };
    let fast = Simulation::new(Variation::default(), 3, EMITTED, 1000).trace(0..2000);
    assert_eq!(traced(3), fast);
}

#[test]
fn one_photon_tells_misreadings_of_its_direction() {
    let numbers = Numbers { roulette: 0.4, u1: 0.3, u2: 0.85 };
    let right = sample_hemisphere(numbers.u1, numbers.u2);
    for normal in [Vec3::NEG_X, Vec3::new(0.28, -0.96, 0.0).normalize()] {
        let frame = Reading::REFERENCE.tangent_frame(normal);
        let expected = (frame * right).normalize();
        let told = directions(frame, numbers);
        for misreading in misreadings() {
            let Variation { hemisphere, frame: transformation, reading, .. } = misreading.variation;
            let is_literal = reading.tangent_basis == TangentBasis::LetterOfTheHandout;
            let is_sampled = hemisphere != Hemisphere::Cosine && hemisphere.uses_frame();
            let is_turned = transformation != Transformation::AsRead
                || reading.tangent_basis == TangentBasis::Transposed
                || misreading.variation.flipped_normal;
            if is_literal || !(is_sampled || is_turned) {
                continue;
            }
            let mut of_it = told.iter().filter(|(_, title, _)| *title == misreading.title);
            let (section, _, direction) = of_it.next().expect("every misreading is told");
            assert_eq!(Some(*section), misreading.misreading.map(|it| it.section));
            // On the wall, t and b as they are written have length 1, and the matrix is symmetric.
            let is_same = is_turned && normal.x == -1.0;
            let apart = direction.normalize().distance(expected);
            assert!(is_same || apart > 1e-2, "{normal}: {}", misreading.title);
        }
        let mut along = told.iter().filter(|(_, _, direction)| direction.distance(normal) < 1e-6);
        let title = along.next().map(|(_, title, _)| title.as_str());
        let of_wall = title.is_some_and(|title| title.contains("leave the right wall along"));
        assert_eq!(of_wall, normal.x == -1.0);
    }
}
