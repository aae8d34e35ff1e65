//! The report: whole, and every claim of its page follows from its data.

use std::collections::HashMap;
use std::fs;
use std::path::Path;
use std::process::{Command, Output};
use std::sync::LazyLock;

use assert_cmd::cargo::CommandCargoExt;
use tempfile::TempDir;

fn run(folder: &Path, arguments: &[&str]) -> Output {
    let mut command = Command::cargo_bin("photon-mapping").unwrap();
    command.current_dir(folder).args(arguments).output().unwrap()
}

/// The files of one quick report.
static REPORT: LazyLock<HashMap<String, String>> = LazyLock::new(|| {
    let folder = TempDir::new().unwrap();
    let output = run(folder.path(), &["report", "--quick"]);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    assert_eq!(String::from_utf8_lossy(&output.stdout), "written: report/report.md\n");
    assert!(output.stderr.is_empty());
    let entries = fs::read_dir(folder.path().join("report")).unwrap();
    let file = |entry: std::io::Result<fs::DirEntry>| {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_str().unwrap().to_owned();
        (name, fs::read_to_string(path).unwrap())
    };
    entries.map(file).collect()
});

type Row = HashMap<String, String>;

/// The rows of a CSV file, by head.
fn rows(name: &str) -> Vec<Row> {
    let mut lines = REPORT[name].lines().map(|line| line.split(',').map(str::to_owned));
    let heads: Vec<_> = lines.next().unwrap().collect();
    lines.map(|line| heads.iter().cloned().zip(line).collect()).collect()
}

fn number(text: &str) -> f64 {
    let digits: String =
        text.chars().take_while(|c| c.is_ascii_digit() || "+-.e".contains(*c)).collect();
    digits.parse().unwrap_or_else(|_| panic!("no number at the start of '{text}'"))
}

fn of(row: &Row, head: &str) -> f64 {
    number(&row[head])
}

/// The numbers that the page prints in bold on its line with `part`.
fn bold(part: &str) -> Vec<f64> {
    let line = REPORT["report.md"].lines().find(|line| line.contains(part));
    let line = line.unwrap_or_else(|| panic!("no line with '{part}'"));
    let words = line.split("**").skip(1).step_by(2);
    let numbers = words.flat_map(|words| {
        words.split(' ').filter(|word| word.starts_with(|c: char| c == '-' || c.is_ascii_digit()))
    });
    numbers.map(number).collect()
}

/// The cells of the row of a table that starts with `first`, in the section with this number.
fn cells(section: u32, first: &str) -> Vec<String> {
    let page = &REPORT["report.md"];
    let section = page.split("\n## ").nth(section as usize).unwrap();
    let start = format!("| {first} | ");
    let line = section.lines().find(|line| line.starts_with(&start)).unwrap();
    line.split('|').map(|cell| cell.trim().to_owned()).skip(2).collect()
}

fn assert_close(found: f64, known: f64, tolerance: f64) {
    let error = (found - known).abs();
    assert!(error <= tolerance * known.abs() + 1e-12, "the page has {found}, the data {known}");
}

fn rms(errors: &[f64]) -> f64 {
    (errors.iter().map(|error| error * error).sum::<f64>() / errors.len() as f64).sqrt()
}

/// Sizes, RMS errors of the stored total, and mean seconds.
fn totals() -> Vec<(f64, f64, f64)> {
    let rows = rows("speed-runs.csv");
    let total = |row: &Row| {
        row.iter().filter(|(head, _)| head.contains('/')).map(|(_, cell)| number(cell)).sum::<f64>()
    };
    let expected = total(&rows[0]);
    let mut sizes: Vec<_> = rows[1..].iter().map(|row| of(row, "emitted")).collect();
    sizes.dedup();
    let of_size = |size: f64| {
        let runs: Vec<_> = rows[1..].iter().filter(|row| of(row, "emitted") == size).collect();
        assert_eq!(runs.len(), 32);
        let error = |row: &&Row| total(row) / size / expected - 1.0;
        let seconds: f64 = runs.iter().map(|row| of(row, "seconds")).sum();
        (size, rms(&runs.iter().map(error).collect::<Vec<_>>()), seconds / runs.len() as f64)
    };
    sizes.into_iter().map(of_size).collect()
}

