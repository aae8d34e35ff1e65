//! Which of the files that a grader names are whose submission, and what no output may replace.
#![cfg(unix)]

use std::fs::{self, File};
use std::io::Write as _;
use std::os::unix::fs::symlink;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use crate::support::{
    csv, fails, folder, grades, json, program, remarks, run, run_line, stderr, stdout, write,
};
use serde_json::Value;
use variants::variation::{Hemisphere, Simulation, Variation};

/// Asks `grade` for `name` in `folder`, which must be refused with both readings and each of
/// `expected`.
fn is_asked_about(folder: &Path, name: &str, expected: &[&str]) {
    let path = folder.join(name);
    let expected = [&["--submission", "--class"], expected].concat();
    fails("grade {}", &[&path], &expected);
}

/// The last words of the names of the submissions in `name`.
fn names(options: &[&str], path: &Path) -> Vec<String> {
    let last = |grade: Value| {
        let name = grade["submission"].as_str().unwrap().to_owned();
        name.rsplit('/').next().unwrap().to_owned()
    };
    grades(options, &[path]).into_iter().map(last).collect()
}

#[test]
fn outputs_replace_nothing_that_is_handed_in() {
    let folder = folder();
    let at = |name: &str| folder.path().join(name);
    let list = csv(1, 20_000);
    let handed_in = [
        "class/amy/old.csv",
        "class/amy/index.html",
        "class/amy/amy.html",
        "class/bob/PointLight.cpp",
        "class/bob/photons.csv.json",
    ];
    for name in ["amy", "bob"] {
        write(at("class").join(name).join("photons.csv"), &list);
    }
    handed_in.iter().for_each(|name| drop(write(at(name), "own")));
    symlink("class/bob/PointLight.cpp", at("out.csv")).unwrap();
    symlink("class", at("link")).unwrap();
    for line in [
        "grade class/amy --out class/amy/old.csv",
        "grade class --out class/bob/PointLight.cpp",
        "grade link --out class/bob/PointLight.cpp",
        "grade --class class --format csv --out link/bob/PointLight.cpp",
        "grade class/amy class/bob --format json --out out.csv",
        "grade class --format html --out class/amy",
        "grade class --format html --out class/amy/",
        "grade class/bob/photons.csv class/bob --format gradescope --out class/bob",
        "check class/bob --out class/bob/photons.csv",
        "check class/bob --list class/bob/photons.csv",
        "check --class class --format csv --out class/amy/old.csv",
    ] {
        let output = program(folder.path()).args(line.split(' ')).output().unwrap();
        let error = stderr(&output);
        assert!(output.status.code() == Some(2) && output.stdout.is_empty(), "{line}: {error}");
        assert!(error.contains("submission") || error.contains("one that is read"), "{error}");
        assert_eq!(error.lines().count(), 1, "{line}: {error}");
        for name in handed_in {
            assert_eq!(fs::read(at(name)).unwrap(), b"own", "{line}: {name}");
        }
        assert_eq!(fs::read_dir(at("class/amy")).unwrap().count(), 4, "{line}");
    }
    // New files are welcome, and pages of this program are replaced.
    let page = at("class/pages/");
    for _ in 0..2 {
        let paths = [&*page, &at("class/amy"), &at("class/bob")];
        run_line("grade --format html --out {} {} {}", &paths).success();
        let page = at("class/amy/grade.html");
        run_line("grade --format html --out {} {}", &[&page, &at("class/amy")]).success();
    }
    assert!(fs::read_to_string(at("class/amy/grade.html")).unwrap().contains("correct"));
}

