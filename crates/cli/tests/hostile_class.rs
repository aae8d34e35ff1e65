//! What a class of attackers can do: nothing.
#![cfg(unix)]

use std::fs::{self, File};
use std::os::unix::fs::{PermissionsExt, symlink};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::Duration;

use crate::support::{
    csv, folder, grades, mkfifo, program, reference_csv, remarks, run_line, stderr, stdout, write,
};
use serde_json::Value;

/// A class in which half of all submissions attack.
fn hostile_class(class: &Path, outside: &Path) -> Vec<String> {
    let at = |name: &str| class.join(name);
    let good = csv(1, 20_000);
    let ply = |rest: &str| format!("ply\nformat binary_little_endian 1.0\n{rest}");
    let xyz = "property float x\nproperty float y\nproperty float z\nend_header\n";
    let long = "漢".repeat(85);
    let list = |name: &str, contents: Vec<u8>| drop(write(at(name).join("photons.csv"), contents));
    list(&long, good.clone().into());
    // As many rows as are read, packed to next to nothing, and as many that nothing packs.
    let header = ply("element vertex 5000000\nproperty float x\nproperty float y\n\
                      property uchar z\nend_header\n");
    let rows = |x: fn(u32) -> f32| -> Vec<u8> {
        let mut rows = Vec::new();
        for number in 0..5_000_000 {
            let row = [x(number), x(number + 1)].map(f32::to_le_bytes);
            rows.extend(row.as_flattened());
            rows.push(0);
        }
        rows
    };
    let random = |number: u32| number.wrapping_mul(2_654_435_761) as f32 / 4e9;
    list("same-rows", [header.as_bytes(), &rows(|_| 0.123_456)].concat());
    list("rows", [header.as_bytes(), &rows(random)].concat());
    list("comments", "#,x,y,z,x,y,z\n".repeat(2_000_000).into());
    list("vertices", ply(&format!("element vertex {}\n{xyz}1234", u64::MAX)).into());
    list("nothing", ply(&format!("element none {}\nelement vertex 0\n{xyz}", u64::MAX)).into());
    let elements: String = (0..90_000).map(|number| format!("element {number:064} 0\n")).collect();
    list("elements", ply(&format!("{elements}element vertex 0\n{xyz}")).into());
    list("endless-line", vec![b'7'; 20_000_000]);
    list("escape", b"x,y,z\n1,\x1b[2J\xe2\x80\xaebob: correct,3\n".to_vec());
    list("bob: correct, 4 of 4 points", b"x,y\n".to_vec());
    list(
        "nan",
        "x,y,z\n".to_owned().into_bytes().into_iter().chain(*b"nan,inf,1.#IND\n").collect(),
    );
    list("columns", (",".repeat(60_000) + "\nx,y,z\n").into());
    fs::create_dir(at("sparse")).unwrap();
    File::create(at("sparse/photons.csv")).unwrap().set_len(1 << 36).unwrap();
    fs::create_dir(at("pipe")).unwrap();
    mkfifo(&at("pipe/photons.csv"));
    fs::create_dir(at("loop")).unwrap();
    symlink("../loop", at("loop/loop")).unwrap();
    symlink(outside, at("link-out")).unwrap();
    fs::create_dir(at("link-in")).unwrap();
    symlink(outside.join("secret.csv"), at("link-in/photons.csv")).unwrap();
    let mut png = Vec::new();
    let picture = image::RgbImage::new(640, 480);
    picture.write_to(&mut std::io::Cursor::new(&mut png), image::ImageFormat::Png).unwrap();
    png[16..24].copy_from_slice(&[0, 0, 0xff, 0xff, 0, 0, 0xff, 0xff]);
    write(at("pixels/assignment8.png"), &png);
    write(at("packed/photons.zip"), b"PK\x03\x04");
    // One file under many names: to look at, and to hold against each other.
    let names = "#x,y,z".to_owned() + &",q".repeat(300) + "\n";
    let first = write(at("many-files/0.csv"), names.repeat(100));
    (1..9000)
        .for_each(|number| fs::hard_link(&first, at(&format!("many-files/{number}"))).unwrap());
    let first = write(at("many-copies/0.csv"), "x,y,z\n".to_owned() + &"1,1,0\n".repeat(30));
    File::options().write(true).open(&first).unwrap().set_len(32 << 20).unwrap();
    (1..1000)
        .for_each(|number| fs::hard_link(&first, at(&format!("many-copies/{number}"))).unwrap());
    write(at("--out=out").join("photons.csv"), &good);
    write(at("deep").join("d/".repeat(60)).join("photons.csv"), &good);
    (0..20).map(|number| format!("good-{number:02}")).collect()
}

