//! The pages and the code say the same: what a page names exists, and the code has a comment for
//! every section of the handout.

use std::fs;
use std::path::Path;

const SECTIONS: [&str; 5] = [
    "Photon Emission",
    "Photon Storage",
    "Photon Scattering/Absorption",
    "Hemisphere Sampling",
    "Hemisphere Ray Transformation",
];

fn read(path: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(path);
    fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// Everything between backquotes.
fn quoted(page: &str) -> Vec<&str> {
    page.split('`').skip(1).step_by(2).collect()
}

#[test]
fn everything_named_exists() {
    let pages =
        ["README.md", "ASSIGNMENT.md", "CHANGELOG.md", "CONTRIBUTING.md", "docs/accuracy.md"];
    let pages = pages.into_iter().chain(["docs/numerics.md", "docs/grading.md"]);
    let pages = pages.chain(["docs/architecture.md", "docs/photon-lists.md", "docs/speed.md"]);
    let mut seen = 0;
    for page in pages {
        let text = read(page);
        // Examples in blocks are not names.
        let text: String = text.split("```").step_by(2).collect();
        let is_place = |name: &&str| {
            let folders = ["src/", "tests/", "crates/", "docs/"];
            folders.iter().any(|folder| name.starts_with(folder)) && !name.contains(' ')
        };
        for name in quoted(&text).into_iter().filter(is_place) {
            let (path, item) = name.split_once("::").unwrap_or((name, ""));
            let place = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(path);
            assert!(place.exists(), "{page}: {path} does not exist");
            seen += 1;
            if item.is_empty() {
                continue;
            }
            let code = read(path);
            let is_test = path.contains("tests/");
            let keywords: &[&str] =
                if is_test { &["fn "] } else { &["fn ", "struct ", "enum ", "pub "] };
            let defined = keywords.iter().any(|keyword| {
                code.match_indices(&format!("{keyword}{item}")).any(|(start, found)| {
                    let after = &code[start + found.len()..];
                    !after.starts_with(|c: char| c.is_alphanumeric() || c == '_')
                })
            });
            assert!(defined, "{page}: {path} has no '{item}'");
        }
    }
    assert!(seen > 100, "found only {seen} names");
}

/// The table of sections lists all tests of the file beside them, and each fails when some line is
/// broken.
#[test]
fn all_tests_of_the_sections_are_listed_and_broken() {
    let (page, mutations) = (read("ASSIGNMENT.md"), read("tests/mutations.txt"));
    for section in SECTIONS {
        let row = page.lines().find(|line| line.starts_with(&format!("| {section} |")));
        let names = quoted(row.unwrap_or_else(|| panic!("{section} has no row of tests")));
        let code = read(names[0]);
        let after_marks = code.split("#[test]").skip(1);
        let tests: Vec<_> = after_marks
            .map(|text| text.split_once("fn ").and_then(|(_, text)| text.split_once('(')))
            .map(|parts| parts.expect("a function follows").0)
            .collect();
        assert!(tests.len() > 3, "{section}: {tests:?}");
        assert_eq!(names[1..], tests, "{section}");
        for test in tests {
            let is_broken = mutations.split_whitespace().any(|word| word == test);
            assert!(is_broken, "tests/mutations.txt breaks no line for '{test}'");
        }
    }
}

#[test]
fn every_section_is_on_the_page_and_in_the_code() {
    let page = read("ASSIGNMENT.md");
    let code = read("src/scene/point_light.rs") + &read("src/rendering/photon_mapping_renderer.rs");
    let mut last = 0;
    for section in SECTIONS {
        assert!(page.contains(&format!("\n## {section}\n")), "{section} is not on the page");
        let comment = format!("// {section}\n");
        let place = code.find(&comment).unwrap_or_else(|| panic!("no comment '{section}'"));
        assert!(place > last, "{section} is not in the handout's order");
        last = place;
        assert_eq!(code.matches(&comment).count(), 1);
    }
}

/// The rows of the tables of `page` under headings that start with `heading`, cell by cell.
fn table_rows(page: &str, heading: &str) -> Vec<Vec<String>> {
    let sections = page.split("\n## ").filter(|section| section.starts_with(heading));
    let lines = sections.flat_map(str::lines);
    let lines = lines.filter(|line| line.starts_with('|') && !line.starts_with("|---"));
    lines
        .map(|line| line.trim_matches('|').split('|').map(|c| c.trim().to_owned()).collect())
        .collect()
}

#[test]
fn the_page_on_grading_has_the_numbers_of_golden_grading() {
    let (page, golden) = (read("docs/grading.md"), read("golden/grading.md"));
    let rows = table_rows(&golden, "Correct submissions");
    assert!(rows.len() > 3, "{rows:?}");
    let of_page = table_rows(&page, "How sure it is");
    for row in rows {
        assert!(of_page.contains(&row), "docs/grading.md lacks {row:?}");
    }
}
