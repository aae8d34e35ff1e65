//! `photon-mapping grade`: a verdict on submissions, and the reasons for it.

mod files;
mod policy;

use std::io::{self, IsTerminal, Read as _};
use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};
use indicatif::{ProgressBar, ProgressStyle};
use rayon::prelude::*;
use serde::Serialize;

use super::error::{CliError, escaped, print_whole};
use super::gradebook::{self, GradebookArgs};
use super::output::{self, protect, write};
use super::values;
pub use files::file_names;
use grading::class::grade_one;
use grading::gradescope;
use grading::intake::contents::same_contents;
use grading::intake::{Collected, Folders, HandedIn, collect};
use grading::judge_list::Expectations;
use grading::page::{Pages, index::index};
use grading::places::Places;
use grading::signature::{Effort, Signatures};
use grading::submission::{Graded, MOST_RECORDS, Settings, Submission, grade_at_most, remark};
use grading::text;
use grading::twins::{Fingerprint, twins};
use grading::verdict::{Grade, SAME_FILES};
use photon_mapping::assignment8;
pub use policy::read as policy;

/// With more bounces allowed, hardly a path ends by the limit, and the signatures kept are right.
const MANY_BOUNCES: i32 = 20;
/// Longer lists are judged one at a time: memory is then that of one, however many there are.
const MANY_RECORDS: usize = 300_000;
/// More is not read from standard input.
const MOST_BYTES: u64 = 1 << 30;
/// How standard input is called.
const STANDARD_INPUT: &str = "-";

/// The options of `grade`.
#[derive(Debug, Args)]
#[command(after_help = "\
Submissions: a file is one, and so is a folder, in which the list and the picture are found by what \
they contain; alice.csv and alice.png are one. A folder without a list or a picture of its own, but with \
several in the folders of at least two students, is a class: each folder in it is a submission. Say \
--class or --submission where a folder could be both. What is wrong with a file is in its grade, and \
stops no other.

Of several lists or pictures in one folder, that called photons or assignment8 is judged, or any if all \
are the same, and what is left out is remarked; else they are not judged.

A SUBMISSION that does not exist is no student's fault: the others are graded, then it is named, with \
exit code 2.

Several submissions: text and JSON go to one output; gradescope and html write a file for each into \
the folder --out, html also an index.html.

Policy: a JSON object that gives scores, each of which may be left out, by default
  { \"correct\": 4, \"undecided\": 0, \"plausible\": 3, \"incorrect\": 2, \"no-dots\": 1, \"unreadable\": 0, \"misreadings\": {} }
'undecided' is for lists with too few photons to tell: look at them yourself. 'plausible' is for \
incorrect photons that are finite, on surfaces and indirect only. 'misreadings' gives incorrect ones \
with a named misreading a score of their own: { \"misreadings\": { \"no-offset\": 3.5 } }. 'sections' \
gives the points of each section that 'check' finds right, by its title.

Exit codes: 0 graded, whatever the grades; 2 could not be carried out.")]
pub struct GradeArgs {
    /// Photon lists (PLY or CSV) and pictures (PNG) of the handout's scene, or folders with them
    #[arg(value_name = "SUBMISSION", required = true)]
    submissions: Vec<PathBuf>,
    /// A folder is a class: each folder, list and picture in it is a submission
    #[arg(long, conflicts_with = "submission")]
    class: bool,
    /// A folder is one submission, whatever is in it
    #[arg(long)]
    submission: bool,
    /// How many photons the submissions emitted, if their lists have no intensity column that says it
    /// [default: from the intensities]
    #[arg(long, value_name = "N", allow_negative_numbers = true,
          value_parser = values::whole(1, u64::from(u32::MAX)))]
    emitted: Option<u64>,
    /// How often a photon may bounce at most, 0 to 1000 times
    #[arg(long, value_name = "N", default_value_t = assignment8::MAX_PHOTON_BOUNCES,
          allow_negative_numbers = true, value_parser = values::whole(0_i32, 1000))]
    max_bounces: i32,
    /// The seed that submissions used, if they draw the reference's random numbers; others need none
    #[arg(long, value_name = "N", default_value_t = assignment8::SEED,
          allow_negative_numbers = true, value_parser = values::whole(0, u64::MAX))]
    seed: u64,
    /// What to write
    #[arg(long, value_enum, default_value_t = FormatName::Text)]
    format: FormatName,
    /// A JSON file with a course's own scores, see below
    #[arg(long, value_name = "FILE.json")]
    policy: Option<PathBuf>,
    /// Where to write the grades: a file for text, JSON, CSV or one submission; a folder for pages or
    /// results.json of several submissions [default: standard output]
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    #[command(flatten)]
    gradebook: GradebookArgs,
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
    /// A table for a gradebook, with a row for each submission
    Csv,
}

