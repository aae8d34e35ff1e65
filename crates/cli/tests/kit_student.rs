//! The edition for students: what fails at first, what each section turns green, and that nothing
//! in it gives the answer away.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use crate::support::{fails, folder, run_line, stdout};

/// The handout's sections, each with the file to write it in and the module of its tests.
const SECTIONS: [(&str, &str, &str); 5] = [
    ("Photon Emission", "src/scene/point_light.rs", "emission"),
    ("Photon Storage", "src/rendering/photon_mapping_renderer.rs", "storage"),
    ("Photon Scattering/Absorption", "src/rendering/photon_mapping_renderer.rs", "roulette"),
    ("Hemisphere Sampling", "src/rendering/sampling.rs", "hemisphere"),
    ("Hemisphere Ray Transformation", "src/rendering/sampling.rs", "transformation"),
];

fn port(file: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(file);
    fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// The edition, in `folder`.
fn edition(folder: &Path) -> PathBuf {
    let starter = folder.join("starter");
    run_line("kit student --out {}", &[&starter]).success();
    starter
}

/// The lines of a section: after its step comment, up to the line that is `end`.
fn body<'a>(text: &'a str, section: &str, end: &str) -> Vec<&'a str> {
    let mark = format!("// {section}");
    let lines = text.lines().skip_while(|line| line.trim() != mark).skip(1);
    lines.take_while(|line| *line != end).collect()
}

/// Writes the port's body of section `number` after its `todo!`, which is met as long as the
/// environment says that fewer sections are written: one program then stands for every state that
/// a student comes by. Gives the port's lines.
fn fill(starter: &Path, number: usize) -> Vec<String> {
    let (section, file, _) = SECTIONS[number];
    let path = starter.join(file);
    let text = fs::read_to_string(&path).expect("the edition has the file");
    let mark = format!("// {section}");
    let lines: Vec<&str> = text.lines().collect();
    let start = lines.iter().position(|line| line.trim() == mark).expect("it is marked") + 1;
    assert!(lines[start].trim().starts_with("todo!("), "{section}: {}", lines[start]);
    let indent = &lines[start][..lines[start].len() - lines[start].trim_start().len()];
    let closing = format!("{indent});");
    let end = start + lines[start..].iter().position(|line| *line == closing).expect("its end");
    let next = lines[end + 1..].iter().find(|line| !line.is_empty()).expect("a line after it");
    let original = port(file);
    let body = body(&original, section, next);
    let open = format!("if crate::written() <= {number} {{");
    let todo = [&[open.as_str()], &lines[start..=end], &["}"]].concat();
    let filled = [&lines[..start], &todo, &body, &lines[end + 1..]].concat().join("\n") + "\n";
    fs::write(&path, filled).expect("the edition can be written");
    body.into_iter().map(str::to_owned).collect()
}

/// How many sections are written, to be added to the edition's library.
const WRITTEN: &str = r#"
fn written() -> usize {
    static WRITTEN: std::sync::LazyLock<usize> = std::sync::LazyLock::new(|| {
        std::env::var("WRITTEN").expect("it is set").parse().expect("a number")
    });
    *WRITTEN
}
"#;

/// What the failing tests say, and the names of those that pass.
struct Outcome {
    failed: BTreeMap<String, String>,
    passed: BTreeSet<String>,
}

/// Builds the edition as this project is built, so that the libraries need not be built again.
fn take_profiles_of_the_project(starter: &Path) {
    let own = starter.join("Cargo.toml");
    let text = fs::read_to_string(&own).expect("the edition has a manifest");
    let project = port("Cargo.toml");
    let parts = |text| str::split_once(text, "[profile.").expect("it has profiles");
    let text = format!("{}[workspace]\n\n[profile.{}", parts(&text).0, parts(&project).1);
    fs::write(&own, text).expect("it can be written");
}