#[test]
fn slope_follows_from_the_runs() {
    let points: Vec<_> = totals().iter().map(|(n, error, _)| (n.ln(), error.ln())).collect();
    let count = points.len() as f64;
    let x_mean = points.iter().map(|p| p.0).sum::<f64>() / count;
    let y_mean = points.iter().map(|p| p.1).sum::<f64>() / count;
    let spread: f64 = points.iter().map(|p| (p.0 - x_mean).powi(2)).sum();
    let product: f64 = points.iter().map(|p| (p.0 - x_mean) * (p.1 - y_mean)).sum();
    let claim = bold("slope, total");
    assert!((claim[0] - product / spread).abs() < 6e-4);
    assert!((claim[1] - 1.96 / 64_f64.sqrt() / spread.sqrt()).abs() < 6e-4);
    // Not only recomputed, but right: three of these half widths are six standard deviations.
    assert!((claim[0] + 0.5).abs() < 3.0 * claim[1]);
}

#[test]
fn times_to_a_goal_follow_from_the_runs() {
    let totals = totals();
    let squares = totals.iter().map(|(n, error, _)| n * error * error);
    let constant = squares.sum::<f64>() / totals.len() as f64;
    let (size, _, seconds) = totals[totals.len() - 1];
    for (goal, line) in [(0.01, "To 1 %"), (0.001, "To 0.1 %")] {
        let claim = bold(line);
        let photons = constant / (goal * goal);
        assert_close(claim[0], photons, 6e-3);
        assert_close(claim[1], photons * seconds / size, 6e-3);
    }
}

#[test]
fn table_of_speed_follows_from_the_runs() {
    for (size, error, seconds) in totals() {
        let cells = cells(1, &if size < 1e6 { size.to_string() } else { format!("{size:e}") });
        assert_close(number(&cells[0]), 100.0 * error, 6e-3);
        assert_close(number(&cells[5]), seconds, 6e-3);
        assert_close(number(&cells[6]), size / seconds, 6e-3);
        assert_close(number(&cells[7]), 1.0 / (error * error * seconds), 6e-3);
    }
}

#[test]
fn claims_of_precision_follow_from_the_data() {
    let row = &rows("precision-summary.csv")[0];
    let per_million = of(row, "other_decision") * 1e6 / of(row, "photons");
    assert_close(bold("decide otherwise")[0], per_million, 6e-3);
    assert_close(
        bold("times as long")[0],
        of(row, "f64_nanoseconds") / of(row, "f32_nanoseconds"),
        6e-3,
    );
    let sum: f64 =
        ["emission", "other_facet", "hit_or_escape"].map(|head| of(row, head)).iter().sum();
    assert_eq!(sum, of(row, "other_decision"));
    // Points are a few units in the last place of the box's size off, at the first hit.
    assert!(of(&rows("precision.csv")[0], "median") < 1e-6);
}

#[test]
fn claims_of_offset_follow_from_the_data() {
    let rows = rows("offset.csv");
    let of_reference = rows.iter().filter(|row| row["rule"] == "reference");
    let worst = of_reference.map(|row| of(row, "wrong_per_million")).fold(0.0, f64::max);
    assert_close(bold("in its worst place")[0], worst, 6e-3);
    for rule in ["none", "1e-7 n", "1e-5 n", "reference"] {
        let row = rows.iter().find(|row| {
            row["rule"] == rule && row["place"] == "scaled" && of(row, "amount") == 1.0
        });
        let row = row.unwrap();
        let per_million = |head: &str| of(row, head) * 1e6 / of(row, "emitted");
        let known = [per_million("self_hits"), per_million("leaks"), of(row, "lost_per_million")];
        let cells = cells(3, rule);
        let found: Vec<_> = cells[2].split(" / ").map(number).collect();
        known.iter().zip(found).for_each(|(known, found)| assert!((known - found).abs() <= 0.5));
        let wrong = known.iter().sum::<f64>();
        assert_close(of(row, "wrong_per_million"), wrong, 1e-6);
        // In its own place the reference is right, and without an offset much is wrong.
        match rule {
            "reference" => assert_eq!(wrong, 0.0),
            "none" => assert!(wrong > 10_000.0),
            _ => {}
        }
    }
}

