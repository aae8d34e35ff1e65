//! What `grade` writes for machines, for Gradescope, and for people: in a browser, too.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::support::{fails, folder, json, run_line, stdout};
use base64::Engine as _;
use base64::prelude::BASE64_STANDARD;
use serde_json::Value;
use sha2::{Digest as _, Sha256};
use variants::variation::{Hemisphere, Simulation, Storage, Variation};

const PHOTONS: u64 = 60_000;

/// A list of the positions and bounces of `variation`, in `folder`.
fn list(folder: &Path, name: &str, variation: Variation) -> PathBuf {
    let simulation = Simulation::new(variation, 9, PHOTONS, 1000);
    let mut text = String::from("x,y,z,bounce\n");
    for record in simulation.trace(0..PHOTONS) {
        let [x, y, z] = record.position.to_array();
        text += &format!("{x},{y},{z},{}\n", record.bounce);
    }
    let path = folder.join(name);
    fs::write(&path, text).unwrap();
    path
}

fn correct(folder: &Path, name: &str) -> PathBuf {
    list(folder, name, Variation::default())
}

fn incorrect(folder: &Path, name: &str) -> PathBuf {
    list(folder, name, Variation { hemisphere: Hemisphere::Uniform, ..Variation::default() })
}

fn names(folder: &Path) -> Vec<String> {
    let names =
        fs::read_dir(folder).unwrap().map(|e| e.unwrap().file_name().into_string().unwrap());
    let mut names: Vec<_> = names.collect();
    names.sort();
    names
}

/// Checks `value` against Gradescope's description of results.json.
fn check_results(value: &Value) {
    let visibilities = ["hidden", "after_due_date", "after_published", "visible"];
    let formats = ["text", "html", "simple_format", "md", "ansi"];
    let is_one_of =
        |value: &Value, words: &[&str]| value.as_str().is_some_and(|v| words.contains(&v));
    let keys = |value: &Value, known: &[&str]| {
        for key in value.as_object().expect("an object").keys() {
            assert!(known.contains(&key.as_str()), "Gradescope knows no '{key}'");
        }
    };
    let top = [
        "score",
        "output",
        "output_format",
        "visibility",
        "stdout_visibility",
        "extra_data",
        "tests",
        "leaderboard",
    ];
    keys(value, &top);
    assert!(value["score"].is_number());
    assert!(value["output"].is_string() && value["extra_data"].is_object());
    assert!(is_one_of(&value["output_format"], &formats));
    assert!(is_one_of(&value["visibility"], &visibilities));
    assert!(is_one_of(&value["stdout_visibility"], &visibilities));
    let tests = value["tests"].as_array().unwrap();
    assert!(!tests.is_empty());
    let of_test =
        ["name", "status", "number", "output", "output_format", "tags", "visibility", "extra_data"];
    for test in tests {
        keys(test, &of_test);
        assert!(
            test["name"].is_string() && test["output"].is_string() && test["number"].is_string()
        );
        assert!(is_one_of(&test["status"], &["passed", "failed"]));
        assert!(is_one_of(&test["visibility"], &visibilities));
        assert!(is_one_of(&test["output_format"], &formats));
    }
}

#[test]
fn json_has_the_fields_of_a_grade() {
    let folder = folder();
    let (right, wrong) = (correct(folder.path(), "r.csv"), incorrect(folder.path(), "w.csv"));
    let grade = json(run_line("grade --format json --emitted 60000 {}", &[&wrong]).success());
    let keys: Vec<_> = grade.as_object().unwrap().keys().map(String::as_str).collect();
    for key in [
        "submission",
        "emitted",
        "stored",
        "score",
        "verdict",
        "misreading",
        "misreading_confidence",
        "findings",
    ] {
        assert!(keys.contains(&key), "{key}");
    }
    for key in ["check", "section", "expected", "found", "p_value", "passed", "advice"] {
        assert!(grade["findings"][0].get(key).is_some(), "{key}");
    }
    assert_eq!(grade["misreading"], "uniform-hemisphere");
    let grades =
        json(run_line("grade --format json --emitted 60000 {} {}", &[&right, &wrong]).success());
    assert_eq!(grades[0]["verdict"], "correct");
    assert_eq!(grades[1], grade, "a grade does not depend on those beside it");
}