#[test]
fn grades_in_a_class_are_no_submissions_and_are_replaced() {
    let folder = folder();
    let at = |name: &str| folder.path().join(name);
    for name in ["amy", "bob"] {
        write(at("class").join(name).join("photons.csv"), csv(1, 20_000));
    }
    let files = ["class/grades.csv", "class/grades.json", "class/grades.txt", "class/amy/own.csv"];
    for round in 0..2 {
        // Each finds what the others wrote.
        for (format, out) in ["csv", "json", "text", "csv"].iter().zip(files) {
            let line = format!("grade --format {format} --out {{}} {{}}");
            run_line(&line, &[&at(out), &at("class")]).success();
        }
        for format in ["html", "gradescope"] {
            let line = format!("grade --format {format} --out {{}} {{}}");
            run_line(&line, &[&at("class").join(format), &at("class")]).success();
        }
        assert_eq!(names(&[], &at("class")), ["amy", "bob"], "{round}");
        // As a shell names them.
        let mut paths: Vec<PathBuf> =
            fs::read_dir(at("class")).unwrap().map(|entry| entry.unwrap().path()).collect();
        paths.sort();
        let named = Vec::from(["grade", "--format", "csv", "--out"].map(PathBuf::from));
        run([named, vec![at("class/grades.csv")], paths].concat()).success();
        let rows = fs::read_to_string(at("class/grades.csv")).unwrap();
        assert_eq!(rows.lines().count(), 3, "{rows}");
    }
    let told = run_line("grade {}", &[&at("class")]).success();
    let error = stderr(told.get_output());
    assert!(
        error.contains("left out: grades.csv, grades.json, grades.txt, gradescope, html: grades"),
        "{error}"
    );
    // Grades of before, which are read, stay.
    let before = fs::read(at("class/grades.json")).unwrap();
    let out = "grade --format json --before {} --out {} {} {}";
    let json = at("class/grades.json");
    let refused = run_line(out, &[&json, &json, &json, &at("class/amy")]).code(2);
    assert!(stderr(refused.get_output()).contains("one that is read"));
    assert_eq!(fs::read(json).unwrap(), before);
}

#[test]
fn a_table_that_only_resembles_grades_is_handed_in() {
    let folder = folder();
    for (at, own) in [
        "name,id,email,score\nbob,1,b,4\n",
        "{\n  \"submission\": \"bob\"\n}\n",
        "bob: correct, 4 of 4\n",
        "bob: perfect, 4 of 4 points\n",
        "<!DOCTYPE html><p>by photon-mapping</p>\n",
    ]
    .iter()
    .enumerate()
    {
        let path = folder.path().join(at.to_string());
        write(path.join("photons.csv"), csv(1, 20_000));
        write(path.join("grades.csv"), own);
        let paths = [path.join("grades.csv"), path.clone()];
        fails("grade --out {} {}", &[&paths[0], &paths[1]], &["one in the folder of a submission"]);
        assert_eq!(fs::read_to_string(&paths[0]).unwrap(), *own);
    }
}

#[test]
fn no_output_is_called_as_others_call_standard_output() {
    let folder = folder();
    let list = write(folder.path().join("a.csv"), csv(1, 20_000));
    let list = list.to_str().unwrap();
    for line in ["grade LIST --out -", "render --photons 99 --out -", "kit student --out -"] {
        let line = line.replace("LIST", list);
        let output = program(folder.path()).args(line.split(' ')).output().unwrap();
        assert!(output.status.code() == Some(2) && output.stdout.is_empty(), "{line}");
        assert!(stderr(&output).contains("/dev/stdout"), "{}", stderr(&output));
        assert!(!folder.path().join("-").exists(), "{line}");
    }
    for verb in ["grade", "merge", "compare", "render", "check"] {
        let help = stdout(run_line(&format!("{verb} --help"), &[]).success());
        assert!(help.contains("'-' is refused"), "{verb}: {help}");
    }
}

#[test]
fn standard_input_is_called_so_and_leaves_nothing() {
    let folder = folder();
    let at = |name: &str| folder.path().join(name);
    fs::create_dir(at("tmp")).unwrap();
    let packed = write(at("packed"), b"\x1f\x8b\x08\0");
    for format in ["text", "json"] {
        let output = program(folder.path())
            .env("TMPDIR", at("tmp"))
            .args(["grade", "--format", format, "-"])
            .stdin(File::open(&packed).unwrap())
            .output()
            .unwrap();
        let text = String::from_utf8(output.stdout).unwrap();
        let is_named = text.starts_with("-: unreadable") || text.contains("\"submission\": \"-\"");
        assert!(is_named && !text.contains("tmp"), "{text}");
    }
    let mut child = program(folder.path())
        .env("TMPDIR", at("tmp"))
        .args(["grade", "-"])
        .stdin(Stdio::piped())
        .stdout(Stdio::null())
        .spawn()
        .unwrap();
    // Waiting would close it, and the program may then end before the signal comes.
    let mut input = child.stdin.take().unwrap();
    input.write_all(b"x,y,z\n").unwrap();
    while fs::read_dir(at("tmp")).unwrap().count() == 0 {
        std::thread::sleep(std::time::Duration::from_millis(10));
    }
    let id = child.id().to_string();
    assert!(Command::new("kill").args(["-TERM", &id]).status().unwrap().success());
    assert_eq!(child.wait().unwrap().code(), Some(143));
    assert_eq!(fs::read_dir(at("tmp")).unwrap().count(), 0);
}

