//! C++ against the reference: the headers of `interop/cpp`, and `compare` on lists made with them.

use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::OnceLock;

use crate::support::{folder, json, run_line};
use photon_list::reader::load;
use photon_list::record::Columns;
use photon_mapping::random::photon_random;

const PHOTONS: &str = "60000";

/// Compiles `source` of `interop/cpp` into `folder`; `None`, with a message, where there is no
/// compiler. In CI there must be one.
fn compile(source: &str, folder: &Path) -> Option<PathBuf> {
    compile_file(&headers().join(source), folder)
}

/// The program `by_the_handout`, compiled once for all tests.
pub fn by_the_handout() -> Option<&'static Path> {
    static PROGRAM: OnceLock<Option<(tempfile::TempDir, PathBuf)>> = OnceLock::new();
    let program = PROGRAM.get_or_init(|| {
        let folder = folder();
        let program = compile("by_the_handout.cpp", folder.path())?;
        Some((folder, program))
    });
    program.as_ref().map(|(_, program)| program.as_path())
}

fn headers() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../interop/cpp")
}

fn compile_file(source: &Path, folder: &Path) -> Option<PathBuf> {
    let program = folder.join(source.file_stem().expect("a file"));
    let compiled = Command::new("g++")
        .arg("-I")
        .arg(headers())
        .args(["-std=c++11", "-O2", "-ffp-contract=off", "-Wall", "-Wextra", "-pedantic"])
        .args(["-Werror", "-o"])
        .args([&program, source])
        .output();
    match compiled {
        Ok(output) => {
            assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
            Some(program)
        }
        Err(error) if std::env::var_os("CI").is_some_and(|ci| ci == "true") => {
            panic!("g++ cannot be run, and CI is set: {error}")
        }
        Err(error) => {
            eprintln!("skipped: g++ cannot be run ({error}); nothing of interop/cpp was tested");
            None
        }
    }
}

/// The list that `by_the_handout` writes with `arguments`.
fn list(program: &Path, folder: &Path, arguments: &[&str]) -> PathBuf {
    let path = folder.join("submission.csv");
    let output = Command::new(program)
        .args(["--seed", "148", "--photons", PHOTONS, "--out"])
        .arg(&path)
        .args(arguments)
        .output()
        .expect("the program runs");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    path
}

#[test]
fn the_header_draws_the_references_numbers() {
    let folder = folder();
    let Some(program) = compile("stream_test.cpp", folder.path()) else { return };
    let seeds = [0, 1, 148, u64::from(u32::MAX), 1 << 32, u64::MAX];
    let streams = [0, 1, 2, 999_999, u64::from(u32::MAX), (1 << 40) + 7];
    // Beyond one block of 16 words, and beyond four, which many implementations compute at once.
    let counts = [1, 16, 17, 64, 300];
    let mut requests = String::new();
    let mut expected = String::new();
    for seed in seeds {
        for stream in streams {
            for count in counts {
                requests += &format!("{seed} {stream} {count}\n");
                let mut rand = photon_random(seed, stream);
                let draws: Vec<_> = (0..count)
                    .map(|_| ((f64::from(rand()) * 2_147_483_648.0) as i64).to_string())
                    .collect();
                expected += &(draws.join(" ") + "\n");
            }
        }
    }
    for mode in ["--rand", "--floats"] {
        let mut child = Command::new(&program)
            .arg(mode)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .expect("the program runs");
        let mut input = child.stdin.take().expect("stdin is piped");
        let requests = requests.clone();
        let writer = std::thread::spawn(move || input.write_all(requests.as_bytes()));
        let output = child.wait_with_output().expect("the program ends");
        writer.join().expect("the writer ends").expect("all requests are read");
        // With --floats the program itself tries the divisions that students write.
        assert!(output.status.success(), "{mode}");
        if mode == "--rand" {
            assert!(String::from_utf8_lossy(&output.stdout) == expected, "the numbers differ");
        }
    }
}

