//! Numbers that two pages repeat.

use crate::markdown::links;
use crate::read;

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
