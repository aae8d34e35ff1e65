//! `photon-mapping grade`: a verdict on submissions, and the reasons for it.

mod class;
mod files;
mod policy;
mod standard_input;

use std::io::{self, IsTerminal};
use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};
use indicatif::{ProgressBar, ProgressStyle};

use super::error::{CliError, escaped};
use super::gradebook::GradebookArgs;
use super::output::{protect, protect_folders, release};
use super::values;
use class::Class;
// What `check` has in common with `grade`, where there is `check`.
#[cfg(unix)]
pub use class::json;
use classroom::intake::{Collected, Folders, collect};
use classroom::page::Pages;
pub use files::places_of_each;
#[cfg(unix)]
pub use files::{INDEX, made_by};
use grading::judge_list::Expectations;
use grading::places::Places;
use grading::signature::Signatures;
use grading::submission::Settings;
use photon_mapping::assignment8;
pub use policy::read as policy;
use standard_input::{STANDARD_INPUT, StandardInput};

/// The options of `grade`.
#[derive(Debug, Args)]
#[command(after_help = "\
Submissions: a file is a submission, and so is a folder. The list and the picture in a folder \
are found by their contents. alice.csv and alice.png are one submission.

Classes: a folder is a class if it has no list or picture of its own, but folders of at least \
two students do, or if all its files have names from Canvas or Moodle. Use --class or \
--submission if a folder could be either. A faulty submission does not stop the others. Grades \
that this program wrote into a class are no submissions, and the next run may replace them.

Several lists or pictures in one folder: the one called photons or assignment8 is judged, or any \
if all are the same. Otherwise none is. A remark names those left out.

Output: text, JSON and CSV go to one file. gradescope and html write a file for each submission \
into the folder --out, and html an index.html too. The exit code is 2 if a SUBMISSION does not \
exist, and the others are still graded.

Policy: a JSON object of scores. Those left out are
  { \"correct\": 4, \"undecided\": 0, \"plausible\": 3, \"incorrect\": 2, \"no-dots\": 1, \
\"unreadable\": 0, \"misreadings\": {}, \"sections\": {} }
'undecided' means too few photons to decide or to recognize: judge these yourself. 'plausible' is \
for incorrect photons that are finite, on surfaces and indirect. 'unreadable' is also for what has \
nothing of a photon map in it. 'misreadings' gives named misreadings a score of their own: \
{ \"misreadings\": { \"no-offset\": 3.5 } }. 'sections' gives points to each section that \
'check' finds right, by its title.

Exit codes: 0 graded, whatever the grades; 2 an error.")]
pub struct GradeArgs {
    /// Photon lists (PLY or CSV) and pictures (PNG) of the handout's scene, or folders with them
    #[arg(value_name = "SUBMISSION", required = true)]
    submissions: Vec<PathBuf>,
    /// Treat a folder as a class: each folder, list and picture in it is a submission
    #[arg(long, conflicts_with = "submission")]
    class: bool,
    /// Treat a folder as one submission, whatever is in it
    #[arg(long)]
    submission: bool,
    /// How many photons each submission emitted [default: what the intensities say]
    #[arg(long, value_name = "N", allow_negative_numbers = true,
          value_parser = values::whole(1, u64::from(u32::MAX)))]
    emitted: Option<u64>,
    /// How often a photon may bounce at most, 0 to 1000 times
    #[arg(long, value_name = "N", default_value_t = assignment8::MAX_PHOTON_BOUNCES,
          allow_negative_numbers = true, value_parser = values::whole(0_i32, 1000))]
    max_bounces: i32,
    /// The seed of submissions that draw the reference's random numbers; others need none
    #[arg(long, value_name = "N", default_value_t = assignment8::SEED,
          allow_negative_numbers = true, value_parser = values::whole(0, u64::MAX))]
    seed: u64,
    /// What to write
    #[arg(long, value_enum, default_value_t = GradeFormat::Text)]
    format: GradeFormat,
    /// A JSON file with a course's own scores, see below
    #[arg(long, value_name = "FILE.json")]
    policy: Option<PathBuf>,
    /// Where to write the grades: a file for text, JSON, CSV or one submission; a folder for pages
    /// or results.json of several submissions [default: standard output]
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    #[command(flatten)]
    gradebook: GradebookArgs,
}

