//! Angles in degrees and radians, whatever draws the numbers: known ones, or those of an engine.

use variants::section::Section;

use super::{faults, report, sections_text};
use crate::report::{Builds, CheckReport};

/// Degrees go around 57 times, which looks even: only the numbers drawn tell.
#[test]
fn angles_in_degrees_are_told() {
    let loop_begins = "do {";
    let polar = "z = 2.f * ((float)rand() / RAND_MAX) - 1.f;
    sum = 360.f * ((float)rand() / RAND_MAX);
    x = std::sqrt(1.f - z * z) * std::cos(sum);
    y = std::sqrt(1.f - z * z) * std::sin(sum);
    ray.SetRayPosition(glm::vec3(GetPosition()));
    ray.SetRayDirection(glm::normalize(glm::vec3(x, y, z)));
    return;
    do {";
    let Some(report) = report(&[(THETA, "360 * u2"), (loop_begins, polar)]) else { return };
    let expected = [
        (Section::PhotonEmission, Some("angle-in-degrees")),
        (Section::HemisphereSampling, Some("angle-in-degrees")),
    ];
    assert_eq!(faults(&report), expected, "{}", sections_text(&report));
}

const THETA: &str = "2.f * 3.14159265f * u2";

/// The report on `one_function` with numbers from `draw`, and one more change.
fn report_with_random(draw: &str, change: (&str, &str)) -> Option<CheckReport> {
    let [light, renderer] = [
        "#include \"common/Scene/Lights/Point/PointLight.h\"",
        "#include \"common/Rendering/Renderer/Photon/PhotonMappingRenderer.h\"",
    ];
    let define = |include: &str| {
        format!(
            "{include}\n#include <cmath>\n#include <cstdio>\n#include <random>\n\
             static float Draw() {{ {draw} }}\n"
        )
    };
    let report = report(&[
        (light, &define(light)),
        (renderer, &define(renderer)),
        ("(float)rand() / RAND_MAX", "Draw()"),
        change,
    ])?;
    assert_eq!(report.builds, Builds::Yes);
    Some(report)
}

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

/// The numbers of an engine are unknown: only millions of directions tell.
#[test]
fn angles_in_degrees_are_told_whatever_draws_them() {
    let cases = [
        (STATIC_ENGINE, "360 * u2", "360"),
        (STATIC_ENGINE, "180.f * u2", "180"),
        (NEW_ENGINE, "360 * u2", "360"),
        (NEW_ENGINE, "180 * u2", "180"),
        (DEVICE, "-360.0 * u2", "360"),
        (PRINTING, "360 * u2", "360"),
    ];
    for (draw, theta, words) in cases {
        let Some(report) = report_with_random(draw, (THETA, theta)) else { return };
        let expected = [(Section::HemisphereSampling, Some("angle-in-degrees"))];
        assert_eq!(faults(&report), expected, "{draw}: {}", sections_text(&report));
        let found = &report.sections[3].faults[0].found;
        assert!(found.contains(words) && found.contains("looks like degrees"), "{found}");
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
        ("2.f * 3.14159265f * u2", "180 * u2"),
    ];
    let Some(report) = report(&changes) else { return };
    let expected = [(Section::HemisphereSampling, Some("angle-in-degrees"))];
    assert_eq!(faults(&report), expected, "{}", sections_text(&report));
}

/// phi around an axis other than z, beside the right theta.
#[test]
fn angles_of_the_light_in_degrees_are_told_whatever_draws_them() {
    let polar = "y = 2.f * (float)rand() / RAND_MAX - 1.f;
    sum = 360.f * (float)rand() / RAND_MAX;
    z = std::sqrt(1.f - y * y) * std::cos(sum);
    x = std::sqrt(1.f - y * y) * std::sin(sum);
    ray.SetRayPosition(glm::vec3(GetPosition()));
    ray.SetRayDirection(glm::normalize(glm::vec3(x, y, z)));
    return;
    do {";
    let polar = polar.replace("(float)rand() / RAND_MAX", "Draw()");
    let Some(report) = report_with_random(STATIC_ENGINE, ("do {", &polar)) else { return };
    let expected = [(Section::PhotonEmission, Some("angle-in-degrees"))];
    assert_eq!(faults(&report), expected, "{}", sections_text(&report));
}

#[test]
fn angles_in_radians_are_right_whatever_draws_them() {
    let cases = [
        (STATIC_ENGINE, "2.f * 3.14159265f * u2"),
        (STATIC_ENGINE, "2 * 3.14 * u2"),
        (NEW_ENGINE, "2 * 3.14 * u2"),
        (NEW_LARGE_ENGINE, "2 * M_PI * u2"),
        (DEVICE, "2 * 3.14 * u2"),
        ("static std::mt19937 engine; return engine() % 100 / 100.f;", "2 * M_PI * u2"),
        ("return rand() % 100 / 100.f;", "2 * M_PI * u2"),
    ];
    for (draw, theta) in cases {
        let Some(report) = report_with_random(draw, (THETA, theta)) else { return };
        assert_eq!(faults(&report), [], "{draw} {theta}: {}", sections_text(&report));
    }
}

/// A gap too narrow for a few thousand directions.
#[test]
fn a_gap_around_the_normal_is_told_whatever_draws_the_numbers() {
    let Some(report) = report_with_random(STATIC_ENGINE, (THETA, "2 * 3.1f * u2")) else { return };
    let expected = [(Section::HemisphereSampling, Some("not-even-around"))];
    assert_eq!(faults(&report), expected, "{}", sections_text(&report));
}

/// With pi = 3.14, no photon lands where anyone could see it.
#[test]
fn a_short_pi_costs_nothing() {
    let Some(report) = report(&[("3.14159265f", "3.14f")]) else { return };
    assert_eq!(faults(&report), [], "{}", sections_text(&report));
    let remarks = &report.sections[3].remarks;
    assert!(remarks.iter().any(|remark| remark.contains("digits of pi")), "{remarks:?}");
}