impl FormatName {
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
/// When the policy cannot be read or an output cannot be written; what is wrong with a submission is in
/// its grade.
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
    let Collected { mut handed_in, ambiguous, notes } =
        collect(&input.in_place_of_name(&there), folders);
    input.name(&mut handed_in);
    notes.iter().for_each(|note| eprintln!("note: {}", escaped(note)));
    let files = handed_in.iter().map(|one| [&one.submission.list, &one.submission.picture]);
    protect(files.flatten().flatten());
    // What nobody could grade is told when all others are graded.
    let mut not_graded = ambiguous;
    if !missing.is_empty() {
        let names: Vec<String> = missing.iter().map(|path| path.display().to_string()).collect();
        not_graded.push(format!("{}: no such file or folder", names.join(", ")));
    }
    if handed_in.is_empty() {
        return Err(CliError::Argument(not_graded.join("; ")));
    }
    let students = arguments.gradebook.class(&there, &mut handed_in)?;
    let folder = folder(arguments, handed_in.len() + missing.len())?;
    let expectations = expectations(arguments.max_bounces);
    let class = Class {
        format: arguments.format,
        settings: &settings,
        expectations: &expectations,
        pages: Pages::new(&expectations, &settings.policy),
        folder,
        students,
        files: file_names(
            handed_in.iter().map(|one| one.submission.name.as_str()),
            arguments.format.of_each().unwrap_or_default(),
        ),
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

/// All that is graded in one run.
struct Class<'a> {
    format: FormatName,
    settings: &'a Settings,
    expectations: &'a Expectations,
    pages: Pages<'a>,
    /// Whose submissions they are.
    students: gradebook::Class,
    /// Where each submission has a file of its own.
    folder: Option<PathBuf>,
    /// The names of these files.
    files: Vec<String>,
    bar: ProgressBar,
}

/// What is kept of a grade when its file is written.
struct Kept {
    grade: Grade,
    /// The only file's contents, where they go elsewhere.
    output: String,
    fingerprint: Option<Fingerprint>,
    /// What went wrong that is not the student's fault.
    problem: Option<String>,
}

impl Class<'_> {
    /// The grades of `handed_in`, whose files are written as soon as each is graded. Nothing that happens
    /// to one submission costs another its grade.
    fn grade(&self, handed_in: &[HandedIn]) -> Vec<Kept> {
        let all = 0..handed_in.len();
        let one = |at: usize, most: usize| self.grade_one(at, &handed_in[at], most);
        let small: Vec<Option<Kept>> =
            all.into_par_iter().map(|at| one(at, MANY_RECORDS)).collect();
        let large = |(at, kept): (usize, Option<Kept>)| {
            kept.unwrap_or_else(|| one(at, MOST_RECORDS).expect("the limit is the largest"))
        };
        let mut graded: Vec<Kept> = small.into_iter().enumerate().map(large).collect();
        if self.students.is_anonymous() {
            return graded;
        }
        let prints: Vec<_> = graded.iter().map(|one| one.fingerprint.as_ref()).collect();
        for (at, mut others) in twins(&prints).into_iter().enumerate() {
            others.retain(|other| !is_named_twice(&handed_in[at], &handed_in[*other]));
            let list = |at: usize| handed_in[at].submission.list.clone();
            let is_copy = |other: &usize| match (list(at), list(*other)) {
                (Some(one), Some(other)) => same_contents(&[one, other]),
                _ => false,
            };
            let (copies, others): (Vec<usize>, Vec<usize>) = others.into_iter().partition(is_copy);
            let notes: Vec<String> = [
                twin_note("the photon list is the same, byte by byte, as that", &copies, &graded),
                twin_note("the photons are the same as those", &others, &graded),
            ]
            .into_iter()
            .flatten()
            .collect();
            if !notes.is_empty() {
                let kept = &mut graded[at];
                let note =
                    |note: &String| remark(SAME_FILES, "photons of the student's own", note, "");
                kept.grade.findings.extend(notes.iter().map(note));
                self.write_results(at, kept);
            }
        }
        graded
    }

