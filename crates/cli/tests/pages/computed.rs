//! Numbers of pages that follow from the scene, from the expected values, or from a run.

use oracle::table::ExpectedTable;
use photon_mapping::assignment8;
use photon_mapping::scene::triangle::Triangle;
use serde_json::Value;

use crate::numbers::{is_rounded, table};
use crate::read;
use crate::support::{folder, json, run_line, stdout};

/// The numbers at the `#`s of `words`, if `text` starts with these.
fn numbers_at<'a>(text: &'a str, words: &str) -> Option<Vec<&'a str>> {
    let mut parts = words.split('#');
    let mut rest = text.strip_prefix(parts.next()?)?;
    let mut numbers = Vec::new();
    for part in parts {
        let end = rest.find(|c: char| !c.is_ascii_digit() && !".,e-".contains(c));
        let number = rest[..end.unwrap_or(rest.len())].trim_end_matches(['.', ',', '-', 'e']);
        if number.is_empty() {
            return None;
        }
        numbers.push(number);
        rest = rest[number.len()..].strip_prefix(part)?;
    }
    Some(numbers)
}

/// Asserts that the page `path` has `words`, with `values` at the `#`s, rounded to the digits
/// shown.
fn assert_says(path: &str, words: &str, values: &[f64]) {
    let text = read(path).split_whitespace().collect::<Vec<_>>().join(" ");
    let places = text.char_indices().map(|(place, _)| &text[place..]);
    let found = places.filter_map(|text| numbers_at(text, words)).next();
    let found = found.unwrap_or_else(|| panic!("{path} does not say '{words}'"));
    let agree = found.iter().zip(values).all(|(number, value)| is_rounded(number, *value));
    assert!(agree && found.len() == values.len(), "{path}: {words}: {found:?} are not {values:?}");
}

#[test]
fn numbers_are_found_and_held_to_their_digits() {
    assert_eq!(numbers_at("at 1e-5, 0.30.", "at #, #."), Some(vec!["1e-5", "0.30"]));
    assert_eq!(numbers_at("10,026 become 9,066", "# become #"), Some(vec!["10,026", "9,066"]));
    assert_eq!(numbers_at("at last", "at #"), None);
    assert!(is_rounded("2.4e-4", 2.441e-4) && !is_rounded("2.4e-4", 2.46e-4));
    assert!(is_rounded("950", 947.0) && !is_rounded("948", 947.0));
}

#[test]
fn numbers_of_the_expected_values() {
    let expected = ExpectedTable::of_assignment8();
    assert_says("ASSIGNMENT.md", "Per emitted photon, # are stored", &[expected.total.stored]);
    let deviation = (1e6 * expected.covariance.iter().flatten().sum::<f64>()).sqrt();
    assert_says("README.md", "For the total it is # and #.", &[deviation, 3.0 * deviation]);
    let words = "the standard deviation of the stored total is about #.";
    assert_says("docs/accuracy.md", words, &[deviation]);
    let of_cell = 10_000_f64.sqrt();
    let words = "with # expected is mostly within # of it, the square root, and nearly always \
                 within #.";
    assert_says("README.md", words, &[10_000.0, of_cell, 3.0 * of_cell]);
}

#[test]
fn numbers_of_the_scene_and_of_rounding() {
    let scene = assignment8::create_scene();
    // Of the box sides that face x, but not the wall, which does exactly.
    let lengths = scene.triangles().iter().map(|triangle| {
        let x = triangle.normal.x;
        1.0 - x * x
    });
    let lengths: Vec<f32> = lengths.filter(|length| (0.01..0.2).contains(length)).collect();
    assert_eq!(lengths.len(), 2 * 4);
    let [least, most] = [f32::min, f32::max]
        .map(|choose| f64::from(lengths.iter().copied().reduce(choose).expect("some").sqrt()));
    assert_says("ASSIGNMENT.md", "|b| = sqrt(1 - n_x^2): # to # on four box", &[least, most]);
    let tries = 6.0 / std::f64::consts::PI;
    assert_says("ASSIGNMENT.md", "It takes 6 / pi = # tries", &[tries]);
    // The largest number drawn is one step of 2^-24 below 1.
    let lowest = f64::exp2(-24.0).sqrt();
    assert_says("ASSIGNMENT.md", "so z is at least # and", &[lowest]);
    assert_says("docs/numerics.md", "rises above its surface by at least #,", &[lowest]);
    let angle = |triangle: &Triangle| {
        let [a, b, c] = triangle.vertices.map(|corner| corner.as_dvec3());
        let exact = (b - a).cross(c - a).normalize();
        exact.cross(triangle.normal.as_dvec3()).length()
    };
    let angle = scene.triangles().iter().map(angle).fold(0.0, f64::max);
    assert_says("docs/numerics.md", "normals of the model file are off by # at most", &[angle]);
    let step = f64::from(1e5_f32.next_up() - 1e5);
    assert_says("docs/numerics.md", "at 1e5, f32 steps are #;", &[step]);
    let rounding = f64::from(f32::EPSILON);
    assert_says("docs/numerics.md", "has coordinates good to # D", &[rounding]);
}

