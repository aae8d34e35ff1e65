//! `photon-mapping grade`: a verdict on submissions, and the reasons for it.

use std::collections::HashSet;
use std::io::{IsTerminal, Write as _};
use std::path::{Path, PathBuf};
use std::time::Instant;

use clap::{Args, ValueEnum};
use indicatif::{ProgressBar, ProgressStyle};
use rayon::prelude::*;
use serde::Serialize;

use super::error::{CliError, print};
use super::output::OutputFile;
use super::values;
use grading::class::grade_one;
use grading::gradescope;
use grading::intake::{HandedIn, collect};
use grading::judge_list::Expectations;
use grading::page::{Pages, index::index};
use grading::places::Places;
use grading::policy::Policy;
use grading::signature::{Effort, Signatures};
use grading::submission::{Settings, grade};
use grading::text;
use grading::verdict::Grade;
use photon_mapping::assignment8;
use variants::misreadings::names;

/// With more bounces allowed, hardly a path ends by the limit, and the signatures kept are right.
const MANY_BOUNCES: i32 = 20;
/// The longest name of a file, without its extension.
const LONGEST_NAME: usize = 100;

/// The options of `grade`.
#[derive(Debug, Args)]
#[command(after_help = "\
Submissions: a file is one, and so is a folder, in which the list and the picture are found by what \
they contain; alice.csv and alice.png are one. A folder without a list or a picture of its own, but with \
at least two folders that have one, is a class: each folder in it is a submission. What is wrong with a \
file is in its grade, and stops no other.

Of several lists or pictures in one folder, that called photons or assignment8 is judged, or any if all \
are the same, and what is left out is remarked; else they are not judged.

A SUBMISSION that does not exist is no student's fault: the others are graded, then it is named, with \
exit code 2.

Several submissions: text and JSON go to one output; gradescope and html write a file for each into \
the folder --out, html also an index.html.

Policy: a JSON object that gives scores, each of which may be left out, by default
  { \"correct\": 4, \"undecided\": 0, \"plausible\": 3, \"incorrect\": 2, \"no-dots\": 1, \"unreadable\": 0, \"misreadings\": {} }
'undecided' is for lists with too few photons to tell: look at them yourself. 'plausible' is for incorrect photons that are finite, on surfaces and indirect only; 'misreadings' gives \
incorrect ones with a named misreading a score of their own: { \"misreadings\": { \"no-offset\": 3.5 } }.

Exit codes: 0 graded, whatever the grades; 2 could not be carried out.")]
pub struct GradeArgs {
    /// Photon lists (PLY or CSV) and pictures (PNG) of the handout's scene, or folders with them
    #[arg(value_name = "SUBMISSION", required = true)]
    submissions: Vec<PathBuf>,
    /// How many photons were sent out [default: what the intensities say, if they do]
    #[arg(long, value_name = "N", allow_negative_numbers = true,
          value_parser = values::whole(1, u64::from(u32::MAX)))]
    emitted: Option<u64>,
    /// How often a photon may bounce at most, 0 to 1000 times
    #[arg(long, value_name = "N", default_value_t = assignment8::MAX_PHOTON_BOUNCES,
          allow_negative_numbers = true, value_parser = values::whole(0_i32, 1000))]
    max_bounces: i32,
    /// The seed of lists that follow the reference's random numbers
    #[arg(long, value_name = "N", default_value_t = assignment8::SEED,
          allow_negative_numbers = true, value_parser = values::whole(0, u64::MAX))]
    seed: u64,
    /// What to write
    #[arg(long, value_enum, default_value_t = FormatName::Text)]
    format: FormatName,
    /// A JSON file with a course's own scores, see below
    #[arg(long, value_name = "FILE.json")]
    policy: Option<PathBuf>,
    /// Where to write the grades, instead of standard output: a file, or a folder that is there already
    /// or for several submissions
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
}

/// The names of the formats.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum FormatName {
    /// For people
    Text,
    /// For programs: an object, or an array for several submissions
    Json,
    /// Gradescope's results.json, one a submission
    Gradescope,
    /// A page that needs no other file, one a submission
    Html,
}

