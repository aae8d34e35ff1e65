//! The autograder for Gradescope, run as Gradescope runs it: in a root of its own where the system
//! lets us make one, else in a folder of its own.
#![cfg(unix)]

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::OnceLock;

use crate::support::{folder, reference_csv, run_line};
use grading::policy::Policy;
use serde_json::{Value, json};
use tempfile::TempDir;
use variants::section::Section;

/// Makes a root around the folder `$1`, which becomes its /autograder, and runs the autograder in
/// it.
const IN_A_ROOT: &str = r#"
set -e
root=$(dirname "$1")/root
mkdir -p "$root"/usr "$root"/etc "$root"/proc "$root"/dev "$root"/tmp "$root"/autograder
for name in bin sbin lib lib64; do ln -sfn "usr/$name" "$root/$name"; done
for name in usr etc dev; do mount --rbind "/$name" "$root/$name"; done
mount -t proc proc "$root/proc"
mount --bind "$1" "$root/autograder"
cd "$root/autograder"
exec chroot "$root" env -i PATH="$PATH" /autograder/run_autograder
"#;

/// The kit as Gradescope has unpacked it.
fn kit() -> &'static Path {
    static KIT: OnceLock<TempDir> = OnceLock::new();
    let folder = KIT.get_or_init(|| {
        let folder = folder();
        run_line("kit gradescope --out {}", &[&folder.path().join("kit")]).success();
        folder
    });
    folder.path()
}

/// Whether a root of its own can be made here.
fn has_roots() -> bool {
    static HAS: OnceLock<bool> = OnceLock::new();
    *HAS.get_or_init(|| {
        let mut try_it = Command::new("unshare");
        try_it.args([
            "--mount",
            "--pid",
            "--fork",
            "sh",
            "-c",
            "mount --bind /usr /mnt && chroot /",
        ]);
        try_it.args(["true"]).stderr(Stdio::null()).stdout(Stdio::null());
        let has = Path::new("/bin").is_symlink() && try_it.status().is_ok_and(|s| s.success());
        if !has {
            eprintln!("skipped: no root of its own can be made; a folder must do");
        }
        has
    })
}

/// The results for what `hand_in` puts into the folder of the submission.
fn results(hand_in: impl Fn(&Path)) -> Value {
    let (folder, base) = laid_out(hand_in);
    let mut run = if has_roots() {
        let mut run = Command::new("unshare");
        run.args(["--mount", "--pid", "--fork", "sh", "-c", IN_A_ROOT, "sh"]).arg(&base);
        run
    } else {
        let mut run = Command::new(base.join("run_autograder"));
        run.env("AUTOGRADER", &base).current_dir(&base);
        run
    };
    let run = run.output().expect("it can be started");
    let error = String::from_utf8_lossy(&run.stderr).into_owned();
    assert!(run.status.success(), "{error}");
    let results = valid(&base);
    drop(folder);
    results
}

/// A folder, and in it one as Gradescope lays it out, with the kit and what `hand_in` puts into it.
fn laid_out(hand_in: impl Fn(&Path)) -> (TempDir, PathBuf) {
    let folder = folder();
    let base = folder.path().join("autograder");
    for name in ["source", "submission", "results"] {
        fs::create_dir_all(base.join(name)).expect("it can be made");
    }
    for entry in fs::read_dir(kit().join("kit")).expect("the kit is there").flatten() {
        let copy = base.join("source").join(entry.file_name());
        fs::hard_link(entry.path(), copy).expect("it can be linked");
    }
    fs::copy(base.join("source/run_autograder"), base.join("run_autograder")).expect("copied");
    hand_in(&base.join("submission"));
    (folder, base)
}

/// Reads results.json, and holds it to the fields that Gradescope publishes.
fn valid(base: &Path) -> Value {
    let text = fs::read_to_string(base.join("results/results.json")).expect("there is one");
    let results: Value = serde_json::from_str(&text).expect("it is JSON");
    let fields = ["score", "output", "output_format", "visibility", "stdout_visibility", "tests"];
    for (field, _) in results.as_object().expect("an object") {
        assert!(fields.contains(&field.as_str()), "{field}");
    }
    assert!(results["score"].is_f64(), "{text}");
    let of_test = ["name", "score", "max_score", "status", "number", "output", "output_format"];
    for test in results["tests"].as_array().expect("an array") {
        for (field, value) in test.as_object().expect("an object") {
            let is_score = ["score", "max_score"].contains(&field.as_str());
            let is_known = of_test.contains(&field.as_str())
                || ["visibility", "extra_data"].contains(&field.as_str());
            assert!(is_known && (field == "extra_data" || value.is_number() == is_score), "{test}");
        }
        assert!(["passed", "failed"].contains(&test["status"].as_str().expect("a text")), "{test}");
    }
    results
}

fn names(results: &Value) -> Vec<&str> {
    let tests = results["tests"].as_array().expect("an array");
    tests.iter().map(|test| test["name"].as_str().expect("a text")).collect()
}

fn solution() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../check/tests/submissions/one_function")
}

fn copy(from: &Path, to: &Path) {
    for entry in fs::read_dir(from).expect("it can be listed").flatten() {
        fs::copy(entry.path(), to.join(entry.file_name())).expect("it can be copied");
    }
}

/// Whether C++ was judged. On CI it must be.
fn has_compiler(results: &Value) -> bool {
    let output = results["output"].as_str().expect("a text");
    let is_missing = output.contains("no C++ compiler") || output.contains("does not find glm");
    assert!(!is_missing || std::env::var_os("CI").is_none(), "{output}");
    !is_missing
}

