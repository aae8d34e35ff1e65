//! What is written where, and what a class of attackers can do: nothing.
#![cfg(unix)]

use std::collections::{BTreeMap, BTreeSet};
use std::fs::{self, File};
use std::os::unix::fs::{FileTypeExt, PermissionsExt, symlink};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use crate::support::{
    csv, fails, folder, grades, json, mkfifo, program, remarks, run_line, stderr, write,
};
use serde_json::Value;

/// A list of few photons in `folder`.
fn few(folder: &Path) -> PathBuf {
    let line = "render --photons 2000 --size 8x6 --quiet --out {}";
    run_line(line, &[&folder.join("few")]).success();
    folder.join("few/photons.ply")
}

fn mode(path: &Path) -> u32 {
    fs::metadata(path).unwrap().permissions().mode() & 0o777
}

#[test]
fn outputs_keep_what_stands_at_their_place() {
    let folder = folder();
    let at = |name: &str| folder.path().join(name);
    let list = few(folder.path());
    let expected = fs::read(&list).unwrap();
    let merge = |out: &Path| run_line("merge --out {} {}", &[out, &list]);

    write(at("target"), "old");
    fs::set_permissions(at("target"), fs::Permissions::from_mode(0o640)).unwrap();
    symlink("target", at("link")).unwrap();
    merge(&at("link")).success();
    assert!(at("link").is_symlink(), "a link stays a link");
    assert!(fs::read(at("target")).unwrap() == expected);
    assert_eq!(mode(&at("target")), 0o640, "the mode is kept");

    symlink("new/target", at("dangling")).unwrap();
    merge(&at("dangling")).success();
    assert!(at("dangling").is_symlink() && fs::read(at("new/target")).unwrap() == expected);

    mkfifo(&at("pipe"));
    let got = File::create(at("got")).unwrap();
    let mut reader = Command::new("cat").arg(at("pipe")).stdout(got).spawn().unwrap();
    merge(&at("pipe")).success();
    assert!(reader.wait().unwrap().success());
    assert!(fs::symlink_metadata(at("pipe")).unwrap().file_type().is_fifo());
    assert!(fs::read(at("got")).unwrap() == expected, "a pipe is written through");

    merge(Path::new("/dev/null")).success();
    assert!(fs::symlink_metadata("/dev/null").unwrap().file_type().is_char_device());
    fails("merge --out /dev/full {}", &[&list], &["/dev/full", "cannot be written"]);

    write(at("locked"), "old");
    fs::set_permissions(at("locked"), fs::Permissions::from_mode(0o444)).unwrap();
    fails("merge --out {} {}", &[&at("locked"), &list], &["locked", "read-only"]);
    assert_eq!((fs::read(at("locked")).unwrap(), mode(&at("locked"))), (b"old".to_vec(), 0o444));
    // No verb writes in another way.
    let grade = at("grade.csv");
    write(grade.clone(), csv(1, 20_000));
    for line in ["grade --out {} {}", "grade --format html --out {} {}"] {
        fails(line, &[&at("locked"), &grade], &["locked", "read-only"]);
    }
    fails("render --photons 99 --size 8x6 --out {}", &[&at("locked")], &["locked", "found a file"]);
}