/// Runs Cargo in the edition. What it builds it keeps where the project's own build is; settings
/// that nothing there has keep it apart from the project's package of the same name.
fn cargo(starter: &Path, arguments: &[&str], written: usize) -> Output {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"));
    Command::new(env!("CARGO"))
        .arg("--offline")
        .args(
            ["opt-level=1", "codegen-units=16"]
                .map(|setting| format!("--config=profile.test.package.photon-mapping.{setting}")),
        )
        .args(arguments)
        .current_dir(starter)
        .env("CARGO_INCREMENTAL", "1")
        .env("CARGO_TARGET_DIR", folder.join("student-target"))
        .env("CARGO_BUILD_BUILD_DIR", folder.parent().expect("the project's target"))
        .env("RUST_BACKTRACE", "0")
        .env("WRITTEN", written.to_string())
        .env_remove("INSTA_UPDATE")
        .output()
        .expect("cargo can be started")
}

/// Checks that Cargo's command compiles, for which nothing need be optimized.
fn builds(starter: &Path, command: [&str; 3], state: &str) {
    let level = "--config=profile.test.package.photon-mapping.opt-level=0";
    let built = cargo(starter, &[&command[..], &[level]].concat(), 0);
    assert!(built.status.success(), "{state}: {}", String::from_utf8_lossy(&built.stderr));
}

/// Runs the edition's tests, but for those in `left_out`.
fn test(starter: &Path, written: usize, left_out: &BTreeSet<String>) -> Outcome {
    let skips = left_out.iter().flat_map(|name| ["--skip", name]);
    let words = ["test", "--test", "assignment", "--", "--exact"].into_iter().chain(skips);
    let run = cargo(starter, &words.collect::<Vec<_>>(), written);
    let text = String::from_utf8_lossy(&run.stdout).into_owned();
    assert!(text.contains("test result"), "{}", String::from_utf8_lossy(&run.stderr));
    let names = |end: &str| {
        let lines = text.lines().filter_map(|line| line.strip_prefix("test ")?.strip_suffix(end));
        lines.map(str::to_owned).collect::<BTreeSet<_>>()
    };
    let said = |name: &String| {
        let (_, said) = text.split_once(&format!("---- {name} stdout ----")).unwrap_or_default();
        said.split("\n---- ").next().unwrap_or_default().to_owned()
    };
    let failed = names(" ... FAILED").into_iter().map(|name| (name.clone(), said(&name)));
    Outcome { failed: failed.collect(), passed: names(" ... ok") }
}

#[test]
fn each_section_turns_its_own_tests_green() {
    let folder = folder();
    let starter = edition(folder.path());
    let resolved = cargo(&starter, &["metadata", "--format-version=1"], 0);
    assert!(resolved.status.success(), "{}", String::from_utf8_lossy(&resolved.stderr));
    take_profiles_of_the_project(&starter);
    builds(&starter, ["test", "--no-run", "--test=assignment"], "as it is");
    let library = starter.join("src/lib.rs");
    let text = fs::read_to_string(&library).expect("the edition has a library");
    fs::write(&library, text + WRITTEN).expect("it can be written");
    // What is written so far compiles, whatever is left.
    for (number, (section, ..)) in SECTIONS.iter().enumerate() {
        fill(&starter, number);
        builds(&starter, ["build", "--lib", "--profile=test"], section);
    }
    let mut before = test(&starter, 0, &BTreeSet::new());
    let is_of = |name: &str, module: &str| name.starts_with(&format!("{module}::"));
    for name in &before.passed {
        let is_of_section = SECTIONS.iter().any(|(_, _, module)| is_of(name, module));
        assert!(!is_of_section, "{name} passes before anything is written");
    }
    assert!(before.passed.iter().any(|name| is_of(name, "numerics")), "{:?}", before.passed);
    // Each section panics, so these meet none, and run again only when all is written.
    let of_no_section = before.passed.clone();
    for (number, (section, _, module)) in SECTIONS.into_iter().enumerate() {
        for (name, said) in &before.failed {
            let message = |(section, ..): &(&str, &str, &str)| {
                said.contains(&format!("not yet implemented: {section}: expected "))
            };
            assert!(SECTIONS[number..].iter().any(message), "{name} says: {said}");
            if is_of(name, module) {
                assert!(message(&SECTIONS[number]), "{name} says: {said}");
            }
        }
        let is_last = number + 1 == SECTIONS.len();
        let left_out = if is_last { BTreeSet::new() } else { of_no_section.clone() };
        let mut after = test(&starter, number + 1, &left_out);
        after.passed.extend(left_out);
        let turned: BTreeSet<_> = after.passed.difference(&before.passed).collect();
        let expected = before.failed.keys().filter(|name| is_of(name, module));
        if !is_last {
            assert_eq!(turned, expected.collect(), "after {section}");
        } else {
            assert!(after.failed.is_empty(), "{:?}", after.failed);
        }
        assert!(after.passed.is_superset(&before.passed), "after {section}");
        before = after;
    }
    for module in ["whole", "bits", "picture"] {
        assert!(before.passed.iter().any(|name| is_of(name, module)), "{module}");
    }
}

