//! `photon-mapping check`: compiles and runs the two C++ files of a submission, section by section.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};
use std::time::Duration;

use check::find::{CppSubmission, refuse_class};
use check::kit::Kit;
use check::wall::{Wall, wall};
use check::{CheckReport, CheckSettings, check};
use clap::{Args, ValueEnum};
use classroom::gradescope;
use classroom::intake::class::{is_litter, left_out};
use classroom::page::{Pages, index::Index};
use grading::policy::Policy;
use grading::verdict::Grade;
use photon_list::writer::{Format, ListWriter};
use photon_mapping::assignment8;
use rayon::prelude::*;

use super::error::{CliError, print_whole};
use super::grade::{INDEX, json, made_by, places_of_each};
use super::gradebook::{GradebookArgs, Roll};
use super::in_order::InOrder;
use super::output::{OutputFile, protect, protect_folders, refuse_protected, write};
use super::{progress, values};

/// The columns of the table after those of every gradebook.
const CSV_COLUMNS: [&str; 8] = [
    "misreadings",
    "builds",
    "emission",
    "storage",
    "scattering",
    "sampling",
    "transformation",
    "whole",
];

/// The options of `check`.
#[derive(Debug, Args)]
#[command(after_help = "Example: photon-mapping check alice/ bob/\n\
                  This runs code from strangers. Use a container or a separate account.\n\
                  Exit codes: 0 all submissions were checked; 2 one could not be.")]
pub struct CheckArgs {
    /// A folder with PointLight.cpp and PhotonMappingRenderer.cpp anywhere in it, or one of these
    /// files
    #[arg(value_name = "SUBMISSION", required = true)]
    submissions: Vec<PathBuf>,
    /// Each SUBMISSION is a class: a folder with a folder for each student
    #[arg(long)]
    class: bool,
    /// Processor time for each file to compile, and for the whole run, in seconds. Each probe of a
    /// section has 3 seconds. On the clock, each has five times as long, and a minute at least
    #[arg(long, value_name = "SECONDS", default_value = "60",
          value_parser = values::whole(1_u64, 3600))]
    timeout: u64,
    /// The folder with the glm headers [default: the system's]
    #[arg(long, value_name = "PATH")]
    glm: Option<PathBuf>,
    /// Write the photon list of the submission for compare, explore and grade; CSV if the name ends
    /// in .csv, else PLY
    #[arg(long, value_name = "FILE")]
    list: Option<PathBuf>,
    /// What to write
    #[arg(long, value_enum, default_value_t = CheckFormat::Text)]
    format: CheckFormat,
    /// A JSON file with a course's own scores, as for grade
    #[arg(long, value_name = "FILE.json")]
    policy: Option<PathBuf>,
    /// Where to write the report, instead of standard output; for html and gradescope of several
    /// submissions, a folder
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    #[command(flatten)]
    gradebook: GradebookArgs,
    /// No progress bar
    #[arg(long, short)]
    quiet: bool,
}

/// The formats of the report.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum CheckFormat {
    /// For people: a few lines for every section
    Text,
    /// For programs: an array with a report for every submission
    Json,
    /// A page that needs no other file, one a submission, with pictures of its photons
    Html,
    /// Gradescope's results.json, one a submission
    Gradescope,
    /// A table with a line for every submission
    Csv,
}

impl CheckFormat {
    /// The extension of its files, where each submission has one of its own.
    fn of_each(self) -> Option<&'static str> {
        match self {
            Self::Html => Some("html"),
            Self::Gradescope => Some("json"),
            Self::Text | Self::Json | Self::Csv => None,
        }
    }
}

/// What is kept of a submission: its list is large, and is written at once.
struct Checked {
    report: CheckReport,
    grade: Grade,
    /// The name and the text of the file of its own, in formats that have one.
    file: String,
    output: String,
    /// What could not be written.
    problems: Vec<CliError>,
}