#[test]
fn outputs_replace_no_input() {
    let folder = folder();
    let at = |name: &str| folder.path().join(name);
    let list = few(folder.path());
    let picture = folder.path().join("few/assignment8.png");
    fs::hard_link(&list, at("same.ply")).unwrap();
    symlink(&list, at("link.ply")).unwrap();
    write(at("amy/photons.csv"), "x,y,z\n1,2,3\n");
    write(at("scores.json"), "{}");
    let before = fs::read(&list).unwrap();
    let same = "found one that is read";
    fails("merge {} --out {}", &[&list, &list], &[same]);
    fails("merge {} --out {}", &[&list, &at("same.ply")], &[same]);
    fails("merge {} --out {}", &[&list, &at("link.ply")], &[same]);
    fails("grade {} --out {}", &[&list, &list], &[same]);
    fails("grade {} --out {}", &[&at("amy"), &at("amy/photons.csv")], &[same]);
    let line = "grade {} --policy {} --out {}";
    fails(line, &[&list, &at("scores.json"), &at("scores.json")], &[same]);
    let other = at("other.png");
    fs::copy(&picture, &other).unwrap();
    image::RgbImage::new(8, 6).save(&other).unwrap();
    fails("compare {} {} --out {}", &[&picture, &other, &picture], &[same]);
    let out = format!("--out={}", list.display());
    let output = program(folder.path()).args(["merge", &out]).arg(&list).output().unwrap();
    assert!(output.status.code() == Some(2) && stderr(&output).contains(same));
    assert!(fs::read(&list).unwrap() == before);
}

#[test]
fn names_of_files_are_made_no_folders() {
    let folder = folder();
    let at = |name: &str| folder.path().join(name);
    let lists = [write(at("a.csv"), csv(1, 20_000)), write(at("b.csv"), csv(2, 20_000))];
    for (format, name) in [("gradescope", "res/results.json"), ("html", "page.html")] {
        let line = format!("grade --format {format} --out {{}} {{}} {{}}");
        let expected = ["the name of a file", "FOLDER"];
        fails(&line, &[&at(name), &lists[0], &lists[1]], &expected);
        assert!(!at(name).exists());
    }
    fails("render --photons 99 --size 8x6 --out {}", &[&at("list.ply")], &["FOLDER"]);
    let out = at("new.json/");
    run_line("grade --format gradescope --out {} {}", &[&out, &lists[0]]).success();
    assert!(at("new.json/a.csv.json").is_file(), "a folder may be called so if that is said");
}

#[test]
fn what_killed_runs_leave_is_removed_and_told() {
    let folder = folder();
    let at = |name: &str| folder.path().join("few").join(name);
    few(folder.path());
    write(at(".unfinished-aBc123"), "stale");
    write(at(".unfinished-notes.txt"), "somebody's own");
    fs::create_dir(at(".unfinished-folder")).unwrap();
    let held = File::create(at(".unfinished-alive1")).unwrap();
    held.lock().unwrap();
    let list = at("photons.ply");
    let out = at("merged.ply");
    let output = run_line("merge {} --out {}", &[&list, &out]).success();
    let error = stderr(output.get_output());
    assert!(error.contains(".unfinished-aBc123") && error.lines().count() == 1, "{error}");
    assert!(!at(".unfinished-aBc123").exists());
    for other in [".unfinished-notes.txt", ".unfinished-folder", ".unfinished-alive1"] {
        assert!(at(other).exists(), "{other}");
    }
}

#[test]
fn signals_end_a_run_with_their_own_exit_codes() {
    let ignored = ignored_signals();
    for (signal, number, code) in [("-INT", 2, 130), ("-TERM", 15, 143), ("-HUP", 1, 129)] {
        // A program that was started with `nohup`, or behind `&`, is not ended by such a signal.
        if ignored & (1 << (number - 1)) != 0 {
            eprintln!("skipped: these tests were started with {signal} ignored");
            continue;
        }
        let folder = folder();
        let out = folder.path().join("out");
        let mut child = program(folder.path())
            .args(["render", "--photons", "4e9", "--size", "8x6"])
            .stdout(Stdio::null())
            .spawn()
            .unwrap();
        while fs::read_dir(&out).map_or(0, Iterator::count) < 2 {
            std::thread::sleep(Duration::from_millis(10));
        }
        let id = child.id().to_string();
        assert!(Command::new("kill").args([signal, &id]).status().unwrap().success());
        assert_eq!(child.wait().unwrap().code(), Some(code), "{signal}");
        assert_eq!(fs::read_dir(&out).unwrap().count(), 0, "{signal}");
    }
}

/// The signals that this process and those that it starts ignore, a bit each; none where the system
/// does not say.
fn ignored_signals() -> u64 {
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok()).unwrap_or(0)
}

