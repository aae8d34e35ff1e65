//! All that pictures are held against.

use std::sync::OnceLock;

use super::signature::PictureSignatures;
use super::view::View;
use crate::places::Places;

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
    /// By cell in sight: by which part of itself the density of photons may be off.
    pub(super) leeway: Vec<f64>,
    /// By facet in sight: whether it is at right angles to no axis.
    pub(super) is_askew: Vec<bool>,
}

impl PictureExpectations {
    /// What is expected of photons that may bounce `max_bounces` times.
    pub fn new(places: &Places, max_bounces: i32) -> Self {
        let view = View::new(places);
        let signatures = PictureSignatures::of_limit(places, &view, max_bounces);
        let is_askew = |facet: &usize| places.facets[*facet].normal.abs().max_element() < 0.99;
        Self {
            leeway: view.cells.iter().map(|cell| places.leeway_of_cell(*cell)).collect(),
            is_askew: view.facets.iter().map(is_askew).collect(),
            places: places.clone(),
            view,
            shifted: OnceLock::new(),
            signatures,
        }
    }

    /// The view through the middles of pixels.
    pub fn shifted(&self) -> &View {
        self.shifted.get_or_init(|| self.view.shifted(&self.places))
    }
}
