//! Lists of a program that shares nothing with the port, right and wrong in many ways, are judged
//! and named as `cases.csv` says.

#[path = "../support/mod.rs"]
mod support;

use std::path::{Path, PathBuf};
use std::process::Command;

use rayon::prelude::*;
use serde::Deserialize;
use support::{folder, json, run};

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

/// The program, compiled into `folder`. Without g++ nothing is tested, unless `CI` is set.
fn tracer(folder: &Path) -> Option<PathBuf> {
    let program = folder.join("tracer");
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/other_programs/tracer.cpp");
    let compiled = Command::new("g++").args(["-O2", "-o"]).args([&program, &source]).status();
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

#[test]
fn other_programs_are_judged_and_named_rightly() {
    let folder = folder();
    let Some(tracer) = tracer(folder.path()) else { return };
    let cases = csv::Reader::from_reader(include_str!("cases.csv").as_bytes());
    let cases: Vec<Case> = cases.into_deserialize().collect::<Result<_, _>>().expect("well formed");
    let wrong: Vec<String> = cases
        .par_iter()
        .flat_map_iter(|case| {
            let Case { name, switches, columns, digits, emitted, seed, .. } = case;
            let list = folder.path().join(format!("{name}.csv"));
            let traced = Command::new(&tracer)
                .args([&switches.replace('+', ","), emitted, seed])
                .arg(&list)
                .args([columns, digits])
                .output()
                .expect("it runs");
            assert!(traced.status.success(), "{name}");
            // With the number of photons known and not known.
            [&[][..], &["--emitted", emitted]].map(|known| {
                let words = ["grade", "--format", "json"].iter().chain(known);
                let grade = json(run(words.map(|word| word.as_ref()).chain([list.as_os_str()])));
                let misreading = grade["misreading"].as_str().unwrap_or_default();
                let may_be_unnamed = case.misreading.strip_suffix('?');
                let is_named = misreading == may_be_unnamed.unwrap_or(&case.misreading)
                    || may_be_unnamed.is_some() && misreading.is_empty();
                let is_right = grade["verdict"] == case.verdict.as_str() && is_named;
                let found = format!("{name} {known:?}: {} {misreading}", grade["verdict"]);
                (!is_right).then(|| format!("{found}, expected {} {}", case.verdict, case.what))
            })
        })
        .flatten()
        .collect();
    assert!(wrong.is_empty(), "{wrong:#?}");
}