#[test]
fn closed_standard_output_is_told() {
    let folder = folder();
    let list = write(folder.path().join("a.csv"), csv(1, 20_000));
    let (reader, writer) = std::io::pipe().unwrap();
    drop(reader);
    let output = program(folder.path())
        .arg("grade")
        .arg(list)
        .stdout(writer)
        .stderr(Stdio::piped())
        .spawn()
        .unwrap()
        .wait_with_output()
        .unwrap();
    assert_eq!(output.status.code(), Some(2));
    assert!(stderr(&output).contains("standard output"), "{}", stderr(&output));
}

#[test]
fn files_that_are_called_like_options_are_refused() {
    let folder = folder();
    let at = |name: &str| folder.path().join(name);
    write(at("a.csv"), "x,y,z\n1,2,3\n");
    write(at("zz.json"), "{\"unreadable\": 4}");
    for option in ["--policy=zz.json", "--out=a.csv", "-h"] {
        write(at(option), "");
        let output = program(folder.path()).args(["grade", option, "a.csv"]).output().unwrap();
        let error = stderr(&output);
        assert!(output.status.code() == Some(2) && output.stdout.is_empty(), "{option}: {error}");
        assert!(error.contains(option) && error.contains("write -- before"), "{error}");
        let output = program(folder.path()).args(["grade", "--", option]).output().unwrap();
        assert_eq!(output.status.code(), Some(0), "{option}: {}", stderr(&output));
        fs::remove_file(at(option)).unwrap();
    }
    assert_eq!(fs::read(at("a.csv")).unwrap(), b"x,y,z\n1,2,3\n");
}

#[test]
fn standard_input_and_powers_of_ten() {
    let folder = folder();
    let list = write(folder.path().join("a.csv"), csv(1, 60_000));
    let output = program(folder.path())
        .args(["grade", "--format", "json", "--emitted", "6e4", "-"])
        .stdin(File::open(&list).unwrap())
        .output()
        .unwrap();
    let grade: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!((&grade["verdict"], &grade["submission"]), (&"correct".into(), &"-".into()));
    assert_eq!(grade["emitted"], 60_000);
    let output = program(folder.path())
        .args(["render", "--size", "8x6", "--json", "--photons-from", "-"])
        .stdin(File::open(&list).unwrap())
        .output()
        .unwrap();
    let summary: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert!(summary["stored"].as_u64().unwrap() > 1000);
    let counted = |photons: &str| {
        json(run_line(&format!("render --count-only --json --photons {photons}"), &[]).success())
    };
    assert_eq!(counted("2e3")["sha256"], counted("2000")["sha256"]);
    for wrong in ["1.5", "1e-1", "1e99", "nan"] {
        fails(&format!("render --count-only --photons {wrong}"), &[], &["a whole number from 1"]);
    }
}

#[test]
fn own_lists_are_told_to_the_course_alone() {
    let folder = folder();
    let list = write(folder.path().join("a.csv"), csv(5, 60_000));
    let told = "this program produces with --seed 5";
    let grade = &grades(&[], &[&list])[0];
    assert_eq!(grade["verdict"], "correct");
    assert!(grade["for_course"][0].as_str().unwrap().contains(told), "{grade:#}");
    let gradescope = json(run_line("grade --format gradescope {}", &[&list]).success());
    let tests = gradescope["tests"].to_string() + gradescope["output"].as_str().unwrap();
    assert!(!tests.contains(told), "{tests}");
    let page = crate::support::stdout(run_line("grade --format html {}", &[&list]).success());
    assert!(!page.contains(told));
    let other = write(folder.path().join("b.csv"), csv(5000, 60_000));
    assert!(grades(&[], &[&other])[0].get("for_course").is_none());
    // Pictures are, too, up to many dots.
    let picture = |seed: u64, photons: u64| {
        let line = format!("render --seed {seed} --photons {photons} --quiet --out {{}}");
        run_line(&line, &[folder.path()]).success();
        let line = "grade --format json {}";
        json(run_line(line, &[&folder.path().join("assignment8.png")]).success())
    };
    for (seed, photons) in [(148, 1_000_000), (5, 100_000), (255, 3_000_000)] {
        let grade = picture(seed, photons);
        let told = format!("this program produces with --seed {seed}");
        assert!(grade["for_course"][0].as_str().unwrap().contains(&told), "{grade:#}");
    }
    for (seed, photons) in [(5000, 1_000_000), (3008, 60_000)] {
        assert!(picture(seed, photons).get("for_course").is_none(), "{seed}");
    }
}

