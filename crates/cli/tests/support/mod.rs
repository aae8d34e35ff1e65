//! What the tests of the command line share.
#![allow(dead_code)] // Not every test uses all of it.

use std::path::{Path, PathBuf};

use assert_cmd::Command;
use assert_cmd::assert::Assert;
use serde_json::Value;

/// The program, to be run with `arguments`, which may be paths.
pub fn run<A: AsRef<std::ffi::OsStr>>(arguments: impl IntoIterator<Item = A>) -> Assert {
    Command::cargo_bin("photon-mapping").expect("the program is built").args(arguments).assert()
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
