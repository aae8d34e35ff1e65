//! The commands that pages show.

use std::collections::BTreeMap;

use super::markdown::{code_blocks, code_spans};
use super::{pages, read};
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

/// Runs the commands of the README's blocks of language `console` in one folder, one after another,
/// and compares what they print. A line of three dots stands for any lines.
#[test]
fn commands_print_what_the_readme_shows() {
    let folder = folder();
    let readme = read("README.md");
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
