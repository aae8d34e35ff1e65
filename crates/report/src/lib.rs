//! `report`: what speed, precision, offset and sampler do to the accuracy, as a page with plots.
//!
//! Each section of the page has a file, which measures, writes its part of the page, and gives the
//! numbers behind it as CSV. Errors are differences from [`oracle`], which traces no photon.

mod both_precisions;
mod convergence;
mod csv;
mod hits;
mod judge;
mod machine;
mod offset;
mod page;
pub mod plan;
mod plot;
mod precision;
mod rules;
mod samplers;
mod speed_runs;
mod statistics;
mod transform;
mod true_paths;

use plan::Plan;

/// The files of a report, in the order in which the page names them.
pub const FILES: [&str; 13] = [
    "report.html",
    "report.md",
    "speed-runs.csv",
    "speed.csv",
    "speed.svg",
    "precision.csv",
    "precision-summary.csv",
    "precision.svg",
    "offset.csv",
    "offset.svg",
    "sampler-runs.csv",
    "sampler.csv",
    "sampler.svg",
];

/// A part of the page, with its plots and data.
struct PageSection {
    /// Markdown, with its heading.
    markdown: String,
    /// Names from [`FILES`], and the contents.
    files: Vec<(&'static str, String)>,
}

/// Measures everything in `plan`, and gives the files of the report: names from [`FILES`] and
/// contents. Calls `progress` with the number of photons traced since the last call.
pub fn run(plan: &Plan, progress: &(impl Fn(u64) + Sync)) -> Vec<(&'static str, String)> {
    let speed = speed_runs::measure(plan, progress);
    let sections = [
        convergence::section(&speed),
        precision::section(&precision::measure(plan, progress)),
        offset::section(plan, &offset::measure(plan, progress)),
        samplers::section(&samplers::measure(plan, progress)),
        machine::section(plan),
    ];
    let page = page::assemble(plan, &sections);
    let files: Vec<_> = sections.into_iter().flat_map(|section| section.files).collect();
    let html = page::html(&page, &files);
    [vec![("report.html", html), ("report.md", page)], files].concat()
}
