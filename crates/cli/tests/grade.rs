//! `grade` on what students hand in: folders and pairs, other programs' lists, and files that are
//! none.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::{Duration, Instant};

use crate::support::{fails, folder, json, run};
use classroom::class::grade_one;
use classroom::intake::{Folders, HandedIn};
use grading::submission::{Settings, Submission, unreadable};
use grading::verdict::Verdict;
use photon_list::reader::load_at_most;
use serde_json::Value;

const PHOTONS: u64 = 60_000;

/// The positions that the reference stores, a line for each, as `line` writes it.
fn lines(line: impl Fn([f32; 3]) -> String) -> String {
    let list = fixtures::list(&fixtures::handout(7, PHOTONS));
    list.iter().map(|record| line(record.position.to_array()) + "\n").collect()
}

fn csv() -> String {
    "x,y,z\n".to_owned() + &lines(|[x, y, z]| format!("{x},{y},{z}"))
}

fn write(path: PathBuf, contents: impl AsRef<[u8]>) -> PathBuf {
    fs::create_dir_all(path.parent().unwrap()).unwrap();
    fs::write(&path, contents).unwrap();
    path
}

/// The grades of `paths`, in JSON.
fn grades(paths: &[PathBuf], options: &[&str]) -> Vec<Value> {
    let paths = paths.iter().map(|path| path.as_os_str());
    let options = options.iter().map(std::ffi::OsStr::new);
    let command = [std::ffi::OsStr::new("grade"), "--format".as_ref(), "json".as_ref()];
    let output = json(run(command.into_iter().chain(options).chain(paths)).success());
    match output {
        Value::Array(grades) => grades,
        grade => vec![grade],
    }
}

/// What the finding `check` of `grade` found.
fn found<'a>(grade: &'a Value, check: &str) -> &'a str {
    let findings = grade["findings"].as_array().unwrap();
    let finding = findings.iter().find(|finding| finding["check"] == check);
    finding.unwrap_or_else(|| panic!("no '{check}' in {grade:#}"))["found"].as_str().unwrap()
}

/// What a grader who names `paths` gets to grade.
fn collect(paths: &[PathBuf]) -> Vec<HandedIn> {
    classroom::intake::collect(paths, Folders::Clear).handed_in
}

#[test]
fn what_a_class_hands_in() {
    let folder = folder();
    let at = |path: &str| folder.path().join(path);
    let list = csv();
    let png = b"\x89PNG\r\n\x1a\n";
    let mut paths = Vec::new();
    paths.push(write(at("pair.csv"), &list));
    paths.push(write(at("alone.csv"), &list));
    paths.push(write(at("pair.png"), png));
    write(at("nested/homework/dump.txt"), &list);
    write(at("nested/homework/main.cpp"), "int main() {}\n");
    write(at("nested/.DS_Store"), list.clone() + "1,2,3\n");
    paths.push(at("nested"));
    write(at("two/a.csv"), &list);
    write(at("two/b.csv"), list.clone() + "1,2,3\n");
    write(at("same/a.csv"), &list);
    write(at("same/b.csv"), &list);
    paths.push(at("two"));
    paths.push(at("same"));
    write(at("usual/photons.csv"), &list);
    write(at("usual/earlier.csv"), "x,y,z\n");
    paths.push(at("usual"));
    write(at("handout/assignment8.csv"), &list);
    write(at("handout/tests.csv"), "x,y,z\n");
    paths.push(at("handout"));
    write(at("pictures/photons.csv"), &list);
    write(at("pictures/1.png"), png);
    write(at("pictures/2.png"), b"\x89PNG\r\n\x1a\nother");
    paths.push(at("pictures"));
    write(at("broken/photons.csv"), "x;why\n1;2\n");
    paths.push(at("broken"));
    fs::create_dir(at("empty")).unwrap();
    paths.push(at("empty"));
    paths.push(at("alone.csv"));
    let grades = grades(&paths, &["--emitted", "60000"]);
    let expected = [
        ("pair", "correct", None),
        ("alone.csv", "correct", None),
        ("nested", "correct", None),
        ("two", "unreadable", Some(("readable", "2 photon lists in it (a.csv, b.csv)"))),
        (
            "same",
            "correct",
            Some(("files", "a.csv is judged, and left out: b.csv, which is the same")),
        ),
        ("usual", "correct", Some(("files", "photons.csv is judged, and left out: earlier.csv"))),
        (
            "handout",
            "correct",
            Some(("files", "assignment8.csv is judged, and left out: tests.csv")),
        ),
        ("pictures", "correct", Some(("files", "2 pictures in it (1.png, 2.png)"))),
        ("broken", "unreadable", Some(("readable", "line 1: expected the columns x, y and z"))),
        ("empty", "unreadable", Some(("readable", "neither a photon list nor a picture"))),
        ("alone.csv (2)", "correct", None),
    ];
    assert_eq!(grades.len(), expected.len());
    for (grade, (name, verdict, finding)) in grades.iter().zip(expected) {
        assert_eq!(grade["submission"], at(name).display().to_string());
        assert_eq!(grade["verdict"], verdict, "{grade:#}");
        if let Some((check, part)) = finding {
            assert!(found(grade, check).contains(part), "{name}: {}", found(grade, check));
        }
    }
    let stored = load_at_most(&at("alone.csv"), 100_000).unwrap().0.records.len();
    assert!(grades.iter().all(|grade| grade["stored"].is_null() || grade["stored"] == stored));
}

