//! Right solutions pass in every section; a planted mistake is told under its section, with its
//! name.

mod support;

use std::fs;
use std::path::{Path, PathBuf};

use check::find::Submission;
use check::report::Builds;
use check::sections::Status;
use check::{Report, Settings, check};
use variants::section::Section;

fn submissions() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/submissions")
}

/// The report on `one_function`, with each pair's first text replaced by its second.
fn report(changes: &[(&str, &str)]) -> Option<Report> {
    let kit = support::kit()?;
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
    let submission = Submission::find(folder.path()).expect("a submission");
    let settings = Settings { photons: 2000, ..Settings::default() };
    Some(check(&submission, kit, &settings).expect("it can be checked"))
}

/// What is said of the sections, for messages of tests.
fn sections_text(report: &Report) -> String {
    let line = |verdict: &check::sections::Verdict| format!("{verdict:#?}");
    report.sections.iter().map(line).collect::<Vec<_>>().join("\n")
}

fn faults(report: &Report) -> Vec<(Section, Option<&'static str>)> {
    let sections = report.sections.iter();
    let faults = sections
        .flat_map(|verdict| verdict.faults.iter().map(|fault| (verdict.section, fault.name)));
    faults.collect()
}

#[test]
fn a_right_solution_is_right_in_every_section() {
    let Some(report) = report(&[]) else { return };
    assert_eq!(report.builds, Builds::Yes);
    let statuses: Vec<_> = report.sections.iter().map(|verdict| verdict.status).collect();
    assert_eq!(statuses, [Status::Right; 5], "{}", sections_text(&report));
}

#[test]
fn the_letter_of_the_handout_is_a_fair_reading() {
    let changes = [
        ("t = glm::normalize(glm::cross(n, axis))", "t = glm::cross(n, axis)"),
        ("b = glm::normalize(glm::cross(n, t))", "b = glm::cross(n, t)"),
    ];
    let Some(report) = report(&changes) else { return };
    assert_eq!(faults(&report), [], "{}", sections_text(&report));
    assert_eq!(report.sections[4].status, Status::RightUnderAnotherReading);
}

#[test]
fn a_missing_name_is_told_with_file_and_line() {
    let Some(report) = report(&[("sum = x * x", "sum = RandFloat01() + x * x")]) else { return };
    let Builds::No(error) = &report.builds else { panic!("it builds: {report:?}") };
    assert_eq!(error.file.as_deref(), Some("PointLight.cpp"));
    assert_eq!(error.missing.as_deref(), Some("RandFloat01"));
    assert!(error.line.is_some());
}

/// A whole checkout of the framework, with a helper of the student's own in another folder.
#[test]
fn a_checkout_brings_its_own_helpers() {
    let Some(kit) = support::kit() else { return };
    let folder = tempfile::tempdir().expect("a folder");
    let write = |path: &str, text: &str| {
        let path = folder.path().join("assignment8").join(path);
        fs::create_dir_all(path.parent().expect("a folder")).expect("can be made");
        fs::write(path, text).expect("can be written");
    };
    let read = |name: &str| {
        fs::read_to_string(submissions().join("one_function").join(name)).expect("a file")
    };
    let light = read("PointLight.cpp").replace("((float)rand() / RAND_MAX)", "RandFloat01()");
    let light = format!("#include \"common/Utility/utils.h\"\n{light}");
    write("common/Scene/Lights/Point/PointLight.cpp", &light);
    let renderer = read("PhotonMappingRenderer.cpp");
    write("common/Rendering/Renderer/Photon/PhotonMappingRenderer.cpp", &renderer);
    write("common/Utility/utils.h", "#pragma once\nfloat RandFloat01();\n");
    let utils = "#include \"common/Utility/utils.h\"\n#include <cstdlib>\n\
                 float RandFloat01() { return rand() / (float)RAND_MAX; }\n";
    write("common/Utility/utils.cpp", utils);
    // What the framework has and the stand-in does not need is of no interest.
    write("main.cpp", "#error this is not compiled\n");
    write("common/common.h", "#error nor is this read\n");
    let submission = Submission::find(folder.path()).expect("a submission");
    let settings = Settings { photons: 2000, ..Settings::default() };
    let report = check(&submission, kit, &settings).expect("it can be checked");
    assert_eq!(report.builds, Builds::Yes);
    let statuses: Vec<_> = report.sections.iter().map(|verdict| verdict.status).collect();
    assert_eq!(statuses, [Status::Right; 5], "{}", sections_text(&report));
    assert!(report.whole.is_reference(), "{:?}", report.whole.sentence(&report.sections));
}
