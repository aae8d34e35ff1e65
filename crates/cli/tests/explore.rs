//! `explore` as a user runs it.

use std::fs;

use crate::support::{fails, folder, reference_csv, run_line, stdout};
use assert_cmd::Command;

#[test]
fn the_page_is_written_and_its_path_printed() {
    let folder = folder();
    let path = stdout(run_line("explore --photons 5000 --out {}", &[folder.path()]).success());
    let page = fs::read_to_string(path.trim_end()).expect("the printed path is the page's");
    assert!(page.starts_with("<!doctype html>") && page.contains("default-src 'none'"));
    let list = reference_csv(folder.path(), 5000);
    let line = "explore --photons 5000 --submission {} --out {}";
    run_line(line, &[&list, folder.path()]).success();
    let page = fs::read_to_string(folder.path().join("explore.html")).expect("written");
    assert!(page.contains("photons.csv: identical"));
}

#[test]
fn a_known_mistake_of_a_submission_is_named() {
    let folder = folder();
    let list = reference_csv(folder.path(), 5000);
    // Without its first bounces, the list is what a program stores from the third hit on.
    let text = fs::read_to_string(&list).expect("written");
    let is_kept = |line: &&str| line.split(',').nth(10) != Some("1");
    let kept: Vec<&str> = text.lines().filter(is_kept).collect();
    fs::write(&list, kept.join("\n")).expect("the folder can be written");
    let line = "explore --photons 5000 --submission {} --out {}";
    run_line(line, &[&list, folder.path()]).success();
    let page = fs::read_to_string(folder.path().join("explore.html")).expect("written");
    for words in ["photons.csv: Photon Storage", "This is the misreading third-hit-on."] {
        assert!(page.contains(words), "{words}");
    }
}

#[test]
fn explain_prints_the_link_of_the_page_of_its_run() {
    let folder = folder();
    let run = |line: &str| {
        let mut command = Command::cargo_bin("photon-mapping").expect("the program is built");
        stdout(command.current_dir(folder.path()).args(line.split(' ')).assert().success())
    };
    let link = "out/explore.html#photon=73&bounce=0&step=emission";
    assert!(!run("explain 73 --photons 5000").contains(link));
    run("explore --photons 5000 --photon 73");
    assert!(run("explain 73 --photons 5000").contains(link));
    assert!(!run("explain 73 --photons 5000 --json").contains(link));
    assert!(!run("explain 73 --photons 5000 --seed 1").contains(link));
}

#[test]
fn bad_arguments_are_refused() {
    fails("explore --photon 10 --photons 10", &[], &["--photon 10", "below 10"]);
    fails("explore --misreading none-such", &[], &["none-such", "transposed-frame"]);
    fails("explore --submission none.csv --photons 10", &[], &["none.csv"]);
    let line = "explore --misreading no-offset --scene a.obj --light 0,0,1";
    fails(line, &[], &["--misreading", "--scene"]);
}
