//! What the tests of the command line share.
#![allow(dead_code)] // Not every test uses all of it.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Output;

use assert_cmd::Command;
use assert_cmd::assert::Assert;
use serde_json::Value;

/// The program, to be run with `arguments`, which may be paths.
pub fn run<A: AsRef<std::ffi::OsStr>>(arguments: impl IntoIterator<Item = A>) -> Assert {
    let mut command = Command::cargo_bin("photon-mapping").expect("the program is built");
    command.env("XDG_CACHE_HOME", env!("CARGO_TARGET_TMPDIR")).args(arguments).assert()
}

/// Runs the program with the words of `line`; `{}` stands for the next of `paths`.
pub fn run_line(line: &str, paths: &[&Path]) -> Assert {
    let mut paths = paths.iter();
    let words = line.split(' ').map(|word| match word {
        "{}" => paths.next().expect("a path for every {}").as_os_str().to_owned(),
        word => word.into(),
    });
    run(words.collect::<Vec<_>>())
}

/// What was printed.
pub fn stdout(assert: Assert) -> String {
    String::from_utf8(assert.get_output().stdout.clone()).expect("output is text")
}

/// What was printed, as JSON.
pub fn json(assert: Assert) -> Value {
    serde_json::from_str(&stdout(assert)).expect("output is JSON")
}

/// Checks that `line` fails with exit code 2, nothing on stdout, and one line on stderr that has
/// all of `expected` in it.
pub fn fails(line: &str, paths: &[&Path], expected: &[&str]) {
    let assert = run_line(line, paths).code(2);
    let output = assert.get_output();
    let error = String::from_utf8_lossy(&output.stderr);
    assert!(output.stdout.is_empty(), "{line}: printed to stdout");
    assert_eq!(error.trim_end().lines().count(), 1, "{line}: {error}");
    for part in expected {
        assert!(error.contains(part), "{line}: expected '{part}' in: {error}");
    }
}

/// A folder that is removed in the end.
pub fn folder() -> tempfile::TempDir {
    tempfile::tempdir_in(env!("CARGO_TARGET_TMPDIR")).expect("a folder can be made")
}

/// The CSV list of `photons` photons of the reference, in `folder`.
pub fn reference_csv(folder: &Path, photons: u64) -> PathBuf {
    let photons = photons.to_string();
    let line = "render --format csv --quiet --size 1x1 --photons {} --out {}";
    run_line(line, &[Path::new(&photons), folder]).success();
    folder.join("photons.csv")
}

/// The program, to be started in `folder`.
pub fn program(folder: &Path) -> std::process::Command {
    let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_photon-mapping"));
    command.current_dir(folder).env("XDG_CACHE_HOME", env!("CARGO_TARGET_TMPDIR"));
    command
}

pub fn stderr(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

/// The positions that the reference stores of `photons` with `seed`.
pub fn csv(seed: u64, photons: u64) -> String {
    let mut text = "x,y,z\n".to_owned();
    for record in fixtures::list(&fixtures::handout(seed, photons)) {
        let [x, y, z] = record.position.to_array();
        text += &format!("{x},{y},{z}\n");
    }
    text
}

pub fn write(path: PathBuf, contents: impl AsRef<[u8]>) -> PathBuf {
    fs::create_dir_all(path.parent().unwrap()).unwrap();
    fs::write(&path, contents).unwrap();
    path
}

pub fn mkfifo(path: &Path) {
    assert!(std::process::Command::new("mkfifo").arg(path).status().unwrap().success());
}

/// The grades of `paths`.
pub fn grades(options: &[&str], paths: &[&Path]) -> Vec<Value> {
    let words = ["grade", "--format", "json", "--emitted", "60000"].iter().chain(options);
    let words = words.map(|word| word.as_ref()).chain(paths.iter().map(|path| path.as_os_str()));
    match json(run(words).success()) {
        Value::Array(grades) => grades,
        grade => vec![grade],
    }
}

pub fn remarks(grade: &Value) -> String {
    let findings = grade["findings"].as_array().unwrap().iter();
    findings.map(|finding| finding["found"].as_str().unwrap().to_owned() + "\n").collect()
}
