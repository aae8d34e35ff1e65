//! The pages: links lead somewhere, sentences are short, commands exist, numbers agree.

mod support;

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use pulldown_cmark::{CodeBlockKind, Event, Options, Parser, Tag, TagEnd};
use support::{run_line, stdout};

/// Pages and folders whose wording is not done yet. Only lengths and words are excused.
const UNFINISHED: [&str; 11] = [
    "docs/check.md",
    "docs/comparing.md",
    "docs/grading.md",
    "interop/cpp",
    "crates/check",
    "crates/cli",
    "crates/compare",
    "crates/grading",
    "crates/model",
    "crates/photon-list",
    "crates/variants",
];

const LONGEST_SENTENCE: usize = 30;
const WIDEST_LINE: usize = 100;

/// Words that the glossary replaces.
const REPLACED_WORDS: [&str; 5] = ["sent out", "send out", "sends out", "looks on", "look on"];

const VERBS: [&str; 9] =
    ["render", "check", "compare", "explain", "explore", "grade", "expect", "merge", "report"];

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// The files below `folder` with one of `endings`, as paths from the root.
fn files(folder: &str, endings: &[&str], found: &mut Vec<String>) {
    let entries = fs::read_dir(root().join(folder)).expect("a folder of the project");
    let mut names: Vec<_> = entries
        .map(|entry| entry.expect("can be read").file_name().into_string().expect("is text"))
        .collect();
    names.sort();
    for name in names {
        let path = if folder == "." { name.clone() } else { format!("{folder}/{name}") };
        if root().join(&path).is_dir() {
            let is_made = ["target", "out", "report", "golden"].contains(&path.as_str());
            if !is_made && !name.starts_with('.') {
                files(&path, endings, found);
            }
        } else if endings.iter().any(|ending| name.ends_with(ending)) {
            found.push(path);
        }
    }
}

fn project_files(endings: &[&str]) -> Vec<(String, String)> {
    let mut found = Vec::new();
    files(".", endings, &mut found);
    let read = |path: String| {
        let text = fs::read_to_string(root().join(&path)).expect("is text");
        (path, text)
    };
    found.into_iter().map(read).collect()
}

fn pages() -> Vec<(String, String)> {
    project_files(&[".md"])
}

fn is_unfinished(path: &str) -> bool {
    UNFINISHED.iter().any(|unfinished| path.starts_with(unfinished))
}

fn events(page: &str) -> impl Iterator<Item = Event<'_>> {
    Parser::new_ext(page, Options::ENABLE_TABLES)
}

/// The texts of headings, paragraphs, list items and table cells; a code span is one word.
fn texts(page: &str) -> Vec<String> {
    let mut texts = vec![String::new()];
    let mut is_code = false;
    for event in events(page) {
        let text = texts.last_mut().expect("one at least");
        match event {
            Event::Start(Tag::CodeBlock(_)) => is_code = true,
            Event::End(TagEnd::CodeBlock) => is_code = false,
            Event::Text(words) if !is_code => text.push_str(&words),
            Event::Code(code) => text.push_str(&code.replace([' ', '.'], "_")),
            Event::SoftBreak | Event::HardBreak => text.push(' '),
            Event::Start(Tag::Paragraph | Tag::Item | Tag::TableCell | Tag::Heading { .. })
            | Event::End(TagEnd::Paragraph | TagEnd::Item | TagEnd::Heading(_)) => {
                texts.push(String::new());
            }
            _ => {}
        }
    }
    texts
}

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

fn code_spans(page: &str) -> Vec<String> {
    let code = |event| if let Event::Code(code) = event { Some(code.to_string()) } else { None };
    events(page).filter_map(code).collect()
}

/// The blocks of code of a page with their languages.
fn code_blocks(page: &str) -> Vec<(String, String)> {
    let mut blocks = Vec::new();
    let mut is_code = false;
    for event in events(page) {
        match event {
            Event::Start(Tag::CodeBlock(kind)) => {
                let CodeBlockKind::Fenced(language) = kind else { continue };
                blocks.push((language.to_string(), String::new()));
                is_code = true;
            }
            Event::End(TagEnd::CodeBlock) => is_code = false,
            Event::Text(text) if is_code => blocks.last_mut().expect("begun").1.push_str(&text),
            _ => {}
        }
    }
    blocks
}