    /// The grade of submission `at`; none if its list has more than `most` records.
    fn grade_one(&self, at: usize, handed_in: &HandedIn, most: usize) -> Option<Kept> {
        let Graded { grade, fingerprint, try_again, list } =
            grade_one(handed_in, self.settings, |submission| {
                grade_at_most(submission, self.settings, self.expectations, most)
            })?;
        let problem =
            try_again.then(|| format!("{}: could not be read: try again", grade.submission));
        let graded = Graded { grade, list, fingerprint, try_again };
        let page = match self.format {
            FormatName::Html => self.pages.page(&handed_in.submission, &graded),
            _ => String::new(),
        };
        let Graded { grade, fingerprint, .. } = graded;
        let mut kept = Kept { grade, output: page, fingerprint, problem };
        if self.format == FormatName::Html
            && let Some(folder) = &self.folder
        {
            let written = write(&folder.join(&self.files[at]), &std::mem::take(&mut kept.output));
            kept.failed(written);
        }
        self.write_results(at, &mut kept);
        self.bar.inc(1);
        Some(kept)
    }

    /// Writes what Gradescope reads, if that is wanted.
    fn write_results(&self, at: usize, kept: &mut Kept) {
        if self.format != FormatName::Gradescope {
            return;
        }
        let results = json(&gradescope::results(&kept.grade, &self.settings.policy));
        match &self.folder {
            Some(folder) => kept.failed(write(&folder.join(&self.files[at]), &results)),
            None => kept.output = results,
        }
    }

    /// Writes what all `graded` have in common.
    fn write(&self, graded: &[Kept], is_alone: bool, out: Option<&Path>) -> Result<(), CliError> {
        let best = self.settings.policy.best();
        let grades: Vec<&Grade> = graded.iter().map(|one| &one.grade).collect();
        let output = match (self.format, grades.as_slice()) {
            (FormatName::Text, grades) => {
                let texts: Vec<_> = grades.iter().map(|grade| text::text(grade, best)).collect();
                texts.join("\n") + &self.students.text(grades)
            }
            (FormatName::Csv, grades) => self.students.csv(grades, self.settings.policy.unreadable),
            (FormatName::Json, [grade]) if is_alone => json(grade),
            (FormatName::Json, grades) => json(&grades),
            (FormatName::Gradescope | FormatName::Html, _) => {
                graded.first().map(|one| one.output.clone()).unwrap_or_default()
            }
        };
        match (&self.folder, out) {
            (Some(folder), _) if self.format == FormatName::Html => {
                let pages: Vec<_> = grades.into_iter().zip(self.files.iter().cloned()).collect();
                write(&folder.join("index.html"), &index(&pages, best))
            }
            (Some(_), _) => Ok(()),
            (None, Some(path)) => write(path, &output),
            (None, None) => print_whole(&output),
        }
    }
}

