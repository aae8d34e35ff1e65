//! The commands that pages show.

use std::collections::BTreeMap;
use std::path::Path;

use super::markdown::{code_blocks, code_spans};
use super::{pages, read};
use crate::interop::by_the_handout;
use crate::support::{folder, run_line, stdout};

/// Options that pages name of GNU parallel, of the C++ example, and of examples in Rust.
const OPTIONS_OF_OTHERS: [&str; 5] =
    ["--sshloginfile", "--mistake", "--reading", "--false-alarms", "--seeds"];

/// What `help` says of every verb.
fn helps() -> BTreeMap<String, String> {
    let all = stdout(run_line("help", &[]).success());
    let verbs = all.split("\nCommands:\n").nth(1).expect("a list of verbs");
    let verbs = verbs.lines().map_while(|line| line.split_whitespace().next());
    let help = |verb: &str| stdout(run_line(&format!("help {verb}"), &[]).success());
    verbs.filter(|verb| *verb != "help").map(|verb| (verb.to_owned(), help(verb))).collect()
}

fn has_option(help: &str, option: &str) -> bool {
    help.split([' ', ',', '\n']).any(|word| word == option)
}

/// Asserts that `command`, which follows the program's name, names a verb and its options.
fn assert_command(page: &str, command: &str, helps: &BTreeMap<String, String>) {
    let end = command.find(['|', '>', '\'', ';', '#']).unwrap_or(command.len());
    let words: Vec<_> = command[..end].split_whitespace().collect();
    let Some(verb) = words.iter().find(|word| !word.starts_with('-')) else { return };
    if *verb == "help" {
        return;
    }
    let help = helps.get(*verb);
    let help = help.unwrap_or_else(|| panic!("{page}: no verb '{verb}': {command}"));
    for option in words.iter().filter(|word| word.starts_with("--")) {
        assert!(has_option(help, option), "{page}: {verb} has no {option}: {command}");
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
        let spans = code_spans(page);
        for span in spans.iter().filter(|span| span.starts_with("--")) {
            let option = span.split(' ').next().expect("a word");
            let is_ours = helps.values().any(|help| has_option(help, option));
            assert!(is_ours || OPTIONS_OF_OTHERS.contains(&option), "{path}: no {option}");
        }
        let code: String = code.chain(spans.into_iter().map(|span| span + "\n")).collect();
        for line in code.lines() {
            for command in line.split("photon-mapping ").skip(1) {
                assert_command(path, command, &helps);
                seen += 1;
            }
        }
    }
    assert!(seen > 30, "found only {seen} commands");
}

/// Runs the commands of `page`'s blocks of language `console` in `folder`, one after another, and
/// compares what they print. A line of three dots stands for any lines. How many there are.
fn commands_print_what_is_shown(page: &str, folder: &Path) -> usize {
    let text = read(page).replace(" \\\n", " ");
    let mut seen = 0;
    for (_, block) in code_blocks(&text).iter().filter(|(language, _)| language == "console") {
        for shown in block.split("$ ").skip(1) {
            let (command, output) = shown.split_once('\n').expect("a line");
            let mut words = command.split_whitespace();
            let mut program = match words.next() {
                Some("photon-mapping") => {
                    assert_cmd::Command::cargo_bin("photon-mapping").expect("is built")
                }
                Some("./by_the_handout") => match by_the_handout() {
                    Some(program) => assert_cmd::Command::new(program),
                    None => return seen,
                },
                other => panic!("{page}: {other:?}"),
            };
            let run = program.current_dir(folder).args(words).assert();
            let printed = stdout(run);
            let mut rest = printed.as_str();
            for part in output.trim().split("...\n").map(|part| part.trim_end_matches("...")) {
                let place = rest.find(part.trim_end());
                let place = place.unwrap_or_else(|| panic!("{command}: no\n{part}in\n{printed}"));
                rest = &rest[place + part.trim_end().len()..];
            }
            let is_whole = output.trim().ends_with("...") || rest.trim().is_empty();
            assert!(is_whole, "{page}: {command}: expected\n...\nfor{rest}");
            seen += 1;
        }
    }
    seen
}

#[test]
fn commands_print_what_the_pages_show() {
    assert!(commands_print_what_is_shown("README.md", folder().path()) >= 3);
    let folder = folder();
    run_line("render --quiet --out {}", &[&folder.path().join("out")]).success();
    for (page, at_least) in [("docs/comparing.md", 7), ("docs/grading.md", 2)] {
        let seen = commands_print_what_is_shown(page, folder.path());
        assert!(seen >= at_least || by_the_handout().is_none(), "{page}: {seen} commands");
    }
}
