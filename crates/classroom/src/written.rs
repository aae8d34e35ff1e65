//! What this program wrote, by how it starts: a second run may replace it, and it is no submission.

use std::fs;
use std::path::Path;

use maud::html;

use grading::picture::kinds::start;
use grading::text::verdict_in_words;
use grading::verdict::Verdict;

/// What made a page, in the page.
pub(crate) const GENERATOR: &str = "photon-mapping";
/// The columns that every gradebook starts with.
pub const GRADEBOOK: [&str; 5] = ["name", "id", "email", "score", "verdict"];

/// How JSON starts that `grade` or `check` wrote, and what is soon to follow.
const JSON: [(&str, &str); 4] = [
    ("{\n  \"submission\": \"", "\n  \"verdict\": \""),
    ("[\n  {\n    \"submission\": \"", "\n    \"verdict\": \""),
    ("[\n  {\n    \"grade\": {\n      \"", "\": "),
    ("{\n  \"score\": ", "\n  \"stdout_visibility\": \"hidden\",\n  \"tests\": ["),
];
const VERDICTS: [Verdict; 5] = [
    Verdict::Correct,
    Verdict::Undecided,
    Verdict::Incorrect,
    Verdict::NoDots,
    Verdict::Unreadable,
];
/// A folder of more files is not looked through.
const MOST_FILES: usize = 10_000;

/// Whether this program wrote the file `path`, or all files of the folder `path`.
pub fn is_own(path: &Path) -> bool {
    let Ok(about) = path.symlink_metadata() else { return false };
    if !about.is_dir() {
        return about.is_file() && start(path).is_ok_and(|start| is_own_start(&start));
    }
    let Ok(entries) = fs::read_dir(path) else { return false };
    let mut files = 0;
    let is_own_file = |entry: std::io::Result<fs::DirEntry>| {
        files += 1;
        let path = entry.map(|entry| entry.path());
        files <= MOST_FILES && path.is_ok_and(|path| !path.is_dir() && is_own(&path))
    };
    entries.into_iter().all(is_own_file) && files > 0
}

/// Whether this program wrote the file that starts with the bytes `start`.
pub(crate) fn is_own_start(start: &[u8]) -> bool {
    let text = String::from_utf8_lossy(start);
    let text = text.trim_start_matches('\u{feff}');
    let first = text.lines().next().unwrap_or_default();
    let is_json = |(start, next): (&str, &str)| {
        text.strip_prefix(start).is_some_and(|rest| rest.contains(next))
    };
    let generator = html! { meta name="generator" content=(GENERATOR); }.into_string();
    let is_page = text.starts_with("<!DOCTYPE html>") && text.contains(&generator);
    is_page
        || JSON.into_iter().any(is_json)
        || first.starts_with(&(GRADEBOOK.join(",") + ","))
        || is_heading(first)
}

/// Whether `line` is the first of a grade as text: a name, a verdict, and points.
fn is_heading(line: &str) -> bool {
    let is_number = |text: &str| text.parse::<f64>().is_ok();
    let parts = line.strip_suffix(" points").and_then(|line| line.rsplit_once(" of "));
    let Some((line, best)) = parts else { return false };
    let Some((line, score)) = line.rsplit_once(", ") else { return false };
    let has_verdict =
        |verdict: Verdict| line.ends_with(&format!(": {}", verdict_in_words(verdict)));
    is_number(best) && is_number(score) && VERDICTS.into_iter().any(has_verdict)
}