#[test]
fn a_folder_of_students_is_a_class() {
    let folder = folder();
    let at = |path: &str| folder.path().join(path);
    let list = csv();
    write(at("class/alice/out/photons.csv"), &list);
    // As long as the others', in another order.
    let mut lines: Vec<&str> = list.lines().collect();
    lines[1..].reverse();
    write(at("class/bob/mine.csv"), lines.join("\n") + "\n");
    write(at("class/carol/main.cpp"), "int main() {}\n");
    write(at("class/dave/photons.csv"), &list);
    write(at("class/erin/photons.csv.gz"), b"\x1f\x8b\x08\0");
    write(at("class/roster.txt"), "alice\n");
    write(at("class/.trash/photons.csv"), &list);
    let grades = grades(&[at("class")], &["--emitted", "60000"]);
    let expected = [
        ("alice", "correct", "same files", "the same, byte by byte, as that of"),
        ("bob", "correct", "same files", "the photons are the same as those of"),
        ("carol", "unreadable", "readable", "neither a photon list nor a picture"),
        ("dave", "correct", "same files", "class/alice"),
        ("erin", "unreadable", "readable", "photons.csv.gz is packed (gzip): unpack it first"),
    ];
    assert_eq!(grades.len(), expected.len());
    for (grade, (name, verdict, check, part)) in grades.iter().zip(expected) {
        assert_eq!(grade["submission"], at("class").join(name).display().to_string());
        assert_eq!(grade["verdict"], verdict, "{grade:#}");
        if check.is_empty() {
            let findings = grade["findings"].as_array().unwrap();
            assert!(findings.iter().all(|finding| finding["check"] != "same files"), "{grade:#}");
        } else {
            assert!(found(grade, check).contains(part), "{grade:#}");
        }
    }
}

#[test]
fn a_student_with_older_files_in_folders_is_no_class() {
    let folder = folder();
    let list = "x,y,z\n1,2,3\n";
    for (name, contents) in [
        ("dump", list.as_bytes()),
        ("photons.csv", b"x;why\n1;2\n"),
        ("1.png", b"\x89PNG\r\n\x1a\n"),
    ] {
        let student = folder.path().join(format!("with-{name}"));
        write(student.join(name), contents);
        write(student.join("monday/photons.csv"), list);
        write(student.join("tuesday/photons.csv"), list);
        assert_eq!(collect(&[student]).len(), 1, "{name}");
    }
}

#[test]
fn pictures_make_a_class_too_and_those_that_are_the_same_are_told() {
    let folder = folder();
    let at = |path: &str| folder.path().join(path);
    let png = b"\x89PNG\r\n\x1a\n";
    for student in ["ann", "ben"] {
        write(at("class").join(student).join("1.png"), png);
    }
    let [ann, ben] = &collect(&[at("class")])[..] else { panic!("two students") };
    for (one, other) in [(ann, ben), (ben, ann)] {
        let [twin] = one.twins.as_slice() else { panic!("{:?}", one.twins) };
        assert!(twin.contains("the picture is the same"), "{twin}");
        assert!(twin.contains(&other.submission.name), "{twin}");
    }
    // A file that is named twice has nothing in common with itself.
    let twice = collect(&[at("class/ann/1.png"), at("class/ben/../ann/1.png")]);
    assert!(twice.len() == 2 && twice.iter().all(|handed_in| handed_in.twins.is_empty()));
}

