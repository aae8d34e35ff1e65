//! `--color`: whether help and messages have colors.

use std::ffi::OsString;
use std::io::{self, IsTerminal};

use clap::builder::EnumValueParser;
use clap::{Arg, ColorChoice, ValueEnum};

const OPTION: &str = "--color";
const RED: &str = "\u{1b}[1;31m";
const YELLOW: &str = "\u{1b}[33m";
const PLAIN: &str = "\u{1b}[0m";

/// The option for help: [`take`] reads it before all others, so that it holds for their errors.
pub fn option() -> Arg {
    Arg::new("color")
        .long("color")
        .global(true)
        .value_name("WHEN")
        .value_parser(EnumValueParser::<ColorChoice>::new())
        .help("Whether help and messages have colors [default: auto]")
}

/// The choice that `words` make, wherever in the command line, and the other words.
///
/// # Errors
/// When the option has another value.
pub fn take(words: Vec<OsString>) -> Result<(ColorChoice, Vec<OsString>), String> {
    let mut choice = ColorChoice::Auto;
    let mut others = Vec::new();
    let mut words = words.into_iter();
    while let Some(word) = words.next() {
        let text = word.to_string_lossy().into_owned();
        let value = match text.strip_prefix(OPTION).map(|rest| (rest, rest.strip_prefix('='))) {
            Some(("", _)) => words.next().unwrap_or_default().to_string_lossy().into_owned(),
            Some((_, Some(value))) => value.to_owned(),
            _ => {
                others.push(word);
                if text == "--" {
                    break;
                }
                continue;
            }
        };
        choice = ColorChoice::from_str(&value, false)
            .map_err(|_| format!("{OPTION}: expected auto, always or never, found '{value}'"))?;
    }
    others.extend(words);
    Ok((choice, others))
}

/// `line`, whose first word says that it is an error or a note, with that word in color if
/// standard error is to have colors.
pub fn message(line: &str, choice: ColorChoice) -> String {
    let is_colored = match choice {
        ColorChoice::Always => true,
        ColorChoice::Never => false,
        ColorChoice::Auto => {
            let is_off = std::env::var_os("NO_COLOR").is_some_and(|value| !value.is_empty());
            io::stderr().is_terminal() && !is_off
        }
    };
    let colors = [("error:", RED), ("note:", YELLOW)];
    let found = colors.into_iter().find_map(|(word, color)| {
        line.strip_prefix(word).map(|rest| format!("{color}{word}{PLAIN}{rest}"))
    });
    found.filter(|_| is_colored).unwrap_or_else(|| line.to_owned())
}