#[test]
fn gradescope_results() {
    let folder = folder();
    let (right, wrong) = (correct(folder.path(), "r.csv"), incorrect(folder.path(), "w.csv"));
    // A list of this kind is remarked on.
    let text = fs::read_to_string(&right).unwrap();
    fs::write(&right, text.replace(',', ";")).unwrap();
    let results =
        json(run_line("grade --format gradescope --emitted 60000 {}", &[&wrong]).success());
    check_results(&results);
    assert_eq!(results["score"], 3.0);
    // Students see why they have it, but not what the grader printed.
    assert_eq!(results["visibility"], "visible");
    assert_eq!(results["stdout_visibility"], "hidden");
    assert!(results["output"].as_str().unwrap().contains("uniform-hemisphere"));
    let failed = |results: &Value| {
        results["tests"].as_array().unwrap().iter().filter(|t| t["status"] == "failed").count()
    };
    assert!(failed(&results) > 0);
    fails(
        "grade --format gradescope {} {}",
        &[&right, &wrong],
        &["--out", "folder", "2 submissions"],
    );
    let out = folder.path().join("results");
    fs::write(&out, "").unwrap();
    fails("grade --format gradescope --out {} {} {}", &[&out, &right, &wrong], &["found a file"]);
    fs::remove_file(&out).unwrap();
    run_line("grade --format gradescope --out {} {} {} {}", &[&out, &right, &wrong, &right])
        .success();
    assert_eq!(names(&out), ["r.csv.json", "r.csv__2_.json", "w.csv.json"]);
    let results: Value =
        serde_json::from_slice(&fs::read(out.join("r.csv.json")).unwrap()).unwrap();
    check_results(&results);
    assert_eq!((&results["score"], failed(&results)), (&4.0.into(), 0));
    let tests = results["tests"].as_array().unwrap();
    let remarks = tests.iter().filter(|test| test["extra_data"]["passed"] == false);
    assert_eq!(remarks.map(|test| &test["name"]).collect::<Vec<_>>(), ["format"]);
    let alone = folder.path().join("results.json");
    let empty = folder.path().join("empty");
    fs::create_dir(&empty).unwrap();
    run_line("grade --format gradescope --out {} {}", &[&alone, &empty]).success();
    check_results(&serde_json::from_slice(&fs::read(&alone).unwrap()).unwrap());
}

#[test]
fn nothing_of_a_submission_gets_into_the_page_as_it_is() {
    let folder = folder();
    let name = "<img src=x onerror=alert(1)>&\"'.csv";
    let path = folder.path().join(name);
    fs::write(&path, "x,y,z\n1,<script>alert(2)</script>,3\n").unwrap();
    let bytes = b"\x89PNG\r\n\x1a\n<script>alert(3)</script>";
    let picture = folder.path().join("<svg onload=alert(4)>.png");
    fs::write(&picture, bytes).unwrap();
    let out = folder.path().join("pages");
    run_line("grade --format html --out {} {} {}", &[&out, &path, &picture]).success();
    assert_eq!(names(&out).len(), 3);
    for file in names(&out) {
        let is_plain = |letter: char| letter.is_ascii_alphanumeric() || "-_.".contains(letter);
        assert!(file.chars().all(is_plain), "{file}");
        let page = fs::read_to_string(out.join(&file)).unwrap();
        for part in
            ["<img src=x", "<script>alert", "<svg onload", "src=\"http", "href=\"http", "@import"]
        {
            assert!(!page.contains(part), "{file} contains {part}");
        }
        assert!(page.contains("Content-Security-Policy"));
        // What is no picture is not shown as one.
        assert!(!page.contains("data:image"), "{file}");
    }
    let index = fs::read_to_string(out.join("index.html")).unwrap();
    assert!(index.contains("&lt;img src=x onerror=alert(1)&gt;"));
    // No style and no script but the page's own, which its policy names by their hashes.
    assert!(!index.contains("unsafe-inline"));
    for tag in ["style", "script"] {
        let (_, rest) = index.split_once(&format!("<{tag}>")).unwrap();
        let (content, others) = rest.split_once(&format!("</{tag}>")).unwrap();
        let hash = BASE64_STANDARD.encode(Sha256::digest(content));
        assert!(index.contains(&format!("{tag}-src 'sha256-{hash}'")), "{tag}");
        assert!(!others.contains(&format!("<{tag}")), "{tag}");
    }
}

#[test]
fn pages_show_no_picture_that_would_fill_them() {
    let folder = folder();
    let (long, page) = (folder.path().join("long.png"), folder.path().join("page.html"));
    image::RgbImage::new(4097, 1).save(&long).unwrap();
    run_line("grade --format html --out {} {}", &[&page, &long]).success();
    let page = fs::read_to_string(page).unwrap();
    assert!(page.contains("is not shown: expected at most 4096 pixels") && !page.contains("<img"));
}