#[test]
#[cfg(unix)]
fn what_a_class_s_folder_has_besides_folders_is_told() {
    let folder = folder();
    let at = |path: &str| folder.path().join(path);
    let list = "x,y,z\n1,2,3\n";
    for student in ["class/ann", "class/ben", "elsewhere"] {
        write(at(student).join("photons.csv"), list);
    }
    write(at("class/yves.zip"), b"PK\x03\x04");
    write(at("class/roster.xlsx"), b"PK\x03\x04");
    std::os::unix::fs::symlink(at("elsewhere"), at("class/zoe")).unwrap();
    let handed_in = collect(&[at("class")]);
    let names: Vec<_> = handed_in.iter().map(|one| one.submission.name.clone()).collect();
    let expected = ["class/ann", "class/ben", "class/yves.zip", "class/zoe"];
    assert_eq!(names, expected.map(|name| at(name).display().to_string()));
    let problem = |at: usize| handed_in[at].problem.as_deref().unwrap_or_default();
    assert!(problem(0).is_empty() && problem(1).is_empty());
    assert!(problem(2).contains("packed (zip)"), "{}", problem(2));
    assert!(problem(3).contains("a link"), "{}", problem(3));
    assert!(handed_in[3].submission.list.is_none());
}

#[test]
fn names_count_without_their_capitals() {
    let folder = folder();
    let at = |path: &str| folder.path().join(path);
    write(at("two/Photons.CSV"), "x,y,z\n1,2,3\n");
    write(at("two/test.csv"), "x,y,z\n4,5,6\n");
    write(at("broken/PHOTONS.CSV"), "x;why\n1;2\n");
    let [two, broken] = &collect(&[at("two"), at("broken")])[..] else { panic!("two students") };
    assert_eq!(two.submission.list, Some(at("two/Photons.CSV")), "{two:?}");
    assert_eq!(broken.submission.list, Some(at("broken/PHOTONS.CSV")), "{broken:?}");
}

#[test]
fn packed_files_are_told_by_what_they_are_packed_with() {
    let folder = folder();
    let kinds: [(&str, &[u8]); 7] = [
        ("gzip", b"\x1f\x8b\x08\0"),
        ("zip", b"PK\x03\x04\x14\0"),
        ("xz", b"\xfd7zXZ\0\0"),
        ("7-Zip", b"7z\xbc\xaf\x27\x1c\0"),
        ("RAR", b"Rar!\x1a\x07"),
        ("bzip2", b"BZh91AY"),
        ("Zstandard", b"\x28\xb5\x2f\xfd\x04"),
    ];
    for (kind, start) in kinds {
        let student = folder.path().join(kind);
        let file = write(student.join("photons.csv"), start);
        for path in [file, student] {
            let problem = collect(&[path]).remove(0).problem.expect("it cannot be graded");
            assert!(problem.contains(&format!("packed ({kind}): unpack it first")), "{problem}");
        }
    }
}

#[test]
fn a_folder_of_far_too_much_is_no_students() {
    let folder = folder();
    let at = |path: &str| folder.path().join(path);
    write(at("deep").join("more/".repeat(7)).join("photons.csv"), "x,y,z\n");
    fs::create_dir(at("wide")).unwrap();
    for number in 0..=10_000 {
        fs::File::create(at("wide").join(number.to_string())).unwrap();
    }
    for name in ["deep", "wide"] {
        let problem = collect(&[at(name)]).remove(0).problem.expect("it cannot be graded");
        assert!(problem.contains("more than 10000 files or 6 levels"), "{name}: {problem}");
    }
}

#[test]
fn a_mistyped_path_is_no_students_fault() {
    let folder = folder();
    let (list, missing) =
        (write(folder.path().join("list.csv"), csv()), folder.path().join("lits"));
    let assert = crate::support::run_line("grade --format json {} {}", &[&missing, &list]).code(2);
    let error = String::from_utf8_lossy(&assert.get_output().stderr).into_owned();
    assert!(error.contains("lits: no such file") && error.lines().count() == 1, "{error}");
    let grades = json(assert);
    assert_eq!(grades.as_array().unwrap().len(), 1);
    assert_eq!(grades[0]["verdict"], "correct");
    // Nothing is graded then, not even nobody.
    fails("grade --format json {}", &[&missing], &["lits: no such file"]);
    // There is a page for each of those that were named.
    fails("grade --format html {} {}", &[&missing, &list], &["--out", "2 submissions"]);
}

