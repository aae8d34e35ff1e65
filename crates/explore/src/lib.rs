//! One page that shows the box in 3-D with all stored photons, and steps through the port's own
//! source on one photon with its numbers.
//!
//! The page is one file: it needs no server and no network. It draws what the port computed: stories
//! come from [`photon_mapping::explain`], lists and comparisons from their own modules. Only the
//! random numbers are drawn again in the page, since they would double its size.

pub mod comparison;
mod pack;
mod page;
mod run;
mod source;

use image::RgbImage;
use photon_mapping::photon_list::record::PhotonRecord;
use photon_mapping::rendering::photon_mapping_renderer::PhotonMappingRenderer;
use photon_mapping::summary::SurfaceSummary;

use comparison::Comparison;

/// What a page shows.
#[derive(Debug)]
pub struct Exploration<'a> {
    /// The run of the reference.
    pub renderer: &'a PhotonMappingRenderer,
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
    pub comparison: Option<&'a Comparison>,
}

impl Exploration<'_> {
    /// The page.
    pub fn page(&self) -> String {
        page::page(self)
    }
}
