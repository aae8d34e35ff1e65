//! How good the grader is with lists: how often it calls correct ones incorrect, and which
//! misreadings it finds and names. Prints the tables of `golden/grading.md`.
//!
//! `cargo run --release -p photon-mapping-grading --example grading_table -- [--false-alarms N]
//! [--seeds N] [--only MISREADING]`

#[path = "common/limit.rs"]
mod limit;
#[path = "common/numbers.rs"]
mod numbers;

use fast::lanes::offset::Offset;
use glam::{DVec3, Vec3};
use grading::expected::Expected;
use grading::judge_list::{
    Expectations, Judgment, RATE_OF_WAYS, SIGNIFICANCE, judge, rate_to_find,
};
use grading::observation::observe;
use grading::places::{Place, Places};
use grading::signature::{Signature, Signatures};
use limit::best_test;
use numbers::{Drand48, FifteenBits, Settings, halton, strata, stratified};
use photon_list::reader::PhotonList;
use photon_list::record::Columns;
use photon_mapping::assignment8::create_scene;
use photon_mapping::photon_list::PhotonRecord;
use photon_mapping::random::photon_random;
use rayon::prelude::*;
use variants::hypotheses::{Hypothesis, fair_readings, misreadings, no_offset};
use variants::pairs::pairs;
use variants::reading::{Reading, TangentBasis};
use variants::variation::{FACETS, Simulation, Transformation, Variation};

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

fn false_alarms(count: u64, expectations: &Expectations, with_small_limit: &Expectations) {
    // Most of the time goes to the largest lists, so they are fewer.
    let decades = [
        (1e4, 1e5, count / 2, expectations),
        (1e5, 1e6, 7 * count / 20, expectations),
        (1e6, 1e7, 3 * count / 20, expectations),
        (1e4, 1e6, count / 4, with_small_limit),
    ];
    println!("## Correct submissions called incorrect\n");
    println!(
        "All kinds of fair readings: offsets from 5e-7 to 1e-3 along the normal and from 1e-5 to \
         1e-3 along the new direction, left-handed frames, and positions up to 0.007 off their \
         surface. Three generators (one of 15 bits), Halton's and stratified numbers. With and \
         without the number of photons. One row has at most {SMALL_LIMIT} bounces. p is the \
         smallest of a list, corrected for the number of tests. Below {SIGNIFICANCE:.0e} a list is \
         called incorrect.\n"
    );
    println!("| emitted | submissions | p < 0.01 | p < 0.001 | p < 0.0001 | called incorrect |");
    println!("|---|---|---|---|---|---|");
    let mut all = [0; 5];
    for (decade, (low, high, count, expectations)) in decades.into_iter().enumerate() {
        let p_values: Vec<(f64, bool)> = (0..count)
            .into_par_iter()
            .map(|index| {
                correct_submission(decade as u64 * 1_000_000 + index, low, high, expectations)
            })
            .collect();
        let below = |limit: f64| p_values.iter().filter(|(p, _)| *p < limit).count();
        let row = [
            p_values.len(),
            below(1e-2),
            below(1e-3),
            below(1e-4),
            p_values.iter().filter(|(_, is_alarm)| *is_alarm).count(),
        ];
        let max_bounces = expectations.signatures.max_bounces;
        let bounces = match max_bounces {
            SMALL_LIMIT => format!(", at most {max_bounces} bounces"),
            _ => String::new(),
        };
        let row_of_text = row.map(|n| n.to_string()).join(" | ");
        println!("| {low:.0e} to {high:.0e}{bounces} | {row_of_text} |");
        all.iter_mut().zip(row).for_each(|(sum, n)| *sum += n);
    }
    println!("| all | {} |\n", all.map(|n| n.to_string()).join(" | "));
}

