//! Ranges traced apart become the whole run's list again.

use std::path::Path;
use std::process::Command;

use assert_cmd::cargo::cargo_bin;

/// The JSON that the program prints.
fn json_of(arguments: &[&str], folder: &Path) -> serde_json::Value {
    let run = Command::new(cargo_bin("photon-mapping"))
        .args(arguments)
        .current_dir(folder)
        .output()
        .expect("the program runs");
    assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
    serde_json::from_slice(&run.stdout).expect("JSON")
}

fn fails_with(arguments: &[&str], folder: &Path, message: &str) {
    let run = Command::new(cargo_bin("photon-mapping"))
        .args(arguments)
        .current_dir(folder)
        .output()
        .expect("the program runs");
    assert_eq!(run.status.code(), Some(2));
    let error = String::from_utf8_lossy(&run.stderr).into_owned();
    assert!(error.contains(message), "{error}");
}

/// `render` with what all runs here have in common.
fn render<'a>(more: &[&'a str]) -> Vec<&'a str> {
    [&["render", "--photons", "20000", "--size", "8x6", "--quiet", "--json"], more].concat()
}

#[test]
fn gnu_parallel_makes_the_whole_list_though_a_piece_was_lost() {
    if Command::new("parallel").arg("--version").output().is_err() {
        eprintln!("skipped: GNU parallel is not installed");
        return;
    }
    let folder = tempfile::tempdir().expect("a temporary folder");
    let program = cargo_bin("photon-mapping");
    let program = program.to_str().expect("a path in UTF-8");
    let parallel = |ranges: &[&str]| {
        let status = Command::new("parallel")
            .args(["--will-cite", "--jobs", "2"])
            .arg(format!(
                "{program} render --photons 20000 --range {{}} --out {{}} --size 8x6 --quiet"
            ))
            .arg(":::")
            .args(ranges)
            .current_dir(folder.path())
            .output()
            .expect("parallel runs");
        assert!(status.status.success(), "{}", String::from_utf8_lossy(&status.stderr));
    };
    let ranges = ["0..5000", "5000..10000", "10000..15000", "15000..20000"];
    parallel(&ranges);
    std::fs::remove_dir_all(folder.path().join(ranges[2])).expect("a piece to lose");
    let pieces = ranges.map(|range| format!("{range}/photons.ply"));
    let [a, b, c, d] = pieces.each_ref().map(String::as_str);
    let without = ["merge", d, a, b, "--out", "all.ply"];
    fails_with(&without, folder.path(), "the photons 10000..15000 are missing");
    parallel(&ranges[2..3]);
    let merged = json_of(&["merge", d, b, a, c, "--out", "all.ply", "--json"], folder.path());
    let whole = json_of(&render(&["--out", "whole"]), folder.path());
    assert_eq!(merged["sha256"], whole["sha256"]);
    let [merged, whole] = ["all.ply", "whole/photons.ply"]
        .map(|name| std::fs::read(folder.path().join(name)).expect("a list"));
    assert!(merged == whole, "the files are the same, too");
}

#[test]
fn counts_add_up_to_those_of_the_whole_run() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let count = |name: &str, more: &[&str]| {
        let json = json_of(&render_counts(more), folder.path());
        std::fs::write(folder.path().join(name), json.to_string()).expect("a file");
        json
    };
    let whole = count("whole", &[]);
    count("a", &["--range", "0..7777"]);
    count("b", &["--range", "7777..20000"]);
    count("other", &["--range", "7777..20000", "--seed", "9"]);
    count("bounces", &["--range", "7777..20000", "--max-bounces", "3"]);
    count("letter", &["--range", "7777..20000", "--letter-of-the-handout"]);
    let merged = json_of(&["merge", "b", "a", "--json"], folder.path());
    for part in ["run", "counts", "surfaces", "emitted", "stored"] {
        assert_eq!(merged[part], whole[part], "{part}");
    }
    for other in ["other", "bounces", "letter"] {
        fails_with(&["merge", "a", other], folder.path(), "belong to different runs");
    }
    fails_with(&["merge", "a", "a"], folder.path(), "overlap in the photons 0..7777");
}

#[test]
fn csv_pieces_are_refused_with_what_to_do() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    for (range, format) in [("0..9000", "ply"), ("9000..20000", "csv")] {
        let arguments = ["--range", range, "--format", format, "--out", format];
        json_of(&render(&arguments), folder.path());
    }
    let merge = ["merge", "ply/photons.ply", "csv/photons.csv", "--out", "all.ply"];
    let advice = "photons.csv: expected a PLY list of render: no other file names its run; trace \
                  it with --format ply";
    fails_with(&merge, folder.path(), advice);
    fails_with(&["merge", "csv/photons.csv"], folder.path(), "trace it with --format ply");
    let counts = json_of(&render_counts(&[]), folder.path());
    std::fs::write(folder.path().join("counts"), counts.to_string()).expect("a file");
    let merge = ["merge", "counts", "--out", "all.ply"];
    fails_with(&merge, folder.path(), "counts are merged without --out");
    for piece in ["-", "packed"] {
        std::fs::write(folder.path().join("packed"), b"\x1f\x8b\x08\0").expect("a file");
        let expected = match piece {
            "-" => "-: expected the names of files; merge does not read standard input",
            _ => "packed: expected a PLY list of render, found a gzip archive",
        };
        fails_with(&["merge", piece], folder.path(), expected);
        fails_with(&["merge", piece, "--out", "all.ply"], folder.path(), expected);
    }
    assert!(!folder.path().join("all.ply").exists());
}

fn render_counts<'a>(more: &[&'a str]) -> Vec<&'a str> {
    [&["render", "--photons", "20000", "--quiet", "--json", "--count-only"], more].concat()
}