#[test]
fn every_submission_has_a_page_of_its_own() {
    let folder = folder();
    // Some systems do not tell capitals apart, and the index is a page too.
    let long = "n".repeat(150);
    let submissions = ["a/r.csv", "b/R.csv", "index", "Index", "..csv", &long].map(|name| {
        let path = folder.path().join("class").join(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(&path, "x,y,z\n").unwrap();
        path
    });
    let out = folder.path().join("pages");
    let mut paths = vec![out.as_path()];
    paths.extend(submissions.iter().map(PathBuf::as_path));
    let line = "grade --format html --out {}".to_owned() + &" {}".repeat(submissions.len());
    run_line(&line, &paths).success();
    let expected = [
        "Index-3.html",
        "R.csv-2.html",
        "csv.html",
        "index-2.html",
        "index.html",
        &format!("{}.html", "n".repeat(100)),
        "r.csv.html",
    ];
    assert_eq!(names(&out), expected);
    assert!(fs::read_to_string(out.join("index.html")).unwrap().contains("6 submissions"));
}

/// A facet's count is the same in the findings and beside its plots.
#[test]
fn a_page_counts_the_photons_of_a_facet_once() {
    let folder = folder();
    let wrong = incorrect(folder.path(), "w.csv");
    let grade = json(run_line("grade --format json --emitted 60000 {}", &[&wrong]).success());
    let findings = grade["findings"].as_array().unwrap();
    let found = findings.iter().find(|f| f["check"] == "facets").unwrap()["found"].as_str();
    let (_, found) = found.unwrap().split_once("largest difference: ").unwrap();
    let (facet, rest) = found.split_once(" has ").unwrap();
    let (count, rest) = rest.split_once(" photons; expected ").unwrap();
    let expected = rest.split(' ').next().unwrap();
    let out = folder.path().join("page.html");
    run_line("grade --format html --emitted 60000 --out {} {}", &[&out, &wrong]).success();
    let page = fs::read_to_string(&out).unwrap();
    let beside = format!("<h3>{facet}</h3><p>{count} found, {expected} expected</p>");
    assert!(page.contains(&beside), "{beside}");
}

#[test]
fn the_index_sums_up_a_class() {
    let folder = folder();
    let class = folder.path().join("class");
    fs::create_dir(&class).unwrap();
    let (right, wrong) = (correct(&class, "r.csv"), incorrect(&class, "w.csv"));
    let out = folder.path().join("pages");
    let line = "grade --format html --emitted 60000 --out {} {} {}";
    run_line(line, &[&out, &right, &wrong]).success();
    let index = fs::read_to_string(out.join("index.html")).unwrap();
    for part in [
        "Mean score: 3.50 of 4 points",
        "<th scope=\"row\">Hemisphere Sampling</th>",
        "<th scope=\"row\">uniform-hemisphere</th>",
        "<td>Hemisphere Sampling</td><td>uniform-hemisphere</td>",
        // The folder that all have in common is not said again.
        "<a href=\"r.csv.html\">r.csv</a>",
        "type=\"search\"",
        "--format html --emitted 60000",
    ] {
        assert!(index.contains(part), "no {part} in\n{index}");
    }
    let page = fs::read_to_string(out.join("w.csv.html")).unwrap();
    assert!(page.contains("<a href=\"index.html\">") && page.contains(">w.csv</h1>"));
    // Pages of another run would pass for pages of this one.
    fails(line, &[&out, &right, &right], &["--out", "files of another run", "w.csv.html"]);
    run_line(line, &[&out, &right, &wrong]).success();
}

#[test]
fn photons_straight_from_the_light_are_not_plausible() {
    let folder = folder();
    let of_light = Variation { storage: Storage::All, ..Variation::default() };
    let path = list(folder.path(), "light.csv", of_light);
    let grade = json(run_line("grade --format json --emitted 60000 {}", &[&path]).success());
    assert_eq!((&grade["verdict"], &grade["score"]), (&"incorrect".into(), &2.0.into()));
    assert_eq!(grade["misreading"], "direct-stored");
}

#[test]
fn incoming_directions_are_shown_where_they_are_given() {
    let folder = folder();
    let with = crate::support::reference_csv(folder.path(), 60_000);
    let text = fs::read_to_string(&with).unwrap();
    let names: Vec<&str> = text.lines().next().unwrap().split(',').collect();
    let of = |line: &str, is_kept: &dyn Fn(&str) -> bool| -> String {
        let values = line.split(',').zip(&names).filter(|(_, name)| is_kept(name));
        values.map(|(value, _)| value).collect::<Vec<_>>().join(",") + "\n"
    };
    let direction = |name: &str| name.starts_with("to_light");
    let is_position = |name: &str| ["x", "y", "z"].contains(&name);
    let without: String = text.lines().map(|line| of(line, &is_position)).collect();
    let bare = folder.path().join("bare.csv");
    fs::write(&bare, without).unwrap();
    // As a ray that is never set.
    let unset = folder.path().join("unset.csv");
    let unset_line = |line: &str| -> String {
        let values = line.split(',').zip(&names);
        let values = values.map(|(value, name)| if direction(name) { "0" } else { value });
        values.collect::<Vec<_>>().join(",") + "\n"
    };
    let (header, rows) = text.split_once('\n').unwrap();
    fs::write(&unset, format!("{header}\n") + &rows.lines().map(unset_line).collect::<String>())
        .unwrap();
    for (list, has_directions, has_bounces) in
        [(&with, true, true), (&bare, false, false), (&unset, false, true)]
    {
        let page = folder.path().join("page.html");
        run_line("grade --format html --out {} {}", &[&page, list]).success();
        let page = fs::read_to_string(&page).unwrap();
        assert_eq!(page.contains("Incoming directions"), has_directions, "{}", list.display());
        assert_eq!(page.contains("<h3>Bounces</h3>"), has_bounces, "{}", list.display());
    }
}

#[cfg(unix)]
#[test]
fn no_half_written_grade() {
    let folder = folder();
    let (list, out) = (correct(folder.path(), "r.csv"), folder.path().join("out/page.html"));
    fs::create_dir(out.parent().unwrap()).unwrap();
    fs::write(&out, "kept").unwrap();
    let program = assert_cmd::cargo::cargo_bin("photon-mapping");
    let output = Command::new("sh")
        .args(["-c", "trap '' XFSZ; ulimit -f 8; exec \"$@\"", "sh"])
        .arg(program)
        .args(["grade", "--format", "html", "--out"])
        .args([&out, &list])
        .output()
        .unwrap();
    let stderr = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{stderr}");
    assert!(stderr.contains("page.html") && stderr.lines().count() == 1, "{stderr}");
    assert_eq!(fs::read_to_string(&out).unwrap(), "kept");
    assert_eq!(names(out.parent().unwrap()), ["page.html"]);
}

/// Opens `page` in Chromium; gives the document that it made of it. Nothing, with a message, where
/// there is no Chromium; where `PHOTON_MAPPING_CHROMIUM` is set there must be one.
fn browse(page: &Path) -> Option<String> {
    let is_expected = std::env::var_os("PHOTON_MAPPING_CHROMIUM").is_some();
    let profile = folder();
    let opened = Command::new("chromium")
        .args(["--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run"])
        .args(["--disable-background-networking", "--disable-component-update", "--disable-sync"])
        .args(["--allow-file-access-from-files", "--dump-dom"])
        .arg(format!("--user-data-dir={}", profile.path().display()))
        .arg(format!("file://{}", page.display()))
        .output();
    match opened {
        Ok(output) => {
            assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
            Some(String::from_utf8(output.stdout).expect("a page is text"))
        }
        Err(error) if is_expected => panic!("chromium cannot be run: {error}"),
        Err(error) => {
            eprintln!("SKIPPED: chromium cannot be run ({error}); no page was opened");
            None
        }
    }
}

#[test]
fn pages_open_in_a_browser() {
    let folder = folder();
    let (right, wrong) = (correct(folder.path(), "r.csv"), incorrect(folder.path(), "w.csv"));
    let out = folder.path().join("pages");
    run_line("grade --format html --emitted 60000 --out {} {} {}", &[&out, &right, &wrong])
        .success();
    assert_eq!(names(&out), ["index.html", "r.csv.html", "w.csv.html"]);
    let page = fs::read_to_string(out.join("w.csv.html")).unwrap();
    // Two axes of twelve faces and the bounces, a map of each face, and three pictures.
    assert_eq!(page.matches("<svg").count(), 25 + 12);
    assert_eq!(page.matches("src=\"data:image/png;base64,").count(), 3);
    assert!(page.contains("uniform-hemisphere") && page.contains("3 of 4 points"));
    // Pages have no scripts: another one measures them in frames as wide as a phone and a screen.
    let files = [("r.csv.html", "correct"), ("w.csv.html", "incorrect"), ("index.html", "")];
    let frames = files.iter().flat_map(|(file, _)| [390, 1200].map(|width| (*file, width)));
    let frame = |(file, width)| format!("<iframe src={file} width={width} height=2400></iframe>");
    let measuring = "<script>onload = () => { const measured = Array.from(frames, (page) => ({\
        verdict: page.document.querySelector('p.verdict')?.className, \
        links: [...page.document.links].map((link) => link.getAttribute('href')), \
        broken: [...page.document.images].filter((image) => !image.naturalWidth).length, \
        over: page.document.documentElement.scrollWidth - page.innerWidth })); \
        document.body.textContent = JSON.stringify(measured); }</script>";
    let measured = out.join("measured.html");
    fs::write(&measured, frames.map(frame).collect::<String>() + measuring).unwrap();
    let Some(document) = browse(&measured) else { return };
    let json = document.split("<body>").nth(1).and_then(|rest| rest.split("</body>").next());
    let pages: Vec<Value> = serde_json::from_str(json.expect("a body")).expect("what was measured");
    for (at, page) in pages.iter().enumerate() {
        let (file, verdict) = files[at / 2];
        assert_eq!(page["broken"], 0, "{file}: a picture is broken");
        assert!(page["over"].as_f64().unwrap() <= 0.0, "{file} is too wide: {page}");
        let links = page["links"].as_array().unwrap();
        match verdict {
            "" => assert!(
                links.contains(&"r.csv.html".into()) && links.contains(&"w.csv.html".into())
            ),
            verdict => assert_eq!(page["verdict"], format!("verdict {verdict}"), "{file}"),
        }
    }
    assert_eq!(pages.len(), 2 * files.len());
}

#[test]
fn text_of_several() {
    let folder = folder();
    let (right, wrong) = (correct(folder.path(), "r.csv"), incorrect(folder.path(), "w.csv"));
    let none = folder.path().join("none.csv");
    fs::write(&none, "x;why\n1;2\n").unwrap();
    let text = stdout(run_line("grade {} {}", &[&right, &none]).success());
    assert!(text.contains("r.csv: correct, 4 of 4 points"), "{text}");
    assert!(text.contains("none.csv: unreadable, 0 of 4 points\n"), "{text}");
    // What all faults of a misreading advise is said once.
    let text = stdout(run_line("grade --emitted 60000 {}", &[&wrong]).success());
    assert!(text.matches("FAULT").count() > 1, "{text}");
    assert_eq!(text.matches("Take r = sqrt(u1)").count(), 1, "{text}");
}

#[test]
fn who_has_the_same_files_is_for_the_course_alone() {
    let folder = folder();
    let of = |name: &str| {
        let student = folder.path().join("class").join(name);
        fs::create_dir_all(&student).unwrap();
        correct(&student, "photons.csv");
    };
    of("ann");
    of("ben");
    for name in ["ann", "ben"] {
        let earlier = folder.path().join("class").join(name).join("earlier.csv");
        fs::write(earlier, "x,y,z\n").unwrap();
    }
    let (class, out) = (folder.path().join("class"), folder.path().join("out"));
    let told = stdout(run_line("grade {}", &[&class]).success());
    assert!(told.contains("byte by byte"));
    run_line("grade --format gradescope --out {} {}", &[&out, &class]).success();
    for name in names(&out) {
        let value: Value =
            serde_json::from_str(&fs::read_to_string(out.join(name)).unwrap()).unwrap();
        check_results(&value);
        let tests = value["tests"].as_array().unwrap();
        let of_others = |test: &&Value| test["output"].as_str().unwrap().contains("byte by byte");
        let twins = tests.iter().find(of_others).expect("they are told");
        assert_eq!(twins["visibility"], "hidden");
        // What was left out is the student's own.
        let others = || tests.iter().filter(|test| !of_others(test));
        assert!(others().all(|test| test["visibility"] == "visible"), "{tests:#?}");
        assert!(others().any(|test| test["name"] == "files"), "{tests:#?}");
    }
    let pages = folder.path().join("pages");
    run_line("grade --format html --out {} {}", &[&pages, &class]).success();
    for name in names(&pages).into_iter().filter(|name| name != "index.html") {
        assert!(!fs::read_to_string(pages.join(name)).unwrap().contains("byte by byte"));
    }
}
