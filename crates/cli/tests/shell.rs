//! Completions, manual pages, the version, tips, and `-q` on either side of the verb.

use crate::support::{fails, folder, run_line, stdout};

const VERBS: [&str; 9] =
    ["render", "check", "compare", "explain", "explore", "grade", "expect", "merge", "kit"];

#[test]
fn completions_know_every_verb() {
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        let text = stdout(run_line(&format!("completions {shell}"), &[]).success());
        for verb in VERBS {
            assert!(text.contains(verb), "{shell} lacks {verb}");
        }
    }
    fails("completions ksh", &[], &["ksh", "bash"]);
}

#[test]
fn there_is_a_page_for_the_program_and_for_each_verb() {
    let text = stdout(run_line("man", &[]).success());
    assert!(text.contains(".TH photon-mapping"), "{text}");
    for verb in VERBS {
        assert!(text.contains(verb), "the page lacks {verb}");
        let text = stdout(run_line(&format!("man {verb}"), &[]).success());
        assert!(text.contains(".SH OPTIONS") || verb == "kit", "{verb}: {text}");
        assert!(text.contains(&format!("photon\\-mapping\\-{verb}")), "{verb}: {text}");
    }
    fails("man rendr", &[], &["rendr", "render"]);
}

#[test]
fn the_version_names_the_photon_lists() {
    let text = stdout(run_line("--version", &[]).success());
    let number = env!("CARGO_PKG_VERSION");
    let (lists, _) = number.rsplit_once('.').expect("three numbers");
    assert_eq!(text, format!("photon-mapping {number} (photon lists of {lists})\n"));
}

#[test]
fn what_may_have_been_meant_is_told() {
    fails("grade --polcy p.json a.csv", &[], &["--polcy", "tip", "--policy"]);
    fails("render --seeed 1", &[], &["--seeed", "tip", "--seed"]);
    fails("rendr", &[], &["rendr", "tip", "'render'"]);
}

#[test]
fn quiet_works_before_and_after_the_verb() {
    let folder = folder();
    for line in ["-q render", "--quiet render", "render -q", "render --quiet"] {
        let line = format!("{line} --photons 100 --size 1x1 --out {{}}");
        run_line(&line, &[folder.path()]).success();
    }
}

#[test]
fn each_verbs_help_ends_with_an_example() {
    for verb in VERBS.iter().chain(&["report", "autograde", "completions", "man"]) {
        for option in ["-h", "--help"] {
            let text = stdout(run_line(&format!("{verb} {option}"), &[]).success());
            let (_, example) = text.rsplit_once("Example").unwrap_or_else(|| panic!("{verb}"));
            assert!(example.contains(&format!("photon-mapping {verb}")), "{verb}: {example}");
        }
    }
}
