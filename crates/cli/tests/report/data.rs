//! The files of one quick report, and the formulas of the page once more.

use std::collections::HashMap;
use std::fs;
use std::path::Path;
use std::process::{Command, Output};
use std::sync::LazyLock;

use assert_cmd::cargo::CommandCargoExt;
use tempfile::TempDir;

pub fn run(folder: &Path, arguments: &[&str]) -> Output {
    let mut command = Command::cargo_bin("photon-mapping").unwrap();
    command.current_dir(folder).args(arguments).output().unwrap()
}

/// The files of one quick report.
pub static REPORT: LazyLock<HashMap<String, String>> = LazyLock::new(|| {
    let folder = TempDir::new().unwrap();
    let output = run(folder.path(), &["report", "--quick"]);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    assert_eq!(String::from_utf8_lossy(&output.stdout), "written: report/report.html\n");
    assert!(output.stderr.is_empty());
    let entries = fs::read_dir(folder.path().join("report")).unwrap();
    let file = |entry: std::io::Result<fs::DirEntry>| {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_str().unwrap().to_owned();
        (name, fs::read_to_string(path).unwrap())
    };
    entries.map(file).collect()
});

pub type Row = HashMap<String, String>;

/// The rows of a CSV file, by head.
pub fn rows(name: &str) -> Vec<Row> {
    let mut lines = REPORT[name].lines().map(|line| line.split(',').map(str::to_owned));
    let heads: Vec<_> = lines.next().unwrap().collect();
    lines.map(|line| heads.iter().cloned().zip(line).collect()).collect()
}

pub fn of(row: &Row, head: &str) -> f64 {
    row[head].parse().unwrap_or_else(|_| panic!("{head} is '{}'", row[head]))
}

/// The different numbers under `head`, ascending.
pub fn different(rows: &[Row], head: &str) -> Vec<f64> {
    let mut numbers: Vec<_> = rows.iter().map(|row| of(row, head)).collect();
    numbers.sort_by(f64::total_cmp);
    numbers.dedup();
    numbers
}

pub fn mean(numbers: &[f64]) -> f64 {
    numbers.iter().sum::<f64>() / numbers.len() as f64
}

/// Squared errors by size, run and cell.
pub type Table = Vec<Vec<Vec<f64>>>;

/// A statistic, and both ends of its 95 % interval.
pub type Interval = [f64; 3];

/// The interval from pseudo-values: the ordinary interval of a mean, of numbers whose mean is the
/// statistic without its bias.
pub fn interval(table: &Table, statistic: &dyn Fn(&Table) -> f64) -> Interval {
    let value = statistic(table);
    let (mut center, mut variance) = (value, 0.0);
    for (size, runs) in table.iter().enumerate() {
        let count = runs.len() as f64;
        let pseudo = |run: usize| {
            let mut without = table.clone();
            without[size].remove(run);
            count * value - (count - 1.0) * statistic(&without)
        };
        let pseudo: Vec<_> = (0..runs.len()).map(pseudo).collect();
        let middle = mean(&pseudo);
        center += middle - value;
        variance +=
            pseudo.iter().map(|p| (p - middle).powi(2)).sum::<f64>() / (count - 1.0) / count;
    }
    // Student's t with one degree of freedom less than runs at a size.
    let t = match table[0].len() {
        32 => 2.039_513,
        16 => 2.131_450,
        other => panic!("{other} runs"),
    };
    let reach = t * variance.sqrt();
    [value, center - reach, center + reach]
}

pub fn exp([value, low, high]: Interval) -> Interval {
    [value.exp(), low.exp(), high.exp()]
}

/// The mean square of one size.
pub fn mean_square(runs: &[Vec<f64>]) -> f64 {
    mean(&runs.concat())
}

/// The RMS of a table of one size.
pub fn rms(runs: &[Vec<f64>]) -> Interval {
    exp(interval(&vec![runs.to_vec()], &|table| 0.5 * mean_square(&table[0]).ln()))
}

/// The slope with a height for each cell: that of a regression on dummies, by Frisch and Waugh. Of
/// each cell only the sizes that expect 20 photons.
pub fn slope(sizes: &[f64], table: &Table, expected: &[f64]) -> Option<Interval> {
    let of_table = |table: &Table| {
        let (mut xy, mut xx) = (0.0, 0.0);
        for (cell, expected) in expected.iter().enumerate() {
            let sizes = sizes.iter().zip(table).filter(|(size, _)| **size * expected >= 20.0);
            let points: Vec<(f64, f64)> = sizes
                .map(|(size, runs)| {
                    let squares: Vec<_> = runs.iter().map(|run| run[cell]).collect();
                    (size.log10(), mean(&squares).sqrt().log10())
                })
                .collect();
            let x = mean(&points.iter().map(|point| point.0).collect::<Vec<_>>());
            let y = mean(&points.iter().map(|point| point.1).collect::<Vec<_>>());
            xy += points.iter().map(|point| (point.0 - x) * (point.1 - y)).sum::<f64>();
            xx += points.iter().map(|point| (point.0 - x).powi(2)).sum::<f64>();
        }
        xy / xx
    };
    of_table(table).is_finite().then(|| interval(table, &of_table))
}
