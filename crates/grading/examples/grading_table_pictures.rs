//! How good the grader is at pictures: simulates them, judges them, and prints a table.
//!
//! `grading_table_pictures [SEEDS] [CORRECT] [EMITTED]`: the pictures of every misreading, of the
//! numbers of photons that programs emit or of one, and those of every number that are correct.

use grading::picture::expectations::PictureExpectations;
use grading::picture::trials::{FalseAlarms, Row, detect, false_alarms, ids};
use grading::places::Places;
use photon_mapping::assignment8::{MAX_PHOTON_BOUNCES, create_scene};

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
            "| correct, emitted | positions | pictures | called incorrect | no dots \
             | smallest p | of all p | p < 0.1 | p < 0.01 | p < 0.001 |"
        );
        println!("|---|---|---|---|---|---|---|---|---|---|");
    }
    let kinds = SIZES.into_iter().flat_map(|size| [(size, false), (size, true)]);
    for ((emitted, fewer), is_off) in kinds.filter(|_| correct > 0) {
        // Of three pictures, one has positions that are off.
        let count = (correct * if is_off { 1 } else { 2 } / 3 / fewer).max(1);
        let seeds = FIRST_SEED..FIRST_SEED + count;
        let alarms = false_alarms(seeds, emitted, is_off, &expectations);
        eprintln!("{emitted}: the smallest p is that of seed {}", alarms.of_seed);
        let FalseAlarms { pictures, incorrect, no_dots, smallest, below, .. } = alarms;
        let [all, a, b, c] = below;
        let positions = if is_off { "up to 4e-3 off" } else { "on the surface" };
        println!(
            "| {emitted} | {positions} | {pictures} | {incorrect} | {no_dots} \
             | {smallest:.1e} | {all} | {a} | {b} | {c} |"
        );
    }
    if seeds == 0 {
        return;
    }
    for emitted in only.map_or(EMITTED.to_vec(), |only| vec![only]) {
        println!("\n{emitted} photons emitted:\n");
        println!(
            "| misreading | incorrect, number known | named | incorrect, number not known | named |"
        );
        println!("|---|---|---|---|---|");
        for id in ids() {
            let rows = detect(id, FIRST_SEED..FIRST_SEED + seeds, emitted, &expectations);
            let columns =
                rows.map(|row| format!("{} of {} | {}", row.incorrect, row.pictures, named(&row)));
            println!("| `{id}` | {} |", columns.join(" | "));
        }
    }
}

fn named(row: &Row) -> String {
    let mut names: Vec<_> = row.named.iter().collect();
    names.sort_by_key(|(id, count)| (std::cmp::Reverse(**count), **id));
    let names: Vec<_> = names.iter().map(|(id, count)| format!("{count} `{id}`")).collect();
    if names.is_empty() { "none".to_owned() } else { names.join(", ") }
}
