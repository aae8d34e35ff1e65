//! `check` as a grader runs it, on a solution written as a student would.
#![cfg(unix)]

mod support;

use std::path::{Path, PathBuf};

use support::{fails, folder, run_line, stdout};

fn solution() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../check/tests/submissions/one_function")
}

#[test]
fn a_right_solution_has_the_photons_of_the_reference() {
    let folder = folder();
    let list = folder.path().join("list.csv");
    let checked = run_line("check {} --quiet --list {}", &[&solution(), &list]);
    let errors = String::from_utf8_lossy(&checked.get_output().stderr).into_owned();
    if errors.contains("no C++ compiler") || errors.contains("does not find glm") {
        assert!(std::env::var_os("CI").is_none(), "{errors}");
        eprintln!("skipped: {errors}");
        return;
    }
    let text = stdout(checked.success());
    assert_eq!(text.matches(": right\n").count(), 5, "{text}");
    let line = "compare --seed 148 --photons 200000 {}";
    let compared = stdout(run_line(line, &[&list]).success());
    assert!(compared.starts_with("the same within"), "{compared}");
}

#[test]
fn a_missing_folder_and_a_list_of_two_are_refused() {
    fails("check {} {} --list out.csv", &[&solution(), &solution()], &["--list", "found 2"]);
}