impl FormatName {
    /// The extension of its files, where each submission has one of its own.
    fn of_each(self) -> Option<&'static str> {
        match self {
            Self::Text | Self::Json => None,
            Self::Gradescope => Some("json"),
            Self::Html => Some("html"),
        }
    }
}

/// Grades, and prints the grades.
///
/// # Errors
/// When the policy cannot be read or an output cannot be written; what is wrong with a submission is in
/// its grade.
pub fn run(arguments: &GradeArgs) -> Result<u8, CliError> {
    let settings =
        Settings { emitted: arguments.emitted, seed: arguments.seed, policy: policy(arguments)? };
    let (missing, there): (Vec<PathBuf>, Vec<PathBuf>) =
        arguments.submissions.iter().cloned().partition(|path| is_missing(path));
    if there.is_empty() {
        return Err(no_such_file(&missing));
    }
    let handed_in = collect(&there);
    let folder = folder(arguments, handed_in.len() + missing.len())?;
    let expectations = expectations(arguments.max_bounces);
    let best = settings.policy.best();
    let pages = Pages::new(&expectations, &settings.policy);
    let files = file_names(&handed_in);
    let bar = progress(handed_in.len());
    // A list is large and a grade is not, so what is written of a list is written at once.
    let one = |(handed_in, file): (&HandedIn, &String)| -> Result<(Grade, String), CliError> {
        let start = Instant::now();
        let graded = grade_one(handed_in, &settings, |submission| {
            grade(submission, &settings, &expectations)
        });
        let seconds = start.elapsed().as_secs_f64();
        bar.inc(1);
        let output = match arguments.format {
            FormatName::Text | FormatName::Json => String::new(),
            FormatName::Gradescope => json(&gradescope::results(&graded.grade, best, seconds)),
            FormatName::Html => pages.page(&handed_in.submission, &graded),
        };
        match &folder {
            Some((folder, extension)) => {
                write(&folder.join(format!("{file}.{extension}")), &output)?;
                Ok((graded.grade, String::new()))
            }
            None => Ok((graded.grade, output)),
        }
    };
    let graded: Result<Vec<(Grade, String)>, CliError> =
        handed_in.par_iter().zip(&files).map(one).collect();
    bar.finish_and_clear();
    let (grades, mut outputs): (Vec<Grade>, Vec<String>) = graded?.into_iter().unzip();
    let output = match (arguments.format, grades.as_slice()) {
        (FormatName::Text, grades) => {
            grades.iter().map(|grade| text::text(grade, best)).collect::<Vec<_>>().join("\n")
        }
        (FormatName::Json, [grade]) if missing.is_empty() => json(grade),
        (FormatName::Json, grades) => json(&grades),
        (FormatName::Gradescope | FormatName::Html, _) => outputs.pop().unwrap_or_default(),
    };
    match (&folder, &arguments.out) {
        (Some((folder, extension)), _) => {
            if arguments.format == FormatName::Html {
                let links = files.iter().map(|file| format!("{file}.{extension}"));
                let pages: Vec<_> = grades.iter().zip(links).collect();
                write(&folder.join("index.html"), &index(&pages, best))?;
            }
        }
        (None, Some(path)) => write(path, &output)?,
        (None, None) => print(&output)?,
    }
    if missing.is_empty() { Ok(0) } else { Err(no_such_file(&missing)) }
}

/// Whether there is nothing at all at `path`: a link that leads nowhere is something.
fn is_missing(path: &Path) -> bool {
    path.symlink_metadata().is_err_and(|error| error.kind() == std::io::ErrorKind::NotFound)
}

fn no_such_file(missing: &[PathBuf]) -> CliError {
    let names: Vec<String> = missing.iter().map(|path| path.display().to_string()).collect();
    CliError::Argument(format!("{}: no such file or folder", names.join(", ")))
}

fn json(value: &impl Serialize) -> String {
    serde_json::to_string_pretty(value).expect("a grade has only plain values") + "\n"
}

fn write(path: &Path, output: &str) -> Result<(), CliError> {
    let mut file = OutputFile::create(path)?;
    file.file().write_all(output.as_bytes()).map_err(|error| CliError::unwritable(path, error))?;
    file.persist()
}

