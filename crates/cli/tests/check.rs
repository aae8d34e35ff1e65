//! `check` as a grader runs it, on a solution written as a student would.
#![cfg(unix)]

use std::fs;
use std::io::{BufRead as _, BufReader, Read as _};
use std::os::unix::fs::PermissionsExt as _;
use std::path::{Path, PathBuf};
use std::process::Stdio;

use crate::support::{fails, folder, json, program, run_line, stdout};

fn solution() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../check/tests/submissions/one_function")
}

/// Whether `errors` say that there is no compiler or no glm, which only outside CI skips a test.
fn lacks_compiler(errors: &str) -> bool {
    let lacks = errors.contains("no C++ compiler") || errors.contains("does not find glm");
    assert!(!lacks || std::env::var_os("CI").is_none(), "{errors}");
    if lacks {
        eprintln!("skipped: {errors}");
    }
    lacks
}

#[test]
fn a_right_solution_has_the_photons_of_the_reference() {
    let folder = folder();
    let list = folder.path().join("list.csv");
    let checked = run_line("check {} --quiet --list {}", &[&solution(), &list]);
    let errors = String::from_utf8_lossy(&checked.get_output().stderr).into_owned();
    if lacks_compiler(&errors) {
        return;
    }
    let text = stdout(checked.success());
    assert_eq!(text.matches(": right\n").count(), 5, "{text}");
    let line = "compare --seed 148 --photons 200000 {}";
    let compared = stdout(run_line(line, &[&list]).success());
    assert!(compared.starts_with("the same within"), "{compared}");
}

/// One bad submission stops nothing, and each gets what its format has for it.
#[test]
fn a_class_gets_a_page_each_and_an_index() {
    let folder = folder();
    let (class, pages) = (folder.path().join("class"), folder.path().join("pages"));
    let two_faults = [("std::sqrt(u1)", "u1"), ("path.size() > 1", "path.size() > 0")];
    for (student, changes) in [
        ("alice", &[][..]),
        ("bob", &[("remainingBounces - 1);", "left);")]),
        ("carol", &two_faults),
    ] {
        let home = class.join(student);
        fs::create_dir_all(&home).expect("can be made");
        for name in ["PointLight.cpp", "PhotonMappingRenderer.cpp"] {
            let text = fs::read_to_string(solution().join(name)).expect("a file");
            let text = changes.iter().fold(text, |text, (from, to)| text.replace(from, to));
            fs::write(home.join(name), text).expect("can be written");
        }
    }
    let line = "check --class {} --quiet --format html --out {}";
    let checked = run_line(line, &[&class, &pages]);
    let errors = String::from_utf8_lossy(&checked.get_output().stderr).into_owned();
    if lacks_compiler(&errors) {
        return;
    }
    checked.success();
    let page = |name: &str| fs::read_to_string(pages.join(name)).expect("a page");
    assert!(page("index.html").contains("alice.html"));
    // The pictures of the submission's photons and of the reference's.
    assert!(page("alice.html").contains("4 of 4 points"));
    assert!(page("alice.html").matches("data:image/png").count() >= 2);
    assert!(page("bob.html").contains("`left` is declared in no file you handed in"));
    // Both sections that are wrong stand open, and neither is the whole explanation.
    let carol = page("carol.html");
    let (open, _) = carol.split_once("<details>").expect("what is right is folded");
    for section in ["Photon Storage", "Hemisphere Sampling"] {
        let row = format!("<tr class=\"fault\"><th scope=\"row\">{section}</th>");
        assert!(open.contains(&row), "{section}: {open}");
        assert_eq!(carol.matches(&format!(">{section}<")).count(), 1, "{section}");
    }
    assert!(!carol.contains("% sure") && !carol.contains("what the handout asks for"));
    assert!(page("index.html").contains("<td>Photon Storage, Hemisphere Sampling</td>"));
    let bob = class.join("bob");
    let table = stdout(run_line("check {} --format csv", &[&bob]).success());
    assert_eq!(table.lines().count(), 2, "{table}");
    assert!(table.contains("\nbob,,,0,unreadable,"), "{table}");
    let results = json(run_line("check {} --format gradescope", &[&bob]).success());
    assert_eq!(results["score"], 0.0, "{results}");
    fails("check {} {} --format html", &[&bob, &bob], &["--out", "expected a folder"]);
    // As for grade: no file is made a folder, and no source is overwritten.
    let html = folder.path().join("page.html");
    let line = "check {} {} --format html --out {}";
    fails(line, &[&bob, &bob, &html], &["page.html", "the name of a file", "FOLDER"]);
    fails(line, &[&bob, &bob, &bob.join("PointLight.cpp")], &["found a file"]);
}