#[cfg(unix)]
#[test]
fn no_file_and_no_way_out() {
    let folder = folder();
    let at = |path: &str| folder.path().join(path);
    write(at("secret.csv"), csv());
    fs::create_dir(at("link")).unwrap();
    std::os::unix::fs::symlink(at("secret.csv"), at("link/photons.csv")).unwrap();
    fs::create_dir(at("linked")).unwrap();
    std::os::unix::fs::symlink(folder.path(), at("linked/more")).unwrap();
    write(at("loop/photons.csv"), csv());
    std::os::unix::fs::symlink(at("loop"), at("loop/again")).unwrap();
    std::os::unix::fs::symlink(at("nothing"), at("nowhere")).unwrap();
    fs::create_dir(at("pipe")).unwrap();
    for path in ["fifo", "pipe/photons.csv"] {
        assert!(Command::new("mkfifo").arg(at(path)).status().unwrap().success());
    }
    let paths = [
        at("link"),
        at("linked"),
        at("loop"),
        at("nowhere"),
        at("fifo"),
        at("pipe"),
        PathBuf::from("/dev/zero"),
    ];
    let reasons = [
        "the link photons.csv leads out of the folder",
        "the link more leads out of the folder",
        "",
        "a link that leads nowhere",
        "neither a file nor a folder",
        "photons.csv is neither a file nor a folder",
        "neither a file nor a folder",
    ];
    let grades = grades(&paths, &[]);
    assert_eq!(grades.len(), reasons.len());
    for (grade, reason) in grades.iter().zip(reasons) {
        if reason.is_empty() {
            assert_eq!(grade["verdict"], "correct", "{grade:#}");
        } else {
            assert_eq!(grade["verdict"], "unreadable", "{grade:#}");
            assert!(found(grade, "readable").contains(reason), "{grade:#}");
        }
    }
}

#[test]
fn other_programs_lists() {
    let folder = folder();
    let at = |path: &str| folder.path().join(path);
    let with = |header: &str, line: fn([f32; 3]) -> String| header.to_owned() + &lines(line);
    let comma: fn([f32; 3]) -> String = |[x, y, z]| format!("{x},{y},{z}");
    let space: fn([f32; 3]) -> String = |[x, y, z]| format!("{x}  {y} {z}");
    let cases = [
        ("semicolons", with("x;y;z\n", |[x, y, z]| format!("{x};{y};{z}")), "semicolons"),
        (
            "decimal-commas",
            with("x;y;z\n", |xyz| xyz.map(|it| it.to_string().replace('.', ",")).join(";")),
            "semicolons",
        ),
        (
            "decimal-commas-alone",
            with("", |xyz| xyz.map(|it| it.to_string().replace('.', ",")).join(";")),
            "semicolons between values; no names of columns",
        ),
        ("tabs", with("x\ty\tz\n", |[x, y, z]| format!("{x}\t{y}\t{z}")), "tabs"),
        (
            "tabs-and-decimal-commas",
            with("x\ty\tz\n", |xyz| xyz.map(|it| it.to_string().replace('.', ",")).join("\t")),
            "tabs",
        ),
        ("spaces", with("", space), "spaces between values; no names of columns"),
        ("numpy", with("# z y x\n", |[x, y, z]| format!("{z} {y} {x}")), "spaces"),
        (
            "quotes",
            with("\"x\",\"y\",\"z\"\n", |xyz| xyz.map(|it| format!("\"{it}\"")).join(",")),
            "",
        ),
        ("no-header", with("", comma), "the three are taken for x, y and z"),
        ("capitals", with("X,Y,Z\n", comma), "'X' for x"),
        ("struct", with("position.x,position.y,position.z\n", comma), "'position.y' for y"),
        (
            "index",
            with("Photon.Position[0],pos_y,pz,z\n", |[x, y, z]| format!("{x},{y},0,{z}")),
            "'pos_y' for y",
        ),
        ("y-up", with("x,y,z\n", |[x, y, z]| format!("{x},{z},{}", -y)), "model's axes"),
        ("windows", with("\u{feff}x,y,z\r\n", |[x, y, z]| format!("{x},{y},{z}\r")), ""),
        (
            "ascii.ply",
            with(
                &format!(
                    "ply\nformat ascii 1.0\nelement vertex {}\nproperty double X\n\
            property double Y\nproperty double Z\nend_header\n",
                    lines(comma).lines().count()
                ),
                space,
            ),
            "'Z' for z",
        ),
    ];
    let paths: Vec<_> = cases.iter().map(|(name, text, _)| write(at(name), text)).collect();
    let stored = lines(comma).lines().count();
    let grades = grades(&paths, &[]);
    assert_eq!(grades.len(), cases.len());
    for (grade, (name, _, remark)) in grades.iter().zip(&cases) {
        assert_eq!(grade["verdict"], "correct", "{name}: {grade:#}");
        assert_eq!(grade["score"], 4.0);
        assert_eq!(grade["stored"], stored, "{name}");
        let has_remark =
            grade["findings"].as_array().unwrap().iter().any(|f| f["check"] == "format");
        assert_eq!(has_remark, !remark.is_empty(), "{name}");
        if has_remark {
            assert!(found(grade, "format").contains(remark), "{name}: {}", found(grade, "format"));
        }
    }
}