/// Checks, and prints a report for every submission in order.
///
/// # Errors
/// When there is no compiler or no glm, or a path cannot be read.
pub fn run(arguments: &CheckArgs) -> Result<u8, CliError> {
    let (mut roll, named) =
        arguments.gradebook.folders(&arguments.submissions, submissions(arguments)?)?;
    let (names, paths): (Vec<String>, Vec<PathBuf>) = named.into_iter().unzip();
    if arguments.list.is_some() && paths.len() != 1 {
        let found = paths.len();
        return Err(CliError::Argument(format!("--list: expected one submission, found {found}")));
    }
    let find = |(path, name): (&PathBuf, String)| {
        Ok(CppSubmission { name, ..CppSubmission::find(path).map_err(argument)? })
    };
    let found: Vec<Result<CppSubmission, CliError>> =
        paths.iter().zip(names.clone()).map(find).collect();
    for submission in found.iter().flatten() {
        protect(submission.light.iter().chain(&submission.renderer).chain(&submission.headers));
    }
    protect_folders(&arguments.submissions);
    arguments.list.as_deref().map_or(Ok(()), refuse_protected)?;
    let (folder, files) = places_of_each(
        arguments.format.of_each(),
        arguments.out.as_deref(),
        names.iter().map(String::as_str),
        paths.len(),
    )?;
    if wall() == Wall::None {
        super::complain(
            "note: neither bubblewrap nor unshare works here, so nothing but a filter of system \
             calls keeps submissions from the network and from other processes",
        );
    }
    let kit = Kit::new(arguments.glm.as_deref()).map_err(argument)?;
    kit.prepare_for(found.len());
    let settings = CheckSettings {
        time: Duration::from_secs(arguments.timeout),
        // A class keeps all cores busy by itself.
        jobs: if paths.len() == 1 { 4 } else { 1 },
        ..CheckSettings::default()
    };
    let grading = grading::submission::Settings {
        emitted: Some(settings.photons),
        seed: assignment8::SEED,
        policy: super::grade::policy(arguments.policy.as_deref())?,
    };
    let expectations = super::grade::expectations(assignment8::MAX_PHOTON_BOUNCES);
    let pages = Pages::new(&expectations, &grading.policy, folder.is_some());
    let best = grading.policy.best();
    let bar = progress::bar(arguments.quiet, "submissions", paths.len() as u64);
    let in_order = Mutex::new(InOrder::default());
    let prints_each = arguments.format == CheckFormat::Text && arguments.out.is_none();
    let one = |found: Result<CppSubmission, CliError>, file: String| {
        let report = check(&found?, &kit, &settings).map_err(argument)?;
        let graded = check::grade::grade(&report, &grading, &expectations);
        let mut output = match arguments.format {
            CheckFormat::Html => {
                let name = report.submission.clone();
                let of_list = grading::submission::Submission { name, ..Default::default() };
                pages.page(&of_list, &graded)
            }
            CheckFormat::Gradescope => json(&gradescope::results(&graded.grade, &grading.policy)),
            _ => String::new(),
        };
        // What cannot be written costs no grade.
        let page = folder.as_ref().map(|folder| folder.join(&file));
        let written = page.map(|page| write(&page, std::mem::take(&mut output)));
        let listed = arguments.list.as_ref().map(|path| write_list(path, &report));
        let problems = [written, listed].into_iter().flatten().filter_map(Result::err).collect();
        bar.inc(1);
        let report = CheckReport { list: None, ..report };
        Ok(Checked { report, grade: graded.grade, file, output, problems })
    };
    // One after another, so that the first reports are the first to be ready.
    let mut results: Vec<(usize, Result<Checked, CliError>)> = found
        .into_iter()
        .zip(files)
        .enumerate()
        .par_bridge()
        .map(|(at, (found, file))| {
            let result = one(found, file);
            if prints_each {
                let text = result.as_ref().map(|checked| text_of(checked, &grading.policy)).ok();
                let mut in_order = in_order.lock().unwrap_or_else(PoisonError::into_inner);
                bar.suspend(|| in_order.print(at, text));
            }
            (at, result)
        })
        .collect();
    bar.finish_and_clear();
    results.sort_by_key(|(at, _)| *at);
    if let Some(error) = in_order.into_inner().unwrap_or_else(PoisonError::into_inner).problem {
        return Err(error);
    }
    let mut problems = Vec::new();
    let mut all = Vec::new();
    for (_, result) in results {
        match result {
            Ok(mut checked) => {
                problems.append(&mut checked.problems);
                all.push(checked);
            }
            Err(error) => {
                roll.leave_out(all.len());
                problems.push(error);
            }
        }
    }
    problems.iter().for_each(|error| super::complain(&format!("error: {error}")));
    let together = || together(arguments.format, &all, &grading.policy, &roll);
    match (&folder, &arguments.out) {
        // An empty report would replace an old one.
        _ if all.is_empty() => {}
        (Some(folder), _) if arguments.format == CheckFormat::Html => {
            let pages = all.iter().map(|checked| (&checked.grade, checked.file.clone())).collect();
            let made_by = made_by(roll.is_anonymous());
            let index = Index { pages, absent: roll.absent(), best, made_by };
            write(&folder.join(INDEX), index.page())?;
        }
        (Some(_), _) => {}
        (None, Some(path)) => write(path, together())?,
        (None, None) if prints_each => {
            let grades: Vec<&Grade> = all.iter().map(|checked| &checked.grade).collect();
            print_whole(&roll.text(&grades))?;
        }
        (None, None) => print_whole(&together())?,
    }
    Ok(if problems.is_empty() { 0 } else { super::FAILED })
}