/// All files below `folder` with their contents.
fn tree(folder: &Path) -> Vec<(PathBuf, u64)> {
    let mut all = Vec::new();
    for entry in fs::read_dir(folder).unwrap() {
        let entry = entry.unwrap();
        let about = fs::symlink_metadata(entry.path()).unwrap();
        all.push((entry.path(), if about.is_file() { about.len() } else { 0 }));
        if about.is_dir() {
            all.extend(tree(&entry.path()));
        }
    }
    all.sort();
    all
}

#[test]
fn a_class_of_attackers_ends_with_all_grades() {
    let folder = folder();
    let at = |name: &str| folder.path().join(name);
    write(at("outside/secret.csv"), "x,y,z\n1,password,3\n");
    fs::create_dir(at("class")).unwrap();
    let good = hostile_class(&at("class"), &at("outside"));
    for (seed, name) in good.iter().enumerate() {
        write(at("class").join(name).join("photons.csv"), csv(seed as u64, 60_000));
    }
    let alone = &grades(&[], &[&at("class").join(&good[7])])[0];
    let before = tree(folder.path());
    let program = env!("CARGO_BIN_EXE_photon-mapping");
    let run = |prefix: &str, line: &str| {
        // As on a machine of 64 cores.
        let limits = "ulimit -v 950000; ulimit -n 40; ulimit -t 90; export RAYON_NUM_THREADS=64";
        let line = format!("{limits}; {prefix} {program} grade --class --emitted 60000 {line}");
        let output =
            Command::new("sh").args(["-c", &line]).current_dir(folder.path()).output().unwrap();
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
        output
    };
    let output = run("", "--format json class");
    let grades: Vec<Value> = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(grades.len(), 43);
    let all = String::from_utf8_lossy(&output.stdout);
    assert!(!all.contains("password"), "what a link leads to is not told");
    assert!(!all.contains('\u{202e}') && !all.contains("\\u001b"));
    for grade in &grades {
        let name = grade["submission"].as_str().unwrap();
        if name.starts_with("class/good-") {
            assert_eq!(grade["score"], 4.0, "{name}: {grade:#}");
        } else if !["漢", "--out=out", "same-rows"].iter().any(|known| name.contains(known)) {
            assert!(grade["score"].as_f64().unwrap() <= 2.0, "{grade:#}");
        }
    }
    let same = grades.iter().find(|grade| grade["submission"] == "class/good-07").unwrap();
    assert_eq!((&same["score"], &same["findings"]), (&alone["score"], &alone["findings"]));
    assert_eq!(tree(folder.path()), before, "nothing is touched");
    // A file of its own for each, whatever it is called, by somebody who may write nowhere else.
    // The many rows were read within the limits above; they are no oddity of a name.
    let many_rows = ["rows", "same-rows"].map(|name| at("class").join(name));
    many_rows.iter().for_each(|many| fs::remove_dir_all(many).unwrap());
    let before = tree(folder.path());
    fs::create_dir(at("out")).unwrap();
    for (name, mode) in [("", 0o755), ("out", 0o777)] {
        fs::set_permissions(at(name), fs::Permissions::from_mode(mode)).unwrap();
    }
    let nobody = "setpriv --reuid=65534 --regid=65534 --clear-groups";
    let is_root = Command::new("sh").args(["-c", &format!("{nobody} test -x {program}")]).status();
    let is_root = is_root.is_ok_and(|status| status.success());
    run(if is_root { nobody } else { "" }, "--format gradescope --out out class");
    let written = fs::read_dir(at("out")).unwrap().map(|entry| {
        serde_json::from_slice::<Value>(&fs::read(entry.unwrap().path()).unwrap()).unwrap()
    });
    let is_left = |grade: &&Value| !grade["submission"].as_str().unwrap().ends_with("rows");
    let scores = |grades: &[Value]| {
        let mut scores: Vec<f64> = grades.iter().map(|it| it["score"].as_f64().unwrap()).collect();
        scores.sort_by(f64::total_cmp);
        scores
    };
    let left: Vec<Value> = grades.iter().filter(is_left).cloned().collect();
    assert_eq!(left.len(), 41);
    assert_eq!(scores(&written.collect::<Vec<_>>()), scores(&left));
    fs::remove_dir_all(at("out")).unwrap();
    assert_eq!(tree(folder.path()), before, "nothing outside of the output folder is touched");
}

