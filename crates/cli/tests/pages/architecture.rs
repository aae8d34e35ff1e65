//! The page on the architecture, its drawing, and the manifests.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;

use super::{project_files, read, root};

const ROOT: &str = "photon-mapping";

/// Which crates each crate uses, by folder, as the manifests have it.
fn manifests() -> BTreeMap<String, BTreeSet<String>> {
    let entries = fs::read_dir(root().join("crates")).expect("a folder of the project");
    let names = entries.map(|entry| entry.expect("can be read").file_name());
    let names: BTreeSet<_> = names.map(|name| name.into_string().expect("is text")).collect();
    let uses = |name: &String| {
        let manifest = read(format!("crates/{name}/Cargo.toml"));
        // Those of one system too, but not those of tests and build scripts.
        let sections = manifest.split("\n[").filter(|section| {
            let head = section.lines().next().unwrap_or_default();
            head == "dependencies]" || head.ends_with(".dependencies]")
        });
        let lines = sections.flat_map(str::lines);
        let used = lines.filter_map(|line| line.split(['.', ' ']).next());
        let is_ours = |used: &&str| *used == ROOT || names.contains(*used);
        (name.clone(), used.filter(is_ours).map(str::to_owned).collect())
    };
    names.iter().map(uses).collect()
}

#[test]
fn table_of_crates_has_what_the_manifests_have() {
    let page = read("docs/architecture.md");
    let rows = page.lines().filter(|line| line.starts_with("|`crates/"));
    let row = |row: &str| {
        let cells: Vec<_> = row.trim_matches('|').split('|').collect();
        let name = cells[0].trim_matches('`').strip_prefix("crates/").expect("a folder").to_owned();
        let used = cells[2].replace("root", ROOT);
        (name, used.split(", ").map(str::to_owned).collect::<BTreeSet<_>>())
    };
    assert_eq!(rows.map(row).collect::<BTreeMap<_, _>>(), manifests());
}

/// A line for every use that no longer way implies; tests alone use fixtures.
#[test]
fn drawing_has_what_the_manifests_have() {
    let uses = manifests();
    let mut expected = BTreeSet::new();
    for (name, used) in uses.iter().filter(|(name, _)| *name != "fixtures") {
        for below in used {
            let by_another = |other: &&String| uses.get(*other).is_some_and(|u| u.contains(below));
            if !used.iter().any(|other| by_another(&other)) {
                expected.insert(format!("{name}-to-{below}"));
            }
        }
    }
    let drawing = read("docs/architecture.svg");
    let lines = drawing.split("<line id=\"").skip(1);
    let drawn = lines.map(|line| line.split('"').next().expect("an id").to_owned());
    assert_eq!(drawn.collect::<BTreeSet<_>>(), expected);
}

/// Aliases of one file for different systems are one thing.
#[test]
fn no_type_name_stands_for_two_things() {
    let mut places: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    for (path, text) in project_files(&[".rs"]) {
        let is_library = path.starts_with("src/") || path.contains("/src/");
        let is_library = is_library && !path.contains("/tests/");
        for line in text.lines().filter(|_| is_library) {
            let declaration =
                line.trim_start_matches("pub(crate) ").trim_start_matches("pub(super) ");
            let declaration = declaration.trim_start_matches("pub ");
            let kinds = ["struct ", "enum ", "trait ", "type "];
            let Some(rest) = kinds.iter().find_map(|kind| declaration.strip_prefix(kind)) else {
                continue;
            };
            let ends = |letter: char| !letter.is_alphanumeric();
            let name = rest.split(ends).next().expect("a first part").to_owned();
            places.entry(name).or_default().insert(path.clone());
        }
    }
    assert!(places.contains_key("PhotonMappingRenderer"), "the port was not read");
    places.retain(|_, paths| paths.len() > 1);
    assert_eq!(places, BTreeMap::new());
}

/// A file of tests without a line in its program, or a test in a library that cargo does not test,
/// would never run.
#[test]
fn no_test_is_left_out() {
    let manifests = project_files(&["Cargo.toml"]);
    let all = project_files(&[".rs"]);
    let mut programs = 0;
    for (manifest, text) in manifests {
        let folder = manifest.strip_suffix("Cargo.toml").expect("its end");
        let below = |part: &str| {
            let start = format!("{folder}{part}/");
            let files = all.iter().filter_map(move |(path, text)| {
                Some((path.strip_prefix(&start)?.to_owned(), text.clone()))
            });
            files.collect::<Vec<_>>()
        };
        if text.contains("\ntest = false") {
            let is_test = |(_, text): &(String, String)| text.contains("#[test]");
            let tests = below("src").into_iter().find(is_test).map(|(path, _)| path);
            assert_eq!(tests, None, "{manifest}");
        }
        if text.contains("\nautotests = false") {
            programs += 1;
            let tests = below("tests");
            let files = tests.iter().filter(|(path, _)| !path.contains('/'));
            for (path, _) in files {
                let name = path.strip_suffix(".rs").expect("its end");
                let lines = [format!("\nmod {name};"), format!("\nname = \"{name}\"")];
                let is_main = name == "main" || text.contains(&lines[1]);
                let is_part = tests.iter().any(|(_, text)| text.contains(&lines[0]));
                assert!(is_main || is_part, "{folder}tests/{path}");
            }
        }
    }
    assert!(programs > 3, "{programs}");
}
