//! The report: whole, and every number of its sections 1 to 4 follows from its data. Section 5
//! names the machine, versions, seeds and commands.

mod claims;
mod data;
mod offset;
mod precision;
mod sampler;
mod speed;

use std::fs;

use data::{REPORT, run};
use tempfile::TempDir;

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
    assert_eq!(REPORT.len(), 13);
    // The same in one file that needs no other.
    let html = &REPORT["report.html"];
    assert_eq!(html.matches("src=\"data:image/svg+xml;base64,").count(), 4);
    assert_eq!(html.matches("<table>").count(), page.matches("\n|---").count());
    assert!(html.contains("<h1>Speed and accuracy</h1>") && !html.contains("src=\"http"));
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
