//! Photons that crowd on spots and lines, tested exactly at any count.
//!
//! The scene is cut into cubes. A photon that falls into a cube where another one lies already is
//! rarer the smaller the cubes are, whatever the fair reading: each cube has a bounded part of all
//! photons. The bound on the chance is that of a supermartingale, so that it needs no large
//! numbers.

use super::limits::{AREA_IN_CUBE, DENSEST, EDGES, LEFT_TO_SELF_HITS, WEIGHTS_OF_SHARED};
use std::collections::HashSet;

use glam::DVec3;

/// A bound on the chance that `positions`, rounded to `unit`, share cubes as often as they do.
pub fn crowding(positions: impl Iterator<Item = DVec3> + Clone, unit: f64) -> f64 {
    let mut smallest = 0.0_f64;
    let growth = WEIGHTS_OF_SHARED.map(f64::exp_m1);
    for edge in EDGES.into_iter().filter(|edge| unit <= *edge * (1.0 + 1e-9)) {
        let of_cube = DENSEST * AREA_IN_CUBE * (edge + unit).powi(2);
        let mut occupied = HashSet::new();
        // By weight: a logarithm, and what it does not have yet, since one of many factors together
        // takes less time.
        let mut bounds = WEIGHTS_OF_SHARED.map(|_| (0.0, 1.0));
        for position in positions.clone() {
            let chance = (LEFT_TO_SELF_HITS + of_cube * occupied.len() as f64).min(1.0);
            // Half a unit aside: rounded positions lie on no cube's face.
            let cube = ((position + 0.5 * unit) / edge).floor().to_array();
            let is_shared = !occupied.insert(packed(cube));
            for ((bound, weight), growth) in bounds.iter_mut().zip(WEIGHTS_OF_SHARED).zip(growth) {
                let (logarithm, factor) = bound;
                *factor *= 1.0 + chance * growth;
                *logarithm -= if is_shared { weight } else { 0.0 };
                if *factor > 1e200 {
                    *logarithm += factor.ln();
                    *factor = 1.0;
                }
            }
            // No photon is rarer than certain: from here on, bounds only grow.
            let is_low = |(logarithm, factor): &(f64, f64)| logarithm + factor.ln() < smallest;
            if chance == 1.0 && !bounds.iter().any(is_low) {
                break;
            }
        }
        let all = bounds.into_iter().map(|(logarithm, factor)| logarithm + factor.ln());
        smallest = all.fold(smallest, f64::min);
    }
    (smallest.exp() * (EDGES.len() * WEIGHTS_OF_SHARED.len()) as f64).min(1.0)
}

/// One number for each cube: positions on facets have coordinates of far less than 2^20 edges.
fn packed(cube: [f64; 3]) -> u64 {
    const BITS: u32 = 21;
    cube.into_iter().fold(0, |all, it| all << BITS | (it as i64 as u64 & ((1 << BITS) - 1)))
}