#[test]
fn a_policy_says_everything_once() {
    let folder = folder();
    let at = |name: &str| folder.path().join(name);
    let list = write(at("a.csv"), "x,y,z\n");
    for (text, key) in [
        ("{\"correct\": 4,\n\"correct\": 5}", "policy.json:2: 'correct' comes twice"),
        ("{\"correct\": 4, \"\\u0063orrect\": 4}", "'correct' comes twice"),
        ("{\"misreadings\": {\"no-offset\": 1, \"no-offset\": 2}}", "'no-offset' comes twice"),
        ("{\"misreadings\": {},\n\"misreadings\": {}}", "policy.json:2: 'misreadings' comes twice"),
    ] {
        let policy = write(at("policy.json"), text);
        fails("grade --policy {} {}", &[&policy, &list], &[key]);
    }
    let policy = write(at("policy.json"), "\u{feff}{\"no-dots\": 3}");
    let grade = json(run_line("grade --format json --policy {} {}", &[&policy, &list]).success());
    assert_eq!(grade["score"], 3.0);
}

/// Where nothing of a photon map is in a list, the picture beside it decides.
#[test]
fn a_picture_decides_beside_what_is_no_photon_list() {
    let folder = folder();
    let at = |name: &str| folder.path().join(name);
    run_line("render --photons 60000 --quiet --out {}", &[&at("right")]).success();
    let picture = fs::read(at("right/assignment8.png")).unwrap();
    let rows = |count: u32, row: &dyn Fn(f64) -> [f64; 3]| -> String {
        (0..count).map(|i| row(f64::from(i)).map(|it| it.to_string()).join(",") + "\n").collect()
    };
    // Any numbers between 0 and 1 will do.
    let any =
        |i: f64, seed: f64| ((i + 1.0) * seed).sin().mul_add(43_758.545_3, 0.0).rem_euclid(1.0);
    let unit = |i: f64| {
        let (z, angle) = (2.0 * any(i, 12.9) - 1.0, std::f64::consts::TAU * any(i, 78.2));
        let radius = (1.0 - z * z).sqrt();
        [radius * angle.cos(), radius * angle.sin(), z]
    };
    let corner = |i: f64| [0.25, 0.5, 1.0].map(|bit: f64| (i * bit).floor().rem_euclid(2.0) - 0.5);
    let tables = [
        ("kdtree.csv", rows(1000, &|i| [i, i + 1.0, i + 2.0])),
        ("timings.csv", rows(100, &|i| [i, i * i, 3.0])),
        ("numbers.csv", rows(500, &|i| [i, any(i, 3.1), any(i, 4.7)])),
        ("normals.csv", rows(2000, &unit)),
        ("random.csv", rows(2000, &|i| [any(i, 1.7), any(i, 2.3), any(i, 5.9)])),
        ("box.csv", rows(32, &corner)),
    ];
    for (name, table) in &tables {
        let student = at("class").join(name);
        write(student.join("assignment8.png"), &picture);
        write(student.join(name), format!("x,y,z\n{table}"));
        let grade = &grades(&["--submission"], &[&student])[0];
        assert_eq!(
            (&grade["verdict"], &grade["score"]),
            (&"correct".into(), &4.0.into()),
            "{name}"
        );
        assert!(remarks(grade).contains(name), "{grade:#}");
    }
    // Several tables are as little a list as one.
    let student = at("several");
    write(student.join("assignment8.png"), &picture);
    for (name, table) in &tables {
        write(student.join(name), format!("x,y,z\n{table}"));
    }
    let grade = &grades(&["--submission"], &[&student])[0];
    assert_eq!(grade["verdict"], "correct", "{grade:#}");
    assert!(remarks(grade).contains("kdtree.csv"), "{grade:#}");
    // A photon map with mistakes decides.
    let uniform = Variation { hemisphere: Hemisphere::Uniform, ..Variation::default() };
    let mut wrong = "x,y,z\n".to_owned();
    for record in Simulation::new(uniform, 9, 60_000, 1000).trace(0..60_000) {
        let [x, y, z] = record.position.to_array();
        wrong += &format!("{x},{y},{z}\n");
    }
    write(at("wrong/assignment8.png"), &picture);
    write(at("wrong/photons.csv"), wrong);
    assert_eq!(grades(&[], &[&at("wrong")])[0]["verdict"], "incorrect");
}