#[test]
fn a_solution_by_the_handout_agrees() {
    let folder = folder();
    let Some(program) = by_the_handout() else { return };
    let list = list(program, folder.path(), &[]);
    let line = "compare --json --seed 148 --photons {} {}";
    let report = json(run_line(line, &[Path::new(PHOTONS), &list]));
    let count = |name: &str| report[name].as_u64().expect("a count");
    assert!(count("reference_records") > 2000);
    assert!(1000 * count("matched") >= 999 * count("reference_records"), "{report}");
    assert!(1000 * count("extra") <= count("reference_records"), "{report}");
    assert_eq!((count("wrong_intensity"), count("wrong_to_light")), (0, 0));
}

/// Vectors with [] instead of .x .y .z, and a ray instead of a direction, as the framework has it.
const OTHER_TYPES: &str = r#"
#include <limits>
#include "photon_dump.hpp"
struct Vector { float v[3]; float operator[](int i) const { return v[i]; } };
struct Ray { Vector direction; Vector GetRayDirection() { return direction; } };
struct Photon { Vector position, intensity; Ray toLightRay; };
int main(int, char** argv) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const std::vector<Photon> photons = {{{{0.1f, -2, 1e-30f}}, {{1e-6f, 1, 2}}, {{{0, 0, -1}}}},
                                         {{{-nan, 0, 0}}, {{1, 1, 1}}, {{{0, 1, 0}}}}};
    photon_dump::PhotonDump recorder;
    recorder.begin_photon(4000000000u);
    recorder.store(photons[0], 3);
    recorder.store(photons[1], 1);
    return photon_dump::dump(photons, argv[1]) && recorder.write(argv[2]) ? 0 : 1;
}
"#;

#[test]
fn photons_of_other_types_are_written() {
    let folder = folder();
    let source = folder.path().join("other_types.cpp");
    std::fs::write(&source, OTHER_TYPES).expect("can be written");
    let Some(program) = compile_file(&source, folder.path()) else { return };
    let (plain, numbered) = (folder.path().join("plain.csv"), folder.path().join("numbered.csv"));
    let status = Command::new(program).args([&plain, &numbered]).status();
    assert!(status.expect("the program runs").success());
    let (plain, numbered) = (load(&plain).expect("a list"), load(&numbered).expect("a list"));
    assert!(plain.columns.to_light && !plain.columns.photon && numbered.columns == Columns::ALL);
    for list in [&plain, &numbered] {
        assert_eq!(list.records[0].position.to_array(), [0.1, -2.0, 1e-30]);
        assert_eq!(list.records[0].intensity.to_array(), [1e-6, 1.0, 2.0]);
        assert_eq!(list.records[0].to_light.to_array(), [0.0, 0.0, -1.0]);
        assert!(list.records[1].position.x.is_nan());
    }
    let numbers = |place: usize| {
        let record = &numbered.records[place];
        (record.photon, record.bounce, record.surface)
    };
    assert_eq!((numbers(0), numbers(1)), ((4_000_000_000, 1, 3), (4_000_000_000, 2, 1)));
}

/// What students write around rand().
const OTHER_CALLS: &str = r#"
#include <algorithm>
#include "photon_dump.hpp"
#define REFERENCE_RAND_REPLACES_RAND
#include "reference_rand.hpp"
struct Vector { float x, y, z; };
struct Photon { Vector position, intensity, toLightRay; };
float rand(float a, float b) { return a + (b - a) * rand() / RAND_MAX; }
struct Sampler { float rand() { return 0.5f; } };
int main(int, char** argv) {
    reference_rand::begin_photon(148, 0);
    int numbers[4];
    std::generate(numbers, numbers + 2, std::rand);
    int (*draw)() = &std::rand;
    numbers[2] = draw();
    reference_rand::begin_photon(148, 0);
    const bool is_same = numbers[0] == rand() && numbers[1] == std::rand() &&
                         numbers[2] == reference_rand::rand();
    const Photon photon = {{rand(1, 2), Sampler().rand(), 0}, {1, 1, 1}, {0, 0, 1}};
    photon_dump::PhotonDump recorder;
    recorder.begin_photon(0);
    recorder.store(&photon);
    reference_rand::begin_photon(148, 1);
    reference_rand::begin_photon(148, 2);
    const float numbers_of_emission[] = {rand(0, 1), rand(0, 1), rand(0, 1)};
    recorder.begin_photon(2);
    recorder.store(photon);
    recorder.store(photon);
    (void)numbers_of_emission;
    return is_same && recorder.write(argv[1]) ? 0 : 1;
}
"#;

