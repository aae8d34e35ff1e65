//! All that pictures are held against.

use std::sync::OnceLock;

use super::signature::{PictureSignatures, known_misreadings, known_pairs};
use super::view::View;
use crate::places::Places;
use crate::signature::Effort;
use variants::hypotheses::{Hypothesis, fair_readings};

/// With more bounces allowed, hardly a path ends by the limit, and the signatures kept are right.
const MANY_BOUNCES: i32 = 20;

/// All that pictures are held against.
#[derive(Clone, Debug)]
pub struct PictureExpectations {
    /// The scene's places.
    pub places: Places,
    /// What the framework's camera sees.
    pub view: View,
    /// The same half a pixel to the right and down; few pictures need it.
    shifted: OnceLock<View>,
    /// The signatures of all hypotheses.
    pub signatures: PictureSignatures,
    pub(super) fair: Vec<Hypothesis>,
    pub(super) misreadings: Vec<Hypothesis>,
    pub(super) pairs: Vec<Hypothesis>,
    /// By facet in sight: whether it is at right angles to no axis.
    pub(super) is_askew: Vec<bool>,
}

impl PictureExpectations {
    /// What is expected of photons that may bounce `max_bounces` times: at once for many bounces,
    /// else measured.
    pub fn new(places: &Places, max_bounces: i32) -> Self {
        let view = View::new(places);
        let signatures = if max_bounces >= MANY_BOUNCES {
            PictureSignatures::of_assignment8(places)
        } else {
            PictureSignatures::measure(places, &view, max_bounces, Effort::QUICK)
        };
        let is_askew = |facet: &usize| places.facets[*facet].normal.abs().max_element() < 0.99;
        Self {
            is_askew: view.facets.iter().map(is_askew).collect(),
            places: places.clone(),
            view,
            shifted: OnceLock::new(),
            signatures,
            fair: fair_readings(),
            misreadings: known_misreadings(places),
            pairs: known_pairs(places),
        }
    }

    /// The view through the middles of pixels.
    pub fn shifted(&self) -> &View {
        self.shifted.get_or_init(|| self.view.shifted(&self.places))
    }

    /// The names of the facets, and of the cells in sight.
    pub(super) fn names(&self, view: &View) -> (Vec<String>, Vec<String>) {
        let facets = view.facets.iter().map(|facet| self.places.name(*facet)).collect();
        let cells = view.cells.iter().map(|cell| self.places.cell_name(*cell)).collect();
        (facets, cells)
    }
}