fn text_of(checked: &Checked, policy: &Policy) -> String {
    check::text::text(&checked.report, &checked.grade, policy.best())
}

fn argument(error: check::error::CheckError) -> CliError {
    CliError::Argument(error.to_string())
}

fn submissions(arguments: &CheckArgs) -> Result<Vec<PathBuf>, CliError> {
    if !arguments.class {
        arguments.submissions.iter().try_for_each(|path| refuse_class(path)).map_err(argument)?;
        return Ok(arguments.submissions.clone());
    }
    let mut all = Vec::new();
    for class in &arguments.submissions {
        let students = CppSubmission::of_class(class).map_err(argument)?;
        let entries = fs::read_dir(class).into_iter().flatten().flatten();
        let paths = entries.map(|entry| entry.path());
        let mut others: Vec<PathBuf> =
            paths.filter(|path| !students.contains(path) && !is_litter(path)).collect();
        others.sort();
        let note = left_out(class, &others, "no folder of a student");
        note.iter().for_each(|note| super::complain(&format!("note: {note}")));
        if students.is_empty() {
            let class = class.display();
            let message = format!("{class}: expected a folder for each student, found none");
            return Err(CliError::Argument(message));
        }
        all.extend(students);
    }
    Ok(all)
}

/// All reports in one text.
fn together(format: CheckFormat, all: &[Checked], policy: &Policy, roll: &Roll) -> String {
    let grades: Vec<&Grade> = all.iter().map(|checked| &checked.grade).collect();
    match format {
        CheckFormat::Text => {
            let texts = all.iter().map(|checked| text_of(checked, policy));
            texts.collect::<Vec<_>>().join("\n") + &roll.text(&grades)
        }
        CheckFormat::Json => {
            let reports: Vec<_> = all
                .iter()
                .map(|Checked { report, grade, .. }| {
                    serde_json::json!({ "report": report, "grade": grade })
                })
                .collect();
            json(&reports)
        }
        CheckFormat::Csv => {
            let cells = |at: usize| cells(&all[at].report);
            roll.csv(&grades, policy.unreadable, &CSV_COLUMNS, cells)
        }
        CheckFormat::Html | CheckFormat::Gradescope => {
            all.iter().map(|checked| checked.output.as_str()).collect()
        }
    }
}

/// What `CSV_COLUMNS` say of a submission.
fn cells(report: &CheckReport) -> Vec<String> {
    let names = report.sections.iter().flat_map(|verdict| &verdict.faults);
    let names: Vec<_> = names.filter_map(|fault| fault.name).collect();
    let mut cells = vec![names.join(" "), report.builds.sentence()];
    let statuses = (0..5).map(|at| report.sections.get(at).map_or("", |v| v.status.in_words()));
    cells.extend(statuses.map(str::to_owned));
    cells.push(report.whole.sentence(&report.sections));
    cells
}

fn write_list(path: &Path, report: &CheckReport) -> Result<(), CliError> {
    let Some(list) = &report.list else {
        return Err(CliError::Argument(format!("--list: {} stored no list", report.submission)));
    };
    let is_csv = path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("csv"));
    let format = if is_csv { Format::Csv } else { Format::Ply };
    let mut file = OutputFile::create(path)?;
    let unwritable = |error| CliError::unwritable(path, error);
    let mut writer = ListWriter::new(file.file(), format, Vec::new()).map_err(unwritable)?;
    writer.write(&list.records).map_err(unwritable)?;
    writer.finish().map_err(unwritable)?;
    file.persist()
}