#[test]
fn rand_is_replaced_however_it_is_written_and_numbers_from_elsewhere_are_told() {
    let folder = folder();
    let source = folder.path().join("other_calls.cpp");
    std::fs::write(&source, OTHER_CALLS).expect("can be written");
    let Some(program) = compile_file(&source, folder.path()) else { return };
    let list = folder.path().join("list.csv");
    let output = Command::new(program).arg(&list).output().expect("the program runs");
    assert!(output.status.success());
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(errors.contains("photon 1 drew no number"), "{errors}");
    assert!(errors.contains("photon 2 is stored at bounce 2 after 3 numbers"), "{errors}");
    assert!(!errors.contains("photon 0"), "{errors}");
    assert!((1.0..2.0).contains(&load(&list).expect("a list").records[0].position.x));
}

const MISTAKES: [(&str, &str, &str); 19] = [
    ("direct-stored", "1000", "Photon Storage"),
    ("bounce-off-by-one", "3", "Photon Storage"),
    ("no-offset", "1000", "Hemisphere Ray Transformation"),
    ("no-absolute-value", "1000", "Hemisphere Ray Transformation"),
    ("nan-frame", "1000", "Hemisphere Ray Transformation"),
    ("transposed-frame", "1000", "Hemisphere Ray Transformation"),
    ("transposed-twice", "1000", "Hemisphere Ray Transformation"),
    ("flipped-normal", "1000", "Hemisphere Ray Transformation"),
    ("along-normal", "1000", "Hemisphere Ray Transformation"),
    ("starts-at-light", "1000", "Hemisphere Ray Transformation"),
    ("uniform-hemisphere", "1000", "Hemisphere Sampling"),
    ("no-square-root", "1000", "Hemisphere Sampling"),
    ("mean-roulette", "1000", "Photon Scattering/Absorption"),
    ("red-roulette", "1000", "Photon Scattering/Absorption"),
    ("no-roulette", "5", "Photon Scattering/Absorption"),
    ("unit-roulette", "1000", "Photon Scattering/Absorption"),
    ("inverted-roulette", "1000", "Photon Scattering/Absorption"),
    ("cube-directions", "1000", "Photon Emission"),
    ("octant", "1000", "Photon Emission"),
];

#[test]
fn the_section_of_every_mistake_is_named() {
    let folder = folder();
    let Some(program) = by_the_handout() else { return };
    for (mistake, max_bounces, section) in MISTAKES {
        let arguments = ["--mistake", mistake, "--max-bounces", max_bounces];
        let list = list(program, folder.path(), &arguments);
        let line = "compare --json --seed 148 --photons {} --max-bounces {} {}";
        let paths = [Path::new(PHOTONS), Path::new(max_bounces), &list];
        let report = json(run_line(line, &paths).code(1));
        let divergence = &report["first_divergence"];
        assert_eq!(divergence["section"], section, "{mistake}: {divergence}");
        assert_eq!(divergence["certain"], true, "{mistake}: {divergence}");
        assert!(divergence["photon"].is_u64() && divergence["bounce"].is_u64(), "{mistake}");
        assert!(report["reading"].is_null(), "{mistake} is no fair reading: {report}");
        assert_eq!(report["random_numbers"], "same", "{mistake}: {report}");
    }
}

