//! Planted faults that are not in the table of misreadings: they are seen where they show, and get
//! no name.

use glam::Vec3;
use photon_list::reader::PhotonList;
use photon_list::record::{ABSENT, Columns};
use photon_mapping::assignment8::create_scene;
use photon_mapping::photon_list::PhotonRecord;
use photon_mapping::random::photon_random;
use rayon::prelude::*;
use variants::variation::{
    Emission, Hemisphere, Roulette, Simulation, Start, Storage, Transformation, Variation,
};

use super::{EMITTED, EXPECTATIONS, name};
use crate::judge_list::{Judgment, judge};
use crate::observation::observe;
use crate::recognized::RECOGNIZED;

/// What a program makes of its numbers.
type Warp = fn(&mut dyn FnMut() -> f32) -> f32;
/// What it makes of its photons.
type Change = fn(Vec<PhotonRecord>) -> Vec<PhotonRecord>;

/// A fault that no entry of the table describes.
enum Plant {
    /// In the tracer.
    Step(Variation),
    /// In the random numbers of a whole program.
    Numbers(Warp),
    /// In what is done with the photons.
    Records(Change),
}

/// How two or more faults come together.
fn steps() -> Vec<(&'static str, Variation)> {
    let plain = Variation::default();
    let roulette = |roulette| Variation { roulette, ..plain };
    vec![
        ("P_r + 0.2", roulette(Roulette::Shifted(0.2))),
        ("P_r - 0.25", roulette(Roulette::Shifted(-0.25))),
        ("P_r = 0.6 and 0.45, by material", roulette(Roulette::ByMaterial([0.6, 0.45]))),
        ("P_r = r + g + b", roulette(Roulette::Weighted([1.0, 1.0, 1.0]))),
        ("P_r = g / 2", roulette(Roulette::Weighted([0.0, 0.5, 0.0]))),
        ("P_r = r + b", roulette(Roulette::Weighted([1.0, 0.0, 1.0]))),
        ("mean of d, first hit sure", Variation { sure_hits: 1, ..roulette(Roulette::Mean) }),
        (
            "half of paths, three hits sure",
            Variation { sure_hits: 3, ..roulette(Roulette::Constant(0.5)) },
        ),
        (
            "always, 3 bounces, upward",
            Variation {
                most_bounces: Some(3),
                emission: Emission::Up,
                ..roulette(Roulette::Constant(1.0))
            },
        ),
        (
            "octant and even hemisphere",
            Variation { emission: Emission::Octant, hemisphere: Hemisphere::Uniform, ..plain },
        ),
        (
            "downward, stored from the third hit",
            Variation { emission: Emission::Down, storage: Storage::FromThird, ..plain },
        ),
        (
            "inverted, stored if scattered",
            Variation { storage: Storage::Scattered, ..roulette(Roulette::Inverted) },
        ),
        (
            "along the normal, direct stored",
            Variation { hemisphere: Hemisphere::AlongNormal, storage: Storage::All, ..plain },
        ),
        (
            "half round, not transformed",
            Variation {
                hemisphere: Hemisphere::HalfAzimuth,
                frame: Transformation::Forgotten,
                ..plain
            },
        ),
        (
            "from the light, even hemisphere",
            Variation { start: Start::Light, hemisphere: Hemisphere::Uniform, ..plain },
        ),
        (
            "half round, even polar angle of the light",
            Variation {
                hemisphere: Hemisphere::HalfAzimuth,
                emission: Emission::PolarAboutZ,
                ..plain
            },
        ),
        (
            "first bounce only, with the square of P_r",
            Variation { storage: Storage::FirstBounce, ..roulette(Roulette::Squared) },
        ),
    ]
}

fn numbers() -> Vec<(&'static str, Warp)> {
    vec![
        ("numbers squared", |rand| {
            let number = rand();
            number * number
        }),
        ("roots of numbers", |rand| rand().sqrt()),
        ("numbers below 0.9", |rand| 0.9 * rand()),
        ("numbers above 0.1", |rand| 0.1 + 0.9 * rand().min(0.999_99)),
        ("the mean of two numbers", |rand| 0.5 * (rand() + rand())),
        ("the larger of two numbers", |rand| rand().max(rand())),
        ("16 different numbers", |rand| (16.0 * rand()).floor() / 16.0),
        ("4 different numbers", |rand| (4.0 * rand() + 0.5).floor().min(3.0) / 4.0),
    ]
}

