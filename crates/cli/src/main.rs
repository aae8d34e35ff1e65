//! The program `photon-mapping`: a file for every verb, each of which parses, calls and prints.

mod autograde;
mod beside_expected;
#[cfg(unix)]
mod check;
mod color;
mod compare;
mod error;
mod examples;
mod expect;
mod explain;
mod explore;
mod export;
mod grade;
mod gradebook;
#[cfg(unix)]
mod in_order;
mod input;
mod kit;
mod merge;
mod off_surfaces;
mod other_format;
mod output;
mod progress;
mod read_list;
mod render;
mod report;
mod run_args;
mod run_summary;
mod shell;
mod threads;
mod values;

use std::ffi::OsString;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::OnceLock;

use clap::{FromArgMatches, Parser, Subcommand};

use error::{CliError, escaped};

/// The exit code after an error.
const FAILED: u8 = 2;

/// The program's version, and the versions whose photon lists are the same, bit by bit: see the
/// value-stability policy in CHANGELOG.md.
const VERSION: &str = concat!(
    env!("CARGO_PKG_VERSION"),
    " (photon lists of ",
    env!("CARGO_PKG_VERSION_MAJOR"),
    ".",
    env!("CARGO_PKG_VERSION_MINOR"),
    ")"
);

/// What `--color` says.
static COLOR: OnceLock<clap::ColorChoice> = OnceLock::new();

/// The options that name what is written.
const OUTPUTS: [&str; 2] = ["--out", "--list"];

#[derive(Debug, Parser)]
#[command(
    name = "photon-mapping",
    version = VERSION,
    about = "The deterministic reference of Stanford CS148's Assignment 8, photon mapping",
    after_help = "Without a command, photon-mapping renders: its options are those of 'render'.",
    args_conflicts_with_subcommands = true
)]
struct Cli {
    #[command(subcommand)]
    command: Option<Command>,
    #[command(flatten)]
    render: render::RenderArgs,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Trace the photons, write their list, and draw the picture
    Render(Box<render::RenderArgs>),
    /// Compile and run a submission's two C++ files, and judge each section of the handout
    #[cfg(unix)]
    Check(check::CheckArgs),
    /// Compare a photon list or a picture with the reference
    Compare(Box<compare::CompareArgs>),
    /// Show every random number, hit and decision of one photon
    Explain(Box<explain::ExplainArgs>),
    /// Write a page that shows the photons in 3-D and steps through the code for one of them
    Explore(Box<explore::ExploreArgs>),
    /// Grade lists and pictures, whatever their random numbers: correct, or which misreading
    Grade(grade::GradeArgs),
    /// Compute how many hits are expected, without tracing a photon
    Expect(expect::ExpectArgs),
    /// Join the lists, or the count-only summaries, of adjoining ranges of one run
    Merge(merge::MergeArgs),
    /// Measure speed and accuracy, and write a page with plots and data
    Report(report::ReportArgs),
    /// Write a folder for a course: an autograder for Gradescope, or a project for students
    Kit(kit::KitArgs),
    /// Grade the submission that Gradescope provides, and write its results.json
    Autograde(autograde::AutogradeArgs),
    /// Print the completions for a shell
    Completions(shell::CompletionsArgs),
    /// Print the manual page, or that of a verb
    Man(shell::ManArgs),
}

fn main() -> ExitCode {
    ExitCode::from(run(std::env::args_os()))
}

