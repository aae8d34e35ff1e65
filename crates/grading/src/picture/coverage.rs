//! How much of a facet shows its photons when their positions are off its plane.
//!
//! A pixel is red when a photon lies in the cube around its point. Photons at a distance d off a
//! plane at right angles to an axis are in it up to d = r, half the cube's edge, and never beyond.
//! For a plane with the normal (a, b), a > b > 0, the photons in the cube fill the part of the line
//! at distance d that is inside a square: it shrinks from d = r (a - b) on, and is gone at d = r (a
//! + b).

use super::view::View;
use crate::places::Places;
use photon_mapping::rendering::photon_mapping_renderer::PHOTON_DOT_RADIUS;

/// How far off their plane positions may be before coverage changes, up to where nothing is left,
/// in world units, in steps between which it changes by three hundredths.
pub const STANDOFFS: [f64; 37] = {
    let mut standoffs = [0.0; 37];
    let mut at = 0;
    while at < standoffs.len() {
        standoffs[at] = 1.95e-3 + 5e-5 * at as f64;
        at += 1;
    }
    standoffs
};

/// By facet in sight, the part of its photons near enough to show, where all are `standoff` off
/// their plane, in world units.
pub fn coverage(view: &View, places: &Places, standoff: f64) -> Vec<f64> {
    let of_facet = |facet: &usize| {
        let normal = places.facets[*facet].normal.abs();
        let mut steep = normal.to_array();
        steep.sort_unstable_by(|a, b| b.total_cmp(a));
        part(steep[0], steep[1], standoff.abs() / f64::from(PHOTON_DOT_RADIUS))
    };
    view.facets.iter().map(of_facet).collect()
}

/// For the normal (a, b) and a distance in units of half the cube's edge.
fn part(a: f64, b: f64, distance: f64) -> f64 {
    if b < 1e-3 {
        return if distance <= 1.0 { 1.0 } else { 0.0 };
    }
    // Along the line (d a - u b, d b + u a), both coordinates within [-1, 1].
    let low = ((-1.0 - distance * b) / a).max((distance * a - 1.0) / b);
    let high = ((1.0 - distance * b) / a).min((distance * a + 1.0) / b);
    (high - low).max(0.0) * a / 2.0
}