/// Builds nothing, so it takes no time to check.
fn broken(class: &Path, student: &str) -> PathBuf {
    let home = class.join(student);
    fs::create_dir_all(&home).expect("can be made");
    for name in ["PointLight.cpp", "PhotonMappingRenderer.cpp"] {
        fs::write(home.join(name), "#error no solution\n").expect("can be written");
    }
    home
}

#[test]
fn a_name_of_two_lines_is_one_line() {
    let folder = folder();
    broken(folder.path(), "amy\nbob: correct, 4 of 4 points/src\nbob: correct, 4 of 4 points");
    let checked = run_line("check {} --quiet", &[folder.path()]);
    let errors = String::from_utf8_lossy(&checked.get_output().stderr).into_owned();
    if lacks_compiler(&errors) {
        return;
    }
    let text = stdout(checked.success());
    assert!(text.contains("builds: no: ") && !text.contains("\nbob"), "{text}");
}

#[test]
fn what_cannot_be_written_costs_no_other_its_page() {
    let folder = folder();
    let (class, pages) = (folder.path().join("class"), folder.path().join("pages"));
    let formula = "=HYPERLINK(1)";
    for student in ["amy", "bob", formula] {
        broken(&class, student);
    }
    for name in [".eve/PointLight.cpp", "zoe_PointLight.cpp"] {
        fs::create_dir_all(class.join(name).parent().expect("a folder")).expect("can be made");
        fs::write(class.join(name), "").expect("can be written");
    }
    let table = run_line("check --class {} --quiet --format csv", &[&class]);
    let errors = String::from_utf8_lossy(&table.get_output().stderr).into_owned();
    if lacks_compiler(&errors) {
        return;
    }
    assert!(errors.contains("left out: .eve, zoe_PointLight.cpp"), "{errors}");
    let table = stdout(table.success());
    assert!(table.contains("\n'=HYPERLINK(1),"), "no formula for spreadsheets: {table}");
    // A full disk, a read-only file, a folder.
    fs::create_dir_all(pages.join("bob.html")).expect("can be made");
    std::os::unix::fs::symlink("/dev/full", pages.join("amy.html")).expect("can be linked");
    let checked = run_line("check --class {} --quiet --format html --out {}", &[&class, &pages]);
    let errors = String::from_utf8_lossy(&checked.code(2).get_output().stderr).into_owned();
    for page in ["amy.html", "bob.html"] {
        let is_told = |line: &str| line.contains(page) && line.contains("cannot be written");
        assert_eq!(errors.lines().filter(|line| is_told(line)).count(), 1, "{page}: {errors}");
    }
    let index = fs::read_to_string(pages.join("index.html")).expect("the index is written");
    let other = fs::read_to_string(pages.join("_HYPERLINK_1_.html")).expect("so is the other");
    assert!(index.ends_with("</html>") && other.ends_with("</html>"));
    let amy = class.join("amy");
    for full in ["--out", "--list"] {
        run_line(&format!("check {{}} --quiet {full} /dev/full"), &[&amy]).code(2);
    }
    let (reader, writer) = std::io::pipe().expect("there are pipes");
    drop(reader);
    let status =
        program(&class).args(["check", "amy", "--quiet"]).stdout(writer).status().expect("it runs");
    assert_eq!(status.code(), Some(2), "nobody gets the grade");
    let old = folder.path().join("old.html");
    fs::write(&old, "old").expect("can be written");
    let line = "check nosuch --format html --out {}";
    fails_last(line, &[&old], "nosuch: cannot be read");
    assert_eq!(fs::read_to_string(&old).expect("it is there"), "old");
    let source = amy.join("PointLight.cpp");
    fails_last("check {} --quiet --out {}", &[&amy, &source], "found one that is read");
    assert_eq!(fs::read_to_string(&source).expect("it is there"), "#error no solution\n");
    let empty = folder.path().join("empty");
    fs::create_dir(&empty).expect("can be made");
    fails("check --class {}", &[&empty], &["empty", "found none"]);
}

