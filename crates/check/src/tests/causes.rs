//! One mistake is told once, under its section, with its cause.

use Section::{
    HemisphereRayTransformation as Transformation, HemisphereSampling as Sampling,
    PhotonEmission as Emission, PhotonScatteringAbsorption as Scattering, PhotonStorage as Storage,
};
use variants::section::Section;

use super::cases::{Faults, tells};

const U1: &str = "u1 = (float)rand() / RAND_MAX";
const U2: &str = "u2 = (float)rand() / RAND_MAX";
const PR: &str = "const float pr";
const FRAME: &str = "glm::mat3(t, b, n)";
const START: &str = "hit + 1e-5f * n";
const POSITION: &str = "photon.position = hit;";
const INCLUDE: &str = "#include \"common/Scene/Lights/Point/PointLight.h\"";
const TIME: &str = "#include \"common/Scene/Lights/Point/PointLight.h\"\n#include <ctime>";
const VARIABLES: &str = "float x, y, z, sum;";
const PERMUTED: Faults = &[(Transformation, Some("permuted-frame"))];
const POSITIONED: Faults = &[(Storage, Some("wrong-position"))];
const BELOW: Faults = &[(Transformation, Some("offset-below"))];

#[test]
fn one_mistake_is_told_once_with_its_cause() {
    let reports = tells(&[
        // With a real `srand`, all photons of a second are alike.
        (
            &[(INCLUDE, TIME), (VARIABLES, "srand((unsigned)time(NULL));\nfloat x, y, z, sum;")],
            &[(Emission, Some("seeded-again"))],
            "once",
        ),
        (
            &[("Ray photonRay;", "Ray photonRay;\nsrand(42);")],
            &[(Emission, Some("seeded-again"))],
            "once",
        ),
        (
            &[(PR, "srand(time(NULL));\nconst float pr")],
            &[(Scattering, Some("seeded-again"))],
            "once",
        ),
        (
            &[("const float u1", "srand48(1);\nconst float u1")],
            &[(Scattering, Some("seeded-again"))],
            "once",
        ),
        // Once is right, and so are numbers that change.
        (
            &[(
                PR,
                "static bool seeded = false;\nif (!seeded) { srand(time(NULL)); seeded = true; }\n\
                 const float pr",
            )],
            &[],
            "",
        ),
        (&[(PR, "srand(rand());\nconst float pr")], &[], ""),
        // Whatever their signs, the columns are in another order.
        (&[(FRAME, "glm::mat3(n, t, -b)")], PERMUTED, "columns"),
        (&[(FRAME, "glm::mat3(t, n, b)")], PERMUTED, "columns"),
        (&[(FRAME, "glm::mat3(n, b, -t)")], PERMUTED, "columns"),
        (&[(FRAME, "glm::mat3(b, n, -t)")], PERMUTED, "columns"),
        (&[(FRAME, "glm::mat3(-n, -t, -b)")], PERMUTED, "columns"),
        (&[(FRAME, "glm::mat3(-t, n, -b)")], PERMUTED, "columns"),
        (
            &[("glm::mat3(t, b, n) * sample", "sample")],
            &[(Transformation, Some("not-transformed"))],
            "tangent space",
        ),
        // A constant number is no matter of the frame.
        (&[(U1, "u1 = 0.5f")], &[(Sampling, None)], "angle to the normal"),
        (&[(U1, "u1 = 0.03f")], &[(Sampling, None)], "angle to the normal"),
        (
            &[(U1, "u1 = 0.3f"), (U2, "u2 = 0.7f")],
            &[(Sampling, Some("same-direction"))],
            "are the same",
        ),
        (
            &[(POSITION, "photon.position = hit + 0.01f * state.ComputeNormal();")],
            POSITIONED,
            "along the normal",
        ),
        (
            &[(POSITION, "photon.position = hit - 0.2f * state.ComputeNormal();")],
            POSITIONED,
            "along the normal",
        ),
        (
            &[(POSITION, "photon.position = glm::vec3(photonRay->GetPosition());")],
            POSITIONED,
            "start of its ray",
        ),
        (
            &[(POSITION, "photon.position = photonRay->GetRayDirection();")],
            POSITIONED,
            "GetRayPosition",
        ),
        (
            &[(POSITION, "photon.position = state.intersectionRay.GetRayPosition(1.f);")],
            POSITIONED,
            "GetRayPosition",
        ),
        (&[(START, "hit - 1e-5f * n")], BELOW, "below the surface"),
        (&[(START, "hit - 1e-3f * n")], BELOW, "below the surface"),
        (&[(START, "hit + 1e-4f * photonRay->GetRayDirection()")], BELOW, "below the surface"),
        (&[(START, "hit")], &[(Transformation, Some("no-offset"))], "missing or too short"),
        // The positions tell what is right; the intensities cost nothing.
        (
            &[
                ("> 0.99f", "> 0.9f"),
                (
                    "TracePhoton(photonMap, &scattered, light",
                    "TracePhoton(photonMap, &scattered, d / pr * light",
                ),
            ],
            &[],
            "",
        ),
    ]);
    let Some(report) = reports.last() else { return };
    assert!(report.whole.is_reference(), "{}", report.whole.sentence(&report.sections));
    assert!(report.remarks.iter().any(|remark| remark.contains("intensities are not")));
}
