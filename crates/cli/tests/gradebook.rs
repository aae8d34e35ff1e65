//! Grades for a gradebook: rosters, exports, CSV, names hidden, and what a regrade changed.

use std::fs;
use std::path::{Path, PathBuf};

use crate::support::{fails, folder, reference_csv, run, run_line, stdout};
use serde_json::Value;
use tempfile::TempDir;

/// A class: `good` photons for the first file, none of the photons' columns for all others.
fn class(files: &[&str]) -> (TempDir, Vec<PathBuf>) {
    let folder = folder();
    let reference = folder.path().join("reference");
    let list = reference_csv(&reference, 20_000);
    let mut paths = Vec::new();
    for (at, file) in files.iter().enumerate() {
        let path = folder.path().join("class").join(file);
        fs::create_dir_all(path.parent().expect("a folder")).expect("it can be made");
        if file.ends_with(".png") {
            fs::copy(reference.join("assignment8.png"), &path).expect("it can be copied");
        } else if at == 0 {
            fs::copy(&list, &path).expect("it can be copied");
        } else {
            fs::write(&path, "x,y,z\n").expect("it can be written");
        }
        paths.push(path);
    }
    (folder, paths)
}

fn write(folder: &Path, name: &str, text: &str) -> PathBuf {
    let path = folder.join(name);
    fs::write(&path, text).expect("it can be written");
    path
}

/// The rows that `grade --format csv` prints, with more `words`, for `paths`.
fn table(words: &[&str], paths: &[PathBuf]) -> Vec<Vec<String>> {
    let words = ["grade", "--format", "csv"].iter().chain(words).map(PathBuf::from);
    let text = stdout(run(words.chain(paths.iter().cloned())).success());
    let reader = csv::ReaderBuilder::new().has_headers(false).from_reader(text.as_bytes());
    let rows = reader.into_records().map(|row| row.expect("a row is CSV"));
    rows.map(|row| row.iter().map(str::to_owned).collect()).collect()
}

fn column(rows: &[Vec<String>], title: &str) -> Vec<String> {
    let at = rows[0].iter().position(|cell| cell == title).expect("there is such a column");
    rows[1..].iter().map(|row| row[at].clone()).collect()
}

#[test]
fn a_table_has_a_row_for_each_submission() {
    let (_folder, paths) = class(&["alice.csv", "=cmd.csv"]);
    let rows = table(&[], &paths);
    let head = ["name", "id", "email", "score", "verdict", "sections", "misreading", "remarks"];
    assert_eq!(rows[0], head);
    assert_eq!(column(&rows, "name"), ["alice", "'=cmd"], "no formula for spreadsheets");
    assert_eq!(column(&rows, "score"), ["4", "1"]);
    assert_eq!(column(&rows, "verdict"), ["correct", "no dots"]);
}

#[test]
fn a_roster_names_orders_and_tells_who_is_absent() {
    let (folder, paths) = class(&["doe_jane.csv", "4711.csv", "rroe.csv", "stranger.csv"]);
    let text = "Student ID,Last Name,First Name,E-mail\n\
                1,Absent,Anna,anna@example.edu\n\
                2,\"Roe\",\"Richard\",rroe@example.edu\n\
                4711,\"de la Cruz\",José,jose@example.edu\n\
                3,Doe,Jane,jane@example.edu\n";
    let roster = write(folder.path(), "roster.csv", text);
    let roster = roster.to_str().expect("a plain path");
    let rows = table(&["--roster", roster], &paths);
    let names = ["Richard Roe", "José de la Cruz", "Jane Doe", "stranger", "Anna Absent"];
    assert_eq!(column(&rows, "name"), names);
    assert_eq!(column(&rows, "id"), ["2", "4711", "3", "", "1"]);
    assert_eq!(column(&rows, "score"), ["1", "1", "4", "1", "0"]);
    assert_eq!(column(&rows, "verdict")[4], "nothing handed in");
    let line = format!("grade --roster {roster} {{}}");
    let text = stdout(run_line(&line, &[&paths[0]]).success());
    assert!(text.starts_with("Jane Doe: correct"), "{text}");
    let absent = "handed in nothing: Anna Absent, Richard Roe, José de la Cruz\n";
    assert!(text.ends_with(absent), "{text}");
}

#[test]
fn a_roster_without_names_is_refused() {
    let (folder, paths) = class(&["alice.csv"]);
    let roster = write(folder.path(), "roster.csv", "id,grade\n1,2\n");
    fails("grade --roster {} {}", &[&roster, &paths[0]], &["roster.csv:1", "'name'", "id, grade"]);
    let missing = folder.path().join("none.csv");
    fails("grade --roster {} {}", &[&missing, &paths[0]], &["none.csv", "cannot be read"]);
}

