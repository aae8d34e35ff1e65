//! How good the grader is with lists: how often it calls correct ones incorrect, and which
//! misreadings it finds and names. Prints the tables of `golden/grading.md`.
//!
//! `cargo run --release -p photon-mapping-grading --example grading_table -- [--false-alarms N]
//! [--seeds N] [--only MISREADING]`

#[path = "../common/limit.rs"]
mod limit;
#[path = "../common/numbers.rs"]
mod numbers;

mod alarms;
mod power;

use glam::DVec3;
use grading::judge_list::{Expectations, Judgment, judge};
use grading::observation::observe;
use grading::places::Places;
use grading::signature::Signatures;
use photon_list::reader::PhotonList;
use photon_list::record::Columns;
use photon_mapping::assignment8::create_scene;
use photon_mapping::photon_list::PhotonRecord;
use rayon::prelude::*;
use variants::hypotheses::misreadings;
use variants::pairs::pairs;
use variants::variation::Simulation;

use alarms::false_alarms;
use power::{cost_of_power, detection};

const EMITTED: u64 = 200_000;
/// With so few bounces allowed, one fewer shows.
const SMALL_LIMIT: i32 = 3;

/// What a list tells besides positions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Content {
    /// Nothing, and the number of photons emitted is not known.
    PositionsAlone,
    /// Nothing, but the course knows the number.
    PositionsAndNumber,
    /// All columns.
    Everything,
}

const CONTENTS: [Content; 3] =
    [Content::PositionsAlone, Content::PositionsAndNumber, Content::Everything];

fn main() {
    let mut arguments = std::env::args().skip(1);
    let (mut alarms, mut seeds, mut only) = (20_000, 100, String::new());
    while let (Some(option), Some(value)) = (arguments.next(), arguments.next()) {
        let number = || value.parse().expect("a whole number");
        match option.as_str() {
            "--false-alarms" => alarms = number(),
            "--seeds" => seeds = number(),
            "--only" => only = value,
            _ => panic!("expected --false-alarms N, --seeds N or --only ID, found {option}"),
        }
    }
    let places = Places::new(&create_scene());
    let expectations = Expectations::new(places.clone(), Signatures::of_assignment8());
    println!("# How good the grader is with lists\n");
    let small_limit = Signatures::of_limit(&places, SMALL_LIMIT);
    let with_small_limit = Expectations::new(places, small_limit);
    false_alarms(alarms, &expectations, &with_small_limit);
    if seeds == 0 {
        return;
    }
    detection(seeds, &only, &expectations, &with_small_limit);
    cost_of_power(&expectations);
    if only.is_empty() && seeds > 0 {
        two_at_once(seeds, &expectations);
    }
}

fn judged(
    mut records: Vec<PhotonRecord>,
    emitted: u64,
    content: Content,
    expectations: &Expectations,
) -> Judgment {
    let has_all = content == Content::Everything;
    let columns = Columns {
        intensity: has_all,
        to_light: has_all,
        photon: false,
        bounce: has_all,
        surface: false,
    };
    if !has_all {
        records.iter_mut().for_each(|record| {
            *record = PhotonRecord { position: record.position, ..photon_list::record::ABSENT };
        });
    }
    let list = PhotonList { columns, records };
    let light: DVec3 = create_scene().lights()[0].position.as_dvec3();
    let observation = observe(&list, &expectations.places, light);
    let by_user = (content == Content::PositionsAndNumber).then_some(emitted as f64);
    let emitted = by_user.or(observation.emitted_by_intensity);
    judge(&observation, emitted, by_user.is_some(), expectations)
}

/// What became of a list: called correct, incorrect without a name, or named.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Outcome {
    Correct,
    Unnamed,
    Named(&'static str),
}

fn outcome(judgment: &Judgment) -> Outcome {
    if !judgment.findings.iter().any(|finding| finding.is_fault()) {
        return Outcome::Correct;
    }
    match &judgment.explanation {
        Some(explanation) => Outcome::Named(explanation.hypothesis.id),
        None => Outcome::Unnamed,
    }
}

/// Lists in which two misreadings were made, which no single name tells.
fn two_at_once(seeds: u64, expectations: &Expectations) {
    let (pairs, singles) = (pairs(), misreadings());
    println!("## Two misreadings at once\n");
    println!(
        "Lists of {EMITTED} photons emitted, of {} pairs of misreadings in turn, which have no \
         name: what was \
         told of them.\n",
        pairs.len()
    );
    println!(
        "| what is known | correct | no name | these two | two others | one of both | a third |"
    );
    println!("|---|---|---|---|---|---|---|");
    for (content, what) in CONTENTS.into_iter().zip(["positions alone", "and the number", "all"]) {
        let tell = |seed: u64| {
            let pair = &pairs[seed as usize % pairs.len()];
            let simulation = Simulation::new(pair.variation, 11_000_000 + seed, EMITTED, 1000);
            let judgment = judged(simulation.trace(0..EMITTED), EMITTED, content, expectations);
            let is_correct = !judgment.findings.iter().any(|finding| finding.is_fault());
            let is_of = |id: &str| {
                let ways = singles.iter().filter(|single| single.id == id);
                ways.map(|way| &way.title).any(|title| pair.title.contains(title))
            };
            match (judgment.explanation, judgment.pair) {
                _ if is_correct => 0,
                (None, None) => 1,
                (None, Some(told)) if pair.title.contains(&told.hypothesis.title) => 2,
                (None, Some(told)) if told.hypothesis.title.contains(&pair.title) => 2,
                (None, Some(_)) => 3,
                (Some(named), _) if is_of(named.hypothesis.id) => 4,
                (Some(named), _) => {
                    eprintln!("{what}: {} was named {}", pair.title, named.hypothesis.id);
                    5
                }
            }
        };
        let mut row = [0; 6];
        let told: Vec<usize> = (0..seeds * 3).into_par_iter().map(tell).collect();
        told.into_iter().for_each(|column| row[column] += 1);
        println!("| {what} | {} |", row.map(|n| n.to_string()).join(" | "));
    }
}