#[test]
fn submissions_are_found_by_what_they_contain() {
    let folder = folder();
    let at = |name: &str| folder.path().join(name);
    let list = csv(1, 60_000);
    let mesh = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n\
                property float z\nelement face 1\nproperty list uchar int i\nend_header\n\
                0 0 0\n1 0 0\n1 1 0\n3 0 1 2\n";
    let line = "render --photons 60000 --quiet --out {}";
    run_line(line, &[&at("render")]).success();
    let picture = fs::read(at("render/assignment8.png")).unwrap();
    // A right picture decides beside what cannot be a list of photons.
    for (name, beside) in [("mesh", mesh), ("camera", "0 1.5 4\n"), ("light", "x,y,z\n0,0,1.7\n")] {
        write(at(name).join("assignment8.png"), &picture);
        write(at(name).join(format!("{name}.txt")), beside);
        write(at(name).join("more.ply"), mesh);
        let grade = &grades(&[], &[&at(name)])[0];
        assert_eq!(grade["verdict"], "correct", "{grade:#}");
        assert!(remarks(grade).contains("no photon list"), "{grade:#}");
    }
    // Parts of one submission in two folders.
    write(at("two/results/photons.csv"), &list);
    write(at("two/report/figure.png"), &picture);
    assert_eq!(grades(&[], &[&at("two")])[0]["verdict"], "correct");
    // A list on top of a deep and wide folder.
    write(at("deep/photons.csv"), &list);
    write(at("deep").join("more/".repeat(9)).join("photons.csv"), "x,y,z\n");
    fs::create_dir(at("deep/wide")).unwrap();
    for number in 0..=10_000 {
        File::create(at("deep/wide").join(number.to_string())).unwrap();
    }
    let grade = &grades(&[], &[&at("deep")])[0];
    assert_eq!(grade["verdict"], "correct", "{grade:#}");
    assert!(remarks(grade).contains("was not searched"), "{grade:#}");
    // What has a name with a dot is told where there is nothing else.
    write(at("dots/.photons.csv"), &list);
    assert!(remarks(&grades(&[], &[&at("dots")])[0]).contains("left out: .photons.csv"));
    // Other formats are named, documents only where there is nothing else.
    write(at("ppm/out.ppm"), b"P6\n1 1\n255\n\x01\x02\x03");
    write(at("pdf/report.pdf"), b"%PDF-1.7\n");
    write(at("tga/out.tga"), [0, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 1, 0, 24, 0, 1, 2, 3]);
    write(at("jp2/out.jp2"), b"\0\0\0\x0cjP  \r\n\x87\n\0\0\0\x14ftypjp2 \0\0\0\0jp2 ");
    for (name, kind) in [("ppm", "PPM"), ("pdf", "PDF"), ("tga", "TGA"), ("jp2", "JP2")] {
        let grade = &grades(&[], &[&at(name)])[0];
        let expected = format!("{kind}, not PNG: hand in the PNG that the framework writes");
        assert!(remarks(grade).contains(&expected), "{grade:#}");
    }
    write(at("with/report.pdf"), b"%PDF-1.7\n");
    write(at("with/shot.png"), &picture);
    assert_eq!(grades(&[], &[&at("with")])[0]["verdict"], "correct");
}

