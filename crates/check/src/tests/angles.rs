//! Angles in degrees and radians, whatever draws the numbers: known ones, or those of an engine.

use variants::section::Section;

use super::cases::{Change, Faults, program, tells, wrong};
use crate::plan::CALLS_AROUND;

const THETA: &str = "2.f * 3.14159265f * u2";
const LOOP: &str = "do {";
const NUMBER: &str = "(float)rand() / RAND_MAX";
const IN_DEGREES: Faults = &[(Section::HemisphereSampling, Some("angle-in-degrees"))];
/// As many directions show what 180 degrees leave: twelve standard deviations.
const FOR_180: u64 = 500_000;
/// As many show a gap of a hundredth of the circle: twice the limit.
const FOR_GAP: u64 = 200_000;
const LOOKS_LIKE_360: &str = "theta looks like degrees, 360 times";
const LOOKS_LIKE_180: &str = "theta looks like degrees, 180 times";

/// One engine for all calls.
const STATIC_ENGINE: &str = "static std::mt19937 engine(std::random_device{}());
    static std::uniform_real_distribution<float> uniform(0.f, 1.f);
    return uniform(engine);";
/// An engine for every number.
const NEW_ENGINE: &str = "std::random_device device;
    std::default_random_engine engine(device());
    return std::uniform_real_distribution<double>(0., 1.)(engine);";
/// A new state of a large engine takes longer than all else.
const NEW_LARGE_ENGINE: &str = "std::random_device device;
    std::mt19937 engine(device());
    return std::uniform_real_distribution<float>(0.f, 1.f)(engine);";
/// What is printed a million times is too much.
const PRINTING: &str = "std::puts(\"a line for every number\");
    static std::mt19937 engine;
    return engine() / 4294967296.0;";
/// No engine at all.
const DEVICE: &str = "std::random_device device;
    return std::generate_canonical<double, 53>(device);";