#[test]
fn what_cannot_be_read_now_is_told_and_tried_again() {
    let folder = folder();
    let lists: Vec<String> = (0..6).map(|seed| format!("list-{seed}.csv")).collect();
    for (seed, name) in lists.iter().enumerate() {
        write(folder.path().join(name), csv(seed as u64, 20_000));
    }
    let program = env!("CARGO_BIN_EXE_photon-mapping");
    let graded = |limits: &str, names: &str| {
        let line = format!("{limits}{program} grade {names}");
        Command::new("sh").args(["-c", &line]).current_dir(folder.path()).output().unwrap()
    };
    // Threads may be lucky and never have two files open at once.
    let output = graded("ulimit -n 4; ", &lists.join(" "));
    let grades = String::from_utf8_lossy(&output.stdout).into_owned();
    match output.status.code() {
        Some(0) => assert!(!grades.contains("unreadable"), "{grades}"),
        code => assert!(code == Some(2) && stderr(&output).contains("try again"), "{grades}"),
    }
    let output = graded("", &format!("{} {}", "x".repeat(300), lists[0]));
    let grades = String::from_utf8_lossy(&output.stdout).into_owned();
    assert_eq!(output.status.code(), Some(2), "{grades}");
    assert!(grades.contains("list-0.csv: "), "the others are graded: {grades}");
    assert!(stderr(&output).contains("could not be read: try again"), "{}", stderr(&output));
}

#[test]
fn kill_leaves_each_file_whole_or_as_it_was() {
    let folder = folder();
    let at = |name: &str| folder.path().join(name);
    for seed in 0..4 {
        write(at(&format!("class/student-{seed}/photons.csv")), csv(seed, 5_000));
    }
    fs::create_dir(at("out")).unwrap();
    let changed = || fs::metadata(at("out")).unwrap().modified().unwrap();
    let mut seen_half_done = false;
    for number in 0..100 {
        let before = changed();
        let mut child = program(folder.path())
            .args(["grade", "--class", "class", "--format", "gradescope", "--out", "out"])
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        // Until it writes its first file there is nothing to break.
        while changed() == before && child.try_wait().unwrap().is_none() {
            std::thread::sleep(Duration::from_micros(200));
        }
        std::thread::sleep(Duration::from_micros(number % 10 * 100));
        let _ = child.kill();
        seen_half_done |= !child.wait().unwrap().success();
        for entry in fs::read_dir(at("out")).unwrap() {
            let path = entry.unwrap().path();
            if path.extension().is_some_and(|extension| extension == "json") {
                let results = serde_json::from_slice::<Value>(&fs::read(&path).unwrap());
                assert!(results.is_ok(), "{}", path.display());
            }
        }
    }
    assert!(seen_half_done);
    let line = "grade --class {} --format gradescope --out {}";
    run_line(line, &[&at("class"), &at("out")]).success();
    assert_eq!(fs::read_dir(at("out")).unwrap().count(), 4, "nothing unfinished is left");
}

#[test]
fn names_move_no_cursor_and_read_as_no_grade() {
    let folder = folder();
    let hidden = "\u{1b}\u{202e}\u{200b}\u{9b}\u{fe0f}\u{e0100}\u{17b4}\u{2800}";
    let odd = &format!("bob: correct, 4 of 4 points{hidden}[2J");
    let at = |name: &str| folder.path().join(name);
    write(at("class").join(odd).join("photons.csv"), "x,y\n1,2\n");
    write(at(&format!("{odd}.csv")), format!("x,y,z\n{odd},2,3\n"));
    write(at(&format!("{odd}.obj")), format!("usemtl {odd}\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"));
    write(at("policy.json"), format!("{{\"{}\": 1}}", odd.replace('\u{1b}', "\\u001b")));
    let list = format!("{odd}.csv");
    let model = format!("{odd}.obj");
    let few = reference_csv(folder.path(), 2000);
    let few = few.to_str().unwrap();
    let runs: [&[&str]; 7] = [
        &["grade", "--class", "class"],
        &["grade", "--class", "class", "--format", "json"],
        &["grade", "--policy", "policy.json", &list],
        &["compare", few, &list],
        &["compare", "--json", few, few],
        &["render", "--photons-from", &list],
        &["render", "--scene", &model, "--light", "0,0,1", "--count-only"],
    ];
    for arguments in runs {
        let output = program(folder.path()).args(arguments).output().unwrap();
        for text in [&output.stdout, &output.stderr] {
            let text = String::from_utf8(text.clone()).unwrap();
            let odd = |letter: char| hidden.contains(letter);
            assert!(!text.contains(odd), "{arguments:?}: {text:?}");
            let reads_as_grade =
                |line: &str| line.starts_with("bob: ") || line.contains("class/bob: ");
            assert!(
                !text.lines().any(|line| reads_as_grade(line) && !line.contains('"')),
                "{text}"
            );
        }
    }
}