#[test]
fn folders_that_could_be_a_class_are_asked_about() {
    let folder = folder();
    let at = |name: &str| folder.path().join(name);
    let list = csv(1, 20_000);
    for (name, files) in [
        ("pair", ["amy/photons.csv", "bob/notes.txt"]),
        ("stray", ["amy/photons.csv", "bob/photons.csv"]),
    ] {
        files.iter().for_each(|file| drop(write(at(name).join(file), &list)));
    }
    write(at("pair/bob/notes.txt"), "no list");
    write(at("stray/photons.csv"), &list);
    write(at("stray/.eve/photons.csv"), &list);
    for name in ["pair", "stray"] {
        fails("grade {}", &[&at(name)], &[name, "amy", "bob", "--submission", "--class"]);
        assert_eq!(grades(&["--submission"], &[&at(name)]).len(), 1, "{name}");
    }
    let names = |name: &str| -> Vec<String> {
        let grades = grades(&["--class"], &[&at(name)]);
        let last = |grade: &Value| {
            let name = grade["submission"].as_str().unwrap().rsplit('/').next();
            name.unwrap().to_owned()
        };
        grades.iter().map(last).collect()
    };
    assert_eq!(names("pair"), ["amy", "bob"]);
    assert_eq!(names("stray"), ["amy", "bob", "photons.csv"]);
    let output = run_line("grade --class {}", &[&at("stray")]).success();
    assert!(stderr(output.get_output()).contains("left out: .eve"));
    // Others are graded all the same.
    let other = write(at("other.csv"), &list);
    let output = run_line("grade --format json {} {}", &[&at("pair"), &other]).code(2);
    assert_eq!(json(output).as_array().map_or(1, Vec::len), 1);
}

#[test]
fn pipes_are_refused_where_their_end_may_never_come() {
    let folder = folder();
    let at = |name: &str| folder.path().join(name);
    let list = few(folder.path());
    mkfifo(&at("pipe"));
    for line in ["compare {} {}", "merge {} {} --out out.ply", "explore --submission {} --out {}"] {
        fails(line, &[&at("pipe"), &list], &["pipe"]);
    }
    fails("compare {} {}", &[&list, &at("pipe")], &["pipe"]);
    for option in ["policy", "roster", "before"] {
        fails(&format!("grade --{option} {{}} {{}}"), &[&at("pipe"), &list], &["pipe"]);
    }
    let line = "render --count-only --light 0,0,1 --scene {}";
    fails(line, &[&at("pipe")], &["pipe"]);
    symlink("/dev/zero", at("endless")).unwrap();
    fails("grade --policy {} {}", &[&at("endless"), &list], &["at most 64 MiB"]);
}

#[test]
fn no_bounces_store_nothing() {
    let folder = folder();
    let some = write(folder.path().join("some.csv"), csv(1, 20_000));
    let none = write(folder.path().join("none.csv"), "x,y,z\n");
    let options = ["--max-bounces", "0"];
    let [some, none] = &grades(&options, &[&some, &none])[..] else { panic!("two grades") };
    assert_eq!((&some["verdict"], &some["score"]), (&"incorrect".into(), &2.0.into()));
    assert_eq!((&none["verdict"], &none["score"]), (&"correct".into(), &4.0.into()));
    // Pictures are judged alike.
    let picture = |bounces: &str| {
        let line = "render --photons 60000 --quiet --max-bounces {} --out {}";
        run_line(line, &[Path::new(bounces), folder.path()]).success();
        grades(&options, &[&folder.path().join("assignment8.png")]).remove(0)
    };
    let (some, none) = (picture("9"), picture("0"));
    assert_eq!((&some["verdict"], &some["score"]), (&"incorrect".into(), &2.0.into()));
    assert_eq!((&none["verdict"], &none["score"]), (&"correct".into(), &4.0.into()), "{none}");
}