#[test]
fn photons_on_the_floor_of_both_frames() {
    let floor = |line: &str| {
        let summary = json(run_line(line, &[]).success());
        let surfaces = summary["surfaces"].as_array().expect("a table").clone();
        let floor = surfaces.iter().find(|row| row["name"] == "floor").cloned();
        floor
            .as_ref()
            .and_then(|row| row["stored"].as_f64())
            .unwrap_or_else(|| panic!("no floor in {}", Value::from(surfaces)))
    };
    let counts = ["", " --letter-of-the-handout"]
        .map(|option| floor(&format!("render --count-only --json --quiet{option}")));
    assert_says("ASSIGNMENT.md", "does not: # photons on the floor become #.", &counts);
}

/// The hash of the run that the page traces in pieces.
#[test]
fn large_run_has_the_hash_of_the_page() {
    let page = read("docs/large-runs.md");
    let folder = folder();
    let line = "render --photons 40000000 --size 1x1 --quiet --out {}";
    let printed = stdout(run_line(line, &[folder.path()]).success());
    let hash = printed.split("SHA-256 ").nth(1).and_then(|rest| rest.split_whitespace().next());
    let hash = hash.expect("the name of the list");
    assert!(page.contains("--photons 40000000 --range"), "the page has another run");
    assert!(page.contains(&format!("`{hash}`")), "docs/large-runs.md lacks {hash}");
}

/// As many scenes and photons in the text and in the README as in the table.
#[test]
fn scenes_without_leaks_add_up() {
    let page = read("docs/numerics.md");
    let rows = table(&page, "Measured");
    let cases: f64 = rows.iter().map(|row| row[1].parse::<f64>().expect("a number")).sum();
    assert_says("docs/numerics.md", "photons a case; # x 10^9 in all", &[cases / 10.0]);
    assert_says("README.md", "hit where they start, # scenes|0 of # x", &[cases, cases / 10.0]);
    assert!(rows.iter().all(|row| row[2..].iter().all(|count| count == "0")), "{rows:?}");
}

/// What the benches printed is kept beside them.
fn result(name: &str) -> String {
    read(format!("crates/fast/benches/results/{name}.txt"))
}

#[test]
fn stages_on_the_page_are_those_of_the_bench() {
    let printed = result("stages");
    let rows = printed.lines().filter(|line| line.starts_with('|')).skip(2);
    let rows: Vec<Vec<&str>> = rows.map(|row| row.trim_matches('|').split('|').collect()).collect();
    let page = table(&read("docs/speed.md"), "Where a photon's time goes");
    assert_eq!(page.len(), rows.len());
    for (shown, row) in page.iter().zip(&rows) {
        for (shown, number) in shown[1..5].iter().zip(&row[1..5]) {
            let agree = match number.parse() {
                Ok(number) => is_rounded(shown, number),
                Err(_) => shown == number,
            };
            assert!(agree, "{shown} is not {number}: {row:?}");
        }
    }
    let number = |before: &str, after: &str| -> f64 {
        let (start, _) = printed.split_once(after).unwrap_or_else(|| panic!("no '{after}'"));
        let (_, number) = start.rsplit_once(before).expect("what is before it");
        number.parse().expect("a number")
    };
    let (ghz, cycles, milliseconds) =
        (number(", ", " GHz"), number(", ", " cycles a pixel"), number(": ", " ms,"));
    assert_says("docs/speed.md", "takes # cycles a pixel, # ms on one", &[cycles, milliseconds]);
    assert_says("docs/speed.md", "At # GHz the target of 0.25 is", &[ghz]);
}

/// `run.sh` keeps what it printed; the first run on a machine makes the file.
#[test]
fn ratios_on_the_page_are_those_of_the_peers() {
    let kept = crate::root().join("crates/fast/benches/results/peers.txt");
    if !kept.exists() {
        eprintln!("skipped: crates/fast/benches/peers/run.sh has kept nothing yet");
        return;
    }
    let printed = result("peers");
    let lines: Vec<&str> = printed.lines().filter(|line| line.contains(", ratio ")).collect();
    let page = table(&read("docs/speed.md"), "Beside other programs");
    assert_eq!(page.len(), lines.len());
    for (row, line) in page.iter().zip(lines) {
        let (_, ratio) = line.split_once(", ratio ").expect("a ratio");
        let is_part = |c: char| !c.is_ascii_digit() && c != '.';
        let numbers = |text: &str| -> Vec<String> {
            let parts = text.split(is_part).map(|part| part.trim_matches('.'));
            parts.filter(|part| !part.is_empty()).map(str::to_owned).collect()
        };
        let (shown, kept) = (numbers(&row[4]), numbers(ratio));
        assert_eq!(shown.len(), 3, "{row:?}");
        for (shown, kept) in shown.iter().zip(&kept) {
            let kept = kept.parse().expect("a number");
            assert!(is_rounded(shown, kept), "{shown} is not {kept}: {line}");
        }
    }
}
