//! Right solutions pass in every section; a planted mistake is told under its section, with its
//! name.

mod support;

use std::fs;
use std::os::unix::fs::PermissionsExt as _;
use std::time::Duration;

use check::find::CppSubmission;
use check::kit::Kit;
use check::report::Builds;
use check::sections::Status;
use check::{CheckReport, CheckSettings, check};
use variants::section::Section;

use support::{faults, report, sections_text, submissions};

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

/// The report on a submission of these files, and on its folder.
fn report_on(files: &[(&str, Vec<u8>)]) -> Option<CheckReport> {
    let kit = support::kit()?;
    let folder = tempfile::tempdir().expect("a folder");
    for (path, content) in files {
        let path = folder.path().join(path);
        fs::create_dir_all(path.parent().expect("a folder")).expect("can be made");
        fs::write(path, content).expect("can be written");
    }
    let submission = CppSubmission::find(folder.path()).expect("a submission");
    let settings = CheckSettings { photons: 2000, ..CheckSettings::default() };
    Some(check(&submission, kit, &settings).expect("it can be checked"))
}

fn read(name: &str) -> String {
    fs::read_to_string(submissions().join("one_function").join(name)).expect("a file")
}

/// A whole checkout of the framework, with a helper of the student's own in another folder, in a
/// folder with a space in its name. Headers are included that nobody needs, or in other letters.
#[test]
fn a_checkout_brings_its_own_helpers() {
    let light = read("PointLight.cpp").replace("((float)rand() / RAND_MAX)", "RandFloat01()");
    let light = format!(
        "#include \"utility\\Utils.h\"\n#include <SDL2/SDL.h>\n\
         #include \"../Area/AreaLight.h\"\n{light}"
    );
    let area_light = "#pragma once\n#include \"common/Scene/Lights/Light.h\"\n\
                      class AreaLight : public Light { int Area() const override; };\n";
    let utils = "#include \"common/Utility/utils.h\"\n#include <cstdlib>\n\
                 float RandFloat01() { return rand() / (float)RAND_MAX; }\n";
    let of = |text: &str| text.as_bytes().to_vec();
    let report = report_on(&[
        ("my homework/common/Scene/Lights/Point/PointLight.cpp", of(&light)),
        (
            "my homework/common/Rendering/Renderer/Photon/PhotonMappingRenderer.cpp",
            of(&read("PhotonMappingRenderer.cpp")),
        ),
        ("my homework/common/Utility/utils.h", of("#pragma once\nfloat RandFloat01();\n")),
        ("my homework/common/Utility/utils.cpp", of(utils)),
        // What the framework has and the stand-in does not need is of no interest.
        ("my homework/common/Scene/Lights/Area/AreaLight.h", of(area_light)),
        ("my homework/common/Scene/Lights/Area/AreaLight.cpp", of("#error nor is this compiled\n")),
        ("my homework/main.cpp", of("#error this is not compiled\n")),
        ("my homework/common/common.h", of("#error nor is this read\n")),
    ]);
    let Some(report) = report else { return };
    assert_eq!(report.builds, Builds::Yes);
    let statuses: Vec<_> = report.sections.iter().map(|verdict| verdict.status).collect();
    assert_eq!(statuses, [Status::Right; 5], "{}", sections_text(&report));
    assert!(report.whole.is_reference(), "{:?}", report.whole.sentence(&report.sections));
    let remark = report.remarks.iter().find(|remark| remark.contains("SDL2/SDL.h"));
    assert!(remark.is_some_and(|remark| !remark.contains("Utils.h")), "{:?}", report.remarks);
}

