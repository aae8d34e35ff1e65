//! The correct paths of the photons, to compare with other starts, photon by photon and with the
//! same random numbers.

use rayon::prelude::*;

use super::both_precisions::{Path, double};
use model::facets::facet_of_triangles;
use photon_mapping::assignment8;
use photon_mapping::random::photon_random;

/// How far off a facet f64 starts its rays, in scene units: far above its rounding, and too small
/// to change where a photon goes.
const START: f64 = 1e-9;

/// The facets that each photon hits, one after another, in the handout's scene.
pub struct TruePaths(Vec<Vec<usize>>);

impl TruePaths {
    /// Traces the first `photons` in f64.
    pub fn trace(photons: u64) -> Self {
        let scene = assignment8::create_scene();
        let facets = facet_of_triangles(&scene);
        let tracer = double::PrecisionTracer::new(&scene, START);
        let trace = |path: &mut Path, photon| {
            tracer.trace(&mut photon_random(assignment8::SEED, photon), path);
            path.hits.iter().map(|(triangle, _)| facets[*triangle]).collect()
        };
        Self((0..photons).into_par_iter().map_init(Path::default, trace).collect())
    }

    /// How many photons are stored: all hits but each path's first.
    pub fn stored(&self) -> u64 {
        self.0.iter().map(|hits| hits.len().saturating_sub(1) as u64).sum()
    }

    /// Where the hits of `photon`, on the facets `found`, first differ from the true ones, if they
    /// do.
    pub fn part(&self, photon: u64, found: impl Iterator<Item = usize>) -> Option<PathParting> {
        let truth = &self.0[photon as usize];
        let mut found = found.fuse();
        (0..).find_map(|hit| match (truth.get(hit).copied(), found.next()) {
            (None, None) => Some(None),
            (is, was) if is == was => None,
            (is, was) => Some(Some(PathParting { hit, lost: is.is_some(), extra: was.is_some() })),
        })?
    }
}

/// The first hit at which a path is wrong. What follows from that hit means nothing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PathParting {
    /// Its number, from 0.
    pub hit: usize,
    /// Whether the path should have gone on to a facet, and did not hit it.
    pub lost: bool,
    /// Whether it hit a facet that it should not have hit. A wrong facet counts as both.
    pub extra: bool,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_part_at_the_first_hit_that_differs() {
        let paths = TruePaths(vec![vec![5, 2, 5]]);
        let part = |found: &[usize]| paths.part(0, found.iter().copied());
        let parting = |hit, lost, extra| Some(PathParting { hit, lost, extra });
        assert_eq!(paths.stored(), 2);
        assert_eq!(part(&[5, 2, 5]), None);
        assert_eq!(part(&[5, 2]), parting(2, true, false));
        assert_eq!(part(&[5, 2, 5, 1]), parting(3, false, true));
        assert_eq!(part(&[5, 1, 5]), parting(1, true, true));
        assert_eq!(part(&[]), parting(0, true, false));
    }
}