impl Kept {
    fn failed(&mut self, written: Result<(), CliError>) {
        if let Err(error) = written {
            self.problem = Some(error.to_string());
        }
    }
}

/// Whether both are the same file, named twice: a link to another's file is no such name.
fn is_named_twice(one: &HandedIn, other: &HandedIn) -> bool {
    let path = |handed_in: &HandedIn| {
        let path = handed_in.submission.list.clone()?;
        (!path.is_symlink()).then(|| std::fs::canonicalize(path).ok())?
    };
    path(one).is_some() && path(one) == path(other)
}

fn twin_note(what: &str, others: &[usize], graded: &[Kept]) -> Option<String> {
    const MOST_NAMED: usize = 5;
    let names = others.iter().take(MOST_NAMED).map(|at| graded[*at].grade.submission.clone());
    let names = names.collect::<Vec<_>>().join(", ");
    (!others.is_empty()).then(|| {
        format!(
            "{what} of {names}; two right programs with the same random numbers may write the same"
        )
    })
}

/// Standard input as a file, if `-` is named.
struct StandardInput(Option<tempfile::TempDir>);

impl StandardInput {
    fn read(paths: &[PathBuf]) -> Result<Self, CliError> {
        let path = Path::new(STANDARD_INPUT);
        if !paths.iter().any(|named| named == path) {
            return Ok(Self(None));
        }
        let unreadable = |error| CliError::unreadable(path, error);
        let folder = tempfile::tempdir().map_err(unreadable)?;
        let mut file =
            std::fs::File::create(folder.path().join(STANDARD_INPUT)).map_err(unreadable)?;
        io::copy(&mut io::stdin().lock().take(MOST_BYTES + 1), &mut file).map_err(unreadable)?;
        Ok(Self(Some(folder)))
    }

    fn file(&self) -> Option<PathBuf> {
        Some(self.0.as_ref()?.path().join(STANDARD_INPUT))
    }

    fn in_place_of_name(&self, paths: &[PathBuf]) -> Vec<PathBuf> {
        let file = |path: &PathBuf| self.file().filter(|_| path == Path::new(STANDARD_INPUT));
        paths.iter().map(|path| file(path).unwrap_or_else(|| path.clone())).collect()
    }

    fn name(&self, handed_in: &mut [HandedIn]) {
        let Some(file) = self.file() else { return };
        for one in handed_in.iter_mut() {
            let Submission { name, list, picture } = &mut one.submission;
            if list.as_ref() == Some(&file) || picture.as_ref() == Some(&file) {
                *name = STANDARD_INPUT.to_owned();
            }
        }
    }
}

/// Whether there is nothing at all at `path`: a link that leads nowhere is something.
fn is_missing(path: &Path) -> bool {
    path != Path::new(STANDARD_INPUT)
        && path.symlink_metadata().is_err_and(|error| error.kind() == io::ErrorKind::NotFound)
}

pub fn json(value: &impl Serialize) -> String {
    serde_json::to_string_pretty(value).expect("a grade has only plain values") + "\n"
}

/// The folder for a file of each of `count` submissions, if there are to be such.
fn folder(arguments: &GradeArgs, count: usize) -> Result<Option<PathBuf>, CliError> {
    if arguments.format.of_each().is_none() {
        return Ok(None);
    }
    let Some(out) = &arguments.out else {
        return match count {
            1 => Ok(None),
            _ => Err(CliError::Argument(format!(
                "--out: expected a folder, for each of {count} submissions has a file of its own"
            ))),
        };
    };
    let is_folder = out.is_dir() || out.to_string_lossy().ends_with(std::path::is_separator);
    match count > 1 || is_folder {
        true => Ok(Some(output::folder(out)?.to_owned())),
        false => Ok(None),
    }
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
pub fn expectations(max_bounces: i32) -> Expectations {
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
