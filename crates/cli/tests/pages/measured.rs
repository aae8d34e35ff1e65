//! Numbers of pages that were measured: what the commands printed is kept, and pages show that.

use std::collections::BTreeMap;

use super::computed::assert_says;
use super::numbers::{assert_rounded, csv, is_rounded, table};
use super::read;

/// The errors on the page are those of `report --long`, which repeat to the last digit.
#[test]
fn errors_on_the_page_are_those_of_the_report() {
    let page = read("docs/accuracy.md");
    let data = csv("golden/report-speed.csv");
    let number = |row: &BTreeMap<String, String>, name: &str| -> f64 {
        row[name].parse().unwrap_or_else(|_| panic!("{name}: {}", row[name]))
    };
    let rows = table(&page, "How errors fall");
    assert_eq!(rows.len(), 6);
    let mut squares = 0.0;
    for row in &rows {
        let emitted: f64 = row[0].replace(',', "").parse().expect("a number");
        let find = |name: &str| {
            let mut all = data.iter();
            all.find(|row| row["name"] == name && number(row, "emitted") == emitted).expect(name)
        };
        let percent = |name: &str, column: &str| 100.0 * number(find(name), column);
        let total = ["rms_error", "low", "high"].map(|column| percent("total", column));
        assert_rounded(&row[1], &total);
        assert_rounded(&row[2], &[percent("total", "theory")]);
        assert_rounded(&row[3], &[percent("each_surface", "rms_error")]);
        assert_rounded(&row[4], &[percent("each_facet", "rms_error")]);
        squares += emitted * number(find("total"), "rms_error").powi(2) / rows.len() as f64;
    }
    let largest = data.iter().rfind(|row| row["name"] == "total").expect("a row");
    let of_theory = number(largest, "emitted") * number(largest, "theory").powi(2);
    for (goal, unit) in [("1", 1.0), ("0.1", 1e6)] {
        let line = page.lines().find(|line| line.starts_with(&format!("- To {goal} %: ")));
        let (_, line) = line.expect("a goal").split_once(": ").expect("its photons");
        let part: f64 = goal.parse().expect("a number");
        let photons = |square: f64| square * (100.0 / part).powi(2) / unit;
        assert_rounded(line, &[photons(squares)]);
        let (_, theory) = line.split_once("theory ").expect("what theory says");
        assert_rounded(theory, &[photons(of_theory)]);
    }
    let samplers = csv("golden/report-sampler.csv");
    for row in table(&page, "Another sampler") {
        let quantity = if row[0] == "stored" { row[0].clone() } else { format!("{}_hits", row[0]) };
        let data = samplers.iter().rfind(|data| data["quantity"] == quantity).expect("a row");
        assert_rounded(&row[1], &[100.0 * number(data, "chacha_rms")]);
        assert_rounded(&row[2], &[100.0 * number(data, "sobol_rms")]);
        let ratio = ["variance_ratio", "ratio_low", "ratio_high"].map(|name| number(data, name));
        assert_rounded(&row[3], &ratio);
    }
}

/// The numbers of the one line of `golden/report.md` that has `part`.
fn reported(part: &str) -> Vec<f64> {
    let report = read("golden/report.md");
    let lines: Vec<_> = report.lines().filter(|line| line.contains(part)).collect();
    let [line] = lines[..] else { panic!("golden/report.md: '{part}' in {} lines", lines.len()) };
    let is_part = |c: char| !c.is_ascii_digit() && !".e-".contains(c);
    let words = line.split(is_part).map(|word| word.trim_end_matches(['.', '-']));
    words.filter_map(|word| word.parse().ok()).collect()
}

