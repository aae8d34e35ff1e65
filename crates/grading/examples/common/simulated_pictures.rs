//! Simulated pictures.

use glam::Vec3;

use grading::picture::view::{PIXELS, View};
use grading::places::Places;
use photon_mapping::random::photon_random;
use variants::hypotheses::{Hypothesis, misreadings, no_offset};
use variants::variation::{FACETS, Simulation, Variation};

/// How many photons are traced at once.
const PIECE: u64 = 1 << 16;

/// The dots of `emitted` photons with `seed` under `variation`, where positions are `standoff` off
/// their facets, in world units: by pixel of `view`.
pub fn simulate_dots(
    variation: Variation,
    seed: u64,
    emitted: u64,
    standoff: f32,
    places: &Places,
    view: &View,
) -> Vec<bool> {
    let simulation =
        Simulation::new(variation, seed, emitted, photon_mapping::assignment8::MAX_PHOTON_BOUNCES);
    let mut red = vec![false; PIXELS];
    for start in (0..emitted).step_by(PIECE as usize) {
        for record in simulation.trace(start..emitted.min(start + PIECE)) {
            let off = match places.facets.get(usize::from(record.surface)) {
                Some(facet) => standoff * facet.normal.as_vec3(),
                None => Vec3::ZERO,
            };
            view.for_each_pixel_of(record.position + off, |pixel| red[pixel] = true);
            if record.position.is_nan() {
                // It is near everything.
                return (0..PIXELS).map(|pixel| view.shows_surface(pixel)).collect();
            }
        }
    }
    red
}

/// What each simulated picture does wrong: the ways to a misreading one after another, seed by
/// seed.
pub fn misread(id: &str, seed: u64) -> Option<Hypothesis> {
    let ways: Vec<Hypothesis> =
        misreadings().into_iter().filter(|hypothesis| hypothesis.id == id).collect();
    if id == "no-offset" {
        // From facet to facet, as rounding would have it.
        let mut random = photon_random(seed, 0);
        let places = Places::new(&photon_mapping::assignment8::create_scene());
        let mut self_hits = [0.0; FACETS];
        for (facet, part) in places.facets.iter().zip(&mut self_hits) {
            let is_straight = facet.normal.abs().max_element() > 0.99;
            *part = if is_straight { 0.15 + 0.1 * random() } else { 0.45 + 0.1 * random() };
        }
        return Some(no_offset(self_hits));
    }
    let count = ways.len().max(1);
    ways.into_iter().nth(seed as usize % count)
}
