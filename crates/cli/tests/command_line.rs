//! The command line as a user runs it, bad input included.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

use assert_cmd::cargo::CommandCargoExt;
use tempfile::TempDir;

fn program(folder: &TempDir) -> Command {
    let mut command = Command::cargo_bin("photon-mapping").unwrap();
    command.current_dir(folder);
    command
}

fn run(folder: &TempDir, arguments: &[&str]) -> Output {
    program(folder).args(arguments).output().unwrap()
}

fn text(bytes: &[u8]) -> &str {
    std::str::from_utf8(bytes).unwrap()
}

/// Runs and expects success; gives standard output.
fn succeed(folder: &TempDir, arguments: &[&str]) -> String {
    let output = run(folder, arguments);
    assert!(output.status.success(), "{arguments:?}: {}", text(&output.stderr));
    text(&output.stdout).to_owned()
}

/// Runs and expects exit code 2 and one line on standard error that holds all of `parts`.
fn fail(folder: &TempDir, arguments: &[&str], parts: &[&str]) {
    let output = run(folder, arguments);
    let stderr = text(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{arguments:?}: {stderr}");
    assert_eq!(stderr.lines().count(), 1, "{arguments:?}: {stderr}");
    assert!(output.stdout.is_empty(), "{arguments:?}");
    for part in parts {
        assert!(stderr.contains(part), "{arguments:?}: expected '{part}' in: {stderr}");
    }
}

fn json(text: &str) -> serde_json::Value {
    serde_json::from_str(text).unwrap()
}

fn folder() -> TempDir {
    tempfile::tempdir().unwrap()
}

fn files(folder: &Path) -> Vec<String> {
    let mut names: Vec<_> = fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}

/// The rows of a binary PLY list.
fn rows(path: PathBuf) -> Vec<u8> {
    let bytes = fs::read(path).unwrap();
    let end = b"end_header\n";
    let header = bytes.windows(end.len()).position(|window| window == end).unwrap() + end.len();
    bytes[header..].to_vec()
}

#[test]
fn plain_command_renders() {
    let folder = folder();
    let summary = succeed(&folder, &["--photons", "20000", "--size", "64x48"]);
    for part in ["seed 148: 20000 photons emitted", "rightWall", "SHA-256", "out/photons.ply"] {
        assert!(summary.contains(part), "{summary}");
    }
    assert_eq!(files(&folder.path().join("out")), ["assignment8.png", "photons.ply"]);
    let picture = image::open(folder.path().join("out/assignment8.png")).unwrap();
    assert_eq!((picture.width(), picture.height()), (64, 48));
}

#[test]
fn json_summary() {
    let folder = folder();
    let arguments = ["render", "--photons", "20000", "--size", "8x6", "--json", "--format", "csv"];
    let summary = json(&succeed(&folder, &arguments));
    assert_eq!(summary["seed"], 148);
    assert_eq!(summary["emitted"], 20_000);
    let list = fs::read_to_string(folder.path().join("out/photons.csv")).unwrap();
    assert_eq!(summary["stored"], list.lines().count() - 1);
    assert_eq!(summary["sha256"].as_str().unwrap().len(), 64);
    for phase in ["trace", "picture", "write"] {
        assert!(summary["seconds"][phase].as_f64().unwrap() >= 0.0);
    }
    let surfaces = summary["surfaces"].as_array().unwrap();
    let names: Vec<_> = surfaces.iter().map(|surface| surface["name"].as_str().unwrap()).collect();
    assert_eq!(names, ["shortBox", "rightWall", "tallBox", "floor"]);
    for surface in surfaces {
        let by_bounce = surface["by_bounce"].as_array().unwrap();
        let sum: u64 = by_bounce.iter().map(|cell| cell["stored"].as_u64().unwrap()).sum();
        assert_eq!(surface["stored"], sum);
        assert!(surface["expected"].as_f64().unwrap() > 100.0);
        assert!(surface["z"].as_f64().unwrap().abs() < 4.0);
    }
    assert_eq!(summary["files"].as_array().unwrap().len(), 2);
}

#[test]
fn csv_and_ply_hold_the_same_list() {
    let folder = folder();
    let hash = |arguments: &[&str]| json(&succeed(&folder, arguments))["sha256"].clone();
    let common = ["--photons", "20000", "--size", "8x6", "--json", "--out"];
    let ply = hash(&[&common[..], &["ply"]].concat());
    let csv = hash(&[&common[..], &["csv", "--format", "csv"]].concat());
    assert_eq!(ply, csv);
    for list in ["ply/photons.ply", "csv/photons.csv"] {
        let read = ["--photons-from", list, "--size", "8x6", "--json", "--out", "again"];
        assert_eq!(hash(&read), ply, "{list} comes back bit for bit");
    }
}

#[test]
fn ranges_join_to_the_whole_list() {
    let folder = folder();
    let whole = ["--photons", "30000", "--size", "8x6"];
    succeed(&folder, &whole);
    let mut joined = Vec::new();
    for (range, threads) in [("0..1", "1"), ("1..16384", "7"), ("16384..30000", "2")] {
        let piece = [&whole[..], &["--range", range, "--threads", threads, "--out", "p"]].concat();
        succeed(&folder, &piece);
        joined.extend(rows(folder.path().join("p/photons.ply")));
    }
    assert!(joined == rows(folder.path().join("out/photons.ply")));
}

#[test]
fn hash_is_that_of_the_rows() {
    use sha2::Digest;
    let folder = folder();
    let summary = json(&succeed(&folder, &["--photons", "20000", "--size", "8x6", "--json"]));
    let digest = sha2::Sha256::digest(rows(folder.path().join("out/photons.ply")));
    let hex: String = digest.iter().map(|byte| format!("{byte:02x}")).collect();
    assert_eq!(summary["sha256"], hex);
}

#[test]
fn letter_of_the_handout_differs() {
    let folder = folder();
    let common = ["--photons", "20000", "--size", "8x6", "--json"];
    let reference = json(&succeed(&folder, &common));
    let letter = json(&succeed(&folder, &[&common[..], &["--letter-of-the-handout"]].concat()));
    assert_ne!(reference["sha256"], letter["sha256"]);
    assert!(letter["surfaces"][0]["expected"].is_null(), "it has another law");
}

#[test]
fn own_scene_with_two_lights() {
    let folder = folder();
    fs::write(folder.path().join("m.mtl"), "newmtl white\nKd 0.5 0.5 0.5\n").unwrap();
    let model = "mtllib m.mtl\no ground\nusemtl white\nv -1 0 -1\nv -1 0 1\nv 1 0 1\nv 1 0 -1\n\
                 f 1 2 3 4\no wall\nv -1 2 -1\nv 1 2 -1\nf 1 4 6 5\n";
    fs::write(folder.path().join("m.obj"), model).unwrap();
    let arguments = [
        "--scene",
        "m.obj",
        "--light",
        "0,-0.5,1",
        "--light",
        "0,-0.5,1.5,3,3,3",
        "--photons",
        "1000",
        "--size",
        "8x6",
        "--json",
    ];
    let summary = json(&succeed(&folder, &arguments));
    assert_eq!(summary["emitted"], 1000, "250 of the white light, 750 of the brighter one");
    assert_eq!(summary["surfaces"][1]["name"], "wall");
    assert!(summary["stored"].as_u64().unwrap() > 0);
}

#[test]
fn handouts_scene_from_its_files() {
    let folder = folder();
    let model = concat!(env!("CARGO_MANIFEST_DIR"), "/../model/assets/cornell_box.obj");
    let common = ["--photons", "20000", "--size", "8x6", "--json"];
    let built_in = json(&succeed(&folder, &common));
    let scene = ["--scene", model, "--light", "0.01909,0.0101,1.77640"];
    let loaded = json(&succeed(&folder, &[&common[..], &scene].concat()));
    assert_eq!(built_in["sha256"], loaded["sha256"]);
}

#[test]
fn positions_alone_are_a_list() {
    let folder = folder();
    fs::write(folder.path().join("p.csv"), "z,extra,y,x\n0.0,a,0.5,0.25\n0.0,b,0.5,nan\n").unwrap();
    let summary = json(&succeed(&folder, &["--photons-from", "p.csv", "--size", "8x6", "--json"]));
    assert_eq!((&summary["stored"], &summary["sha256"]), (&2.into(), &serde_json::Value::Null));
    let ascii = "ply\nformat ascii 1.0\nelement vertex 1\nproperty double y\nproperty float z\n\
                 property float x\nend_header\n0.5 0 0.25\n";
    fs::write(folder.path().join("p.ply"), ascii).unwrap();
    let read = ["--photons-from", "p.ply", "--size", "8x6", "--json"];
    assert_eq!(json(&succeed(&folder, &read))["stored"], 1);
}

#[test]
fn lists_in_other_axes_or_units_are_drawn_with_a_note() {
    let folder = folder();
    succeed(&folder, &["--photons", "20000", "--size", "8x6", "--format", "csv", "--out", "a"]);
    let list = fs::read_to_string(folder.path().join("a/photons.csv")).unwrap();
    let positions: Vec<[f64; 3]> = list
        .lines()
        .skip(1)
        .map(|line| {
            let numbers: Vec<f64> = line.split(',').take(3).map(|x| x.parse().unwrap()).collect();
            [numbers[0], numbers[1], numbers[2]]
        })
        .collect();
    let note_of = |turn: &dyn Fn([f64; 3]) -> [f64; 3]| {
        let row = |[x, y, z]: [f64; 3]| format!("{x:.2},{y:.2},{z:.2}\n");
        let rows: String = positions.iter().map(|position| row(turn(*position))).collect();
        fs::write(folder.path().join("p.csv"), format!("x,y,z\n{rows}")).unwrap();
        let output = run(&folder, &["--photons-from", "p.csv", "--size", "8x6", "--out", "b"]);
        assert_eq!(output.status.code(), Some(0));
        text(&output.stderr).to_owned()
    };
    assert_eq!(note_of(&|position| position), "");
    for turn in [
        &|[x, y, z]: [f64; 3]| [x, z, -y],
        &|[x, y, z]: [f64; 3]| [z, x, y],
        &|position: [f64; 3]| position.map(|x| 1000.0 * x),
        &|position: [f64; 3]| position.map(|x| x / 2.54),
        &|_| [f64::NAN; 3],
    ] as [&dyn Fn([f64; 3]) -> [f64; 3]; 5]
    {
        let note = note_of(turn);
        assert!(note.starts_with("note: p.csv: ") && note.lines().count() == 1, "{note}");
        assert!(note.contains(&format!("of {} photons lie on no surface", positions.len())));
    }
}

#[test]
fn what_a_list_holds_besides_photons_is_told() {
    let folder = folder();
    fs::write(folder.path().join("p.csv"), "x,y,z\n0.1,0.1,0\n,,\n,,\n").unwrap();
    let output = run(&folder, &["--photons-from", "p.csv", "--size", "8x6"]);
    let note = "note: p.csv: 2 rows of only empty values, from line 3 on\n";
    assert_eq!(text(&output.stderr), note);
}

#[test]
fn other_formats_are_named() {
    let folder = folder();
    let tar = [&[b'a'; 257][..], b"ustar\x0000", &[0; 100]].concat();
    let long = format!("{{\"x\": [{}0]}}", "0.5,".repeat(20_000));
    let cases: [(&[u8], &str); 9] = [
        (b"\x1f\x8b\x08\0\0\0\0\0", "a gzip archive"),
        (b"PK\x03\x04\x14\0", "a zip archive"),
        (b"\xfd7zXZ\0\0", "an xz archive"),
        (b"\x89PNG\r\n\x1a\n\0\0\0\x0dIHDR", "a picture (PNG)"),
        (b"%PDF-1.7\n", "a document (PDF)"),
        (b"\x93NUMPY\x01\0v\0{'descr': '<f4'}\n", "a NumPy array"),
        (&tar, "a tar archive"),
        (b"[{\"x\": 1, \"y\": 2, \"z\": 3}]\n", "JSON"),
        (long.as_bytes(), "JSON"),
    ];
    for (bytes, name) in cases {
        fs::write(folder.path().join("list"), bytes).unwrap();
        let parts = ["list: expected a photon list, found ", name];
        fail(&folder, &["--photons-from", "list"], &parts);
        // Two pictures are compared as pictures.
        if !name.contains("PNG") {
            fail(&folder, &["compare", "list", "list"], &parts);
            let graded = run(&folder, &["grade", "list"]);
            assert!(!name.contains("JSON") || text(&graded.stdout).contains("found JSON"));
        }
        // What standard input has given once it does not give again.
        for words in [
            &["--photons-from", "-"][..],
            &["compare", "--photons", "9", "-"],
            &["explore", "--photons", "9", "--submission", "-"],
        ] {
            let output = from_standard_input(&folder, words, bytes);
            let error = text(&output.stderr);
            assert_eq!(output.status.code(), Some(2), "{words:?}: {error}");
            let expected = format!("error: -: expected a photon list, found {name}\n");
            assert_eq!(error, expected, "{words:?}");
        }
    }
}

/// What `words` do with `bytes` on standard input.
fn from_standard_input(folder: &TempDir, words: &[&str], bytes: &[u8]) -> Output {
    fs::write(folder.path().join("input"), bytes).unwrap();
    let input = fs::File::open(folder.path().join("input")).unwrap();
    let mut command = Command::new(env!("CARGO_BIN_EXE_photon-mapping"));
    command.current_dir(folder.path()).args(words).stdin(input).output().unwrap()
}

#[test]
fn lists_on_standard_input_are_read_whole_in_any_encoding() {
    let folder = folder();
    let list = "x,y,z\n".to_owned() + &"0.1,0.2,0\n".repeat(1000);
    let utf_16: Vec<u8> = list.encode_utf16().flat_map(u16::to_le_bytes).collect();
    for bytes in [list.as_bytes(), &utf_16] {
        fs::write(folder.path().join("list"), &list).unwrap();
        let output = from_standard_input(&folder, &["compare", "list", "-"], bytes);
        assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    }
    let header = "ply\nformat binary_little_endian 1.0\nelement vertex 2\nproperty float x\n\
                  property float y\nproperty float z\nend_header\n";
    let cut = [header.as_bytes(), &[0; 13]].concat();
    let output = from_standard_input(&folder, &["compare", "--photons", "9", "-"], &cut);
    let error = text(&output.stderr);
    assert_eq!(error, "error: -: expected 2 photons, found 1: truncated?\n");
}

#[test]
fn every_verb_tells_what_of_a_list_is_not_used() {
    let folder = folder();
    let list = "x,y,z,to_light_x,dx\n0.1,0.1,0,1,2\n,,,,\n";
    fs::write(folder.path().join("p.csv"), list).unwrap();
    let told = "p.csv: unknown, so not judged: 'dx'; without the other two of their three, so not \
                judged: 'to_light_x'; 1 row of only empty values, from line 3 on\n";
    let count = |words: &[&str]| {
        let output = run(&folder, words);
        text(&output.stderr).matches(&format!("note: {told}")).count()
    };
    assert_eq!(count(&["compare", "p.csv", "p.csv"]), 2);
    assert_eq!(count(&["compare", "--photons", "9", "p.csv"]), 1);
    assert_eq!(count(&["explore", "--photons", "9", "--submission", "p.csv"]), 1);
    assert_eq!(count(&["--photons-from", "p.csv", "--size", "8x6"]), 1);
    // A piece of a run to which somebody added an element.
    let render = ["--photons", "99", "--range", "0..99", "--size", "8x6", "--out", "."];
    run(&folder, &render);
    let path = folder.path().join("photons.ply");
    let piece = fs::read(&path).unwrap();
    let end = piece.windows(10).position(|bytes| bytes == b"end_header").unwrap();
    let element = b"element note 1\nproperty uchar n\n";
    fs::write(&path, [&piece[..end], element, &piece[end..], b"7"].concat()).unwrap();
    let output = run(&folder, &["merge", "photons.ply", "--out", "whole.ply"]);
    let note = "note: photons.ply: elements other than 'vertex', so not judged: 'note' (1 rows)\n";
    assert_eq!(text(&output.stderr), note);
}

#[test]
fn no_output_replaces_a_material_library() {
    let folder = folder();
    let path = |name: &str| folder.path().join(name);
    fs::create_dir(path("out")).unwrap();
    let corners = "usemtl m\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    for name in ["photons.ply", "assignment8.png"] {
        let material = "newmtl m\nKd 0.5 0.5 0.5\n";
        let library = path("out").join(name);
        fs::write(&library, material).unwrap();
        for (model, mtllib) in [("m.obj", format!("out/{name}")), ("out/m.obj", name.to_owned())] {
            fs::write(path(model), format!("mtllib {mtllib}\n{corners}")).unwrap();
            let render = ["--scene", model, "--light", "0,0,1", "--photons", "10", "--size", "8x6"];
            fail(&folder, &render, &["--out", name, "found one that is read"]);
            assert_eq!(fs::read_to_string(&library).unwrap(), material);
        }
        fs::remove_file(library).unwrap();
    }
}