#[test]
fn hostile_files() {
    let folder = folder();
    let at = |path: &str| folder.path().join(path);
    let ply = |rest: &str| format!("ply\nformat binary_little_endian 1.0\n{rest}");
    let many = "property float x\nproperty float y\nproperty float z\nend_header\n12345678901";
    let junk: Vec<u8> =
        (0..100_000_u32).map(|k| (k.wrapping_mul(2_654_435_761) >> 24) as u8).collect();
    let repeated = |row: &str| format!("x,y,z\n{}", row.repeat(1000)).into_bytes();
    let cases: Vec<(&str, Vec<u8>, &str)> = vec![
        ("commas", vec![b','; 1 << 20], "at most 65536 bytes in a line"),
        ("endless", vec![b'7'; 1 << 20], "at most 65536 bytes in a line"),
        ("vertices", ply(&format!("element vertex {}\n{many}", 1_u64 << 60)).into(), "truncated"),
        (
            "lists",
            ply("element vertex 9\nproperty list half float x\n").into(),
            "a type that PLY knows",
        ),
        ("header", ply(&"comment\n".repeat(110_000)).into(), "header of under"),
        ("comments", "# none\n".repeat(1_100_000).into(), "found only comments"),
        ("blank", "\n".repeat(1_100_000).into(), "nothing but white space"),
        ("nan", repeated("nan,nan,nan\n"), "no position in the list is a finite number"),
        ("infinite", repeated("inf,-inf,1e400\n"), "no position in the list is a finite number"),
        ("junk", junk, "line 1: expected text"),
        ("numbers", b"1,2,3,4\n".to_vec(), "expected the names of the columns"),
        (
            "escape",
            b"x,y,z\n1,\x1b[2J\x1b[31mcorrect,3\n".to_vec(),
            "line 2: expected a number for 'y'",
        ),
    ];
    let mut paths: Vec<_> = cases.iter().map(|(name, bytes, _)| write(at(name), bytes)).collect();
    // A file of 10 GB that takes no room.
    let huge = at("huge");
    fs::File::create(&huge).unwrap().set_len(10_000_000_000).unwrap();
    paths.push(huge);
    let start = Instant::now();
    let graded = grades(&paths, &["--emitted", "1000000"]);
    assert!(start.elapsed() < Duration::from_secs(20), "{:?}", start.elapsed());
    let reasons =
        cases.iter().map(|(_, _, reason)| *reason).chain(["at most 100 MB, found 10000 MB"]);
    for (grade, reason) in graded.iter().zip(reasons) {
        assert_eq!((&grade["verdict"], &grade["score"]), (&"unreadable".into(), &0.0.into()));
        let found = found(grade, "readable");
        assert!(found.contains(reason), "{}: {found}", grade["submission"]);
        assert!(!found.contains('\u{1b}'), "{found}");
    }
    // Far away is not unreadable.
    let far = grades(&[write(at("far"), repeated("1e38,-1e38,3e38\n"))], &[]);
    assert_eq!((&far[0]["verdict"], &far[0]["score"]), (&"incorrect".into(), &0.0.into()));
    // An honest list without photons is none either.
    let none = grades(&[write(at("none"), "x,y,z\n")], &[]);
    assert_eq!((&none[0]["verdict"], &none[0]["score"]), (&"no-dots".into(), &1.0.into()));
}

