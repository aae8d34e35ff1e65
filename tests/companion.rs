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