#[test]
fn quiet_and_piped_runs_show_no_progress() {
    let folder = folder();
    for arguments in [&["--photons", "1000", "--size", "8x6"][..], &["--photons", "1000", "-q"]] {
        assert!(run(&folder, arguments).stderr.is_empty());
    }
}

#[cfg(target_os = "linux")]
#[test]
fn unwritable_standard_error_is_no_panic() {
    let folder = folder();
    let full = fs::File::options().write(true).open("/dev/full").unwrap();
    let status = program(&folder).args(["--photons", "0"]).stderr(full).status().unwrap();
    assert_eq!(status.code(), Some(2));
}

#[test]
fn byte_order_marks_are_passed_over() {
    let folder = folder();
    fs::write(folder.path().join("m.mtl"), "\u{feff}newmtl m\nKd 0.5 0.5 0.5\n").unwrap();
    let model = "\u{feff}mtllib m.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    fs::write(folder.path().join("m.obj"), model).unwrap();
    succeed(&folder, &["--scene", "m.obj", "--light", "0,0,1", "--photons", "10", "--size", "8x6"]);
}

#[test]
fn closed_pipe_is_no_error() {
    let folder = folder();
    let mut child = program(&folder)
        .args(["--photons", "1000", "--size", "8x6"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    drop(child.stdout.take());
    let output = child.wait_with_output().unwrap();
    assert!(output.status.success() && output.stderr.is_empty(), "{output:?}");
}

#[test]
fn closed_pipe_keeps_the_exit_code() {
    let folder = folder();
    fs::write(folder.path().join("a.csv"), "x,y,z\n1,0,0\n").unwrap();
    fs::write(folder.path().join("b.csv"), "x,y,z\n0,1,0\n").unwrap();
    let mut child = program(&folder)
        .args(["compare", "a.csv", "b.csv"])
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    drop(child.stdout.take());
    assert_eq!(child.wait().unwrap().code(), Some(1), "the lists differ, whoever reads it");
}

#[test]
fn help_gives_units_and_defaults() {
    let help = succeed(&folder(), &["render", "--help"]);
    for part in ["[default: 148]", "[default: 1000000]", "[default: 1000]", "pixels", "640x480"] {
        assert!(help.contains(part), "{help}");
    }
}

#[test]
fn wrong_arguments() {
    let folder = folder();
    fail(&folder, &["--photons", "0"], &["--photons", "from 1 to 4294967295"]);
    fail(&folder, &["--photons", "10000000000000000000"], &["--photons", "from 1 to 4294967295"]);
    fail(&folder, &["--photons", "many"], &["--photons", "many"]);
    fail(&folder, &["--photons", "-1"], &["--photons", "-1", "from 1 to 4294967295"]);
    fail(&folder, &["--seed", "-1"], &["--seed", "from 0 to 18446744073709551615"]);
    fail(&folder, &["--max-bounces", "-1"], &["--max-bounces", "from 0 to 1000"]);
    fail(&folder, &["--max-bounces", "1001"], &["--max-bounces", "from 0 to 1000"]);
    fail(&folder, &["--size", "0x480"], &["--size", "WIDTHxHEIGHT"]);
    fail(&folder, &["--size", "640"], &["--size", "WIDTHxHEIGHT"]);
    fail(&folder, &["--range", "5..5"], &["--range", "A < B"]);
    fail(&folder, &["--photons", "10", "--range", "5..11"], &["--range 5..11", "at most 10"]);
    fail(&folder, &["--threads", "0"], &["--threads", "from 1 to 1024"]);
    fail(&folder, &["--light", "0,0,1"], &["--scene"]);
    fail(&folder, &["--scene", "m.obj"], &["--light"]);
    for light in
        ["0,0", "0,0,nan", "0,0,inf", "0,0,1e38", "0,0,1,0,0,0", "0,0,1,-1,1,1", "0,0,1,1e-40,0,0"]
    {
        fail(&folder, &["--scene", "m.obj", "--light", light], &["--light", "x,y,z"]);
    }
    fail(&folder, &["--photons-from", "a.csv", "--seed", "1"], &["--photons-from", "--seed"]);
    fail(&folder, &["--no-such-option"], &["--no-such-option"]);
    fail(&folder, &["paint"], &["paint"]);
    assert!(files(folder.path()).is_empty(), "nothing was written");
}

#[test]
fn wrong_models() {
    let folder = folder();
    let good_material = "newmtl m\nKd 0.5 0.5 0.5\n";
    let corners = "mtllib m.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 0 1 0\n";
    let cases: &[(&str, &str, &[&str])] = &[
        ("", "", &["m.obj:1", "at least one face"]),
        ("v 0 0\n", good_material, &["m.obj:1", "three numbers", "nothing more"]),
        ("v 0 x 0\n", good_material, &["m.obj:1", "'x'"]),
        ("v 0 nan 0\n", good_material, &["m.obj:1", "'nan'"]),
        ("v 0 inf 0\n", good_material, &["m.obj:1", "'inf'"]),
        ("\nv 0 1e38 0\n", good_material, &["m.obj:2", "'1e38'"]),
        ("vn 0 0 0\n", good_material, &["m.obj:1", "longer than zero"]),
        (&format!("{corners}f 1 2 4\n"), good_material, &["m.obj:6", "vertex 4 does not exist"]),
        (&format!("{corners}f 1 2 0\n"), good_material, &["m.obj:6", "vertex 0 does not exist"]),
        (&format!("{corners}f 1 2 -4\n"), good_material, &["m.obj:6", "vertex -4"]),
        (&format!("{corners}f 1 2 3.5\n"), good_material, &["m.obj:6", "'3.5'"]),
        (&format!("{corners}f 1//1 2//1 3//1\n"), good_material, &["m.obj:6", "normal 1"]),
        (&format!("{corners}f 1 2\n"), good_material, &["m.obj:6", "3 corners"]),
        (&format!("{corners}f 1 2 2\n"), good_material, &["m.obj:6", "at least one face"]),
        ("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", good_material, &["m.obj:4", "usemtl"]),
        ("mtllib m.mtl\nusemtl other\n", good_material, &["m.obj:2", "'other'"]),
        ("mtllib none.mtl\n", good_material, &["none.mtl"]),
        ("mtllib m.mtl\n", "newmtl m\nKd 0.5 2 0\n", &["m.mtl:2", "from 0 to 1", "'2'"]),
        ("mtllib m.mtl\n", "newmtl m\nKd 0.5 nan 0\n", &["m.mtl:2", "'nan'"]),
        ("mtllib m.mtl\n", "Kd 0.5 0.5 0.5\n", &["m.mtl:1", "newmtl"]),
        ("mtllib m.mtl\n", "newmtl m\nKa 1 1 1\n", &["m.mtl:1", "'Kd'"]),
    ];
    for (model, material, parts) in cases {
        fs::write(folder.path().join("m.obj"), model).unwrap();
        fs::write(folder.path().join("m.mtl"), material).unwrap();
        fail(&folder, &["--scene", "m.obj", "--light", "0,0,1"], parts);
    }
    let many: String = (0..65_537).map(|k| format!("o {k}\nf 1 2 3\n")).collect();
    fs::write(folder.path().join("m.mtl"), good_material).unwrap();
    fs::write(folder.path().join("m.obj"), format!("{corners}{many}")).unwrap();
    fail(&folder, &["--scene", "m.obj", "--light", "0,0,1"], &["m.obj:131079", "65535 objects"]);
    fs::write(folder.path().join("m.obj"), b"# caf\xe9\n").unwrap();
    fail(&folder, &["--scene", "m.obj", "--light", "0,0,1"], &["m.obj:1", "at least one face"]);
    fail(&folder, &["--scene", "none.obj", "--light", "0,0,1"], &["none.obj"]);
}

#[test]
fn wrong_lists() {
    let folder = folder();
    let cases: &[(&[u8], &[&str])] = &[
        (b"", &["empty"]),
        (b"x,y\n1,2\n", &["line 1", "'z'"]),
        (b"x,y,z,x\n1,2,3,4\n", &["line 1", "'x' twice"]),
        (b"x,y,z\n1,2,3\n1,2\n", &["line 3", "expected 3 values, found 2"]),
        (b"x,y,z\n1,2,3,4\n", &["line 2", "expected 3 values, found 4"]),
        (b"x,y,z\n1,banana,3\n", &["line 2", "'y'", "'banana'"]),
        (b"x,y,z\n1,two,3\n", &["line 2", "'y'", "'two'"]),
        (b"x,y,z,photon\n1,2,3,-4\n", &["line 2", "'photon'", "'-4'"]),
        (b"x,y,z\n1,\xff,3\n", &["line 2", "'ÿ'"]),
        (b"ply\nformat ascii 1.0\n", &["end_header"]),
        (b"ply\nformat binary 1.0\n", &["line 2", "a format that PLY knows"]),
        (
            b"ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\n\
           property float z\nend_header\n1 2 3\n",
            &["expected 2 photons, found 1"],
        ),
        (b"ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n1\n", &["'y'"]),
        (b"ply\nformat ascii 1.0\nelement vertex 1\nproperty list uchar int x\n", &["line 4"]),
    ];
    for (bytes, parts) in cases {
        fs::write(folder.path().join("list"), bytes).unwrap();
        fail(&folder, &["--photons-from", "list"], &[&["list"], *parts].concat());
    }
    fail(&folder, &["--photons-from", "none.ply"], &["none.ply"]);
    succeed(&folder, &["--photons", "20000", "--size", "8x6", "--out", "whole"]);
    let whole = fs::read(folder.path().join("whole/photons.ply")).unwrap();
    fs::write(folder.path().join("cut.ply"), &whole[..whole.len() - 1]).unwrap();
    fail(&folder, &["--photons-from", "cut.ply"], &["cut.ply", "truncated"]);
    fs::write(folder.path().join("two.ply"), [&whole[..], &whole].concat()).unwrap();
    fail(&folder, &["--photons-from", "two.ply"], &["two.ply", "found more"]);
}

#[test]
fn what_cannot_be_written_is_left_alone() {
    let folder = folder();
    fs::write(folder.path().join("file"), "kept").unwrap();
    fail(&folder, &["--photons", "10", "--out", "file"], &["file"]);
    assert_eq!(fs::read_to_string(folder.path().join("file")).unwrap(), "kept");
    fs::create_dir_all(folder.path().join("out/photons.ply/inside")).unwrap();
    fail(&folder, &["--photons", "10", "--size", "8x6"], &["photons.ply"]);
    assert_eq!(files(&folder.path().join("out")), ["photons.ply"], "no picture without its list");
}

/// A disk that is full for this process: files may not grow beyond a few blocks.
#[cfg(unix)]
#[test]
fn full_disk() {
    let folder = folder();
    succeed(&folder, &["--photons", "1000", "--size", "8x6"]);
    let before: Vec<_> = ["assignment8.png", "photons.ply"]
        .map(|name| fs::read(folder.path().join("out").join(name)).unwrap())
        .into();
    let path = Command::cargo_bin("photon-mapping").unwrap().get_program().to_owned();
    let output = Command::new("sh")
        .current_dir(&folder)
        .args(["-c", "trap '' XFSZ; ulimit -f 32; exec \"$0\" --photons 100000 --size 8x6"])
        .arg(path)
        .output()
        .unwrap();
    let stderr = text(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{stderr}");
    assert!(stderr.contains("photons.ply") && stderr.lines().count() == 1, "{stderr}");
    assert_eq!(files(&folder.path().join("out")), ["assignment8.png", "photons.ply"]);
    for (name, before) in ["assignment8.png", "photons.ply"].into_iter().zip(before) {
        assert!(fs::read(folder.path().join("out").join(name)).unwrap() == before, "{name}");
    }
}

#[test]
fn sobol_sampler_is_a_labeled_extra() {
    let folder = folder();
    let render = |more: &[&str]| {
        let mut arguments = vec!["render", "--photons", "20000", "--size", "8x6", "--json"];
        arguments.extend(more);
        let summary = json(&succeed(&folder, &arguments));
        let header = fs::read(folder.path().join("out/photons.ply")).unwrap();
        (summary, String::from_utf8_lossy(&header[..600]).into_owned())
    };
    let (plain, header) = render(&[]);
    assert!(plain.get("sampler").is_none() && !header.contains("sampler"));
    assert!(plain["total"]["z"].is_number());
    let (named, _) = render(&["--sampler", "chacha"]);
    assert_eq!(named["sha256"], plain["sha256"]);

    let (sobol, header) = render(&["--sampler", "sobol", "--threads", "1"]);
    assert_eq!(sobol["sampler"], "sobol");
    assert!(header.contains("comment sampler sobol\n"), "{header}");
    assert_ne!(sobol["sha256"], plain["sha256"]);
    // Its photons are not independent: what is expected is known, its spread is not.
    assert!(sobol["total"]["expected"].is_number() && sobol["total"]["z"].is_null());
    assert!(sobol["surfaces"][0]["by_bounce"][0]["z"].is_null());
    for threads in ["2", "7"] {
        let (again, _) = render(&["--sampler", "sobol", "--threads", threads]);
        assert_eq!(again["sha256"], sobol["sha256"], "{threads} threads");
    }
    let text = succeed(
        &folder,
        &["--photons", "2000", "--size", "8x6", "--sampler", "sobol", "--out", "other"],
    );
    assert!(text.contains("seed 148, sampler sobol: 2000 photons emitted"), "{text}");
    assert!(!text.contains("standard deviations"), "{text}");
    fail(&folder, &["--sampler", "halton"], &["halton"]);
    fail(&folder, &["--photons-from", "a.ply", "--sampler", "sobol"], &["--sampler"]);
}

#[test]
fn colors_are_a_choice() {
    let folder = TempDir::new().unwrap();
    let run = |line: &str| run(&folder, &line.split(' ').collect::<Vec<_>>());
    let message = |line: &str| text(&run(line).stderr).to_owned();
    // A pipe gets none unless it asks.
    let plain = message("explain nine");
    assert!(plain.starts_with("error: ") && !plain.contains('\u{1b}'), "{plain}");
    for line in ["--color always explain nine", "explain nine --color=always"] {
        assert!(message(line).starts_with("\u{1b}[1;31merror:\u{1b}[0m "), "{line}");
    }
    let help = |line: &str| text(&run(line).stdout).to_owned();
    assert!(help("grade --help --color always").contains("\u{1b}["));
    assert!(!help("grade --help --color never").contains("\u{1b}["));
    assert!(message("--color pink explain 1").contains("expected auto, always or never"));
}
