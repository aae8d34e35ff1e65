//! The same mistakes in programs of different styles: every section's verdict is right, whatever a
//! student writes around it. Each program is compiled once; its name says which mistake it makes.

use std::fs;
use std::path::Path;
use std::time::Duration;

use super::cases::{FEW, Program};
use super::handed_in;
use crate::plan::CALLS_AROUND;
use crate::sections::{SectionVerdict, Status, judge};
use variants::section::Section;

const TIME: Duration = Duration::from_secs(60);
/// The mistake for which a million directions must be counted.
const DEGREES: u8 = 21;

/// The mistakes, by their numbers in `styles/mistake.h`, with the section and name of the fault.
const MISTAKES: [(u8, Section, &str); 17] = [
    (1, Section::PhotonStorage, "direct-stored"),
    (2, Section::HemisphereRayTransformation, "no-offset"),
    (3, Section::HemisphereSampling, "uniform-hemisphere"),
    (4, Section::HemisphereSampling, "no-square-root"),
    (5, Section::PhotonEmission, "cube-directions"),
    (6, Section::PhotonScatteringAbsorption, "mean-roulette"),
    (7, Section::PhotonScatteringAbsorption, "red-roulette"),
    (8, Section::PhotonScatteringAbsorption, "no-roulette"),
    (9, Section::HemisphereRayTransformation, "transposed-frame"),
    (10, Section::HemisphereRayTransformation, "flipped-normal"),
    (11, Section::HemisphereRayTransformation, "nan-frame"),
    (12, Section::PhotonStorage, "bounce-off-by-one"),
    (13, Section::PhotonScatteringAbsorption, "inverted-roulette"),
    (14, Section::HemisphereSampling, "along-normal"),
    (15, Section::HemisphereRayTransformation, "start-not-moved"),
    (16, Section::PhotonStorage, "first-bounce-only"),
    (DEGREES, Section::HemisphereSampling, "angle-in-degrees"),
];

/// Fair readings, by their numbers, with a word of what is said of them.
const FAIR: [(u8, &str); 4] = [(0, ""), (17, "not normalized"), (18, "offset"), (19, "")];

fn faults(verdicts: &[SectionVerdict]) -> Vec<(Section, &'static str)> {
    let of = |verdict: &SectionVerdict| {
        let section = verdict.section;
        let names = verdict.faults.iter().map(|fault| fault.name.unwrap_or("unnamed"));
        names.map(move |name| (section, name)).collect::<Vec<_>>()
    };
    verdicts.iter().flat_map(of).collect()
}

/// What is wrong with the verdicts on all mistakes in the style `name`.
fn try_style(name: &str) {
    let styles = handed_in().join("styles");
    let folder = tempfile::tempdir().expect("a folder");
    let copy = |from: &Path| {
        let to = folder.path().join(from.file_name().expect("a name"));
        fs::copy(from, to).expect("can be copied");
    };
    copy(&styles.join("../hostile/name.h"));
    for from in [styles.clone(), styles.join(name)] {
        let entries = fs::read_dir(from).expect("a folder").map(|entry| entry.expect("one").path());
        entries.filter(|path| path.is_file()).for_each(|path| copy(&path));
    }
    let Some(program) = Program::new(folder.path()) else { return };
    let verdicts = |mistake: u8| {
        let around = if mistake == DEGREES { CALLS_AROUND } else { FEW };
        judge(&program.run(&mistake.to_string(), around, TIME))
    };
    let mut wrong = Vec::new();
    for (mistake, section, name) in MISTAKES {
        let verdicts = verdicts(mistake);
        let found = faults(&verdicts);
        if found != [(section, name)] {
            wrong.push(format!("{name}: found {found:?}\n{verdicts:#?}"));
        }
    }
    for (reading, words) in FAIR {
        let verdicts = verdicts(reading);
        let readings: Vec<_> = verdicts.iter().flat_map(|verdict| &verdict.readings).collect();
        let is_right = verdicts.iter().all(|verdict| {
            [Status::Right, Status::RightUnderAnotherReading].contains(&verdict.status)
        });
        let is_named = words.is_empty() || readings.iter().any(|reading| reading.contains(words));
        if !(is_right && is_named) {
            wrong.push(format!("reading {reading}: {verdicts:#?}"));
        }
    }
    // Two mistakes at once.
    let both = faults(&verdicts(20));
    let sections: Vec<_> = both.iter().map(|(section, _)| *section).collect();
    if sections != [Section::PhotonEmission, Section::PhotonScatteringAbsorption] {
        wrong.push(format!("two at once: {both:?}"));
    }
    assert!(wrong.is_empty(), "{name}: {}", wrong.join("\n"));
}

#[test]
fn lambdas_doubles_a_pointer_to_rand_and_a_loop() {
    try_style("loop");
}

#[test]
fn helper_functions_and_goto() {
    try_style("helpers");
}

#[test]
fn members_added_to_the_header() {
    try_style("members");
}

#[test]
fn an_engine_of_random() {
    try_style("engine");
}