#[test]
fn pictures_cost_no_more_than_their_pixels() {
    let folder = folder();
    let at = |name: &str| folder.path().join(name);
    run_line("render --photons 60000 --quiet --out {}", &[&at("render")]).success();
    let png = fs::read(at("render/assignment8.png")).unwrap();
    // Three million chunks would fit into what is read; none of them is unpacked.
    let chunk = |kind: &[u8; 4], contents: &[u8]| {
        [&(contents.len() as u32).to_be_bytes(), &kind[..], contents, &[0; 4]].concat()
    };
    let profile = [b"p\0\0".as_slice(), &vec![0x78; 1 << 20]].concat();
    let texts = chunk(b"zTXt", b"a\0\0x").repeat(100_000);
    write(
        at("many/assignment8.png"),
        [&png[..33], &chunk(b"iCCP", &profile), &texts, &png[33..]].concat(),
    );
    write(at("few/assignment8.png"), &png);
    let start = Instant::now();
    let grade = &grades(&[], &[&at("many")])[0];
    assert!(start.elapsed() < Duration::from_secs(10), "{:?}", start.elapsed());
    let few = &grades(&[], &[&at("few")])[0];
    assert_eq!((&grade["verdict"], &grade["findings"]), (&few["verdict"], &few["findings"]));
    let start = Instant::now();
    let pictures = ["few", "many"].map(|name| at(name).join("assignment8.png"));
    run_line("compare {} {}", &[&pictures[0], &pictures[1]]).code(0);
    assert!(start.elapsed() < Duration::from_secs(10), "{:?}", start.elapsed());
    let huge = [&png[..16], &[0, 0, 0xff, 0xff, 0, 0, 0xff, 0xff], &png[24..]].concat();
    let huge = write(at("huge.png"), huge);
    fails("compare {} {}", &[&huge, &huge], &["65535 x 65535 pixels"]);
    // A chunk that claims to be longer than the file is broken, not endless.
    write(at("cut/assignment8.png"), [&png[..33], &[0xff; 4], b"IDAT", &png[33..99]].concat());
    assert!(remarks(&grades(&[], &[&at("cut")])[0]).contains("broken PNG"));
}

/// All files below `folder`, by their names in it, with their contents.
fn contents(folder: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let mut all = BTreeMap::new();
    for entry in fs::read_dir(folder).into_iter().flatten() {
        let path = entry.unwrap().path();
        let name = PathBuf::from(path.file_name().unwrap());
        if path.is_dir() {
            all.extend(contents(&path).into_iter().map(|(inner, it)| (name.join(inner), it)));
        } else {
            all.insert(name, fs::read(&path).unwrap());
        }
    }
    all
}

#[test]
fn each_write_that_fails_leaves_whole_files() {
    let folder = folder();
    let at = |name: &str| folder.path().join(name);
    few(folder.path());
    write(at("a.csv"), csv(1, 20_000));
    write(at("b.csv"), csv(2, 20_000));
    image::RgbImage::new(8, 6).save(at("black.png")).unwrap();
    let program = env!("CARGO_BIN_EXE_photon-mapping");
    for (line, replaces) in [
        ("merge few/photons.ply --out OUT/merged.csv", true),
        ("grade a.csv --out OUT/a.txt", true),
        ("grade a.csv b.csv --format gradescope --out OUT", true),
        ("grade a.csv b.csv --format html --out OUT", true),
        ("compare few/assignment8.png black.png --out OUT/d.png", true),
        ("render --photons 2000 --size 8x6 --out OUT", true),
        ("render --photons 2000 --size 8x6 --format csv --out OUT", true),
        ("explore --photons 200 --out OUT", true),
        ("kit student --out OUT", false),
        ("kit gradescope --out OUT", false),
    ] {
        let run = |most: String| {
            let line = line.replace("OUT", "out");
            let line = format!("trap '' XFSZ; ulimit -f {most}; {program} {line}");
            Command::new("sh").args(["-c", &line]).current_dir(folder.path()).output().unwrap()
        };
        run("unlimited".to_owned());
        let good = contents(&at("out"));
        assert!(!good.is_empty(), "{line}");
        fs::remove_dir_all(at("out")).unwrap();
        // In blocks of 512 bytes: nothing fits, or all but the end of a file.
        let ends: BTreeSet<usize> =
            good.values().map(|it| it.len().saturating_sub(1) / 512).collect();
        for most in BTreeSet::from([0]).union(&ends) {
            if replaces {
                good.keys().for_each(|name| drop(write(at("out").join(name), "old")));
            }
            let output = run(most.to_string());
            let (error, found) = (stderr(&output), contents(&at("out")));
            for (name, it) in &found {
                let is_whole = good.get(name) == Some(it) || (replaces && it == b"old");
                assert!(is_whole, "{line}: {most} blocks: {}", name.display());
            }
            let _ = fs::remove_dir_all(at("out"));
            assert_eq!(output.status.code(), Some(2), "{line}: {most} blocks: {error}");
            assert!(error.contains("cannot be written"), "{line}: {error}");
        }
    }
}