#[test]
fn reading_stops_at_the_cap() {
    let folder = folder();
    let path = write(folder.path().join("list"), "x,y,z\n".to_owned() + &"0,0,0\n".repeat(101));
    assert_eq!(load_at_most(&path, 101).unwrap().0.records.len(), 101);
    let error = load_at_most(&path, 100).unwrap_err().to_string();
    assert!(error.contains("at most 100 records"), "{error}");
    let error = load_at_most(folder.path(), 100).unwrap_err().to_string();
    assert!(error.contains("expected a file, found a folder"), "{error}");
    // What comes after is not even looked at.
    let path =
        write(folder.path().join("list"), "x,y,z\n".to_owned() + &"0,0,0\n".repeat(101) + "?");
    assert!(load_at_most(&path, 100).unwrap_err().to_string().contains("at most 100 records"));
}

#[test]
fn a_fault_of_the_grader_stops_nothing() {
    let settings = Settings::default();
    let named = |name: &str| HandedIn {
        submission: Submission { name: name.into(), ..Submission::default() },
        notes: vec!["left out".to_owned()],
        ..HandedIn::default()
    };
    let graded: Vec<_> = ["a", "b"]
        .map(|name| {
            grade_one(&named(name), &settings, |submission| {
                assert!(submission.name != "a", "the sky fell");
                Some(unreadable(submission, &settings, "fine"))
            })
            .expect("a grade")
        })
        .into();
    assert_eq!(graded[0].grade.verdict, Verdict::Unreadable);
    let [first, note] = graded[0].grade.findings.as_slice() else { panic!("two findings") };
    assert!(first.found.contains("the grader itself failed"), "{}", first.found);
    assert!(first.found.contains("the sky fell"), "{}", first.found);
    assert!(!note.is_fault() && note.found == "left out");
    assert_eq!(graded[1].grade.findings[0].found, "fine");
}

#[test]
fn names_are_printable_and_unique() {
    let folder = folder();
    let path = write(folder.path().join("a\u{1b}[2Jb\n.csv"), "x,y,z\n");
    let names = |paths: &[PathBuf]| -> Vec<String> {
        collect(paths).into_iter().map(|handed_in| handed_in.submission.name).collect()
    };
    let names = names(&[path.clone(), path, Path::new("nowhere/").to_owned()]);
    assert!(names[0].ends_with("a\u{fffd}[2Jb\u{fffd}.csv"), "{}", names[0]);
    assert_eq!(names[1], format!("{} (2)", names[0]));
    assert_eq!(names[2], "nowhere");
}

#[test]
fn the_number_that_the_course_gives_counts() {
    let folder = folder();
    let list = write(folder.path().join("list.csv"), csv());
    for (emitted, verdict) in [(60_000, "correct"), (80_000, "incorrect")] {
        let grade = grades(std::slice::from_ref(&list), &["--emitted", &emitted.to_string()]);
        assert_eq!(
            (&grade[0]["verdict"], &grade[0]["emitted"]),
            (&verdict.into(), &emitted.into())
        );
    }
    let grade = &grades(&[list], &[])[0];
    assert_eq!((&grade["verdict"], &grade["emitted"]), (&"correct".into(), &Value::Null));
}