const READINGS: [(&str, &str); 15] = [
    ("--reading literal", "t and b to the letter of the handout, not normalized"),
    (
        "--threshold 0.7",
        "the fallback axis in equation (7) at absolute dot products of 0.9536 or more (not at \
         0.3011)",
    ),
    ("--reading axis-z", "fallback axis (0, 0, 1)"),
    ("--reading first-axis-y", "the axis (0, 1, 0) in equation (7)"),
    ("--reading exchanged", "t and b exchanged"),
    ("--reading other-frame", "another frame of unit vectors around the normal"),
    ("--reading u2-first", "at each hit, the roulette's number, u2, u1 drawn in this order"),
    ("--reading zyx", "in each try, z, y, x drawn in this order"),
    ("--offset-normal 1e-4", "offset 1e-4 along the normal"),
    ("--offset-normal 0 --offset-direction 1e-4", "offset along the new direction"),
    (
        "--offset-normal 0 --offset-direction 1e-3 --pull-back 1e-3",
        "offset 1e-3 back along the ray, positions stored 1e-3 back along the ray",
    ),
    (
        "--threshold 0.8 --offset-normal 1e-3",
        "the fallback axis in equation (7) at absolute dot products of 0.9536 or more (not at \
         0.3011), offset 1e-3 along the normal",
    ),
    (
        "--threshold 0.7 --offset-normal 1e-3",
        "the fallback axis in equation (7) at absolute dot products of 0.9536 or more (not at \
         0.3011), offset 1e-3 along the normal",
    ),
    (
        "--threshold 0.8 --offset-normal 0 --offset-direction 1e-5",
        "the fallback axis in equation (7) at absolute dot products of 0.9536 or more (not at \
         0.3011), offset along the new direction",
    ),
    (
        "--reading literal --offset-normal 0 --offset-back 6.7e-3",
        "t and b to the letter of the handout, not normalized, offset 6.7e-3 back along the ray",
    ),
];

#[test]
fn fair_readings_count_as_the_same_and_are_named() {
    let folder = folder();
    let Some(program) = by_the_handout() else { return };
    for (arguments, name) in READINGS {
        let list = list(program, folder.path(), &arguments.split(' ').collect::<Vec<_>>());
        let line = "compare --json --seed 148 --photons {} {}";
        let report = json(run_line(line, &[Path::new(PHOTONS), &list]).code(0));
        assert_eq!(report["outcome"], "same-under-another-reading", "{arguments}: {report}");
        assert_eq!(report["reading"], name, "{arguments}");
        let count = |name: &str| report[name].as_u64().expect("a count");
        assert!(100 * count("reading_matched") >= 98 * count("reading_tried"), "{arguments}");
        assert_ne!(report["first_divergence"]["certain"], false, "{arguments}");
    }
    let list = list(program, folder.path(), &["--reading", "exchanged"]);
    let line = "compare --strict --seed 148 --photons {} {}";
    run_line(line, &[Path::new(PHOTONS), &list]).code(1);
}

/// Whoever reads the handout in another way may still have made a mistake.
#[test]
fn a_mistake_is_found_behind_a_fair_reading() {
    let folder = folder();
    let Some(program) = by_the_handout() else { return };
    for (arguments, reading, section) in [
        (
            "--mistake unit-roulette --reading first-axis-y",
            "the axis (0, 1, 0) in equation (7)",
            "Photon Scattering/Absorption",
        ),
        (
            "--mistake unit-roulette --reading other-frame",
            "another frame of unit vectors around the normal",
            "Photon Scattering/Absorption",
        ),
        (
            "--mistake mean-roulette --reading literal --offset-normal 1e-3",
            "t and b to the letter of the handout, not normalized, offset 1e-3 along the normal",
            "Photon Scattering/Absorption",
        ),
    ] {
        let list = list(program, folder.path(), &arguments.split(' ').collect::<Vec<_>>());
        let line = "compare --json --seed 148 --photons {} {}";
        let report = json(run_line(line, &[Path::new(PHOTONS), &list]).code(1));
        assert_eq!(report["reading"], reading, "{report}");
        assert_eq!(report["first_divergence"]["section"], section, "{report}");
    }
}