/// Runs the command line `arguments`, of which the first is the program's name, and gives the exit
/// code.
fn run(arguments: impl IntoIterator<Item = OsString>) -> u8 {
    let words: Vec<OsString> = arguments.into_iter().collect();
    if let Some(file) = options_that_are_files(&words).next() {
        let file = file.to_string_lossy();
        complain(&format!(
            "error: '{file}' is an option, but also a file here: write -- before the names of \
             files, or ./{file}"
        ));
        return FAILED;
    }
    let (color, words) = match color::take(words) {
        Ok((choice, words)) => (choice, words),
        Err(message) => {
            complain(&format!("error: {message}"));
            return FAILED;
        }
    };
    let _ = COLOR.set(color);
    let command = examples::command().color(color);
    let matches = command.try_get_matches_from(shell::quiet_after_verb(words.clone()));
    let cli = match matches.and_then(|matches| Cli::from_arg_matches(&matches)) {
        Ok(cli) => cli,
        Err(error) if !error.use_stderr() => {
            // Help and version.
            return match error.print().and_then(|()| std::io::stdout().flush()) {
                Err(error) if error.kind() != std::io::ErrorKind::BrokenPipe => {
                    complain(&format!("error: {}", CliError::Output(error)));
                    FAILED
                }
                _ => 0,
            };
        }
        Err(error) => {
            complain(&with_tips(&error.to_string()));
            return FAILED;
        }
    };
    threads::keep_within_memory();
    output::remove_unfinished_files_on_interrupt();
    output::protect(inputs(&words));
    let result = match cli.command {
        None => render::run(&cli.render),
        Some(Command::Render(arguments)) => render::run(&arguments),
        Some(Command::Expect(arguments)) => expect::run(&arguments),
        #[cfg(unix)]
        Some(Command::Check(arguments)) => check::run(&arguments),
        Some(Command::Compare(arguments)) => compare::run(&arguments),
        Some(Command::Explain(arguments)) => explain::run(&arguments),
        Some(Command::Explore(arguments)) => explore::run(&arguments),
        Some(Command::Grade(arguments)) => grade::run(&arguments),
        Some(Command::Merge(arguments)) => merge::run(&arguments),
        Some(Command::Report(arguments)) => report::run(&arguments),
        Some(Command::Kit(arguments)) => kit::run(&arguments),
        Some(Command::Autograde(arguments)) => autograde::run(&arguments),
        Some(Command::Completions(arguments)) => shell::completions(&arguments),
        Some(Command::Man(arguments)) => shell::man(&arguments),
    };
    match result {
        Ok(code) => code,
        Err(error) => {
            complain(&format!("error: {}", one_line(&error.to_string())));
            FAILED
        }
    }
}

/// Options for which there is a file of the same name: with `grade *`, a student would choose
/// options.
fn options_that_are_files(words: &[OsString]) -> impl Iterator<Item = &OsString> {
    let options = words.iter().skip(1).take_while(|word| *word != "--");
    let is_option = |word: &OsString| word.len() > 1 && word.to_string_lossy().starts_with('-');
    options.filter(move |word| is_option(word) && Path::new(word).symlink_metadata().is_ok())
}

/// The words that may name files that are read: all but those behind options that name outputs.
fn inputs(words: &[OsString]) -> impl Iterator<Item = PathBuf> {
    let before = std::iter::once(None).chain(words.iter().map(Some));
    let is_no_output = |option: &OsString| OUTPUTS.iter().all(|output| option != output);
    let read = words.iter().zip(before).filter(move |(_, before)| before.is_none_or(is_no_output));
    read.map(|(word, _)| {
        let text = word.to_string_lossy();
        match text.strip_prefix("--").and_then(|option| option.split_once('=')) {
            Some((option, _)) if OUTPUTS.contains(&format!("--{option}").as_str()) => {
                PathBuf::new()
            }
            Some((_, value)) => value.into(),
            None => word.into(),
        }
    })
}

/// Prints `line` to standard error; where that cannot be written, the exit code alone must do.
fn complain(line: &str) {
    let color = COLOR.get().copied().unwrap_or_default();
    let line = color::message(&escaped(&without_codes(line)), color);
    let _ = writeln!(std::io::stderr(), "{line}");
}

/// `line` without the system's numbers of errors, which stand beside their words.
fn without_codes(line: &str) -> String {
    let mut parts = line.split(" (os error ");
    let mut plain = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        plain += part.split_once(')').map_or(part, |(_, rest)| rest);
    }
    plain
}

/// The error `text` of clap on one line: what is wrong, and what may have been meant.
fn with_tips(text: &str) -> String {
    let mut paragraphs = text.split("\n\n");
    let error = one_line(paragraphs.next().unwrap_or_default());
    let lines = paragraphs.flat_map(str::lines).map(str::trim);
    let tips = lines.filter(|line| line.starts_with("tip: ")).map(|tip| format!(" ({tip})"));
    error + &tips.collect::<String>()
}

/// The first paragraph of `text` on one line.
fn one_line(text: &str) -> String {
    let paragraph = text.split("\n\n").next().unwrap_or_default();
    paragraph.split_whitespace().collect::<Vec<_>>().join(" ")
}