#[test]
fn slope_and_goals_are_those_of_the_report() {
    let slope = reported("Log-log slope, total:");
    assert_says("docs/accuracy.md", "The slope is # (# to #).", &[slope[0], slope[2], slope[3]]);
    for (part, words, unit) in [
        ("To 1 % of the stored total:", "To 1 %: # photons (# to #; theory #).", 1.0),
        ("To 0.1 % of the stored total:", "To 0.1 %: # million (# to #; theory #).", 1e6),
    ] {
        let found = reported(part);
        let photons = [found[1], found[5], found[6], found[7]].map(|photons| photons / unit);
        assert_says("docs/accuracy.md", words, &photons);
    }
}

#[test]
fn precision_and_offset_are_those_of_the_report() {
    let page = "docs/accuracy.md";
    let paths = reported("photons with the random numbers of seed")[0];
    assert_says(page, "All # paths take", &[paths]);
    assert_eq!(reported("of a million paths decide otherwise")[0], 0.0);
    let [first, second] = ["| 1 | ", "| 2 | "].map(|row| reported(row)[2]);
    assert_says(page, "differ by # at the first hit and # at the second", &[first, second]);
    let offset = reported("photons a case, so a 0 stands for fewer than");
    assert_says(page, "no photon of # a case went wrong", &offset[2..3]);
    assert_says(page, "So fewer than # of a million do", &offset[4..5]);
    assert_eq!(reported("The reference's rule, in its worst place")[0], 0.0);
}

/// Self-hits, leaks, lost and extra photons in the handout's scene with an offset of `rule`, per
/// million.
fn with_offset(rule: &str) -> Vec<f64> {
    let report = read("golden/report.md");
    let row = report.lines().find(|line| line.starts_with(&format!("| {rule} | ")));
    let cells: Vec<_> = row.unwrap_or_else(|| panic!("no offset {rule}")).split('|').collect();
    cells[4].split('/').map(|count| count.trim().parse().expect("a count")).collect()
}

#[test]
fn offsets_are_those_of_the_report() {
    let self_hits = with_offset("1e-7 n")[0];
    assert_says("docs/numerics.md", "At 1e-7, # of a million photons", &[self_hits]);
    let lost = with_offset("1e-2 n")[2];
    assert_says("docs/numerics.md", "wall: # of a million photons miss a hit", &[lost]);
    assert_eq!(with_offset("1e-5 n"), [0.0; 4]);
}

/// What the test of 10^8 photons a case wrote.
#[test]
fn scenes_without_leaks_are_those_of_the_table() {
    let page = table(&read("docs/numerics.md"), "Measured");
    let data = csv("golden/leaks.csv");
    let number = |row: &BTreeMap<String, String>, name: &str| -> f64 {
        row[name].parse().unwrap_or_else(|_| panic!("{name}: {}", row[name]))
    };
    let mut seen = 0;
    for row in &page {
        let of_row = |data: &&BTreeMap<String, String>| {
            let amount = number(data, "by");
            let is_listed = match data["case"].as_str() {
                "moved" => [amount.to_string(), format!("{amount:e}")]
                    .iter()
                    .any(|amount| row[0].split([' ', ',']).any(|word| word == amount)),
                _ => true,
            };
            row[0].starts_with(&data["case"]) && is_listed
        };
        let cases: Vec<_> = data.iter().filter(of_row).collect();
        seen += cases.len();
        assert_eq!(row[1], cases.len().to_string(), "{row:?}");
        for (shown, name) in row[2..].iter().zip(["self_hits", "from_behind", "under_a_box"]) {
            let count: f64 = cases.iter().map(|data| number(data, name)).sum();
            assert!(is_rounded(shown, count), "{name}: {count}, {row:?}");
        }
    }
    assert_eq!(seen, data.len());
    let photons: Vec<_> = data.iter().map(|row| number(row, "photons")).collect();
    let (cases, all) = (data.len() as f64, photons.iter().sum::<f64>() / 1e9);
    assert!(photons.iter().all(|photons| *photons == 1e8));
    assert_says("docs/numerics.md", "10^8 photons a case; # x 10^9 in all", &[all]);
    assert_says("README.md", "hit where they start, # scenes|0 of # x", &[cases, all]);
}