/// The anchors that GitHub gives the headings of `page`.
fn anchors(page: &str) -> Vec<String> {
    let mut anchors = Vec::new();
    let mut is_heading = false;
    for event in events(page) {
        match event {
            Event::Start(Tag::Heading { .. }) => {
                is_heading = true;
                anchors.push(String::new());
            }
            Event::End(TagEnd::Heading(_)) => is_heading = false,
            Event::Text(text) | Event::Code(text) if is_heading => {
                let kept = |c: &char| c.is_alphanumeric() || " -_".contains(*c);
                let slug = text.to_lowercase().chars().filter(kept).collect::<String>();
                anchors.last_mut().expect("begun").push_str(&slug.replace(' ', "-"));
            }
            _ => {}
        }
    }
    anchors
}

fn links(page: &str) -> Vec<String> {
    let target = |event| match event {
        Event::Start(Tag::Link { dest_url, .. } | Tag::Image { dest_url, .. }) => Some(dest_url),
        _ => None,
    };
    events(page).filter_map(target).map(|url| url.to_string()).collect()
}

#[test]
fn links_and_anchors_exist() {
    let mut seen = 0;
    for (path, page) in pages() {
        for link in links(&page).iter().filter(|link| !link.contains("://")) {
            let (file, anchor) = link.split_once('#').unwrap_or((link, ""));
            let folder = Path::new(&path).parent().expect("a file is in a folder");
            let target = if file.is_empty() { path.clone().into() } else { folder.join(file) };
            assert!(root().join(&target).exists(), "{path}: {link} leads nowhere");
            if !anchor.is_empty() {
                let text = fs::read_to_string(root().join(&target)).expect("a page");
                assert!(anchors(&text).iter().any(|a| a == anchor), "{path}: no anchor {link}");
            }
            seen += 1;
        }
    }
    assert!(seen > 30, "found only {seen} links");
}

#[test]
fn sentences_are_short() {
    let mut faults = String::new();
    for (path, page) in pages().iter().filter(|(path, _)| !is_unfinished(path)) {
        for text in texts(page) {
            for sentence in sentences(&text).iter().filter(|s| words(s) > LONGEST_SENTENCE) {
                faults += &format!("{path}: {} words: {}\n", words(sentence), sentence.trim());
            }
        }
    }
    assert!(faults.is_empty(), "at most {LONGEST_SENTENCE} words:\n{faults}");
}

#[test]
fn lines_are_narrow_and_words_are_the_glossarys() {
    let mut faults = String::new();
    let all = project_files(&[".rs", ".js", ".css", ".html", ".md"]);
    for (path, text) in all.iter().filter(|(path, _)| !is_unfinished(path)) {
        for (number, line) in (1..).zip(text.lines()) {
            // Tables and pictures of Markdown cannot be broken.
            let is_whole = path.ends_with(".md") && line.starts_with(['|', '!', '[']);
            if !is_whole && line.chars().count() > WIDEST_LINE {
                faults += &format!("{path}:{number}: {} columns\n", line.chars().count());
            }
            for word in REPLACED_WORDS.iter().filter(|word| line.contains(**word)) {
                faults += &format!("{path}:{number}: '{word}' is not in the glossary\n");
            }
        }
    }
    assert!(faults.is_empty(), "{faults}");
}

/// What `help` says of every verb.
fn helps() -> BTreeMap<&'static str, String> {
    let help =
        |verb: &'static str| (verb, stdout(run_line(&format!("help {verb}"), &[]).success()));
    VERBS.into_iter().map(help).collect()
}

/// Asserts that `command`, which follows the program's name, names a verb and its options.
fn assert_command(page: &str, command: &str, helps: &BTreeMap<&str, String>) {
    let end = command.find(['|', '>', '\'', ';', '#']).unwrap_or(command.len());
    let words: Vec<_> = command[..end].split_whitespace().collect();
    let Some(verb) = words.iter().find(|word| !word.starts_with('-')) else { return };
    if *verb == "help" {
        return;
    }
    let help = helps.get(verb);
    let help = help.unwrap_or_else(|| panic!("{page}: no verb '{verb}': {command}"));
    for option in words.iter().filter(|word| word.starts_with("--")) {
        let has = help.split([' ', ',', '\n']).any(|word| word == *option);
        assert!(has, "{page}: {verb} has no {option}: {command}");
    }
}

