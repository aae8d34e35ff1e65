//! One page that shows the box in 3-D with all stored photons, and steps through the port's own
//! source on one photon with its numbers.
//!
//! The page is one file: it needs no server and no network. It draws what the port computed:
//! stories come from [`compare::explain`], lists and comparisons from their own crates. Only the
//! random numbers are drawn again in the page, since they would double its size.
//!
//! The box is drawn by some 250 lines of WebGL of our own. Two crates embed a chart library, and
//! neither would do: `plotly` 0.14 brings 4.7 MB of JavaScript, twice the size that this page may
//! have, and sizes its dots in pixels, not in the scene's units; `charming` 0.6 embeds ECharts
//! without its 3-D part.

pub mod comparison;
mod html;
pub mod misreading;
mod overlay;
mod pack;
mod page;
mod parting;
mod paths;
mod scene;
mod table;

use image::RgbImage;
use oracle::summary::SurfaceSummary;
use photon_mapping::photon_list::PhotonRecord;
use variants::run::Run;

use comparison::ListComparison;

/// What a page shows.
#[derive(Debug)]
pub struct Exploration<'a> {
    /// The run of the reference.
    pub run: &'a Run,
    /// Whether it is a run of the handout's scene.
    pub is_handout: bool,
    /// Its whole list, path after path.
    pub records: &'a [PhotonRecord],
    /// The table of the summary: a line for every surface, and one for all together.
    pub table: (&'a [SurfaceSummary], &'a SurfaceSummary),
    /// The picture of the run, for browsers without WebGL.
    pub picture: &'a RgbImage,
    /// The photon on which the page opens; the first stored one if none is named.
    pub photon: Option<u64>,
    /// The list that is laid over the run's.
    pub comparison: Option<&'a ListComparison>,
}

/// The name of `run` in its page.
fn name_of(run: &Run) -> String {
    let part = run.part(0..0);
    format!("{} {} {} {}", part.seed, part.emitted, part.max_bounces, part.scene)
}

/// Whether the page that starts with `text` is one of `run`.
pub fn is_page_of(text: &str, run: &Run) -> bool {
    text.contains(&format!("<meta name=\"run\" content=\"{}\">", name_of(run)))
}

/// The part of a page's address that opens photon `photon`.
pub fn link(photon: u64) -> String {
    step_link((photon, 0, "emission"))
}

/// The part of a page's address that opens a step of a bounce of a photon.
fn step_link((photon, bounce, step): (u64, usize, &str)) -> String {
    format!("#photon={photon}&bounce={bounce}&step={step}")
}

impl Exploration<'_> {
    /// The page.
    pub fn page(&self) -> String {
        page::page(self)
    }
}
