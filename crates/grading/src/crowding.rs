//! Photons that crowd on spots and lines, tested exactly at any count.
//!
//! The scene is cut into cubes. A photon that falls into a cube where another one lies already is
//! rarer the smaller the cubes are, whatever the fair reading: each cube has a bounded part of all
//! photons. The bound on the chance is that of a supermartingale, so that it needs no large
//! numbers.

use std::collections::HashSet;

use glam::DVec3;

/// Edges of the cubes, in world units.
const EDGES: [f64; 5] = [2e-5, 2e-4, 2e-3, 2e-2, 0.1];
/// Of all photons, so many at most lie on a unit of area: three times what the reference has where
/// they are densest.
const DENSEST: f64 = 1.0;
/// The largest area of facets in a cube of edge 1: three faces that meet.
const AREA: f64 = 3.0;
/// This part of the photons is left to self-hits and to paths along edges.
const LEFT: f64 = 0.03;
/// The weights of the supermartingales that are tried.
const WEIGHTS: [f64; 4] = [0.5, 1.0, 2.0, 3.0];

/// A bound on the chance that `positions`, rounded to `unit`, share cubes as often as they do.
pub fn crowding(positions: impl Iterator<Item = DVec3> + Clone, unit: f64) -> f64 {
    let mut smallest = 0.0_f64;
    for edge in EDGES.into_iter().filter(|edge| unit <= *edge * (1.0 + 1e-9)) {
        let of_cube = DENSEST * AREA * (edge + unit).powi(2);
        let mut occupied = HashSet::new();
        let mut logarithms = WEIGHTS.map(|_| 0.0);
        for position in positions.clone() {
            let chance = (LEFT + of_cube * occupied.len() as f64).min(1.0);
            // Half a unit aside: rounded positions lie on no cube's face.
            let cube = ((position + 0.5 * unit) / edge).floor().to_array();
            let is_shared = !occupied.insert(packed(cube));
            for (logarithm, weight) in logarithms.iter_mut().zip(WEIGHTS) {
                *logarithm += (chance * weight.exp_m1()).ln_1p();
                *logarithm -= if is_shared { weight } else { 0.0 };
            }
        }
        smallest = logarithms.into_iter().fold(smallest, f64::min);
    }
    (smallest.exp() * (EDGES.len() * WEIGHTS.len()) as f64).min(1.0)
}

/// One number for each cube: positions on facets have coordinates of far less than 2^20 edges.
fn packed(cube: [f64; 3]) -> u64 {
    const BITS: u32 = 21;
    cube.into_iter().fold(0, |all, it| all << BITS | (it as i64 as u64 & ((1 << BITS) - 1)))
}
