//! One mistake is told once, under its section, with its cause.

use crate::report::CheckReport;
use variants::section::Section;

use super::{faults, report, sections_text};

/// Checks that `report` tells one fault in this section, with this name and these words.
fn tells(report: &CheckReport, section: Section, name: Option<&str>, words: &str) {
    assert_eq!(faults(report), [(section, name)], "{}", sections_text(report));
    let all = report.sections.iter().flat_map(|verdict| &verdict.faults);
    let text: Vec<_> = all.map(|fault| format!("{} -> {}", fault.found, fault.advice)).collect();
    assert!(text[0].contains(words), "expected {words:?} in {text:?}");
}

/// With a real `srand`, all photons of a second are alike.
#[test]
fn seeding_again_for_every_photon_is_told() {
    let emission = "srand(static_cast<unsigned>(time(NULL)));\n    float x, y, z, sum;";
    let cases = [
        ("float x, y, z, sum;", emission, Section::PhotonEmission),
        ("Ray photonRay;", "Ray photonRay;\nsrand(42);", Section::PhotonEmission),
        (
            "const float pr",
            "srand(time(NULL));\nconst float pr",
            Section::PhotonScatteringAbsorption,
        ),
        ("const float u1", "srand48(1);\nconst float u1", Section::PhotonScatteringAbsorption),
    ];
    for (from, to, section) in cases {
        let include = (
            "#include \"common/Scene/Lights/Point/PointLight.h\"",
            "#include \"common/Scene/Lights/Point/PointLight.h\"\n#include <ctime>",
        );
        let Some(report) = report(&[include, (from, to)]) else { return };
        tells(&report, section, Some("seeded-again"), "once");
    }
}

#[test]
fn seeding_once_is_right() {
    let once = "static bool seeded = false;\nif (!seeded) { srand(time(NULL)); seeded = true; }\n\
                const float pr";
    let other = "srand(rand());\nconst float pr";
    for to in [once, other] {
        let Some(report) = report(&[("const float pr", to)]) else { return };
        assert!(!faults(&report).iter().any(|(_, name)| *name == Some("seeded-again")), "{to}");
    }
}

#[test]
fn columns_in_another_order_are_told_whatever_their_signs() {
    let frames = ["n, t, -b", "t, n, -b", "n, b, -t", "b, n, -t", "-n, -t, -b", "-t, n, -b"];
    for frame in frames {
        let frame = format!("glm::mat3({frame})");
        let Some(report) = report(&[("glm::mat3(t, b, n)", &frame)]) else { return };
        let section = Section::HemisphereRayTransformation;
        tells(&report, section, Some("permuted-frame"), "columns");
    }
}

#[test]
fn a_direction_that_is_not_transformed_is_told() {
    let Some(report) = report(&[("glm::mat3(t, b, n) * sample", "sample")]) else { return };
    let section = Section::HemisphereRayTransformation;
    tells(&report, section, Some("not-transformed"), "tangent space");
}

#[test]
fn a_constant_number_is_no_matter_of_the_frame() {
    let u1 = "u1 = (float)rand() / RAND_MAX";
    for (constant, _) in [("u1 = 0.5f", ()), ("u1 = 0.03f", ())] {
        let Some(report) = report(&[(u1, constant)]) else { return };
        tells(&report, Section::HemisphereSampling, None, "angle to the normal");
    }
    let both = [(u1, "u1 = 0.3f"), ("u2 = (float)rand() / RAND_MAX", "u2 = 0.7f")];
    let Some(report) = report(&both) else { return };
    tells(&report, Section::HemisphereSampling, Some("same-direction"), "are the same");
}

#[test]
fn a_wrong_position_is_told_once_and_named() {
    let cases = [
        ("hit + 0.01f * state.ComputeNormal()", "along the normal"),
        ("hit - 0.2f * state.ComputeNormal()", "along the normal"),
        ("glm::vec3(photonRay->GetPosition())", "start of its ray"),
        ("photonRay->GetRayDirection()", "GetRayPosition"),
        ("state.intersectionRay.GetRayPosition(1.f)", "GetRayPosition"),
    ];
    for (position, words) in cases {
        let position = format!("photon.position = {position};");
        let Some(report) = report(&[("photon.position = hit;", &position)]) else { return };
        tells(&report, Section::PhotonStorage, Some("wrong-position"), words);
    }
}

#[test]
fn an_offset_to_the_wrong_side_is_told() {
    for offset in
        ["hit - 1e-5f * n", "hit - 1e-3f * n", "hit + 1e-4f * photonRay->GetRayDirection()"]
    {
        let Some(report) = report(&[("hit + 1e-5f * n", offset)]) else { return };
        let section = Section::HemisphereRayTransformation;
        tells(&report, section, Some("offset-below"), "below the surface");
    }
    let Some(report) = report(&[("hit + 1e-5f * n", "hit")]) else { return };
    tells(&report, Section::HemisphereRayTransformation, Some("no-offset"), "missing or too short");
}

/// The positions tell what is right; the intensities cost nothing.
#[test]
fn other_intensities_are_told_of_the_reference_s_photons() {
    let changes = [
        ("> 0.99f", "> 0.9f"),
        (
            "TracePhoton(photonMap, &scattered, light",
            "TracePhoton(photonMap, &scattered, d / pr * light",
        ),
    ];
    let Some(report) = report(&changes) else { return };
    assert!(report.whole.is_reference(), "{}", report.whole.sentence(&report.sections));
    assert!(report.remarks.iter().any(|remark| remark.contains("intensities are not")));
}