#[test]
fn nothing_gives_the_answer_away() {
    let folder = folder();
    let starter = edition(folder.path());
    let mut files = Vec::new();
    gather(&starter, &mut files);
    let is_test = |path: &&PathBuf| path.starts_with(starter.join("tests"));
    let texts: Vec<(PathBuf, String)> = files
        .iter()
        .filter(|path| !is_test(path))
        .filter_map(|path| Some((path.clone(), fs::read_to_string(path).ok()?)))
        .collect();
    // The framework's own code says how a material is found and how a ray is made.
    let given = port("src/rendering/backward_renderer.rs") + &port("src/scene/camera.rs");
    let mut seen = 0;
    for number in 0..SECTIONS.len() {
        for line in fill(&starter, number) {
            let line = line.trim();
            // Ends of blocks and the like tell nothing.
            if line.len() < 20 || given.contains(line) {
                continue;
            }
            seen += 1;
            for (path, text) in &texts {
                assert!(!text.contains(line), "{}: {line}", path.display());
            }
        }
    }
    assert!(seen > 25, "{seen} lines");
    let names: Vec<_> = files.iter().map(|path| path.strip_prefix(&starter).unwrap()).collect();
    for other in ["ASSIGNMENT.md", "tests/mutations.txt", "golden/letter-of-the-handout.snap"] {
        assert!(!names.contains(&Path::new(other)), "{other}");
    }
}

fn gather(folder: &Path, files: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("a folder can be listed") {
        let path = entry.expect("an entry can be read").path();
        if path.is_dir() { gather(&path, files) } else { files.push(path) }
    }
}

/// A loop that accepts no direction ends, nothing is said of a toolkit, and a failing test changes
/// no golden file.
#[test]
fn the_edition_is_made_for_students() {
    let folder = folder();
    let starter = edition(folder.path());
    let read = |file| fs::read_to_string(starter.join(file)).expect("the edition has the file");
    assert!(read("src/random.rs").contains("assert!(drawn <= 100_000"));
    let main = read("src/main.rs");
    assert!(!main.contains("toolkit"));
    assert_eq!(main.lines().count() + 1, port("src/main.rs").lines().count());
    assert!(read(".cargo/config.toml").contains("INSTA_UPDATE = { value = \"no\", force = true }"));
}

#[test]
fn the_readme_names_what_is_there() {
    let folder = folder();
    let starter = edition(folder.path());
    let readme = fs::read_to_string(starter.join("README.md")).expect("there is one");
    assert!(readme.split_whitespace().count() < 500);
    for (section, file, module) in SECTIONS {
        let row = readme.lines().find(|line| line.starts_with(&format!("| {section} |")));
        let row = row.unwrap_or_else(|| panic!("{section} has no row"));
        assert!(row.contains(file.trim_start_matches("src/")), "{row}");
        assert!(row.contains(&format!("cargo test {module}::")), "{row}");
        let function = row.split('`').nth(3).expect("a function");
        assert!(port(file).contains(&format!("fn {function}")), "{file}: {function}");
    }
}

#[test]
fn a_folder_with_files_is_refused() {
    let folder = folder();
    fs::write(folder.path().join("notes.txt"), "mine").expect("it can be written");
    fails("kit student --out {}", &[folder.path()], &["new or empty folder", "found files"]);
    let empty = folder.path().join("empty");
    fs::create_dir(&empty).expect("it can be made");
    let printed = stdout(run_line("kit student --out {}", &[&empty]).success());
    assert!(printed.contains("README.md"), "{printed}");
}