#[test]
fn a_policy_sets_the_scores() {
    let folder = folder();
    let at = |path: &str| folder.path().join(path);
    let list = write(at("some-far.csv"), csv() + &"9,9,9\n".repeat(100));
    let far = write(at("far.csv"), "x,y,z\n".to_owned() + &"9,9,9\n".repeat(1000));
    let policy =
        write(at("policy.json"), r#"{ "correct": 10, "incorrect": 2.5, "unreadable": 0.5 }"#);
    let graded = grades(&[list.clone(), far], &["--policy", policy.to_str().unwrap()]);
    assert_eq!((&graded[0]["score"], &graded[1]["score"]), (&2.5.into(), &0.5.into()));
    for (text, parts) in [
        (r#"{ "corect": 4 }"#, &["policy.json:1: ", "'corect'", "did you mean 'correct'?"][..]),
        ("{ \"correct\": 4,\n \"price\": 1 }", &["policy.json:2: ", "'price'", "plausible"]),
        (r#"{ "misreadings": { "off": 1 } }"#, &["'off'", "did you mean 'no-offset'?"]),
        (r#"{ "misreadings": { "x": "1" } }"#, &["'x': expected a number, found \"1\""]),
        (r#"{ "misreadings": { "wxyz": 1 } }"#, &["'wxyz'", "docs/misreadings.md"]),
        (r#"{ "correct": "4" }"#, &["'correct': expected a number, found \"4\""]),
        (r#"{ "sections": 4 }"#, &["'sections': expected an object of scores, found 4"]),
        ("", &["policy.json:1: expected '}', found the end of the file"]),
        ("{\n\"correct\" 4 }", &["policy.json:2: expected JSON"]),
        ("[]", &["policy.json:1: expected a JSON object"]),
        (
            r#"{ "sections": { "Emission": 4 } }"#,
            &["no section is called 'Emission'", "did you mean 'Photon Emission'?"],
        ),
        (r#"{ "sections": { "Lights": 4 } }"#, &["'Lights'", "there are Photon Emission, Photon"]),
        (r#"{ "sections": { "Photon Storage": 3 } }"#, &["add up to 3, not to 4"]),
        (r#"{ "no-dots": -1 }"#, &["policy.json", "'no-dots' is -1", "from 0 to 'correct', 4"]),
        (r#"{ "misreadings": { "no-offset": 5 } }"#, &["'no-offset' is 5"]),
        (r#"{ "misreadings": { "no-offset": -1 } }"#, &["'no-offset' is -1"]),
        (r#"{ "correct": -1 }"#, &["'correct' is -1"]),
        (r#"{ "plausible": 5 }"#, &["'plausible' is 5"]),
        (r#"{ "correct": 1.5 }"#, &["'plausible' is 3, which is not from 0 to 'correct', 1.5"]),
        (r#"{ "incorrect": 4.5 }"#, &["'incorrect' is 4.5"]),
        (r#"{ "unreadable": 5 }"#, &["'unreadable' is 5"]),
    ] {
        fs::write(&policy, text).unwrap();
        fails("grade --policy {} {}", &[&policy, &list], parts);
    }
    fails("grade --policy {} {}", &[&at("none.json"), &list], &["none.json", "cannot be read"]);
    fails("grade", &[], &["SUBMISSION"]);
}

#[test]
fn lists_after_comments_and_in_other_byte_orders() {
    let folder = folder();
    let at = |path: &str| folder.path().join(path);
    let list = fixtures::list(&fixtures::handout(7, PHOTONS));
    let count = list.len();
    let header = "ply\nformat binary_big_endian 1.0\nelement vertex";
    let columns = "property float x\nproperty double y\nproperty float z\nend_header";
    let mut ply = format!("{header} {count}\n{columns}\n").into_bytes();
    for record in &list {
        ply.extend(record.position.x.to_be_bytes());
        ply.extend(f64::from(record.position.y).to_be_bytes());
        ply.extend(record.position.z.to_be_bytes());
    }
    write(at("class/comment/any.txt"), "# photons, of mine\n# all of them\n".to_owned() + &csv());
    write(at("class/excel/photons.csv"), "\u{feff}sep=,\r\n".to_owned() + &csv());
    write(at("class/big/photons.ply"), ply);
    let german = lines(|xyz| xyz.map(|it| it.to_string().replace('.', ",")).join(";"));
    write(at("class/german/photons.csv"), "\"SEP=;\"\r\nx;y;z\r\n".to_owned() + &german);
    let grades = grades(&[at("class")], &["--emitted", "60000"]);
    assert_eq!(grades.len(), 4);
    for grade in grades {
        assert_eq!((&grade["verdict"], &grade["stored"]), (&"correct".into(), &count.into()));
    }
    let (nothing, comments) = (write(at("nothing.png"), ""), write(at("it.csv"), "# a\n# b\n"));
    let grades = self::grades(&[nothing, comments], &[]);
    assert!(found(&grades[0], "readable").contains("the file is empty"));
    assert!(found(&grades[1], "readable").contains("only comments"));
}

#[test]
fn a_black_picture_with_far_too_much_data_is_none() {
    let folder = folder();
    let path = folder.path().join("bomb.png");
    image::RgbImage::new(640, 480).save(&path).unwrap();
    let verdict = |path: &PathBuf| grades(std::slice::from_ref(path), &[]).remove(0);
    assert_eq!(verdict(&path)["verdict"], "no-dots");
    let mut bytes = fs::read(&path).unwrap();
    bytes.resize(3 << 20, 0);
    write(path.clone(), bytes);
    assert!(found(&verdict(&path), "readable").contains("far more data"));
}
