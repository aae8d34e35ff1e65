//! Right solutions pass in every section; a planted mistake is told under its section, with its
//! name.

use Section::{
    HemisphereRayTransformation as Transformation, HemisphereSampling as Sampling,
    PhotonScatteringAbsorption as Scattering, PhotonStorage as Storage,
};
use variants::section::Section;

use super::cases::{Change, Faults, tells};
use super::statuses;
use crate::report::CheckReport;

const MAXIMUM: &str = "std::max(d.r, std::max(d.g, d.b))";
const HEIGHT: &str = "std::sqrt(1.f - u1)";
const OTHER_HEIGHT: Faults = &[(Sampling, Some("other-height"))];
const NORMAL: Change = ("n = state.ComputeNormal()", "n = -state.ComputeNormal()");

#[test]
fn mistakes_are_told_under_their_sections() {
    let reports = tells(&[
        (&[], &[], ""),
        // The letter of the handout is a fair reading.
        (
            &[
                ("t = glm::normalize(glm::cross(n, axis))", "t = glm::cross(n, axis)"),
                ("b = glm::normalize(glm::cross(n, t))", "b = glm::cross(n, t)"),
            ],
            &[],
            "",
        ),
        // A ray that is handed on unchanged is one fault.
        (
            &[("&scattered, light", "photonRay, light")],
            &[(Transformation, Some("start-not-moved"))],
            "",
        ),
        // What ends every call is told once, under the first section that meets it.
        (
            &[("const glm::vec3 hit = ", "*(volatile int*)nullptr = 1;\nconst glm::vec3 hit = ")],
            &[(Storage, None)],
            "",
        ),
        // What happens after the roulette is no matter of storing.
        (
            &[("Ray scattered(", "*(volatile int*)nullptr = 1;\nRay scattered(")],
            &[(Scattering, None)],
            "",
        ),
        // What ends a call only where its ray meets nothing says nothing about the roulette.
        (
            &[(
                "&state)) {\n        return;",
                "&state)) {\n        TracePhoton(photonMap, photonRay, lightIntensity, path, \
                 currentIOR, remainingBounces);\n        return;",
            )],
            &[(Storage, None)],
            "",
        ),
        // Directions are wrong twice: what the frame does is told apart from the law of the angle.
        (
            &[("std::sqrt(u1)", "u1"), ("glm::mat3(t, b, n)", "glm::mat3(t, n, b)")],
            &[(Sampling, Some("no-square-root")), (Transformation, Some("permuted-frame"))],
            "",
        ),
        // A law without a name below the surface.
        (
            &[
                (HEIGHT, "std::sqrt(1.f - u1 * u1 * u1)"),
                NORMAL,
                // Offset to the right side, lest rays meet their own surface.
                ("hit + 1e-5f * n", "hit - 1e-5f * n"),
            ],
            &[(Sampling, None), (Transformation, Some("flipped-normal"))],
            "",
        ),
        // Photons that scatter below the surface have a path, too.
        (
            &[NORMAL, ("path.push_back('D');", "")],
            &[(Storage, Some("path-does-not-grow")), (Transformation, Some("flipped-normal"))],
            "",
        ),
        // u1 is small, but u2 does not follow from it.
        (
            &[
                (
                    "if ((float)rand() / RAND_MAX >= pr)",
                    "const float u1 = (float)rand() / RAND_MAX;\n    if (u1 >= pr)",
                ),
                (
                    "    const float u1 = (float)rand() / RAND_MAX;\n    const float u2",
                    "    const float u2",
                ),
            ],
            &[(Sampling, Some("roulette-number-again"))],
            "",
        ),
        // Laws of the height that the handout's z has not.
        (&[(HEIGHT, "std::sqrt(1.f - r)")], OTHER_HEIGHT, ""),
        (&[(HEIGHT, "std::sqrt(1.f - u1 * u1)")], OTHER_HEIGHT, ""),
        (&[(HEIGHT, "1.f - r")], OTHER_HEIGHT, ""),
        (&[(HEIGHT, "1.f")], OTHER_HEIGHT, ""),
        (&[(HEIGHT, "1.f - u1")], &[(Sampling, Some("no-square-root-of-height"))], ""),
    ]);
    let found: Vec<_> = reports.iter().take(5).map(statuses).collect();
    let expected = ["+++++", "++++~", "+++?x", "+x???", "+?x??"];
    assert!(reports.is_empty() || found == expected, "{found:?}");
}

/// In the cube with P_r = 0.5, an inverted roulette and the mean give the right chance everywhere.
#[test]
fn only_a_roulette_that_is_right_later_gets_the_remark() {
    const DECIDES: &str = "(float)rand() / RAND_MAX >= pr";
    let reports = tells(&[
        (
            &[(DECIDES, "(float)rand() / RAND_MAX < pr")],
            &[(Scattering, Some("inverted-roulette"))],
            "",
        ),
        (&[(MAXIMUM, "(d.r + d.g + d.b) / 3")], &[(Scattering, Some("mean-roulette"))], ""),
        (
            &[(DECIDES, "(float)rand() / RAND_MAX >= pr && path.size() > 1")],
            &[(Scattering, Some("no-roulette"))],
            "",
        ),
    ]);
    let remarks = |report: &CheckReport| {
        let remarks = report.sections.iter().flat_map(|verdict| &verdict.remarks);
        remarks.filter(|remark| remark.contains("at the first hit of a path alone")).count()
    };
    let found: Vec<_> = reports.iter().map(remarks).collect();
    assert!(reports.is_empty() || found == [0, 0, 1], "{found:?}");
}

/// The probes find nothing in these. Only the first has the reference's numbers to the end; the
/// others are right, and draw a number more at every hit, or at late hits.
#[test]
fn a_roulette_that_is_wrong_later_is_found_by_the_whole_run() {
    const GROWS: &str = "path.push_back('D');";
    tells(&[
        (
            &[(
                MAXIMUM,
                "path.size() > 1 ? (d.r + d.g + d.b) / 3 : std::max(d.r, std::max(d.g, d.b))",
            )],
            &[(Scattering, Some("late-roulette"))],
            "records are not the reference's",
        ),
        (&[(GROWS, "path.push_back('D');\nif (path.size() > 1) rand();")], &[], ""),
        (&[(GROWS, "path.push_back('D');\nif (path.size() > 2) rand();")], &[], ""),
    ]);
}
