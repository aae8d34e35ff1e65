//! What is hard to see is found nearly as often as can be, and few photons get no wrong name.

#[path = "../../examples/common/limit.rs"]
mod limit;

use glam::Vec3;
use limit::best_test;
use photon_list::reader::PhotonList;
use photon_list::record::{ABSENT, Columns};
use photon_mapping::assignment8::create_scene;
use photon_mapping::photon_list::PhotonRecord;
use rayon::prelude::*;
use variants::variation::{Simulation, Variation};

use super::EXPECTATIONS;
use crate::judge_list::{Expectations, Judgment, judge};
use crate::observation::observe;
use crate::signature::{Known, Signature};

/// Far from the seeds of the signatures.
const FIRST_SEED: u64 = 9_000_000;

fn ways(id: &str) -> Vec<&'static Known<Signature>> {
    let all = EXPECTATIONS.signatures.misreadings.iter();
    all.filter(|known| known.hypothesis.id == id).collect()
}

/// What is said of photons under `variation`, by positions and their number, or by the columns too.
fn judged(variation: Variation, seed: u64, emitted: u64, has_columns: bool) -> Judgment {
    let mut records = Simulation::new(variation, seed, emitted, 1000).trace(0..emitted);
    for record in &mut records {
        *record = match has_columns {
            true => PhotonRecord { intensity: Vec3::splat(1.0 / emitted as f32), ..*record },
            false => PhotonRecord { position: record.position, ..ABSENT },
        };
    }
    let [intensity, to_light, bounce] = [has_columns; 3];
    let columns = Columns { intensity, to_light, bounce, ..Columns::default() };
    let light = create_scene().lights()[0].position.as_dvec3();
    let observation = observe(&PhotonList { columns, records }, &EXPECTATIONS.places, light);
    let by_user = (!has_columns).then_some(emitted as f64);
    let emitted = by_user.or(observation.emitted_by_intensity);
    judge(&observation, emitted, by_user.is_some(), &EXPECTATIONS)
}

#[test]
fn what_hardly_shows_is_found_nearly_as_often_as_by_the_best_test() {
    const LISTS: u64 = 24;
    const EMITTED: u64 = 100_000;
    let ways = ways("numbers-again");
    let Expectations { places, signatures, .. } = &*EXPECTATIONS;
    let none = vec![0.0; places.cells];
    let found_by_best = |way: &&Known<Signature>| {
        let counts: Vec<f64> =
            way.signature.cells.iter().map(|mean| mean * EMITTED as f64).collect();
        best_test(&counts, Some(EMITTED as f64), signatures.fair.iter(), |fair, size| {
            fair.signature.of_cells(&signatures.correlation, &none, size)
        })
    };
    let best = ways.iter().map(found_by_best).sum::<f64>() / ways.len() as f64;
    assert!((0.2..0.95).contains(&best), "{best}: it is neither hidden nor plain");
    let is_found = |seed: &u64| {
        let way = ways[*seed as usize % ways.len()];
        let judgment = judged(way.hypothesis.variation, FIRST_SEED + seed, EMITTED, false);
        judgment.findings.iter().any(|finding| finding.is_fault())
    };
    let found = (0..LISTS).into_par_iter().filter(is_found).count() as f64;
    let expected = 0.95 * best * LISTS as f64;
    // Of so many lists, chance takes as many as this.
    let by_chance = (expected * (1.0 - best)).sqrt();
    assert!(found >= expected - by_chance, "{found} of {expected}");
}

#[test]
fn a_number_made_to_fit_gives_few_photons_no_wrong_name() {
    let way = ways("octant-directions")[0];
    for seed in 0..8 {
        let judgment = judged(way.hypothesis.variation, FIRST_SEED + seed, 10_000, true);
        let name = judgment.explanation.map(|explanation| explanation.hypothesis.id);
        assert!([None, Some("octant-directions")].contains(&name), "{seed}: {name:?}");
    }
}

#[test]
fn of_two_hypotheses_that_are_close_none_is_known_better() {
    // Whose signature has less noise is likelier by this alone: too much for a name, if the two
    // hardly differ. By marks, "nan-frame" is told from all.
    const EMITTED: f64 = 1e6;
    let Expectations { places, signatures, .. } = &*EXPECTATIONS;
    let none = vec![0.0; places.cells];
    let noise = |known: &Known<Signature>| EMITTED / known.signature.emitted;
    let all = || signatures.misreadings.iter().chain(&signatures.unnamed);
    for named in signatures.misreadings.iter().filter(|it| it.hypothesis.id != "nan-frame") {
        let expected = named.signature.of_cells(&signatures.correlation, &none, EMITTED);
        let law = expected.law(true);
        let others = all().filter(|other| {
            let id = other.hypothesis.id;
            ![named.hypothesis.id, "nan-frame"].contains(&id) && noise(other) > noise(named)
        });
        let total: f64 = expected.mean.iter().sum();
        for other in others {
            let cells = &other.signature.cells;
            let scale = total / cells.iter().sum::<f64>();
            let counts: Vec<f64> = cells.iter().map(|mean| scale * mean).collect();
            let apart: f64 =
                law.towards(&counts, [counts.clone()].into_iter()).map(|(_, apart)| apart).sum();
            let by_noise = cells.len() as f64 * (noise(named) + noise(other));
            let unlikelier = 0.5 * (apart.powi(2) - by_noise) / (1.0 + noise(other));
            let better = ((1.0 + noise(other)) / (1.0 + noise(named))).ln();
            let advantage = 0.5 * cells.len() as f64 * better;
            let [named, other] = [named, other].map(|it| &it.hypothesis.title);
            assert!(unlikelier > advantage, "{named}; {other}: {unlikelier} {advantage}");
        }
    }
}
