//! `ASSIGNMENT.md` and the code say the same: what the page names exists, and the code has a comment
//! for every section of the handout.

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
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(path);
    fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// Everything between backquotes.
fn quoted(page: &str) -> Vec<&str> {
    page.split('`').skip(1).step_by(2).collect()
}

#[test]
fn everything_named_exists() {
    let page = read("ASSIGNMENT.md");
    let names: Vec<_> = quoted(&page)
        .into_iter()
        .filter(|name| name.starts_with("src/") || name.starts_with("tests/"))
        .collect();
    assert!(names.len() > 60, "found only {} names", names.len());
    for name in names {
        let (path, item) = name.split_once("::").unwrap_or((name, ""));
        let code = read(path);
        if item.is_empty() {
            continue;
        }
        let is_test = path.starts_with("tests/");
        let keywords: &[&str] =
            if is_test { &["fn "] } else { &["fn ", "struct ", "enum ", "pub "] };
        let defined = keywords.iter().any(|keyword| {
            code.match_indices(&format!("{keyword}{item}")).any(|(start, found)| {
                !code[start + found.len()..].starts_with(|c: char| c.is_alphanumeric() || c == '_')
            })
        });
        assert!(defined, "{path} has no '{item}'");
    }
}

#[test]
fn every_section_is_on_the_page_and_in_the_code() {
    let page = read("ASSIGNMENT.md");
    let code =
        read("src/scene/lights/point_light.rs") + &read("src/rendering/photon_mapping_renderer.rs");
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

#[test]
fn ground_floor_imports_nothing_from_above() {
    let above = [
        "photon_list",
        "summary",
        "cli",
        "lanes",
        "text_table",
        "compare",
        "explain",
        "accuracy",
        "grading",
        "report",
    ];
    let folders = ["src/scene", "src/scene/lights", "src/rendering"];
    let mut files = vec!["src/assignment8.rs".to_owned(), "src/random.rs".to_owned()];
    for folder in folders {
        let entries = fs::read_dir(Path::new(env!("CARGO_MANIFEST_DIR")).join(folder)).unwrap();
        for entry in entries {
            let name = entry.unwrap().file_name().into_string().unwrap();
            if name.ends_with(".rs") {
                files.push(format!("{folder}/{name}"));
            }
        }
    }
    assert!(files.len() > 15);
    for file in files {
        let code = read(&file);
        for room in above {
            assert!(!code.contains(&format!("crate::{room}")), "{file} imports {room}");
        }
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
fn readme_has_the_numbers_of_golden_grading() {
    let (readme, golden) = (read("README.md"), read("golden/grading.md"));
    for row in table_rows(&golden, "Correct submissions") {
        let line = format!("| {} |", row.join(" | "));
        assert!(readme.contains(&line), "README lacks {line}");
    }
    let sections = ["positions alone", "positions, and", "all columns"]
        .map(|section| table_rows(&golden, &format!("Found and named: {section}")));
    let ids = sections[0].iter().filter(|row| row[0].contains('`'));
    let mut rows = 0;
    for (place, row) in ids.enumerate() {
        let (_, id) = row[0].split_once(' ').expect("a number and a name");
        // Called correct, without a name, then named by number: the diagonal is right.
        let cells = sections.each_ref().map(|section| {
            let row = section.iter().find(|row| row[0].ends_with(id)).expect("in every section");
            let count = |column: usize| row[column].parse::<u32>().unwrap_or(0);
            let found: u32 = (2..row.len()).map(count).sum();
            format!("{} / {}", found, count(3 + place))
        });
        let line = format!("| {id} | {} |", cells.join(" | "));
        assert!(readme.contains(&line), "README lacks {line}");
        rows += 1;
    }
    assert_eq!(rows, 15);
}