/// A folder, or a file where a folder is needed: nobody can write there, not even root.
#[test]
fn what_cannot_be_written_is_told_before_any_work_where_that_is_known() {
    let folder = folder();
    let at = |name: &str| folder.path().join(name);
    let list = few(folder.path());
    write(at("grader/submission/photons.csv"), csv(1, 20_000));
    write(at("grader/results"), "a file");
    write(at("file"), "a file");
    for (line, reason) in [
        ("report --out file/report", "cannot be written"),
        ("report --out report.html", "the name of a file"),
        ("kit student --out starter.zip", "the name of a file"),
        ("kit gradescope --out file", "found a file"),
        ("explore --photons 99 --out file/out", "cannot be written"),
        ("render --photons 99 --size 8x6 --out file/out", "cannot be written"),
        ("merge few/photons.ply --out file/merged.ply", "cannot be written"),
        ("grade few/photons.ply --out file/grade.txt", "cannot be written"),
        ("grade few few --format html --out file/pages", "cannot be written"),
        ("autograde grader", "cannot be written"),
    ] {
        let before = contents(folder.path());
        let output = program(folder.path()).args(line.split(' ')).output().unwrap();
        let error = stderr(&output);
        assert!(output.status.code() == Some(2) && output.stdout.is_empty(), "{line}: {error}");
        assert!(error.contains(reason) && error.lines().count() == 1, "{line}: {error}");
        assert!(contents(folder.path()) == before, "{line}");
    }
    // Each file of the report in turn, before it measures for minutes.
    for name in report::FILES {
        fs::create_dir_all(at("report").join(name)).unwrap();
        fails("report --quiet --out {}", &[&at("report")], &[name, "is a directory"]);
        assert!(contents(&at("report")).is_empty(), "{name}");
        fs::remove_dir(at("report").join(name)).unwrap();
    }
    // A list of the pieces that are merged is no output either.
    fails("merge {} --out {}", &[&list, &at("few")], &["few", "is a directory"]);
}

#[test]
fn no_verb_takes_a_full_standard_output_for_a_success() {
    let folder = folder();
    let list = few(folder.path());
    let list = list.to_str().unwrap();
    let runs: [&[&str]; 12] = [
        &["--help"],
        &["--version"],
        &["expect", "--quick", "--json"],
        &["explore", "--photons", "99"],
        &["kit", "student", "--out", "starter"],
        &["grade", list],
        &["compare", list, list],
        &["render", "--photons", "99", "--size", "8x6"],
        &["explain", "1"],
        &["merge", list, "--out", "merged.ply"],
        &["completions", "bash"],
        &["man"],
    ];
    for arguments in runs {
        let full = File::options().write(true).open("/dev/full").unwrap();
        let mut command = program(folder.path());
        let output = command.args(arguments).stdout(full).stderr(Stdio::piped()).spawn().unwrap();
        let output = output.wait_with_output().unwrap();
        let error = stderr(&output);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {error}");
        assert!(error.contains("cannot be written"), "{arguments:?}: {error}");
    }
}
