//! How good the grader is at pictures: simulates them, judges them, and prints a table.
//!
//! `grading_table_pictures [SEEDS] [CORRECT] [EMITTED]`: the pictures of every misreading, of the
//! numbers of photons that programs emit or of one, and those of every number that are correct.

#[path = "common/limit.rs"]
mod limit;
#[path = "common/simulated_pictures.rs"]
mod simulated_pictures;

use std::collections::BTreeMap;
use std::ops::Range;

use grading::picture::expectations::PictureExpectations;
use grading::picture::expected::expect;
use grading::picture::judge::judge_dots;
use grading::places::Places;
use grading::verdict::Verdict;
use limit::best_test;
use photon_mapping::assignment8::{MAX_PHOTON_BOUNCES, create_scene};
use photon_mapping::random::photon_random;
use rayon::prelude::*;
use simulated_pictures::{misread, simulate_dots};
use variants::hypotheses::{fair_readings, misreadings};

/// As many photons as the framework emits, and as a public copy of it does.
const EMITTED: [u64; 2] = [1_000_000, 200_000];
/// Far from all seeds with which signatures were measured.
const FIRST_SEED: u64 = 70_000;
/// The numbers of photons of correct pictures, and by how much fewer there are of these than of the
/// first.
const SIZES: [(u64, u64); 6] =
    [(10_000, 1), (30_000, 2), (100_000, 4), (1_000_000, 20), (3_000_000, 60), (10_000_000, 200)];

fn main() {
    let arguments: Vec<u64> =
        std::env::args().skip(1).map(|text| text.parse().expect("expected a number")).collect();
    let seeds = arguments.first().copied().unwrap_or(100);
    let correct = arguments.get(1).copied().unwrap_or(20_000);
    let only = arguments.get(2).copied();
    let places = Places::new(&create_scene());
    let expectations = PictureExpectations::new(&places, MAX_PHOTON_BOUNCES);

    if correct > 0 {
        println!(
            "| correct, emitted | positions | pictures | called incorrect | undecided | no dots \
             | smallest p | of all p | p < 0.1 | p < 0.01 | p < 0.001 |"
        );
        println!("|---|---|---|---|---|---|---|---|---|---|---|");
    }
    let kinds = SIZES.into_iter().flat_map(|size| [(size, false), (size, true)]);
    for ((emitted, fewer), is_off) in kinds.filter(|_| correct > 0) {
        // Of three pictures, one has positions that are off.
        let count = (correct * if is_off { 1 } else { 2 } / 3 / fewer).max(1);
        let seeds = FIRST_SEED..FIRST_SEED + count;
        let alarms = false_alarms(seeds, emitted, is_off, &expectations);
        eprintln!("{emitted}: the smallest p is that of seed {}", alarms.of_seed);
        let FalseAlarms { pictures, incorrect, undecided, no_dots, smallest, below, .. } = alarms;
        let [all, a, b, c] = below;
        let positions = if is_off { "up to 4e-3 off" } else { "on the surface" };
        println!(
            "| {emitted} | {positions} | {pictures} | {incorrect} | {undecided} | {no_dots} \
             | {smallest:.1e} | {all} | {a} | {b} | {c} |"
        );
    }
    if seeds == 0 {
        return;
    }
    for emitted in only.map_or(EMITTED.to_vec(), |only| vec![only]) {
        println!("\n{emitted} photons emitted:\n");
        println!(
            "| misreading | number known: best test / incorrect | named | number not known: best \
             test / incorrect | named |"
        );
        println!("|---|---|---|---|---|");
        for id in ids() {
            let rows = detect(id, FIRST_SEED..FIRST_SEED + seeds, emitted, &expectations);
            let columns = [Some(emitted as f64), None].into_iter().zip(rows).map(|(known, row)| {
                let limit = limit_of(id, emitted as f64, known, &expectations)
                    .map_or("-".to_owned(), |part| format!("{:.1}", part * row.pictures as f64));
                format!("{limit} / {} of {} | {}", row.incorrect, row.pictures, named(&row))
            });
            println!("| `{id}` | {} |", columns.collect::<Vec<_>>().join(" | "));
        }
    }
}

fn named(row: &Row) -> String {
    let mut names: Vec<_> = row.named.iter().collect();
    names.sort_by_key(|(id, count)| (std::cmp::Reverse(**count), **id));
    let names: Vec<_> = names.iter().map(|(id, count)| format!("{count} `{id}`")).collect();
    if names.is_empty() { "none".to_owned() } else { names.join(", ") }
}