/// The p-value of a correct submission, and whether it is called incorrect.
fn correct_submission(index: u64, low: f64, high: f64, expectations: &Expectations) -> (f64, bool) {
    let mut settings = Settings(Box::new(photon_random(148_000, index)));
    let emitted = settings.between(low, high) as u64;
    let reading = Reading {
        tangent_basis: settings
            .one_of(&[TangentBasis::Normalized, TangentBasis::LetterOfTheHandout]),
        fallback_threshold: settings
            .one_of(&[0.99, 0.999, 0.95, 0.9, 0.8, 0.957, 0.9545, 0.5, 0.2]),
        fallback_axis: settings.one_of(&[Vec3::Y, Vec3::Z]),
        offset: match settings.one_of(&[0, 1, 2]) {
            0 => Reading::REFERENCE.offset,
            1 => Offset::AlongNormal(settings.between(5e-7, 1e-3) as f32),
            _ => Offset::AlongDirection(settings.between(1e-5, 1e-3) as f32),
        },
    };
    // A left-handed frame is as good.
    let frame = settings.one_of(&[
        Transformation::AsRead,
        Transformation::AsRead,
        Transformation::Columns([1, 0, 2]),
    ]);
    let variation = Variation { reading, frame, ..Variation::default() };
    let max_bounces = expectations.signatures.max_bounces;
    let simulation = Simulation::new(variation, 7_000_000 + index, emitted, max_bounces);
    let other_generator = emitted <= 200_000 && settings.one_of(&[true, false]);
    let mut records = match settings.one_of(&[0, 1, 2, 3]) {
        _ if !other_generator => simulation.trace(0..emitted),
        0 => simulation.trace_with(0..emitted, Drand48::new(index)),
        1 => simulation.trace_with(0..emitted, FifteenBits(index as u32)),
        2 => simulation.trace_one_by_one(0..emitted, |photon| halton(photon, index)),
        _ => {
            let strata = strata(emitted, index);
            simulation.trace_one_by_one(0..emitted, |photon| stratified(photon, &strata, index))
        }
    };
    let off = settings.one_of(&[0.0, 0.0, 1e-4, 7e-3]);
    shift(&mut records, off, settings.one_of(&[true, false]), &expectations.places);
    let content = settings.one_of(&CONTENTS);
    let judgment = judged(records, emitted, content, expectations);
    let p_values = judgment.findings.iter().filter(|finding| finding.check != "bounces");
    let smallest = p_values.filter_map(|finding| finding.p_value).fold(1.0, f64::min);
    let alarm = judgment.findings.iter().find(|finding| finding.is_fault());
    if let Some(alarm) = alarm {
        eprintln!("false alarm {index}: {emitted} {content:?} {off} {reading:?}: {alarm:?}");
    }
    (smallest, alarm.is_some())
}

