//! `photon-mapping explain`: the whole story of one photon.

use std::io::Read as _;

use clap::Args;

use super::error::{CliError, print};
use super::run_args::RunArgs;
use super::values;
use compare::explain::{explain, first_that_stores};
use variants::run::Run;

/// The options of `explain`.
#[derive(Debug, Args)]
pub struct ExplainArgs {
    /// The photon's number, counted from 0 over all lights; with --until-stored, where to start
    /// the search [default with --until-stored: 0]
    #[arg(required_unless_present = "until_stored", allow_negative_numbers = true,
          value_parser = values::whole(0_u64, u64::MAX))]
    photon: Option<u64>,
    /// The first photon that stores at least K photons
    #[arg(long, value_name = "K", allow_negative_numbers = true,
          value_parser = values::whole(1_u16, 1000))]
    until_stored: Option<u16>,
    /// Print the story as JSON
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    run: RunArgs,
}

/// Prints the story.
///
/// # Errors
/// When there is no such photon, or the model cannot be read.
pub fn run(arguments: &ExplainArgs) -> Result<u8, CliError> {
    let run = arguments.run.load()?;
    let emitted = run.renderer.emitted();
    let mut photon = arguments.photon.unwrap_or(0);
    if photon >= emitted {
        return Err(CliError::Argument(format!(
            "PHOTON {photon}: expected a number below {emitted}, the photons of the run"
        )));
    }
    if let Some(stored) = arguments.until_stored {
        photon = first_that_stores(&run, photon, usize::from(stored)).ok_or_else(|| {
            CliError::Argument(format!(
                "--until-stored {stored}: expected a photon from {photon} to {} that stores at \
                     least {stored} photons, found none",
                emitted - 1
            ))
        })?;
    }
    let story = explain(&run, photon).expect("the photon is one of those emitted");
    if arguments.json {
        let json = serde_json::to_string(&story).expect("a story has only plain values");
        print(&(json + "\n"))?;
    } else {
        print(&(story.text() + &link(&run, photon)))?;
    }
    Ok(0)
}

/// Where the page of `explore` shows photon `photon`, if the page of this run is in its usual
/// place.
fn link(run: &Run, photon: u64) -> String {
    let path = std::path::Path::new("out").join(super::explore::PAGE);
    let mut start = [0; 2048];
    let read = std::fs::File::open(&path).and_then(|mut page| page.read(&mut start)).unwrap_or(0);
    if !explore::is_page_of(&String::from_utf8_lossy(&start[..read]), run) {
        return String::new();
    }
    format!("\nin 3-D: {}{}\n", path.display(), explore::link(photon))
}
