//! `photon-mapping check`: compiles and runs the two C++ files of a submission, section by section.

use std::path::PathBuf;
use std::time::Duration;

use check::find::Submission;
use check::kit::Kit;
use check::{Report, Settings, check};
use clap::{Args, ValueEnum};
use photon_list::writer::{Format, ListWriter};
use rayon::prelude::*;

use super::error::{CliError, print};
use super::output::OutputFile;
use super::{progress, values};

/// The options of `check`.
#[derive(Debug, Args)]
#[command(after_help = "Example: photon-mapping check alice/ bob/\n\
                  This runs code from strangers. Use a container or an account of its own.\n\
                  Exit codes: 0 all submissions were checked; 2 one could not be.")]
pub struct CheckArgs {
    /// Folders anywhere above PointLight.cpp and PhotonMappingRenderer.cpp, or one of these files
    #[arg(value_name = "SUBMISSION", required = true)]
    submissions: Vec<PathBuf>,
    /// Take each SUBMISSION for a class: a folder whose subfolders are submissions
    #[arg(long)]
    class: bool,
    /// How long the compiler may take for a file, and how long a submission may run, in seconds
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
    /// Text for people, or JSON for programs
    #[arg(long, value_enum, default_value_t = FormatName::Text)]
    format: FormatName,
    /// No progress bar
    #[arg(long, short)]
    quiet: bool,
}

/// The formats of the report.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum FormatName {
    /// A few lines for every section
    Text,
    /// An array with a report for every submission
    Json,
}

/// Checks, and prints a report for every submission in order.
///
/// # Errors
/// When there is no compiler or no glm, or a path cannot be read.
pub fn run(arguments: &CheckArgs) -> Result<u8, CliError> {
    let argument = |error: check::error::CheckError| CliError::Argument(error.to_string());
    let paths: Vec<PathBuf> = if arguments.class {
        let classes: Vec<_> = arguments
            .submissions
            .iter()
            .map(|path| Submission::of_class(path))
            .collect::<Result<_, _>>()
            .map_err(argument)?;
        classes.into_iter().flatten().collect()
    } else {
        arguments.submissions.clone()
    };
    if arguments.list.is_some() && paths.len() != 1 {
        let found = paths.len();
        return Err(CliError::Argument(format!("--list: expected one submission, found {found}")));
    }
    let kit = Kit::new(arguments.glm.as_deref()).map_err(argument)?;
    let settings = Settings { time: Duration::from_secs(arguments.timeout), ..Settings::default() };
    let bar = progress::bar(arguments.quiet, "submissions", paths.len() as u64);
    let reports: Vec<Result<Report, _>> = paths
        .par_iter()
        .map(|path| {
            let report =
                Submission::find(path).and_then(|submission| check(&submission, &kit, &settings));
            bar.inc(1);
            report
        })
        .collect();
    bar.finish_and_clear();
    let failed = reports.iter().filter(|report| report.is_err()).count();
    for error in reports.iter().filter_map(|report| report.as_ref().err()) {
        super::complain(&format!("error: {error}"));
    }
    let reports: Vec<Report> = reports.into_iter().flatten().collect();
    if let (Some(path), [report]) = (&arguments.list, reports.as_slice()) {
        write_list(path, report)?;
    }
    match arguments.format {
        FormatName::Text => {
            let texts: Vec<String> = reports.iter().map(check::text::text).collect();
            print(&texts.join("\n"))?;
        }
        FormatName::Json => {
            let json = serde_json::to_string(&reports).expect("a report has only plain values");
            print(&(json + "\n"))?;
        }
    }
    Ok(if failed > 0 { super::FAILED } else { 0 })
}

fn write_list(path: &std::path::Path, report: &Report) -> Result<(), CliError> {
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
