//! What a run did, printed for people or as JSON.

use std::path::PathBuf;

use serde::Serialize;

use super::error::{CliError, print};
use oracle::summary::{Counts, SurfaceSummary, table};
use photon_list::run::RunPart;

/// What a run did.
#[derive(Debug, Default, Serialize)]
pub struct Summary {
    /// Which run, or part of one; only where counts alone were kept.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub run: Option<RunPart>,
    /// What `merge` adds up; only where counts alone were kept.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub counts: Option<Counts>,
    /// None where a list was read.
    pub seed: Option<u64>,
    /// Named only where it is not the reference's.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sampler: Option<&'static str>,
    /// None where a list was read.
    pub emitted: Option<u64>,
    /// Stored photons.
    pub stored: u64,
    /// Of the list's rows.
    pub sha256: Option<String>,
    /// How long it took.
    pub seconds: Seconds,
    /// By surface and bounce.
    pub surfaces: Vec<SurfaceSummary>,
    /// All surfaces together.
    pub total: Option<SurfaceSummary>,
    /// Where the fast path and the port differ; the run is then the port's.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub differences_from_port: Vec<String>,
    /// What was written.
    pub files: Vec<PathBuf>,
}

/// How long each phase took. The list's rows are written while later photons are traced; `write`
/// is what remains to be done after that.
#[derive(Debug, Default, Serialize)]
pub struct Seconds {
    /// Tracing, or reading a list.
    pub trace: f64,
    /// The picture.
    pub picture: f64,
    /// Writing.
    pub write: f64,
}

/// Prints `summary` and gives the exit code.
pub fn print_summary(summary: &Summary, as_json: bool) -> Result<u8, CliError> {
    if as_json {
        let json = serde_json::to_string(summary).expect("a summary has only plain values");
        print(&(json + "\n"))?;
    } else {
        print(&text(summary))?;
    }
    Ok(0)
}

fn text(summary: &Summary) -> String {
    let mut text = String::new();
    if let (Some(seed), Some(emitted)) = (summary.seed, summary.emitted) {
        let sampler = summary.sampler.map(|name| format!(", sampler {name}")).unwrap_or_default();
        let stored = summary.stored;
        text += &format!("seed {seed}{sampler}: {emitted} photons emitted, {stored} stored\n\n");
    } else {
        text += &format!("{} photons read\n\n", summary.stored);
    }
    if !summary.surfaces.is_empty() {
        let lines: Vec<_> = summary.surfaces.iter().chain(&summary.total).cloned().collect();
        text += &table(&lines);
        if summary.surfaces.iter().any(|surface| surface.expected.is_some()) {
            text += match summary.sampler {
                None => "stored / expected (difference in standard deviations)\n",
                Some(_) => "stored / expected\n",
            };
        }
        text += "\n";
    }
    if let Some(sha256) = &summary.sha256 {
        text += &format!("photon list SHA-256 {sha256}\n");
    }
    let Seconds { trace, picture, write } = summary.seconds;
    let first = if summary.seed.is_some() { "trace" } else { "read" };
    if trace + picture + write > 0.0 {
        text += &format!("seconds: {first} {trace:.2}, picture {picture:.2}, write {write:.2}\n");
    }
    for difference in &summary.differences_from_port {
        text += &format!(
            "warning: the fast path differs from the port at {difference}; the port did this run\n"
        );
    }
    for file in &summary.files {
        text += &format!("written: {}\n", file.display());
    }
    text
}
