//! `photon-mapping report`: speed, precision, offset and sampler against accuracy, as a page.

use std::io::Write as _;
use std::path::PathBuf;

use clap::Args;

use super::error::{CliError, print};
use super::output::{self, OutputFile};
use super::progress;
use report::plan::Plan;
use report::{self, FILES};

/// The options of `report`.
#[derive(Debug, Args)]
pub struct ReportArgs {
    /// The folder for the page, its plots and its data; created if it does not exist
    #[arg(long, value_name = "DIR", default_value = "report")]
    out: PathBuf,
    /// Fewer photons: under 20 seconds on two cores
    #[arg(long, conflicts_with = "long")]
    quick: bool,
    /// Adds runs of 10^8 photons; takes minutes
    #[arg(long)]
    long: bool,
    /// No progress bar
    #[arg(long, short)]
    quiet: bool,
}

/// Measures, and writes the page.
///
/// # Errors
/// When a file cannot be written; nothing is measured if that is known before.
pub fn run(arguments: &ReportArgs) -> Result<u8, CliError> {
    let plan = match (arguments.quick, arguments.long) {
        (true, _) => Plan::quick(),
        (_, true) => Plan::long(),
        _ => Plan::usual(),
    };
    let mut outputs = Vec::new();
    for name in FILES {
        outputs.push((name, OutputFile::create(&output::folder(&arguments.out)?.join(name))?));
    }
    let bar = progress::bar(arguments.quiet, "photons", plan.photons());
    let files = report::run(&plan, &|photons| bar.inc(photons));
    bar.finish_and_clear();
    for (name, output) in &mut outputs {
        let content = files.iter().find(|file| file.0 == *name).map(|file| &file.1);
        let content = content.expect("the report has all of its files");
        let written = output.file().write_all(content.as_bytes());
        written.map_err(|error| CliError::unwritable(output.path(), error))?;
    }
    let page = arguments.out.join(FILES[0]);
    // The page last: when it is there, all that it shows is.
    for (_, output) in outputs.into_iter().rev() {
        output.persist()?;
    }
    print(&format!("written: {}\n", page.display()))?;
    Ok(0)
}