#[test]
fn claims_of_sampler_follow_from_the_runs() {
    let rows = rows("sampler-runs.csv");
    let largest = rows[1..].iter().map(|row| of(row, "emitted")).fold(0.0, f64::max);
    let of_sampler = |name: &str| -> Vec<&Row> {
        let is_it = |row: &&Row| row["sampler"] == name && of(row, "emitted") == largest;
        rows[1..].iter().filter(is_it).collect()
    };
    let quantities = [("first hits", "hits1"), ("second hits", "hits2"), ("stored", "stored")];
    for (name, head) in quantities {
        let error = |sampler: &str| {
            let expected = of(&rows[0], head);
            let error = |row: &&Row| of(row, head) / largest / expected - 1.0;
            rms(&of_sampler(sampler).iter().map(error).collect::<Vec<_>>())
        };
        let (chacha, sobol) = (error("chacha"), error("sobol"));
        let cells = cells(4, name);
        assert_close(number(&cells[0]), 100.0 * chacha, 6e-3);
        assert_close(number(&cells[1]), 100.0 * sobol, 6e-3);
        assert_close(number(&cells[2]), (chacha / sobol).powi(2), 6e-3);
        if name == "first hits" {
            assert!(sobol < chacha / 5.0, "{sobol} is not much better than {chacha}");
        }
    }
    let seconds =
        |sampler: &str| of_sampler(sampler).iter().map(|row| of(row, "seconds")).sum::<f64>();
    assert_close(bold("s with ChaCha")[0], seconds("sobol") / seconds("chacha"), 6e-3);
}

#[test]
fn page_shows_plots_that_are_there() {
    let page = &REPORT["report.md"];
    for name in ["speed", "precision", "offset", "sampler"] {
        assert!(page.contains(&format!("]({name}.svg)")));
        let svg = &REPORT[&format!("{name}.svg")];
        let document = roxmltree::Document::parse(svg).unwrap();
        assert_eq!(document.root_element().tag_name().name(), "svg");
        assert!(!svg.contains("NaN") && !svg.contains("inf"), "{name}");
    }
    for link in page.split("](").skip(1).map(|rest| rest.split(')').next().unwrap()) {
        assert!(REPORT.contains_key(link), "the page links to '{link}'");
    }
    assert_eq!(REPORT.len(), 12);
    for part in ["rustc", "photon-mapping report --quick", "seeds of section 1"] {
        assert!(page.contains(part), "{part}");
    }
}

#[test]
fn folder_that_cannot_be_made_is_one_line() {
    let folder = TempDir::new().unwrap();
    fs::write(folder.path().join("file"), "").unwrap();
    let output = run(folder.path(), &["report", "--quick", "--out", "file/report"]);
    let stderr = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(2));
    assert_eq!(stderr.lines().count(), 1, "{stderr}");
    assert!(stderr.contains("file/report"), "{stderr}");
    assert!(output.stdout.is_empty());
}

#[test]
fn quick_and_long_exclude_each_other() {
    let folder = TempDir::new().unwrap();
    let output = run(folder.path(), &["report", "--quick", "--long"]);
    assert_eq!(output.status.code(), Some(2));
    assert_eq!(String::from_utf8(output.stderr).unwrap().lines().count(), 1);
    assert!(fs::read_dir(folder.path()).unwrap().next().is_none());
}