fn records() -> Vec<(&'static str, Change)> {
    vec![
        ("a third lost", |records| {
            records.into_iter().enumerate().filter(|it| it.0 % 3 > 0).map(|it| it.1).collect()
        }),
        ("none on the short box", |records| {
            records.into_iter().filter(|it| !(3..8).contains(&it.surface)).collect()
        }),
        ("half of the wall", |records| {
            records.into_iter().filter(|it| it.position.x < 0.99 || it.position.z < 0.9).collect()
        }),
        ("left and right turned", |mut records| {
            records.iter_mut().for_each(|it| it.position.y = -it.position.y);
            records
        }),
        ("the second bounce alone", |records| {
            records.into_iter().filter(|it| it.bounce == 2).collect()
        }),
        ("all but the second bounce", |records| {
            records.into_iter().filter(|it| it.bounce != 2).collect()
        }),
        ("only those that come from above", |records| {
            records.into_iter().filter(|it| it.to_light.dot(Vec3::Z) > 0.0).collect()
        }),
    ]
}

fn plants() -> Vec<(&'static str, Plant)> {
    let steps = steps().into_iter().map(|(what, it)| (what, Plant::Step(it)));
    let numbers = numbers().into_iter().map(|(what, it)| (what, Plant::Numbers(it)));
    let records = records().into_iter().map(|(what, it)| (what, Plant::Records(it)));
    steps.chain(numbers).chain(records).collect()
}

fn trace(plant: &Plant, seed: u64) -> Vec<PhotonRecord> {
    let simulation = |variation| Simulation::new(variation, seed, EMITTED, 1000);
    match plant {
        Plant::Step(variation) => simulation(*variation).trace(0..EMITTED),
        Plant::Numbers(warp) => {
            let mut rand = photon_random(seed, 0);
            let numbers = std::iter::from_fn(move || Some(warp(&mut rand)));
            simulation(Variation::default()).trace_with(0..EMITTED, numbers)
        }
        Plant::Records(change) => change(simulation(Variation::default()).trace(0..EMITTED)),
    }
}

/// What is said of `records`, with more and more of it known.
fn judged(records: &[PhotonRecord]) -> [Judgment; 3] {
    let bare = |record: &PhotonRecord| PhotonRecord { position: record.position, ..ABSENT };
    let bare: Vec<_> = records.iter().map(bare).collect();
    let all =
        Columns { intensity: true, to_light: true, photon: false, bounce: true, surface: false };
    let light = create_scene().lights()[0].position.as_dvec3();
    let judged = |records, columns, emitted: Option<f64>| {
        let observation = observe(&PhotonList { columns, records }, &EXPECTATIONS.places, light);
        let known = emitted.or(observation.emitted_by_intensity);
        judge(&observation, known, emitted.is_some(), &EXPECTATIONS)
    };
    [
        judged(bare.clone(), Columns::default(), None),
        judged(bare, Columns::default(), Some(EMITTED as f64)),
        judged(records.to_vec(), all, Some(EMITTED as f64)),
    ]
}

fn is_incorrect(judgment: &Judgment) -> bool {
    judgment.findings.iter().any(|finding| finding.is_fault())
}

/// Those of which the name of one is no false one, since it was made: by positions alone, the other
/// does not show.
const OF_TWO: [(&str, &str); 4] = [
    ("always, 3 bounces, upward", "half-directions"),
    ("mean of d, first hit sure", "late-roulette"),
    ("half of paths, three hits sure", "no-roulette"),
    ("downward, stored from the third hit", "third-hit-on"),
];

#[test]
fn faults_that_are_not_in_the_table_get_no_name() {
    let told: Vec<_> = plants()
        .into_par_iter()
        .enumerate()
        .map(|(seed, (what, plant))| (what, judged(&trace(&plant, 40 + seed as u64))))
        .collect();
    for (what, judgments) in &told {
        for judgment in judgments {
            let name = name(judgment);
            let is_right = |name| OF_TWO.contains(&(what, name));
            assert!(name.is_none_or(is_right), "{what}: {name:?}");
            let is_made_up = judgment.findings.iter().any(|it| it.check == RECOGNIZED);
            assert!(!is_made_up, "{what} is taken for made up");
        }
        let [alone, with_number, with_all] = judgments.each_ref().map(is_incorrect);
        assert!(with_all, "{what} is not seen");
        assert!(with_number || !alone, "{what} is lost with the number");
    }
    assert!(told.len() >= 30);
}
