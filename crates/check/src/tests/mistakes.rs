//! Right solutions pass in every section; a planted mistake is told under its section, with its
//! name.

use variants::section::Section;

use super::{faults, report, sections_text};
use crate::report::Builds;
use crate::sections::Status;

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

/// Directions are wrong twice: what the frame does is told apart from the law of the angle.
#[test]
fn a_wrong_law_in_a_wrong_frame_is_told_as_both() {
    let changes = [("std::sqrt(u1)", "u1"), ("glm::mat3(t, b, n)", "glm::mat3(t, n, b)")];
    let Some(report) = report(&changes) else { return };
    let expected = [
        (Section::HemisphereSampling, Some("no-square-root")),
        (Section::HemisphereRayTransformation, Some("permuted-frame")),
    ];
    assert_eq!(faults(&report), expected, "{}", sections_text(&report));
}

#[test]
fn a_law_without_a_name_below_the_surface_is_told_as_both() {
    let changes = [
        ("std::sqrt(1.f - u1)", "std::sqrt(1.f - u1 * u1 * u1)"),
        ("n = state.ComputeNormal()", "n = -state.ComputeNormal()"),
        // Offset to the right side, lest rays meet their own surface.
        ("hit + 1e-5f * n", "hit - 1e-5f * n"),
    ];
    let Some(report) = report(&changes) else { return };
    let expected = [
        (Section::HemisphereSampling, None),
        (Section::HemisphereRayTransformation, Some("flipped-normal")),
    ];
    assert_eq!(faults(&report), expected, "{}", sections_text(&report));
}

/// Photons that scatter below the surface have a path, too.
#[test]
fn a_path_that_does_not_grow_is_told_where_photons_go_below_the_surface() {
    let changes =
        [("n = state.ComputeNormal()", "n = -state.ComputeNormal()"), ("path.push_back('D');", "")];
    let Some(report) = report(&changes) else { return };
    let expected = [
        (Section::PhotonStorage, Some("path-does-not-grow")),
        (Section::HemisphereRayTransformation, Some("flipped-normal")),
    ];
    assert_eq!(faults(&report), expected, "{}", sections_text(&report));
}

/// u1 is small, but u2 does not follow from it.
#[test]
fn a_number_used_again_is_one_fault() {
    let changes = [
        (
            "if ((float)rand() / RAND_MAX >= pr)",
            "const float u1 = (float)rand() / RAND_MAX;\n    if (u1 >= pr)",
        ),
        (
            "    const float u1 = (float)rand() / RAND_MAX;\n    const float u2",
            "    const float u2",
        ),
    ];
    let Some(report) = report(&changes) else { return };
    let expected = [(Section::HemisphereSampling, Some("roulette-number-again"))];
    assert_eq!(faults(&report), expected, "{}", sections_text(&report));
}

/// Laws of the height that the handout's z has not.
#[test]
fn other_laws_of_the_height_have_names() {
    let cases = [
        ("std::sqrt(1.f - r)", "other-height"),
        ("std::sqrt(1.f - u1 * u1)", "other-height"),
        ("1.f - r", "other-height"),
        ("1.f", "other-height"),
        ("1.f - u1", "no-square-root-of-height"),
    ];
    for (height, name) in cases {
        let Some(report) = report(&[("std::sqrt(1.f - u1)", height)]) else { return };
        let expected = [(Section::HemisphereSampling, Some(name))];
        assert_eq!(faults(&report), expected, "{height}: {}", sections_text(&report));
    }
}

#[test]
fn a_ray_that_is_handed_on_unchanged_is_one_fault() {
    let Some(report) = report(&[("&scattered, light", "photonRay, light")]) else { return };
    let expected = [(Section::HemisphereRayTransformation, Some("start-not-moved"))];
    assert_eq!(faults(&report), expected, "{}", sections_text(&report));
    assert_eq!(report.sections[3].status, Status::NotReached);
}

/// What ends every call is told once, under the first section that meets it.
#[test]
fn a_crash_in_every_call_is_told_once() {
    let hit = "const glm::vec3 hit = ";
    let crash = "*(volatile int*)nullptr = 1;\n    const glm::vec3 hit = ";
    let Some(report) = report(&[(hit, crash)]) else { return };
    assert_eq!(faults(&report), [(Section::PhotonStorage, None)], "{}", sections_text(&report));
    let statuses = report.sections[2..].iter().map(|verdict| verdict.status);
    assert!(statuses.clone().all(|status| status == Status::NotReached));
}

/// What happens after the roulette is no matter of storing.
#[test]
fn a_crash_after_the_roulette_is_told_under_scattering() {
    let crash = "*(volatile int*)nullptr = 1;\n    Ray scattered(";
    let Some(report) = report(&[("Ray scattered(", crash)]) else { return };
    let expected = [(Section::PhotonScatteringAbsorption, None)];
    assert_eq!(faults(&report), expected, "{}", sections_text(&report));
    assert_eq!(report.sections[1].status, Status::NotReached);
}

/// What ends a call only where its ray meets nothing says nothing about the roulette.
#[test]
fn a_recursion_without_end_at_a_miss_is_told_under_storage() {
    let miss = "&state)) {\n        return;";
    let again = "&state)) {\n        TracePhoton(photonMap, photonRay, lightIntensity, path, \
                 currentIOR, remainingBounces);\n        return;";
    let Some(report) = report(&[(miss, again)]) else { return };
    assert_eq!(faults(&report), [(Section::PhotonStorage, None)], "{}", sections_text(&report));
}