#[test]
fn several_students_files_are_no_single_submission() {
    let folder = folder();
    let at = |name: &str| folder.path().join(name);
    let list = csv(1, 20_000);
    let png = b"\x89PNG\r\n\x1a\n";
    for (name, files) in [
        ("flat", &["amy.csv", "bob.csv", "cat.csv"][..]),
        ("usual", &["amy.csv", "bob.csv", "photons.csv"]),
        ("mix", &["amy/photons.csv", "bob.csv", "cat.csv"]),
        ("sections", &["1/amy/a.csv", "1/bob/b.csv", "2/cat/c.csv", "2/dan/d.csv"]),
    ] {
        files.iter().for_each(|file| drop(write(at(name).join(file), &list)));
    }
    for name in ["amy", "bob", "cat"] {
        write(at("shots").join(name).with_extension("png"), png);
    }
    is_asked_about(folder.path(), "flat", &["amy.csv", "bob.csv", "cat.csv"]);
    is_asked_about(folder.path(), "usual", &["amy.csv", "bob.csv"]);
    is_asked_about(folder.path(), "shots", &["amy.png", "bob.png", "cat.png"]);
    is_asked_about(folder.path(), "mix", &["amy", "bob.csv", "cat.csv"]);
    is_asked_about(folder.path(), "sections", &["sections/1", "amy", "bob"]);
    assert_eq!(names(&["--class"], &at("flat")), ["amy.csv", "bob.csv", "cat.csv"]);
    assert_eq!(names(&["--class"], &at("mix")), ["amy", "bob.csv", "cat.csv"]);
    assert_eq!(names(&["--submission"], &at("flat")), ["flat"]);
    // One student's own files stay one submission.
    for file in ["photons.csv", "old.csv", "test-2.csv", "run.csv"] {
        write(at("own").join(file), &list);
    }
    assert_eq!(names(&[], &at("own")), ["own"]);
    // Canvas says whose they are.
    for file in ["doejane_12_901_photons.csv", "roeal_LATE_13_902_photons-1.csv"] {
        write(at("canvas").join(file), &list);
    }
    assert_eq!(names(&[], &at("canvas")), ["doejane", "roeal"]);
}

#[test]
fn one_section_in_a_class_costs_the_others_nothing() {
    let folder = folder();
    let at = |name: &str| folder.path().join("class").join(name);
    for name in ["amy/photons.csv", "bob/photons.csv", "two/cat/p.csv", "two/dan/p.csv"] {
        write(at(name), csv(1, 60_000));
    }
    let path = folder.path().join("class");
    let output = run_line("grade --format json --emitted 60000 {}", &[&path]).code(2);
    assert!(stderr(output.get_output()).contains("class/two: it could be one submission"));
    let grades = json(output);
    let verdicts: Vec<_> = (0..3).map(|at| grades[at]["verdict"].as_str().unwrap()).collect();
    assert_eq!(verdicts, ["correct", "correct", "unreadable"]);
}

#[test]
fn a_class_is_found_in_single_folders() {
    let folder = folder();
    let at = |name: &str| folder.path().join(name);
    let list = csv(1, 20_000);
    for file in ["c/submissions/amy/photons.csv", "c/submissions/bob/photons.csv", "one/eve/p.csv"]
    {
        write(at(file), &list);
    }
    for options in [&[][..], &["--class"]] {
        assert_eq!(names(options, &at("c")), ["amy", "bob"], "{options:?}");
    }
    assert_eq!(names(&["--class"], &at("one")), ["eve"]);
    write(at("c/submissions/submission_metadata.yml"), "amy:\n");
    assert_eq!(names(&[], &at("c")), ["amy", "bob"]);
}

#[test]
fn names_with_a_dot_are_told_and_litter_is_not() {
    let folder = folder();
    let at = |name: &str| folder.path().join(name);
    let list = csv(1, 60_000);
    for file in ["dotted/.amy/photons.csv", "dotted/bob/photons.csv"] {
        write(at(file), &list);
    }
    let grade = &grades(&[], &[&at("dotted")])[0];
    assert!(remarks(grade).contains("left out: .amy"), "{grade:#}");
    for file in ["class/amy/photons.csv", "class/bob/photons.csv", "class/__MACOSX/amy/p.csv"] {
        write(at(file), &list);
    }
    for litter in [".DS_Store", "Thumbs.db", "desktop.ini", "amy/.DS_Store", "amy/Thumbs.db"] {
        write(at("class").join(litter), &list);
    }
    for options in [&[][..], &["--class"]] {
        assert_eq!(names(options, &at("class")), ["amy", "bob"]);
    }
    let output = run_line("grade {}", &[&at("class")]).success();
    let told = stderr(output.get_output()) + &stdout(output);
    assert!(!told.contains("left out"), "{told}");
    let paths = ["class/amy", "class/bob", "class/__MACOSX"].map(at);
    assert_eq!(grades(&[], &paths.each_ref().map(|path| path.as_path())).len(), 2);
}
