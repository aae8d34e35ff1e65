//! The README shows what `cargo run` prints.

use std::fs;
use std::path::Path;
use std::process::Command;

#[test]
fn a_run_prints_what_the_readme_shows() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let readme = fs::read_to_string(root.join("README.md")).expect("the README is there");
    let section = readme.split("\n## What a run prints\n").nth(1).expect("a section");
    let shown = section.split("```text\n").nth(1).and_then(|rest| rest.split("```").next());
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"));
    let run = Command::new(env!("CARGO_BIN_EXE_assignment8")).current_dir(folder).output();
    let printed = String::from_utf8(run.expect("it runs").stdout).expect("it prints text");
    assert_eq!(shown.expect("a block"), printed, "the README is left, the program right");
}
