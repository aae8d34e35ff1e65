//! Numbers that two pages repeat.

use std::collections::BTreeMap;

use super::markdown::links;
use super::read;

/// The numbers of the README's last table are on the pages that it gives as evidence.
#[test]
fn numbers_of_the_readme_are_in_the_evidence() {
    let readme = read("README.md");
    let section = readme.split("\n## How fast and how sure\n").nth(1).expect("a section");
    let section = section.split("\n## ").next().expect("its text");
    let mut seen = 0;
    for row in section.lines().filter(|line| line.starts_with('|') && line.contains("](")) {
        let cells: Vec<_> = row.trim_matches('|').split('|').collect();
        let link = links(cells[2]).remove(0);
        let file = link.split('#').next().expect("a path");
        let evidence = read(file).replace(',', "");
        let is_part = |c: char| !c.is_ascii_digit() && c != '.';
        let numbers = cells[1].replace(',', "");
        for number in numbers.split(is_part).filter(|number| !number.is_empty()) {
            let mut found = evidence.split(is_part);
            assert!(found.any(|other| other == number), "{file} has no {number}: {row}");
            seen += 1;
        }
    }
    assert!(seen > 5, "found only {seen} numbers");
}

/// The rows of a CSV file, by the names of its columns.
pub fn csv(path: &str) -> Vec<BTreeMap<String, String>> {
    let text = read(path);
    let mut lines = text.lines().map(|line| line.split(',').map(str::to_owned));
    let heads: Vec<_> = lines.next().expect("a line of names").collect();
    lines.map(|cells| heads.iter().cloned().zip(cells).collect()).collect()
}

/// Whether `number`, as a page shows it, is `value` rounded to the digits shown.
pub fn is_rounded(number: &str, value: f64) -> bool {
    let number = number.replace(',', "");
    let (digits, power) = number.split_once('e').unwrap_or((&number, "0"));
    let decimals = digits.split_once('.').map_or(0, |(_, decimals)| decimals.len());
    let round = digits.trim_end_matches('0').len();
    let trailing = if round == 0 { 0 } else { digits.len() - round };
    let last = if decimals > 0 { -(decimals as i32) } else { trailing as i32 };
    let last = last + power.parse::<i32>().expect("a power of ten");
    let shown: f64 = number.parse().expect("a number");
    (shown - value).abs() <= 0.501 * 10_f64.powi(last)
}

/// Asserts that `text` starts with the numbers `values`, each rounded to the digits that it shows.
pub fn assert_rounded(text: &str, values: &[f64]) {
    let text = text.replace(',', "");
    let is_part = |c: char| !c.is_ascii_digit() && c != '.';
    let found: Vec<_> = text.split(is_part).filter(|number| !number.is_empty()).collect();
    for (number, value) in found.iter().zip(values) {
        assert!(is_rounded(number, *value), "{number} is not {value}: {text}");
    }
    assert!(found.len() >= values.len(), "expected {values:?}, found {text}");
}

pub fn table(page: &str, heading: &str) -> Vec<Vec<String>> {
    let section = page.split("\n## ").find(|section| section.starts_with(heading));
    let lines = section.unwrap_or_else(|| panic!("no section {heading}")).lines();
    let rows = lines.filter(|line| line.starts_with('|')).skip(2);
    rows.map(|row| row.trim_matches('|').split('|').map(str::to_owned).collect()).collect()
}