#[test]
fn names_that_could_be_read_as_a_grade_are_quoted() {
    let folder = folder();
    let at = |name: &str| folder.path().join("class").join(name);
    let odd = [
        "amy: 4",
        "bob, correct",
        "cy\u{a789} correct",
        "dee\u{ff1a}correct",
        " eve",
        "f\u{2d0} g",
    ];
    let plain = ["Gil", "hannah_1234", "J. R. (late)", "漢字"];
    for name in odd.iter().chain(&plain) {
        write(at(name).join("photons.csv"), "x,y\n");
    }
    let output = program(folder.path()).args(["grade", "--class", "class"]).output().unwrap();
    let text = String::from_utf8(output.stdout).unwrap();
    for name in odd {
        assert!(text.contains(&format!("\"class/{name}\": unreadable")), "{name}: {text}");
    }
    for name in plain {
        assert!(text.contains(&format!("\nclass/{name}: unreadable")), "{name}: {text}");
    }
}

#[test]
fn what_a_student_hands_in_names_nobody_else() {
    let folder = folder();
    let at = |name: &str| folder.path().join("class").join(name);
    let list = csv(1, 60_000);
    write(at("submission_1/photons.csv"), "x,y,z\n");
    write(at("submission_2/photons.csv"), &list);
    let metadata = "submission_2:\n  :submitters:\n  - :name: Eve\n    :sid: '1'\n";
    write(at("submission_1/submission_metadata.yml"), metadata);
    let paths = [at("submission_1"), at("submission_2")];
    let grades = grades(&[], &paths.each_ref().map(PathBuf::as_path));
    let names = grades.iter().map(|grade| grade["submission"].as_str().unwrap());
    assert!(!names.into_iter().any(|name| name.contains("Eve")), "{grades:#?}");
    // Folders with the names of others make nobody a class.
    for name in ["amy", "bob"] {
        write(at("submission_1").join(name).join("photons.csv"), &list);
    }
    fs::remove_file(at("submission_1/photons.csv")).unwrap();
    let output = program(&at("")).args(["grade", "submission_1", "submission_2"]).output().unwrap();
    let text = String::from_utf8(output.stdout.clone()).unwrap();
    assert_eq!(output.status.code(), Some(2), "{text}");
    assert!(text.starts_with("submission_2: ") && !text.contains("amy"), "{text}");
    let told = stderr(&output);
    assert!(told.contains("submission_1: it could be one submission, or a class"), "{told}");
    // Nor is a pipe waited for in what is named.
    mkfifo(&at("submission_2/submission_metadata.yml"));
    run_line("grade {}", &[&paths[1]]).success();
}

#[test]
fn a_submission_that_links_to_anothers_is_a_twin() {
    let folder = folder();
    let at = |name: &str| folder.path().join(name);
    run_line("render --photons 60000 --quiet --format csv --out {}", &[&at("amy")]).success();
    symlink("amy", at("bob")).unwrap();
    for name in ["assignment8.png", "photons.csv"] {
        let [amy, bob] = ["amy", "bob"].map(|student| at(student).join(name));
        let twins = |paths: &[&Path]| {
            let same = |grade| remarks(grade).contains("is the same, byte by byte");
            grades(&[], paths).iter().map(same).collect::<Vec<_>>()
        };
        assert_eq!(twins(&[&amy, &bob]), [true, true], "{name}");
        assert_eq!(twins(&[&amy, &at("bob/../amy").join(name)]), [true, true], "{name}");
        assert_eq!(twins(&[&amy, &amy]), [false, false], "{name}: named twice");
    }
}

/// A photon or a few, invented or true, decide nothing.
#[test]
fn a_few_photons_get_no_points() {
    let folder = folder();
    for list in ["x,y,z\n1,1,1\n", "x,y,z\n0.5,0.2,0\n", "x,y,z\n-1,-1,0\n1,0.5,1\n"] {
        let path = folder.path().join("photons.csv");
        write(path.clone(), list);
        let text = stdout(run_line("grade {}", &[&path]).success());
        assert!(text.contains("undecided, needs a look, 0 of 4 points"), "{text}");
    }
    run_line("render --photons 1000 --quiet --out {}", &[folder.path()]).success();
    let picture = folder.path().join("assignment8.png");
    let text = stdout(run_line("grade {}", &[&picture]).success());
    assert!(text.contains("undecided, needs a look, 0 of 4 points"), "{text}");
}
