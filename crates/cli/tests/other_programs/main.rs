//! Lists of a program that shares nothing with the port, right and wrong in many ways, are judged
//! and named as `cases.csv` says.

use std::path::{Path, PathBuf};
use std::process::Command;

use crate::support::{folder, json, run};
use rayon::prelude::*;
use serde::Deserialize;

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
    let Some(tracer) = tracer(folder.path(), &["-O2"]) else { return };
    let cases = csv::Reader::from_reader(include_str!("cases.csv").as_bytes());
    let cases: Vec<Case> = cases.into_deserialize().collect::<Result<_, _>>().expect("well formed");
    let wrong: Vec<String> = cases
        .par_iter()
        .flat_map_iter(|case| {
            let Case { name, switches, columns, digits, emitted, seed, .. } = case;
            let list = folder.path().join(format!("{name}.csv"));
            trace(&tracer, [&switches.replace('+', ","), emitted, seed], &list, [columns, digits]);
            // With the number of photons known and not known.
            [&[][..], &["--emitted", emitted]].map(|known| {
                let words = ["grade", "--format", "json"].iter().chain(known);
                let grade = json(run(words.map(|word| word.as_ref()).chain([list.as_os_str()])));
                let misreading = grade["misreading"].as_str().unwrap_or_default();
                let may_be_unnamed = case.misreading.strip_suffix('?');
                let is_named = misreading == may_be_unnamed.unwrap_or(&case.misreading)
                    || may_be_unnamed.is_some() && misreading.is_empty();
                // Points strewn by hand, and photons at two places, have nothing of a photon map.
                // Photons of so few emitted that have no name need a person's look.
                let is_small = emitted.parse::<u64>().expect("a number") < 50_000;
                let has_points = ["f08", "t17"].iter().any(|it| name.starts_with(it))
                    || is_small && misreading.is_empty()
                    || grade["score"].as_f64() > Some(0.0);
                let is_right = grade["verdict"] == case.verdict.as_str() && is_named && has_points;
                let found = format!("{name} {known:?}: {} {misreading}", grade["verdict"]);
                (!is_right).then(|| format!("{found}, expected {} {}", case.verdict, case.what))
            })
        })
        .flatten()
        .collect();
    assert!(wrong.is_empty(), "{wrong:#?}");
}

#[cfg(target_arch = "x86_64")]
#[test]
fn the_arithmetic_of_other_compilers_is_correct() {
    for options in [&["-O2", "-mfpmath=387"][..], &["-O3", "-ffast-math", "-march=native"]] {
        let folder = folder();
        let Some(tracer) = tracer(folder.path(), options) else { return };
        for (emitted, seed) in [("200000", "3148"), ("1000000", "3149")] {
            let list = folder.path().join("list.csv");
            trace(&tracer, ["nbasis", emitted, seed], &list, ["all", "9"]);
            let words = ["grade", "--format", "json", "--emitted", emitted].map(|it| it.as_ref());
            let grade = json(run(words.into_iter().chain([list.as_os_str()])));
            assert_eq!(grade["verdict"], "correct", "{options:?} {emitted}: {grade}");
        }
    }
}