#[test]
fn commands_exist() {
    let helps = helps();
    let mut seen = 0;
    for (path, page) in pages().iter().filter(|(path, _)| path != "CHANGELOG.md") {
        let blocks = code_blocks(page);
        let blocks = blocks.iter().filter(|(language, _)| language != "text");
        let code = blocks.map(|(_, code)| code.replace("\\\n", " "));
        let code: String =
            code.chain(code_spans(page).into_iter().map(|span| span + "\n")).collect();
        for line in code.lines() {
            for command in line.split("photon-mapping ").skip(1) {
                assert_command(path, command, &helps);
                seen += 1;
            }
        }
    }
    assert!(seen > 30, "found only {seen} commands");
}

/// Runs the commands of the README's blocks of language `console` in one folder, one after another,
/// and compares what they print. A line of three dots stands for any lines.
#[test]
fn commands_print_what_the_readme_shows() {
    let folder = support::folder();
    let readme = fs::read_to_string(root().join("README.md")).expect("is there");
    let mut seen = 0;
    for (_, block) in code_blocks(&readme).iter().filter(|(language, _)| language == "console") {
        for shown in block.split("$ photon-mapping ").skip(1) {
            let (command, output) = shown.split_once('\n').expect("a line");
            let mut program = assert_cmd::Command::cargo_bin("photon-mapping").expect("is built");
            let run = program.current_dir(&folder).args(command.split(' ')).assert();
            let printed = stdout(run);
            let mut rest = printed.as_str();
            for part in output.trim().split("...\n").map(|part| part.trim_end_matches("...")) {
                let place = rest.find(part.trim_end());
                let place = place.unwrap_or_else(|| panic!("{command}: no\n{part}in\n{printed}"));
                rest = &rest[place + part.trim_end().len()..];
            }
            seen += 1;
        }
    }
    assert!(seen >= 3, "found only {seen} commands");
}

/// The numbers of the README's last table are on the pages that it gives as evidence.
#[test]
fn numbers_of_the_readme_are_in_the_evidence() {
    let readme = fs::read_to_string(root().join("README.md")).expect("is there");
    let section = readme.split("\n## How fast and how sure\n").nth(1).expect("a section");
    let section = section.split("\n## ").next().expect("its text");
    let mut seen = 0;
    for row in section.lines().filter(|line| line.starts_with('|') && line.contains("](")) {
        let cells: Vec<_> = row.trim_matches('|').split('|').collect();
        let link = links(cells[2]).remove(0);
        let file = link.split('#').next().expect("a path");
        let evidence = fs::read_to_string(root().join(file)).expect("a page").replace(',', "");
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

/// The table of crates in docs/architecture.md has what their manifests have.
#[test]
fn crates_use_what_the_architecture_says() {
    let page = fs::read_to_string(root().join("docs/architecture.md")).expect("is there");
    let mut seen = 0;
    for row in page.lines().filter(|line| line.starts_with("|`crates/")) {
        let cells: Vec<_> = row.trim_matches('|').split('|').collect();
        let folder = cells[0].trim_matches('`');
        let manifest = fs::read_to_string(root().join(folder).join("Cargo.toml")).expect(folder);
        let section = manifest.split("[dependencies]\n").nth(1).expect("a section");
        let section = section.split("\n[").next().expect("its lines");
        let names = section.lines().filter_map(|line| line.split(['.', ' ']).next());
        let is_ours = |name: &&str| {
            *name == "photon-mapping"
                || root().join("crates").join(name).is_dir() && !name.is_empty()
        };
        let used: Vec<_> =
            names.filter(is_ours).map(|name| name.replace("photon-mapping", "root")).collect();
        assert_eq!(cells[2], used.join(", "), "{folder}");
        seen += 1;
    }
    let mut folders = fs::read_dir(root().join("crates")).expect("is there");
    assert_eq!(seen, folders.by_ref().count(), "a row for every crate");
}