/// The names of the formats.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum GradeFormat {
    /// For people
    Text,
    /// For programs: an object, or an array for several submissions
    Json,
    /// Gradescope's results.json, one a submission
    Gradescope,
    /// A page that needs no other file, one a submission
    Html,
    /// A table for a gradebook, with a row for each submission
    Csv,
}

impl GradeFormat {
    /// The extension of its files, where each submission has one of its own.
    fn of_each(self) -> Option<&'static str> {
        match self {
            Self::Text | Self::Json | Self::Csv => None,
            Self::Gradescope => Some("json"),
            Self::Html => Some("html"),
        }
    }
}

/// Grades, and prints the grades.
///
/// # Errors
/// When the policy cannot be read or an output cannot be written; what is wrong with a submission
/// is in its grade.
pub fn run(arguments: &GradeArgs) -> Result<u8, CliError> {
    let policy = policy(arguments.policy.as_deref())?;
    let settings = Settings { emitted: arguments.emitted, seed: arguments.seed, policy };
    let (missing, there): (Vec<PathBuf>, Vec<PathBuf>) =
        arguments.submissions.iter().cloned().partition(|path| is_missing(path));
    let input = StandardInput::read(&there)?;
    let folders = match (arguments.class, arguments.submission) {
        (true, _) => Folders::Class,
        (_, true) => Folders::Submission,
        _ => Folders::Clear,
    };
    let Collected { mut handed_in, ambiguous, classes, own, notes } =
        collect(&input.in_place_of_name(&there), folders);
    input.name(&mut handed_in);
    notes.iter().for_each(|note| eprintln!("note: {}", escaped(note)));
    let files = handed_in.iter().map(|one| [&one.submission.list, &one.submission.picture]);
    release(&own);
    protect(arguments.policy.iter().chain(arguments.gradebook.files()));
    protect(files.flatten().flatten());
    protect_folders(&there);
    // What nobody could grade is told when all others are graded.
    let mut not_graded = ambiguous;
    if !missing.is_empty() {
        let names: Vec<String> = missing.iter().map(|path| path.display().to_string()).collect();
        not_graded.push(format!("{}: no such file or folder", names.join(", ")));
    }
    if handed_in.is_empty() {
        return Err(CliError::Argument(not_graded.join("; ")));
    }
    let students = arguments.gradebook.class(&[&there[..], &classes].concat(), &mut handed_in)?;
    let count = handed_in.len() + missing.len();
    let names = handed_in.iter().map(|one| one.submission.name.as_str());
    let (folder, files) =
        places_of_each(arguments.format.of_each(), arguments.out.as_deref(), names, count)?;
    let expectations = expectations(arguments.max_bounces);
    let class = Class {
        format: arguments.format,
        settings: &settings,
        expectations: &expectations,
        pages: Pages::new(&expectations, &settings.policy, folder.is_some()),
        folder,
        students,
        files,
        bar: progress(handed_in.len()),
    };
    let graded = class.grade(&handed_in);
    class.bar.finish_and_clear();
    let is_alone = handed_in.len() + missing.len() == 1;
    let written = class.write(&graded, is_alone, arguments.out.as_deref());
    not_graded.extend(written.err().map(|error| error.to_string()));
    not_graded.extend(graded.iter().filter_map(|one| one.problem.clone()));
    match not_graded.is_empty() {
        true => Ok(0),
        false => Err(CliError::Argument(not_graded.join("; "))),
    }
}

/// Whether `path` does not exist. A broken symlink exists.
fn is_missing(path: &Path) -> bool {
    path != Path::new(STANDARD_INPUT)
        && path.symlink_metadata().is_err_and(|error| error.kind() == io::ErrorKind::NotFound)
}

/// A progress bar on a terminal.
fn progress(count: usize) -> ProgressBar {
    if count < 2 || !std::io::stderr().is_terminal() {
        return ProgressBar::hidden();
    }
    let style = ProgressStyle::with_template("graded {wide_bar} {human_pos}/{human_len} {eta}");
    ProgressBar::new(count as u64).with_style(style.expect("the template is well formed"))
}

/// What the submissions are judged by.
pub fn expectations(max_bounces: i32) -> Expectations {
    let places = Places::new(&assignment8::create_scene());
    let signatures = Signatures::of_limit(&places, max_bounces);
    Expectations::new(places, signatures)
}