/// The folder for a file of each of `count` submissions, and these files' extension, if there are to be
/// such.
fn folder(
    arguments: &GradeArgs,
    count: usize,
) -> Result<Option<(PathBuf, &'static str)>, CliError> {
    let Some(extension) = arguments.format.of_each() else { return Ok(None) };
    match &arguments.out {
        Some(out) if count > 1 && out.exists() && !out.is_dir() => {
            Err(CliError::Argument(format!(
                "--out {}: expected a folder for {count} submissions, found a file",
                out.display()
            )))
        }
        Some(out) if count > 1 || out.is_dir() => Ok(Some((out.clone(), extension))),
        None if count > 1 => Err(CliError::Argument(format!(
            "--out: expected a folder, for each of {count} submissions has a file of its own"
        ))),
        _ => Ok(None),
    }
}

/// For each submission the name of its files: its own, without what systems do not take or what leads
/// elsewhere.
fn file_names(handed_in: &[HandedIn]) -> Vec<String> {
    // Also for systems that do not tell capitals apart.
    let mut seen = HashSet::from(["index".to_owned()]);
    let mut unique = |handed_in: &HandedIn| {
        let name = Path::new(&handed_in.submission.name);
        let name = name.file_name().unwrap_or(name.as_os_str()).to_string_lossy();
        let is_plain = |letter: char| letter.is_alphanumeric() || "-_.".contains(letter);
        let plain = name.chars().take(LONGEST_NAME).map(|c| if is_plain(c) { c } else { '_' });
        let plain = plain.collect::<String>().trim_start_matches('.').to_owned();
        let plain = if plain.is_empty() { "submission".to_owned() } else { plain };
        let numbered = (2..).map(|number| format!("{plain}-{number}"));
        let mut names = std::iter::once(plain.clone()).chain(numbered);
        names.find(|name| seen.insert(name.to_lowercase())).expect("there is always another number")
    };
    handed_in.iter().map(&mut unique).collect()
}

/// A bar on a terminal, when there is something to wait for.
fn progress(count: usize) -> ProgressBar {
    if count < 2 || !std::io::stderr().is_terminal() {
        return ProgressBar::hidden();
    }
    let style = ProgressStyle::with_template("graded {wide_bar} {human_pos}/{human_len} {eta}");
    ProgressBar::new(count as u64).with_style(style.expect("the template is well formed"))
}

/// What the submissions are held against.
fn expectations(max_bounces: i32) -> Expectations {
    let places = Places::new(&assignment8::create_scene());
    let signatures = if max_bounces >= MANY_BOUNCES {
        Signatures::of_assignment8()
    } else {
        if std::io::stderr().is_terminal() {
            eprintln!("measuring what is expected of at most {max_bounces} bounces ...");
        }
        Signatures::measure(&places, max_bounces, Effort::QUICK)
    };
    Expectations::new(places, signatures)
}

fn policy(arguments: &GradeArgs) -> Result<Policy, CliError> {
    let Some(path) = &arguments.policy else {
        return Ok(Policy::default());
    };
    let wrong = |message: String| {
        CliError::Argument(format!("{}: expected a policy: {message}", path.display()))
    };
    let text = std::fs::read_to_string(path).map_err(|error| CliError::unreadable(path, error))?;
    // Without this, an array would be taken for the scores in their order.
    let object: serde_json::Map<String, serde_json::Value> =
        serde_json::from_str(&text).map_err(|error| wrong(error.to_string()))?;
    let policy: Policy =
        serde_json::from_value(object.into()).map_err(|error| wrong(error.to_string()))?;
    if let Some((name, score)) = policy.odd_score() {
        let best = policy.correct;
        return Err(wrong(format!(
            "'{name}' is {score}, which is not from 0 to 'correct', {best}"
        )));
    }
    let known = names();
    match policy.misreadings.keys().find(|id| !known.contains(&id.as_str())) {
        Some(id) => {
            let known = known.join(", ");
            Err(wrong(format!("no misreading is called '{id}'; there are {known}")))
        }
        None => Ok(policy),
    }
}