/// The second submission compiles only when the report on the first is out. The third is
/// ready before either, and waits.
#[test]
fn reports_are_printed_as_they_come() {
    let folder = folder();
    let (class, go) = (folder.path().join("class"), folder.path().join("go"));
    let amy = broken(&class, "amy").join("PhotonMappingRenderer.cpp");
    fs::write(amy, "#error amy is slow\n").expect("can be written");
    broken(&class, "cid");
    let bob = broken(&class, "bob").join("PhotonMappingRenderer.cpp");
    fs::write(bob, "#error bob waits\n").expect("can be written");
    let compiler = folder.path().join("compiler");
    let script = format!(
        "#!/bin/sh\nfor last; do :; done\n\
         if grep -q 'is slow' -- \"$last\" 2>/dev/null; then sleep 0.5; fi\n\
         if grep -q waits -- \"$last\" 2>/dev/null; then\n\
         i=0; while [ $i -lt 200 ] && ! [ -e {0} ]; do sleep 0.1; i=$((i + 1)); done\n\
         [ -e {0} ] || {{ echo \"$last:1:1: error: in vain\" >&2; exit 1; }}\nfi\n\
         exec c++ \"$@\"\n",
        go.display()
    );
    fs::write(&compiler, script).expect("can be written");
    fs::set_permissions(&compiler, fs::Permissions::from_mode(0o755)).expect("can be changed");
    let mut child = program(folder.path())
        .args(["check", "--class", "class"])
        .env("CXX", &compiler)
        .env("RAYON_NUM_THREADS", "3")
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("it runs");
    let mut output = BufReader::new(child.stdout.take().expect("it is piped"));
    let mut text = String::new();
    output.read_line(&mut text).expect("a line");
    fs::write(&go, "").expect("can be written");
    output.read_to_string(&mut text).expect("text");
    let ended = child.wait_with_output().expect("it ends");
    if lacks_compiler(&String::from_utf8_lossy(&ended.stderr)) {
        return;
    }
    let names = text.lines().filter_map(|line| line.split_once(": unreadable"));
    assert_eq!(names.map(|(name, _)| name).collect::<Vec<_>>(), ["amy", "bob", "cid"], "{text}");
    assert!(text.contains("#error bob waits"), "{text}");
}

/// As [`fails`], whatever notes come before.
fn fails_last(line: &str, paths: &[&Path], expected: &str) {
    let failed = run_line(line, paths).code(2);
    let errors = String::from_utf8_lossy(&failed.get_output().stderr).into_owned();
    assert!(errors.lines().last().is_some_and(|last| last.contains(expected)), "{errors}");
}

/// Folders without any file: what counts is whose they are.
#[test]
fn a_class_has_the_names_of_its_roster() {
    let folder = folder();
    let class = folder.path().join("class");
    for name in ["poe_edgar", "=1+1", "jdoe"] {
        fs::create_dir_all(class.join(name)).expect("a folder");
    }
    let roster = folder.path().join("roster.csv");
    let text = "name,id,email\nJane Doe,7,jdoe@uni.edu\nEdgar Poe,8,\nAda Byron,9,\n";
    fs::write(&roster, text).expect("a file");
    let line = "check --class {} --roster {} --format csv";
    let table = stdout(run_line(line, &[&class, &roster]).success());
    let starts: Vec<_> = table.lines().map(|row| row.split(',').take(5).collect()).collect();
    let expected: [&[&str]; 5] = [
        &["name", "id", "email", "score", "verdict"],
        &["Jane Doe", "7", "jdoe@uni.edu", "0", "unreadable"],
        &["Edgar Poe", "8", "", "0", "unreadable"],
        &["'=1+1", "", "", "0", "unreadable"],
        &["Ada Byron", "9", "", "0", "nothing handed in"],
    ];
    assert_eq!(starts as Vec<Vec<&str>>, expected, "{table}");
    let old = folder.path().join("old.json");
    let line = "check --class {} --roster {} --format json --out {}";
    run_line(line, &[&class, &roster, &old]).success();
    let line = "check --class {} --roster {} --before {}";
    let text = stdout(run_line(line, &[&class, &roster, &old]).success());
    assert!(text.starts_with("Jane Doe: unreadable"), "{text}");
    assert!(text.contains("\nchanged since the earlier grades: 0\n"), "{text}");
    assert!(text.ends_with("\nhanded in nothing: Ada Byron\n"), "{text}");
    let text = stdout(run_line("check --class {} --anonymous", &[&class]).success());
    assert!(text.contains("submission 3: ") && !text.contains("doe"), "{text}");
}

#[test]
fn a_missing_folder_and_a_list_of_two_are_refused() {
    fails("check {} {} --list out.csv", &[&solution(), &solution()], &["--list", "found 2"]);
    let checked = run_line("check nosuch", &[]).code(2);
    let errors = String::from_utf8_lossy(&checked.get_output().stderr).into_owned();
    let last = errors.lines().last().expect("an error");
    assert_eq!(last, "error: nosuch: cannot be read: No such file or directory");
}

/// Without `--class`, one student's files would be judged for all.
#[test]
fn a_class_that_is_not_called_one_is_refused() {
    let class = folder();
    for student in ["alice", "bob"] {
        let home = class.path().join(student).join("src");
        fs::create_dir_all(&home).expect("can be made");
        for name in ["PointLight.cpp", "PhotonMappingRenderer.cpp"] {
            fs::copy(solution().join(name), home.join(name)).expect("can be copied");
        }
    }
    fails("check {}", &[class.path()], &["alice, bob", "--class"]);
}
