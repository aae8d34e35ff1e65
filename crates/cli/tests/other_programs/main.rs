//! Lists of a program that shares nothing with the port, right and wrong in many ways, are judged
//! and named as `cases.csv` says.

use std::collections::BTreeSet;
use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::support::{folder, json, run};
use rayon::prelude::*;
use serde::Deserialize;
use serde_json::Value;

#[derive(Deserialize)]
struct Case {
    name: String,
    switches: String,
    columns: String,
    digits: String,
    emitted: String,
    seed: String,
    verdict: String,
    /// With a question mark, it may also be unnamed: chance decides.
    misreading: String,
    #[serde(rename = "what is done")]
    what: String,
}

/// The program, compiled with `options` into `folder`. Without g++ nothing is tested, unless `CI`
/// is set.
fn tracer(folder: &Path, options: &[&str]) -> Option<PathBuf> {
    let program = folder.join("tracer");
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/other_programs/tracer.cpp");
    let compiled = Command::new("g++").args(options).arg("-o").args([&program, &source]).status();
    match compiled {
        Ok(status) => {
            assert!(status.success());
            Some(program)
        }
        Err(error) => {
            assert!(std::env::var_os("CI").is_none(), "g++ cannot be run: {error}");
            eprintln!("SKIPPED: g++ cannot be run ({error})");
            None
        }
    }
}

/// Runs `tracer` with its switches, the number of photons and the seed, which writes `list`.
fn trace(tracer: &Path, settings: [&str; 3], list: &Path, form: [&str; 2]) {
    let traced = Command::new(tracer).args(settings).arg(list).args(form).output();
    assert!(traced.expect("it runs").status.success(), "{}", list.display());
}

#[test]
fn other_programs_are_judged_and_named_rightly() {
    let folder = folder();
    let Some(tracer) = tracer(folder.path(), &["-O2", "-ftree-vectorize"]) else { return };
    let cases = csv::Reader::from_reader(include_str!("cases.csv").as_bytes());
    let cases: Vec<Case> = cases.into_deserialize().collect::<Result<_, _>>().expect("well formed");
    let list = |case: &Case| folder.path().join(format!("{}.csv", case.name));
    cases.par_iter().for_each(|case| {
        let Case { switches, columns, digits, emitted, seed, .. } = case;
        let settings = [&switches.replace('+', ","), emitted.as_str(), seed];
        trace(&tracer, settings, &list(case), [columns, digits]);
    });
    // With the number of photons known and not known.
    let numbers: BTreeSet<&str> = cases.iter().map(|case| case.emitted.as_str()).collect();
    let mut wrong = Vec::new();
    for known in numbers.into_iter().map(Some).chain([None]) {
        let is_of_number = |case: &&Case| known.is_none_or(|known| case.emitted == known);
        let cases: Vec<&Case> = cases.iter().filter(is_of_number).collect();
        let words = ["grade", "--format", "json"].into_iter();
        let words = words.chain(known.iter().flat_map(|known| ["--emitted", known]));
        let lists = cases.iter().map(|case| list(case).into_os_string());
        let grades = match json(run(words.map(OsString::from).chain(lists))) {
            Value::Array(grades) => grades,
            grade => vec![grade],
        };
        assert_eq!(grades.len(), cases.len());
        for (Case { name, emitted, verdict, misreading: expected, what, .. }, grade) in
            cases.into_iter().zip(grades)
        {
            let misreading = grade["misreading"].as_str().unwrap_or_default();
            let may_be_unnamed = expected.strip_suffix('?');
            let is_named = misreading == may_be_unnamed.unwrap_or(expected)
                || may_be_unnamed.is_some() && misreading.is_empty();
            // Points strewn by hand, and photons at two places, have nothing of a photon map.
            // Photons of so few emitted that have no name need a person's look.
            let is_small = emitted.parse::<u64>().expect("a number") < 50_000;
            let has_points = ["f08", "t17"].iter().any(|it| name.starts_with(it))
                || is_small && misreading.is_empty()
                || grade["score"].as_f64() > Some(0.0);
            if grade["verdict"] != verdict.as_str() || !is_named || !has_points {
                let found = &grade["verdict"];
                wrong.push(format!(
                    "{name} {known:?}: {found} {misreading}, expected {verdict} {what}"
                ));
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

#[cfg(target_arch = "x86_64")]
#[test]
fn the_arithmetic_of_other_compilers_is_correct() {
    for options in [&["-O2", "-mfpmath=387"][..], &["-O3", "-ffast-math", "-march=native"]] {
        let folder = folder();
        let options = [options, &["-DONLY_FLOAT"]].concat();
        let Some(tracer) = tracer(folder.path(), &options) else { return };
        for (emitted, seed) in [("200000", "3148"), ("1000000", "3149")] {
            let list = folder.path().join("list.csv");
            trace(&tracer, ["nbasis", emitted, seed], &list, ["all", "9"]);
            let words = ["grade", "--format", "json", "--emitted", emitted].map(|it| it.as_ref());
            let grade = json(run(words.into_iter().chain([list.as_os_str()])));
            assert_eq!(grade["verdict"], "correct", "{options:?} {emitted}: {grade}");
        }
    }
}