#[test]
fn files_of_canvas_become_one_submission_a_student() {
    let (folder, paths) = class(&[
        "doejane_12_901_photons.csv",
        "doejane_12_902_assignment8.png",
        "roerichard_LATE_13_903_photons.csv",
    ]);
    let rows = table(&[], &paths);
    assert_eq!(column(&rows, "name"), ["doejane", "roerichard"]);
    assert_eq!(column(&rows, "id"), ["12", "13"]);
    assert_eq!(column(&rows, "score"), ["4", "1"]);
    let roster = write(folder.path(), "roster.csv", "name\nRichard Roe\n\"Doe, Jane\"\n");
    let rows = table(&["--roster", roster.to_str().expect("a plain path")], &paths);
    assert_eq!(column(&rows, "name"), ["Richard Roe", "Doe, Jane"]);
}

#[test]
fn folders_of_moodle_and_gradescope_have_their_students_names() {
    let moodle = [
        "Jane Doe_12_assignsubmission_file/photons.csv",
        "Richard Roe_13_assignsubmission_file/photons.csv",
    ];
    let (folder, _paths) = class(&moodle);
    let rows = table(&[], &[folder.path().join("class")]);
    assert_eq!(column(&rows, "name"), ["Jane Doe", "Richard Roe"]);
    assert_eq!(column(&rows, "id"), ["12", "13"]);

    let (folder, _paths) = class(&["submission_1/photons.csv", "submission_2/photons.csv"]);
    let text = "---\nsubmission_2:\n  :submitters:\n  - :name: Richard Roe\n    :sid: '13'\n\
                \x20   :email: rroe@example.edu\n  - :name: Mary Major\n    :sid: '14'\n\
                submission_1:\n  :submitters:\n  - :name: Jane Doe\n    :sid: '12'\n\
                \x20   :email: jane@example.edu\n  :created_at: 2019-11-25\n";
    write(&folder.path().join("class"), "submission_metadata.yml", text);
    let rows = table(&[], &[folder.path().join("class")]);
    assert_eq!(column(&rows, "name"), ["Jane Doe", "Richard Roe & Mary Major"]);
    assert_eq!(column(&rows, "id"), ["12", "13"]);
    assert_eq!(column(&rows, "email"), ["jane@example.edu", "rroe@example.edu"]);
}

#[test]
fn anonymous_grades_name_nobody() {
    let (folder, paths) = class(&["doe_jane.csv", "roe_richard.csv", "4711_twin.csv"]);
    let pages = folder.path().join("pages");
    let line = "grade --anonymous --format html --out {} {} {} {}";
    run_line(line, &[&pages, &paths[0], &paths[1], &paths[2]]).success();
    let mut seen = 0;
    for entry in fs::read_dir(&pages).expect("there are pages").flatten() {
        let text = fs::read_to_string(entry.path()).expect("a page is text");
        let name = entry.file_name().to_string_lossy().into_owned();
        for secret in ["doe_", "jane", "roe_", "richard", "4711"] {
            assert!(!text.contains(secret) && !name.contains(secret), "{name}: {secret}");
        }
        seen += 1;
    }
    assert_eq!(seen, 4);
    assert_eq!(column(&table(&["--anonymous"], &paths), "name").len(), 3);
}

#[test]
fn a_regrade_says_what_changed() {
    let (folder, paths) = class(&["alice.csv", "bob.csv"]);
    let old = folder.path().join("old.json");
    run_line("grade --format json --out {} {} {}", &[&old, &paths[0], &paths[1]]).success();
    let text = stdout(run_line("grade --before {} {} {}", &[&old, &paths[0], &paths[1]]).success());
    assert!(text.ends_with("changed since the earlier grades: 0\n"), "{text}");
    let mut grades: Value =
        serde_json::from_str(&fs::read_to_string(&old).expect("there is one")).expect("JSON");
    grades[0]["score"] = 2.0.into();
    grades[0]["verdict"] = "incorrect".into();
    fs::write(&old, grades.to_string()).expect("it can be written");
    let text = stdout(run_line("grade --before {} {} {}", &[&old, &paths[0], &paths[1]]).success());
    assert!(text.contains("changed since the earlier grades: 1\n"), "{text}");
    let end = "alice.csv: was incorrect, 2 points; is correct, 4 points\n";
    assert!(text.ends_with(end), "{text}");
    let rows = table(&["--before", old.to_str().expect("a plain path")], &paths);
    assert_eq!(column(&rows, "score before"), ["2", "1"]);
    fs::write(&old, "[1, 2]").expect("it can be written");
    fails("grade --before {} {}", &[&old, &paths[0]], &["old.json", "--format json"]);
}