/// How often, over the ways to `id`, the best test would find a picture of `size` photons.
fn limit_of(
    id: &str,
    size: f64,
    emitted: Option<f64>,
    expectations: &PictureExpectations,
) -> Option<f64> {
    let PictureExpectations { view, signatures, .. } = expectations;
    let (shown, none) = (vec![1.0; view.facets.len()], vec![0.0; view.cells.len()]);
    let ways = signatures.misreadings.iter().filter(|known| known.hypothesis.id == id);
    let powers: Vec<f64> = ways
        .map(|known| {
            let counts = expect(view, &known.signature, size, &shown, &none).mean;
            best_test(&counts, emitted, signatures.fair.iter(), |fair, size| {
                expect(view, &fair.signature, size, &shown, &none)
            })
        })
        .collect();
    // How many self-hits there are, only a program knows.
    let is_known = id != "no-offset" && !powers.is_empty();
    is_known.then(|| powers.iter().sum::<f64>() / powers.len() as f64)
}

/// What became of the pictures of one kind.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
struct Row {
    /// How many there were.
    pictures: usize,
    /// How many were called incorrect.
    incorrect: usize,
    /// The misreadings named, and how often.
    named: BTreeMap<&'static str, usize>,
}

/// The misreadings that a picture can show.
fn ids() -> Vec<&'static str> {
    let mut ids: Vec<&str> = misreadings().iter().map(|hypothesis| hypothesis.id).collect();
    ids.push("no-offset");
    ids.sort_unstable();
    ids.dedup();
    ids.retain(|id| *id != "bounce-off-by-one");
    ids
}

/// Judges pictures of `emitted` photons with the misreading `id`, one for each of `seeds`: with the
/// number known, and without.
fn detect(
    id: &str,
    seeds: Range<u64>,
    emitted: u64,
    expectations: &PictureExpectations,
) -> [Row; 2] {
    let judge = |seed: u64| {
        let hypothesis = misread(id, seed).expect("it is one of the ids");
        let view = &expectations.view;
        let red =
            simulate_dots(hypothesis.variation, seed, emitted, 0.0, &expectations.places, view);
        [Some(emitted as f64), None].map(|known| judge_dots(&red, view, known, expectations))
    };
    let judged: Vec<_> = seeds.into_par_iter().map(judge).collect();
    [0, 1].map(|which| {
        let mut row = Row::default();
        for judgment in judged.iter().map(|pair| &pair[which]) {
            row.pictures += 1;
            row.incorrect += usize::from(judgment.verdict() == Verdict::Incorrect);
            if let Some(explanation) = &judgment.explanation {
                *row.named.entry(explanation.hypothesis.id).or_default() += 1;
            }
        }
        row
    })
}

/// What became of pictures that are correct.
#[derive(Clone, Debug, Default, PartialEq)]
struct FalseAlarms {
    /// How many there were; each is judged with the number of photons known, and without.
    pictures: usize,
    /// How many were called incorrect, either way.
    incorrect: usize,
    /// How many were undecided, either way.
    undecided: usize,
    /// How many have no dots, since positions are too far off.
    no_dots: usize,
    /// The smallest p-value, corrected for the number of tests.
    smallest: f64,
    /// The seed of the picture that has it.
    of_seed: u64,
    /// How many p-values there were, and how many below 0.1, 0.01 and 0.001.
    below: [usize; 4],
}

/// Judges correct pictures of `emitted` photons, one for each of `seeds`, of all fair readings in
/// turn; where `is_off`, with positions up to 4e-3 off. Farther off, no dot is left.
fn false_alarms(
    seeds: Range<u64>,
    emitted: u64,
    is_off: bool,
    expectations: &PictureExpectations,
) -> FalseAlarms {
    let fair = fair_readings();
    let judge = |seed: u64| {
        let variation = fair[seed as usize % fair.len()].variation;
        let standoff = if is_off { 4e-3 * photon_random(seed, 1)() } else { 0.0 };
        let view = &expectations.view;
        let red = simulate_dots(variation, seed, emitted, standoff, &expectations.places, view);
        [Some(emitted as f64), None].map(|known| judge_dots(&red, view, known, expectations))
    };
    let first = seeds.start;
    let judged: Vec<_> = seeds.into_par_iter().map(judge).collect();
    let mut alarms = FalseAlarms { smallest: 1.0, ..FalseAlarms::default() };
    for (seed, judgments) in (first..).zip(judged) {
        alarms.pictures += 1;
        let is = |verdict| judgments.iter().any(|judgment| judgment.verdict() == verdict);
        alarms.incorrect += usize::from(is(Verdict::Incorrect));
        alarms.undecided += usize::from(is(Verdict::Undecided));
        alarms.no_dots += usize::from(!judgments[0].has_dots);
        for p_value in judgments.iter().filter_map(|judgment| judgment.p_value) {
            if p_value < alarms.smallest {
                (alarms.smallest, alarms.of_seed) = (p_value, seed);
            }
            for (count, limit) in alarms.below.iter_mut().zip([f64::INFINITY, 0.1, 0.01, 0.001]) {
                *count += usize::from(p_value < limit);
            }
        }
    }
    alarms
}
