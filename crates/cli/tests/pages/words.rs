//! The wording of pages, and the width of their lines and of the code's.

use super::markdown::texts;
use super::{pages, project_files, read};

const LONGEST_SENTENCE: usize = 30;
const WIDEST_LINE: usize = 100;
/// How many words a page may have, with its code and tables.
const LONGEST_PAGES: [(&str, usize); 11] = [
    ("README.md", 1300),
    ("ASSIGNMENT.md", 2000),
    ("CONTRIBUTING.md", 300),
    ("docs/accuracy.md", 600),
    ("docs/architecture.md", 600),
    ("docs/comparing.md", 800),
    ("docs/grading.md", 1200),
    ("docs/large-runs.md", 600),
    ("docs/numerics.md", 600),
    ("docs/photon-lists.md", 600),
    ("docs/speed.md", 600),
];

/// Words that the glossary replaces.
const REPLACED_WORDS: [&str; 5] = ["sent out", "send out", "sends out", "looks on", "look on"];

/// Parts of words as they are spelled in Britain; the project writes American English.
const BRITISH: [&str; 20] = [
    "colour",
    "neighbour",
    "behaviour",
    "favour",
    "honour",
    "normalis",
    "vectoris",
    "initialis",
    "organis",
    "recognis",
    "summaris",
    "minimis",
    "optimise",
    "optimising",
    "optimisation",
    "judgement",
    "licence",
    "catalogue",
    "centre",
    "grey",
];

/// Names that keep their spelling: of misreadings, of what a student's file calls a material, and
/// of the course framework.
const KEPT_NAMES: [&str; 5] =
    ["half-normalised", "not-normalised", "Anodized Grey", "optimise()", "_and_optimise"];

fn words(sentence: &str) -> usize {
    sentence.split_whitespace().filter(|word| word.contains(char::is_alphanumeric)).count()
}

fn sentences(text: &str) -> Vec<&str> {
    let mut sentences = Vec::new();
    let mut start = 0;
    for (place, _) in text.match_indices(['.', '!', '?']) {
        let rest = text[place + 1..].trim_start_matches([')', '"', '\'']);
        if rest.is_empty() || rest.starts_with(' ') {
            sentences.push(&text[start..=place]);
            start = place + 1;
        }
    }
    sentences.push(&text[start..]);
    sentences
}

#[test]
fn sentences_are_short() {
    let mut faults = String::new();
    for (path, page) in pages() {
        for text in texts(&page) {
            for sentence in sentences(&text).iter().filter(|s| words(s) > LONGEST_SENTENCE) {
                faults += &format!("{path}: {} words: {}\n", words(sentence), sentence.trim());
            }
        }
    }
    assert!(faults.is_empty(), "at most {LONGEST_SENTENCE} words:\n{faults}");
}

#[test]
fn pages_are_short() {
    for (path, most) in LONGEST_PAGES {
        let words = read(path).split_whitespace().count();
        assert!(words <= most, "{path}: {words} words, {most} at most");
    }
}

#[test]
fn spelling_is_american() {
    let mut faults = String::new();
    let kinds = [".rs", ".js", ".css", ".html", ".md", ".toml", ".sh", ".py", ".yml", ".hpp"];
    for (path, text) in &project_files(&kinds) {
        // What students hand in is theirs.
        if path.ends_with("pages/words.rs") || path.contains("/tests/field/") {
            continue;
        }
        for (number, line) in (1..).zip(text.lines()) {
            let kept = |line: String, name: &&str| line.replace(*name, "");
            let line = KEPT_NAMES.iter().fold(line.to_owned(), kept).to_lowercase();
            for part in BRITISH.iter().filter(|part| line.contains(**part)) {
                faults += &format!("{path}:{number}: '{part}' is not American\n");
            }
        }
    }
    assert!(faults.is_empty(), "{faults}");
}

#[test]
fn lines_are_narrow_and_words_are_the_glossarys() {
    let mut faults = String::new();
    let all = project_files(&[".rs", ".js", ".css", ".html", ".md"]);
    for (path, text) in &all {
        for (number, line) in (1..).zip(text.lines()) {
            // Tables and pictures of Markdown cannot be broken.
            let is_whole = path.ends_with(".md") && line.starts_with(['|', '!', '[']);
            if !is_whole && line.chars().count() > WIDEST_LINE {
                faults += &format!("{path}:{number}: {} columns\n", line.chars().count());
            }
            let is_rule = path.ends_with("pages/words.rs");
            for word in REPLACED_WORDS.iter().filter(|word| !is_rule && line.contains(**word)) {
                faults += &format!("{path}:{number}: '{word}' is not in the glossary\n");
            }
        }
    }
    assert!(faults.is_empty(), "{faults}");
}
