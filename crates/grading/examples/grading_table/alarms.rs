//! Correct lists of all kinds, and how often they are called incorrect.

use fast::lanes::offset::Offset;
use glam::Vec3;
use grading::judge_list::{Expectations, SIGNIFICANCE};
use grading::places::{Place, Places};
use photon_mapping::photon_list::PhotonRecord;
use photon_mapping::random::photon_random;
use rayon::prelude::*;
use variants::reading::{Reading, TangentBasis};
use variants::variation::{Simulation, Transformation, Variation};

use crate::numbers::{Drand48, FifteenBits, Settings, halton, strata, stratified};
use crate::{CONTENTS, SMALL_LIMIT, judged};

/// Prints how often `count` correct lists are called incorrect, and a quarter as many of at most
/// [`SMALL_LIMIT`] bounces.
pub fn false_alarms(count: u64, expectations: &Expectations, with_small_limit: &Expectations) {
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