/// Systems for handing in rename files, and some editors write UTF-16.
#[test]
fn renamed_files_in_utf_16_are_found() {
    let number = "(float)rand() / RAND_MAX >= pr";
    let renderer = read("PhotonMappingRenderer.cpp").replace(number, "rand() / RAND_MAX >= pr");
    let utf_16 = std::iter::once(0xfeff).chain(renderer.encode_utf16());
    let report = report_on(&[
        ("doe_PointLight-1.cpp", read("PointLight.cpp").into_bytes()),
        ("doe_Renderer.cpp", utf_16.flat_map(u16::to_le_bytes).collect()),
    ]);
    let Some(report) = report else { return };
    // Dividing two integers makes the roulette's number 0.
    let expected = [(Section::PhotonScatteringAbsorption, Some("no-roulette"))];
    assert_eq!(faults(&report), expected, "{}", sections_text(&report));
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

/// What lies outside of the submission is shown to nobody, whatever reads it.
#[test]
fn files_that_were_not_handed_in_are_not_read() {
    let Some(kit) = support::kit() else { return };
    let outside = tempfile::tempdir().expect("a folder");
    let secret = outside.path().join("secret.h");
    fs::write(&secret, "hunter2 = no_type;\n").expect("can be written");
    let secret = secret.display();
    let at_top = [
        format!("#include \"{secret}\"\n"),
        format!("#include \"/usr/include/../..{secret}\"\n"),
        format!("#define TEXT \"{secret}\"\n#include TEXT\n"),
        format!("#line 1 \"{secret}\"\nnonsense value;\n"),
        format!("#define TEXT(x) #x\nconst char* text = TEXT(\n#include \"{secret}\"\n);\n"),
        format!("#ifdef NO\n#endif\n#include \"{secret}\"\n#error stop\n"),
        format!("__asm__(\".incbin \\\"{secret}\\\"\");\n"),
        format!("__asm__(\".include \\\"{secret}\\\"\");\n"),
        format!("__asm__(\".macro m a\\n.inc\\\\a \\\"{secret}\\\"\\n.endm\\nm bin\");\n"),
        format!(
            "__attribute__((section(\".text\\n.incbin \\\"{secret}\\\"\\n.section a\")))\
                 void put() {{}}\n"
        ),
        "__asm__(\"no_such_instruction\");\n".to_owned(),
    ];
    for first in at_top {
        let folder = tempfile::tempdir().expect("a folder");
        for name in ["PointLight.cpp", "PhotonMappingRenderer.cpp"] {
            let file = submissions().join("one_function").join(name);
            let text = fs::read_to_string(file).expect("a file");
            let first = if name == "PointLight.cpp" { &*first } else { "" };
            fs::write(folder.path().join(name), format!("{first}{text}")).expect("can be written");
        }
        let submission = CppSubmission::find(folder.path()).expect("a submission");
        let settings = CheckSettings { photons: 100, ..CheckSettings::default() };
        let report = check(&submission, kit, &settings).expect("it can be checked");
        let Builds::No(error) = &report.builds else { panic!("{first} builds: {report:?}") };
        assert!(!format!("{report:?}").contains("hunter2"), "{first}: {report:?}");
        let is_told = ["not handed in", "assembler code", "nonsense", "not supported"];
        assert!(is_told.iter().any(|words| error.message.contains(words)), "{first}: {error:?}");
    }
}

#[test]
fn a_compiler_that_never_ends_is_ended() {
    let Some(kit) = support::kit() else { return };
    let endless = "template <int n, class T> struct Tree { static const int count = \
                   Tree<n - 1, T*>::count ^ Tree<n - 1, T[2]>::count; };\n\
                   template <class T> struct Tree<0, T> { static const int count = 1; };\n\
                   static const int count = Tree<40, char>::count;\n";
    let folder = tempfile::tempdir().expect("a folder");
    for name in ["PointLight.cpp", "PhotonMappingRenderer.cpp"] {
        fs::write(folder.path().join(name), endless).expect("can be written");
    }
    let submission = CppSubmission::find(folder.path()).expect("a submission");
    let time = Duration::from_secs(2);
    let settings = CheckSettings { time, ..CheckSettings::default() };
    let report = check(&submission, kit, &settings).expect("it can be checked");
    let told = report.builds.sentence();
    assert!(told.contains("needs more than 2 s of processor time"), "{told}");
}

#[test]
fn a_compiler_that_waits_for_a_busy_machine_has_time() {
    if support::kit().is_none() {
        return;
    }
    let mut kit = Kit::new(None).expect("there was one");
    let folder = tempfile::tempdir().expect("a folder");
    let slow = folder.path().join("slow");
    let script = format!(
        "#!/bin/sh\ncase \"$*\" in *PointLight.cpp) sleep 5;; esac\nexec {} \"$@\"\n",
        kit.compiler.display()
    );
    fs::write(&slow, script).expect("can be written");
    fs::set_permissions(&slow, fs::Permissions::from_mode(0o755)).expect("can be changed");
    kit.compiler = slow;
    let submission = CppSubmission::find(&submissions().join("one_function")).expect("one");
    let settings =
        CheckSettings { time: Duration::from_secs(4), photons: 100, ..CheckSettings::default() };
    let report = check(&submission, &kit, &settings).expect("it can be checked");
    assert_eq!(report.builds, Builds::Yes);
}
