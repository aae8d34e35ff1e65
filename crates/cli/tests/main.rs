//! The program as a user runs it, and what the pages say of it. One program of tests: it is linked
//! once, and tests that wait take no other test's time. Tests start in the order of their names:
//! what waits longest comes first.

mod array_job;
mod check;
mod command_line;
mod companion;
mod compare;
mod expectation;
mod explain;
mod explore;
mod files;
mod grade;
mod grade_formats;
mod grade_pictures;
mod gradebook;
mod hostile_class;
mod intake;
mod interop;
mod kit_gradescope;
mod kit_student;
mod merge;
#[path = "other_programs/main.rs"]
mod other_programs;
#[path = "pages/main.rs"]
mod pages;
#[path = "report/main.rs"]
mod report;
mod shell;
mod support;

/// A file without its line above would never be compiled.
#[test]
fn no_file_of_tests_is_left_out() {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("tests");
    let all = include_str!("main.rs");
    for entry in std::fs::read_dir(folder).expect("a folder").flatten() {
        let path = entry.path();
        let name = path.file_stem().expect("a name").to_string_lossy();
        assert!(name == "main" || all.contains(&format!("\nmod {name};")), "{}", path.display());
    }
}