/// Directions of the light in polar coordinates, with phi in degrees.
const AROUND_Z: &str = "z = 2.f * ((float)rand() / RAND_MAX) - 1.f;
    sum = 360.f * ((float)rand() / RAND_MAX);
    x = std::sqrt(1.f - z * z) * std::cos(sum);
    y = std::sqrt(1.f - z * z) * std::sin(sum);
    ray.SetRayPosition(glm::vec3(GetPosition()));
    ray.SetRayDirection(glm::normalize(glm::vec3(x, y, z)));
    return;
    do {";
/// phi around an axis other than z.
const AROUND_Y: &str = "y = 2.f * (float)rand() / RAND_MAX - 1.f;
    sum = 360.f * (float)rand() / RAND_MAX;
    z = std::sqrt(1.f - y * y) * std::cos(sum);
    x = std::sqrt(1.f - y * y) * std::sin(sum);
    ray.SetRayPosition(glm::vec3(GetPosition()));
    ray.SetRayDirection(glm::normalize(glm::vec3(x, y, z)));
    return;
    do {";

/// Degrees go around 57 times, which looks even: only the numbers drawn tell.
#[test]
fn angles_from_known_numbers_are_told() {
    let reports = tells(&[
        (
            &[(THETA, "360 * u2"), (LOOP, AROUND_Z)],
            &[
                (Section::PhotonEmission, Some("angle-in-degrees")),
                (Section::HemisphereSampling, Some("angle-in-degrees")),
            ],
            "",
        ),
        // With pi = 3.14, no photon lands where anyone could see it.
        (&[("3.14159265f", "3.14f")], &[], ""),
    ]);
    let Some(report) = reports.last() else { return };
    let remarks = &report.sections[3].remarks;
    assert!(remarks.iter().any(|remark| remark.contains("digits of pi")), "{remarks:?}");
}

/// The numbers of an engine are unknown: only millions of directions tell.
#[test]
fn angles_are_told_whatever_draws_them() {
    let cases: [(&str, Change, u64, Faults, &str); 15] = [
        (STATIC_ENGINE, (THETA, "360 * u2"), CALLS_AROUND, IN_DEGREES, LOOKS_LIKE_360),
        (STATIC_ENGINE, (THETA, "180.f * u2"), FOR_180, IN_DEGREES, LOOKS_LIKE_180),
        (NEW_ENGINE, (THETA, "360 * u2"), CALLS_AROUND, IN_DEGREES, LOOKS_LIKE_360),
        (NEW_ENGINE, (THETA, "180 * u2"), FOR_180, IN_DEGREES, LOOKS_LIKE_180),
        (DEVICE, (THETA, "-360.0 * u2"), CALLS_AROUND, IN_DEGREES, LOOKS_LIKE_360),
        (PRINTING, (THETA, "360 * u2"), CALLS_AROUND, IN_DEGREES, LOOKS_LIKE_360),
        // The light's, beside the right theta.
        (
            STATIC_ENGINE,
            (LOOP, AROUND_Y),
            CALLS_AROUND,
            &[(Section::PhotonEmission, Some("angle-in-degrees"))],
            "looks like degrees",
        ),
        // A gap too narrow for a few thousand directions.
        (
            STATIC_ENGINE,
            (THETA, "2 * 3.1f * u2"),
            FOR_GAP,
            &[(Section::HemisphereSampling, Some("not-even-around"))],
            "",
        ),
        (STATIC_ENGINE, (THETA, THETA), FOR_GAP, &[], ""),
        (STATIC_ENGINE, (THETA, "2 * 3.14 * u2"), FOR_GAP, &[], ""),
        (NEW_ENGINE, (THETA, "2 * 3.14 * u2"), FOR_GAP, &[], ""),
        (NEW_LARGE_ENGINE, (THETA, "2 * M_PI * u2"), FOR_GAP, &[], ""),
        (DEVICE, (THETA, "2 * 3.14 * u2"), FOR_GAP, &[], ""),
        (
            "static std::mt19937 engine; return engine() % 100 / 100.f;",
            (THETA, "2 * M_PI * u2"),
            CALLS_AROUND,
            &[],
            "",
        ),
        ("return rand() % 100 / 100.f;", (THETA, "2 * M_PI * u2"), FOR_GAP, &[], ""),
    ];
    let [light, renderer] = [
        "#include \"common/Scene/Lights/Point/PointLight.h\"",
        "#include \"common/Rendering/Renderer/Photon/PhotonMappingRenderer.h\"",
    ];
    let define = |include: &str, draw: &str| {
        format!(
            "{include}\n#include <cmath>\n#include <cstdio>\n#include <random>\n\
             static float Draw() {{ {draw} }}\n"
        )
    };
    let defined = cases.map(|(draw, ..)| [define(light, draw), define(renderer, draw)]);
    let changes = std::array::from_fn::<[Change; 4], 15, _>(|case| {
        let [of_light, of_renderer] = &defined[case];
        [(light, of_light), (renderer, of_renderer), cases[case].1, (NUMBER, "Draw()")]
    });
    let Some(program) = program(&changes) else { return };
    for (case, (draw, change, around, expected, words)) in cases.into_iter().enumerate() {
        let wrong = wrong(&program.report(case, around), expected, words);
        assert_eq!(wrong, None, "{draw}: {change:?}");
    }
}

/// A large engine made in every call is slow: on a busy machine, too slow for 360 degrees.
#[test]
fn angles_in_degrees_are_told_of_engines_made_in_every_call() {
    let engine = "std::random_device device;
    std::mt19937 engine(device());
    std::uniform_real_distribution<float> uniform(0.f, 1.f);
    const Material* material";
    let changes = [
        ("#include <ctime>", "#include <ctime>\n#include <random>"),
        ("const Material* material", engine),
        ("if ((float)rand() / RAND_MAX", "if (uniform(engine)"),
        ("u1 = (float)rand() / RAND_MAX", "u1 = uniform(engine)"),
        ("u2 = (float)rand() / RAND_MAX", "u2 = uniform(engine)"),
        (THETA, "180 * u2"),
    ];
    let Some(program) = program(&[changes]) else { return };
    assert_eq!(wrong(&program.report(0, FOR_180), IN_DEGREES, LOOKS_LIKE_180), None);
}