/// Moves positions off their surface by `off`: along the normal, or back to where they came from.
fn shift(records: &mut [PhotonRecord], off: f32, along_normal: bool, places: &Places) {
    if off == 0.0 {
        return;
    }
    for record in records {
        let position = record.position.as_dvec3();
        let way = match places.place(position) {
            Place::Cell { facet, .. } | Place::Corner { facet } if along_normal => {
                places.facets[facet].normal.as_vec3()
            }
            _ => record.to_light,
        };
        record.position += off * way;
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

/// The numbers of photons emitted of which the power is told.
const SIZES: [u64; 4] = [10_000, 100_000, 200_000, 1_000_000];

fn detection(seeds: u64, only: &str, expectations: &Expectations, with_small_limit: &Expectations) {
    // As the framework's rounding has it: less where a plane lies along the axes. And as others'.
    let sides = [0.2, 0.6, 0.6, 0.6, 0.6, 0.3, 0.2, 0.6, 0.6, 0.6, 0.6, 0.15];
    let mut hypotheses = fair_readings();
    hypotheses.extend([sides, [0.1; FACETS], [0.45; FACETS]].map(no_offset));
    hypotheses.extend(misreadings());
    let mut ids: Vec<&'static str> = hypotheses.iter().map(|hypothesis| hypothesis.id).collect();
    ids.sort_unstable();
    ids.dedup();
    ids.retain(|id| *id != "fair");
    println!("## Found and named\n");
    println!(
        "Each row has {seeds} lists, made in all ways of the misreading in turn. The three numbers \
         of a cell are: how many lists the best possible test would find / how many are called \
         incorrect / how many are named rightly. The best test knows the counts that this \
         misreading and the closest fair reading give in the cells. \"All columns\" leaves out \
         `photon`; the best test with columns is not known.\n"
    );
    println!(
        "| what was done | emitted | positions alone | and the number emitted | all columns \
         | named wrongly |"
    );
    println!("|---|---|---|---|---|---|");
    let rows = std::iter::once(&"fair").chain(&ids);
    for id in rows.filter(|id| only.is_empty() || **id == only) {
        let ways: Vec<&Hypothesis> =
            hypotheses.iter().filter(|hypothesis| hypothesis.id == *id).collect();
        let is_of_limit = *id == "bounce-off-by-one";
        let expectations = if is_of_limit { with_small_limit } else { expectations };
        let outcomes: Vec<_> = (0..seeds)
            .into_par_iter()
            .map(|seed| outcomes(ways[seed as usize % ways.len()], 9_000_000 + seed, expectations))
            .collect();
        for (size, emitted) in SIZES.into_iter().enumerate() {
            let mut wrong = Vec::new();
            let columns = CONTENTS.into_iter().enumerate().map(|(at, content)| {
                let outcomes = || outcomes.iter().map(|of_seed| of_seed[size][at]);
                let incorrect = outcomes().filter(|it| *it != Outcome::Correct).count();
                let right = outcomes().filter(|it| *it == Outcome::Named(id)).count();
                wrong.extend(outcomes().filter_map(|outcome| match outcome {
                    Outcome::Named(name) if name != *id => Some(name),
                    _ => None,
                }));
                let limit = limit(id, emitted, content, expectations)
                    .map_or("-".to_owned(), |limit| format!("{:.1}", limit * seeds as f64));
                format!("{limit} / {incorrect} / {right}")
            });
            let columns: Vec<String> = columns.collect();
            wrong.sort_unstable();
            println!("| `{id}` | {emitted} | {} | {} |", columns.join(" | "), wrong.join(", "));
        }
    }
    println!("\n`bounce-off-by-one` is judged with `--max-bounces {SMALL_LIMIT}`.\n");
}

/// What becomes of lists of each size with each content, all of one run.
fn outcomes(way: &Hypothesis, seed: u64, expectations: &Expectations) -> Vec<Vec<Outcome>> {
    let max_bounces = expectations.signatures.max_bounces;
    let most = SIZES[SIZES.len() - 1];
    let all = Simulation::new(way.variation, seed, most, max_bounces).trace(0..most);
    let of_size = |emitted: u64| {
        let first = all.iter().filter(|record| u64::from(record.photon) < emitted);
        let intensity = Vec3::splat(1.0 / emitted as f32);
        let records: Vec<_> = first.map(|record| PhotonRecord { intensity, ..*record }).collect();
        let of_content =
            |content| outcome(&judged(records.clone(), emitted, content, expectations));
        CONTENTS.into_iter().map(of_content).collect()
    };
    SIZES.into_iter().map(of_size).collect()
}

/// How often, over the ways to `id`, the best test would find it that knows two laws: this one, and
/// that of the closest fair reading.
fn limit(id: &str, size: u64, content: Content, expectations: &Expectations) -> Option<f64> {
    let emitted = match content {
        Content::PositionsAlone => None,
        Content::PositionsAndNumber => Some(size as f64),
        Content::Everything => return None,
    };
    let signatures = &expectations.signatures;
    let of_id: Vec<_> =
        signatures.misreadings.iter().filter(|known| known.hypothesis.id == id).collect();
    let none = vec![0.0; expectations.places.cells];
    let powers: Vec<f64> = of_id
        .iter()
        .map(|known| {
            let counts: Vec<f64> =
                known.signature.cells.iter().map(|mean| mean * size as f64).collect();
            best_test(&counts, emitted, signatures.fair.iter(), |fair, size| {
                fair.signature.of_cells(&signatures.correlation, &none, size)
            })
        })
        .collect();
    (!powers.is_empty()).then(|| powers.iter().sum::<f64>() / powers.len() as f64)
}

/// What it would cost to find nearly as many lists as the best tests, each of which looks for one
/// misreading.
fn cost_of_power(expectations: &Expectations) {
    let signatures = &expectations.signatures;
    let shows = |id: &str| id != "bounce-off-by-one";
    let known: Vec<_> =
        signatures.misreadings.iter().filter(|known| shows(known.hypothesis.id)).collect();
    println!("## What more would cost\n");
    println!(
        "The best test looks for one misreading. The judge looks for {} ways to make one. To find \
         nearly as many as the best tests, it would call so many of 100,000 correct lists \
         incorrect. Allowed are {:.0}.\n",
        known.len(),
        RATE_OF_WAYS * 1e5
    );
    println!("| emitted | positions alone | and the number emitted |");
    println!("|---|---|---|");
    let none = vec![0.0; expectations.places.cells];
    for size in SIZES.map(|size| size as f64) {
        let fair = signatures.fair[0].signature.of_cells(&signatures.correlation, &none, size);
        let rates = [true, false].map(|is_free| {
            let means = |it: &Signature| it.cells.iter().map(|mean| mean * size).collect();
            let means = known.iter().map(|known| means(&known.signature)).collect();
            1e5 * rate_to_find_all(&fair, means, is_free)
        });
        println!("| {size} | {:.1} | {:.1} |", rates[0], rates[1]);
    }
    println!();
}

/// How often correct submissions would be called incorrect if the test of each misreading, of which
/// `means` has the counts, found nearly as many as the best one. They are held against `fair`,
/// what a fair reading leaves.
fn rate_to_find_all(fair: &Expected, means: Vec<Vec<f64>>, is_free: bool) -> f64 {
    let law = fair.law(is_free);
    let all = |counts: &[f64]| counts.iter().sum::<f64>();
    let scaled = means.into_iter().map(|mut means| {
        let factor = if is_free { all(&fair.mean) / all(&means).max(1.0) } else { 1.0 };
        means.iter_mut().for_each(|mean| *mean *= factor);
        means
    });
    law.towards(&fair.mean, scaled).map(|(_, length)| rate_to_find(length)).sum()
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

const EMITTED: u64 = 200_000;
/// With so few bounces allowed, one fewer shows.
const SMALL_LIMIT: i32 = 3;

fn outcome(judgment: &Judgment) -> Outcome {
    if !judgment.findings.iter().any(|finding| finding.is_fault()) {
        return Outcome::Correct;
    }
    match &judgment.explanation {
        Some(explanation) => Outcome::Named(explanation.hypothesis.id),
        None => Outcome::Unnamed,
    }
}
