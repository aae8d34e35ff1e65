//! What the tests of real C++ have in common.
#![allow(dead_code, reason = "no test needs all of it")]

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use check::find::CppSubmission;
use check::kit::Kit;
use check::{CheckReport, CheckSettings, check};
use variants::section::Section;

/// The kit, with its harness compiled once for all tests of a file; nothing, with a message, where
/// there is no compiler or no glm. In CI there must be both.
pub fn kit() -> Option<&'static Kit> {
    static KIT: OnceLock<Option<Kit>> = OnceLock::new();
    let made = KIT.get_or_init(|| match Kit::new(None) {
        Ok(kit) => Some(kit),
        Err(error) if std::env::var_os("CI").is_some() => panic!("{error}"),
        Err(error) => {
            eprintln!("skipped: {error}");
            None
        }
    });
    made.as_ref()
}

/// `program` under another name, by which it chooses what it does.
pub fn named(program: &Path, name: &str) -> PathBuf {
    let named = program.with_file_name(name);
    std::fs::copy(program, &named).expect("can be copied");
    named
}

pub fn submissions() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/submissions")
}

/// The report on `one_function`, with each pair's first text replaced by its second.
pub fn report(changes: &[(&str, &str)]) -> Option<CheckReport> {
    let kit = kit()?;
    let folder = tempfile::tempdir().expect("a folder");
    let mut unused: Vec<_> = changes.to_vec();
    for name in ["PointLight.cpp", "PhotonMappingRenderer.cpp"] {
        let mut text =
            fs::read_to_string(submissions().join("one_function").join(name)).expect("a file");
        unused.retain(|(from, _)| !text.contains(from));
        for (from, to) in changes {
            text = text.replace(from, to);
        }
        fs::write(folder.path().join(name), text).expect("can be written");
    }
    assert!(unused.is_empty(), "{unused:?} is nowhere");
    let submission = CppSubmission::find(folder.path()).expect("a submission");
    let settings = CheckSettings { photons: 2000, ..CheckSettings::default() };
    Some(check(&submission, kit, &settings).expect("it can be checked"))
}

/// What is said of the sections, for messages of tests.
pub fn sections_text(report: &CheckReport) -> String {
    let line = |verdict: &check::sections::SectionVerdict| format!("{verdict:#?}");
    report.sections.iter().map(line).collect::<Vec<_>>().join("\n")
}

pub fn faults(report: &CheckReport) -> Vec<(Section, Option<&'static str>)> {
    let sections = report.sections.iter();
    let faults = sections
        .flat_map(|verdict| verdict.faults.iter().map(|fault| (verdict.section, fault.name)));
    faults.collect()
}
