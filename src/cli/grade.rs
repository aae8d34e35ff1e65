//! `photon-mapping grade`: a verdict on submissions, and the reasons for it.

use std::io::{IsTerminal, Write as _};
use std::path::PathBuf;

use clap::{Args, ValueEnum};
use rayon::prelude::*;

use super::error::{CliError, print};
use super::output::OutputFile;
use super::values;
use crate::assignment8;
use crate::grading::judge_list::Expectations;
use crate::grading::picture::reading::{kind, start_of};
use crate::grading::places::Places;
use crate::grading::policy::Policy;
use crate::grading::signature::{Effort, Signatures};
use crate::grading::submission::{Graded, Settings, Submission, grade};
use crate::grading::text;

/// With more bounces allowed, hardly a path ends by the limit, and the signatures kept are right.
const MANY_BOUNCES: i32 = 20;

/// The options of `grade`.
#[derive(Debug, Args)]
pub struct GradeArgs {
    /// Photon lists (PLY or CSV) and pictures (PNG) of the handout's scene
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
    /// What to print
    #[arg(long, value_enum, default_value_t = FormatName::Text)]
    format: FormatName,
    /// A JSON file with a course's own scores
    #[arg(long, value_name = "FILE.json")]
    policy: Option<PathBuf>,
    /// Where to write the grades, instead of standard output
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
}

/// Grades, and prints the grades.
///
/// # Errors
/// When the policy cannot be read or an output cannot be written; what is wrong with a submission is in
/// its grade.
pub fn run(arguments: &GradeArgs) -> Result<u8, CliError> {
    let settings =
        Settings { emitted: arguments.emitted, seed: arguments.seed, policy: policy(arguments)? };
    let expectations = expectations(arguments.max_bounces);
    let submissions: Vec<Submission> = arguments.submissions.iter().map(submission).collect();
    let graded: Vec<Graded> = submissions
        .par_iter()
        .map(|submission| grade(submission, &settings, &expectations))
        .collect();
    let grades: Vec<_> = graded.iter().map(|graded| &graded.grade).collect();
    let best = settings.policy.best();
    let output = match arguments.format {
        FormatName::Text => {
            grades.iter().map(|grade| text::text(grade, best)).collect::<Vec<_>>().join("\n")
        }
        FormatName::Json => {
            let json = match grades.as_slice() {
                [grade] => serde_json::to_string_pretty(grade),
                _ => serde_json::to_string_pretty(&grades),
            };
            json.expect("a grade has only plain values") + "\n"
        }
    };
    match &arguments.out {
        None => print(&output)?,
        Some(path) => {
            let mut file = OutputFile::create(path)?;
            file.file()
                .write_all(output.as_bytes())
                .map_err(|error| CliError::unwritable(path, error))?;
            file.persist()?;
        }
    }
    Ok(0)
}

fn submission(path: &PathBuf) -> Submission {
    let name = path.display().to_string();
    let is_picture = start_of(path).is_some_and(|start| kind(&start).is_some());
    let [list, picture] = if is_picture { [None, Some(path)] } else { [Some(path), None] };
    Submission { name, list: list.cloned(), picture: picture.cloned() }
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
    let text = std::fs::read_to_string(path).map_err(|error| CliError::unreadable(path, error))?;
    serde_json::from_str(&text).map_err(|error| {
        CliError::Argument(format!("{}: expected a policy: {error}", path.display()))
    })
}