#[test]
fn a_list_gets_its_points() {
    let results = results(|submission| {
        reference_csv(submission, 20_000);
        fs::remove_file(submission.join("assignment8.png")).expect("a picture is drawn too");
    });
    assert_eq!(results["score"], 4.0, "{results}");
    let output = results["output"].as_str().expect("a text");
    assert!(output.starts_with("submission: correct"), "{output}");
}

#[test]
fn right_cpp_gets_points_by_section_and_its_picture_is_judged_too() {
    let results = results(|submission| {
        copy(&solution(), submission);
        let port = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../golden/assignment8.png");
        fs::copy(port, submission.join("assignment8.png")).expect("it can be copied");
    });
    if has_compiler(&results) {
        let names = names(&results);
        assert_eq!(names.iter().filter(|name| **name == "builds").count(), 1, "{names:?}");
        assert!(names.contains(&"dots by facet"), "no test of the picture: {names:?}");
        let tests = results["tests"].as_array().expect("an array");
        for title in Section::ALL.map(Section::title) {
            let test = tests.iter().find(|test| test["name"] == title).expect("each has its test");
            assert_eq!((&test["score"], &test["max_score"]), (&json!(0.8), &json!(0.8)), "{test}");
        }
    }
    assert_eq!(results["score"], 4.0, "{results}");
}

#[test]
fn cpp_that_hangs_crashes_or_does_not_build_gets_its_result() {
    let broken = |line: &str, score: f64, found: &str| {
        let (_folder, base) = laid_out(|submission| {
            copy(&solution(), submission);
            let path = submission.join("PointLight.cpp");
            let text = fs::read_to_string(&path).expect("the solution has it");
            let (before, after) = text.split_once("GenerateRandomPhotonRay").expect("it is there");
            let (head, body) = after.split_once('{').expect("its body");
            let text = format!("{before}GenerateRandomPhotonRay{head}{{ {line}\n{body}");
            fs::write(&path, text).expect("it can be written");
        });
        // The compiler may take a quarter of this, on a busy machine too.
        run_line("autograde {} --timeout 240", &[&base]).success();
        let results = valid(&base);
        if has_compiler(&results) {
            let text = results.to_string();
            assert!(text.contains(found), "{line}: {text}");
            assert!(results["score"].as_f64() <= Some(score), "{line}: {text}");
        }
    };
    broken("*(volatile int*)0 = 1;", 3.2, "Photon Emission");
    broken("expected a semicolon", 0.0, "no: PointLight.cpp:");
    broken("for (volatile int i = 0;; i = i + 1) {}", 3.2, "Photon Emission");
}

#[test]
fn whatever_is_handed_in_there_is_a_result() {
    let nothing = results(|_| ());
    assert_eq!(nothing["score"], 0.0);
    assert!(nothing["output"].as_str().expect("a text").starts_with("Nothing was handed in"));
    let junk: [(&str, &[u8]); 5] = [
        ("assignment8.png", b""),
        ("assignment8.png", b"\x89PNG\r\n\x1a\n and no more"),
        ("photons.csv", b"x,y,z\n1,2\n"),
        ("photons.ply", b"ply\nformat binary_little_endian 1.0\nelement vertex 9999999999\n"),
        ("report.docx", b"PK\x03\x04"),
    ];
    for (name, content) in junk {
        let results = results(|submission| {
            fs::write(submission.join(name), content).expect("it can be written");
        });
        assert_eq!(results["score"], 0.0, "{name}: {results}");
    }
    let linked = results(|submission| {
        std::os::unix::fs::symlink("/dev/zero", submission.join("photons.csv")).expect("a link");
    });
    assert_eq!(linked["score"], 0.0, "{linked}");
}

#[test]
fn a_grader_that_takes_too_long_or_is_ended_leaves_a_result() {
    let folder = folder();
    let submission = folder.path().join("submission");
    fs::create_dir_all(&submission).expect("it can be made");
    let list = reference_csv(&submission, 20_000);
    let text = fs::read_to_string(&list).expect("a list is text");
    let position = |row: &str| row.split(',').take(3).collect::<Vec<_>>().join(",") + "\n";
    let (head, rows) = text.split_once('\n').expect("it has a head");
    let rows: String = rows.lines().map(position).collect();
    fs::write(&list, position(head) + &rows.repeat(90_000_000 / rows.len())).expect("written");
    run_line("autograde {} --timeout 1", &[folder.path()]).success();
    let late = valid(folder.path());
    assert_eq!(late["score"], 0.0);
    assert!(late["output"].as_str().expect("a text").contains("took longer than 1 s"), "{late}");

    // A program that cannot even start leaves what run_autograder wrote first.
    fs::create_dir_all(folder.path().join("source")).expect("it can be made");
    fs::write(folder.path().join("source/photon-mapping"), "#!/bin/false\n").expect("written");
    let run = Command::new(kit().join("kit/run_autograder"))
        .env("AUTOGRADER", folder.path())
        .stderr(Stdio::null())
        .status();
    assert!(!run.expect("it can be started").success());
    let text = fs::read_to_string(folder.path().join("results/results.json")).expect("is there");
    let results: Value = serde_json::from_str(&text).expect("it is JSON");
    assert_eq!(results["score"], 0);
}

#[test]
fn the_policy_of_the_kit_is_the_handouts_rubric() {
    let path = kit().join("kit/policy.json");
    let text = fs::read_to_string(path).expect("the kit has it");
    let policy: Policy = serde_json::from_str(&text).expect("it is a policy");
    assert_eq!(Policy { sections: BTreeMap::new(), ..policy.clone() }, Policy::default());
    assert_eq!(policy.of_all_sections(), Some(policy.correct));
}