/// What a submission does, how many photons it emits, and the fair reading or the section to name.
/// With more photons, more are mistaken for another.
const WITHOUT_PHOTONS: [(&str, &str, Result<&str, &str>); 12] = [
    (
        "--reading literal --offset-normal 0 --offset-back 6.7e-3",
        "1000000",
        Ok("t and b to the letter of the handout, not normalized, offset 6.7e-3 back along \
            the ray"),
    ),
    ("--mistake transposed-twice", "1000000", Err("Hemisphere Ray Transformation")),
    (
        "--offset-normal 0 --offset-direction 1e-3 --pull-back 1e-3",
        "200000",
        Ok("offset 1e-3 back along the ray, positions stored 1e-3 back along the ray"),
    ),
    ("--reading exchanged", "200000", Ok("t and b exchanged")),
    (
        "--reading literal --offset-normal 3e-3",
        "200000",
        Ok("t and b to the letter of the handout, not normalized, offset 3e-3 along the normal"),
    ),
    (
        "--reading u2-first --offset-normal 0 --offset-back 2e-3",
        "200000",
        Ok("at each hit, the roulette's number, u2, u1 drawn in this order, offset 2e-3 back \
            along the ray"),
    ),
    (
        "--mistake unit-roulette --reading literal --offset-normal 0 --offset-back 6.7e-3",
        "200000",
        Err("Photon Scattering/Absorption"),
    ),
    (
        "--mistake transposed-twice --offset-normal 1e-3",
        "200000",
        Err("Hemisphere Ray Transformation"),
    ),
    ("--mistake starts-at-light", "200000", Err("Hemisphere Ray Transformation")),
    ("--mistake direct-stored", "200000", Err("Photon Storage")),
    ("--mistake no-offset", "200000", Err("Hemisphere Ray Transformation")),
    ("--mistake uniform-hemisphere", "200000", Err("Hemisphere Sampling")),
];

/// Of what the framework's own photons tell, NaN leaves nothing to follow but the order.
#[test]
fn positions_that_are_no_numbers_have_their_section_without_photons() {
    let folder = folder();
    let Some(program) = by_the_handout() else { return };
    let list = list(program, folder.path(), &["--mistake", "nan-frame"]);
    let text = std::fs::read_to_string(&list).expect("a list");
    for columns in [3, 9] {
        let kept = |line: &str| line.split(',').take(columns).collect::<Vec<_>>().join(",");
        let untold = folder.path().join("untold.csv");
        let lines: Vec<_> = text.lines().map(kept).collect();
        std::fs::write(&untold, lines.join("\n")).expect("can be written");
        let line = "compare --json --seed 148 --photons {} {}";
        let report = json(run_line(line, &[Path::new(PHOTONS), &untold]).code(1));
        let divergence = &report["first_divergence"];
        assert_eq!(divergence["section"], "Hemisphere Ray Transformation", "{divergence}");
        assert_eq!(divergence["certain"], true, "{divergence}");
        let reason = divergence["reason"].as_str().expect("a reason");
        assert!(reason.contains("(-1, 0, 0) is parallel to (1, 0, 0)"), "{reason}");
    }
}

/// A list as the framework's tree gives it has another order, and no photons.
#[test]
fn lists_without_photons_are_compared_by_their_directions() {
    let folder = folder();
    let Some(program) = by_the_handout() else { return };
    let compared = |arguments: &str, photons: &str| {
        let mut arguments: Vec<_> = arguments.split_whitespace().collect();
        // The last count is the one that counts.
        arguments.extend(["--photons", photons]);
        let list = list(program, folder.path(), &arguments);
        let text = std::fs::read_to_string(&list).expect("a list");
        let mut lines: Vec<_> = text.lines().map(first_nine_columns).collect();
        lines[1..].sort();
        let untold = folder.path().join("untold.csv");
        std::fs::write(&untold, lines.join("\n") + "\n").expect("can be written");
        let line = "compare --json --seed 148 --photons {} {}";
        json(run_line(line, &[Path::new(photons), &untold]))
    };
    let right = compared("", "1000000");
    assert_eq!(right["outcome"], "within-tolerance", "{right}");
    assert_eq!(right["wrong_to_light"], 0, "{right}");
    for (arguments, photons, expected) in WITHOUT_PHOTONS {
        let report = compared(arguments, photons);
        assert_eq!(report["random_numbers"], "same", "{arguments}: {report}");
        match expected {
            Ok(reading) => {
                assert_eq!(
                    report["outcome"], "same-under-another-reading",
                    "{arguments}: {report}"
                );
                assert_eq!(report["reading"], reading, "{arguments}");
            }
            Err(section) => {
                assert_eq!(report["outcome"], "different", "{arguments}: {report}");
                let divergence = &report["first_divergence"];
                assert_eq!(divergence["section"], section, "{arguments}: {divergence}");
            }
        }
    }
}

fn first_nine_columns(line: &str) -> &str {
    line.match_indices(',').nth(8).map_or(line, |(end, _)| &line[..end])
}
