//! Hits by facet and bounce, direct hits too, counted while tracing.

use std::ops::Range;

use rayon::prelude::*;

use photon_mapping::rendering::photon_mapping_renderer::PathVertex;
use variants::run::Run;

/// Photons a thread traces before it takes the next piece.
const PIECE: usize = 4096;

/// The surface hits of a path, after its light.
pub fn surface_hits(
    path: &[PathVertex],
) -> impl Iterator<Item = &photon_mapping::scene::ray::IntersectionState> {
    path.iter().filter_map(|vertex| match vertex {
        PathVertex::Light => None,
        PathVertex::Surface(state) => Some(state),
    })
}

/// Traces `photons` on all cores, shows every path to `look` together with a fresh `T` for each
/// piece of the work, and gives those in order.
pub fn look_at_paths<T: Default + Send>(
    run: &Run,
    photons: Range<u64>,
    look: impl Fn(&mut T, u64, &[PathVertex]) + Sync,
) -> Vec<T> {
    let pieces: Vec<_> = photons
        .clone()
        .step_by(PIECE)
        .map(|start| start..photons.end.min(start + PIECE as u64))
        .collect();
    let one_piece = |piece| {
        let mut found = T::default();
        run.trace_photons(piece, |photon, path, _| look(&mut found, photon, path));
        found
    };
    pieces.into_par_iter().map(one_piece).collect()
}

/// How many photons hit anything at their first hit, second hit, and so on, to the last that
/// counts; then how many were stored altogether.
pub fn hits_by_bounce<const HITS: usize>(run: &Run, photons: Range<u64>) -> ([u64; HITS], u64) {
    let pieces = look_at_paths(run, photons, |found: &mut (Vec<u64>, u64), _, path| {
        found.0.resize(HITS, 0);
        let hits = path.len() - 1;
        found.0.iter_mut().take(hits).for_each(|count| *count += 1);
        found.1 += hits.saturating_sub(1) as u64;
    });
    let mut hits = [0; HITS];
    let mut stored = 0;
    for piece in pieces {
        hits.iter_mut().zip(&piece.0).for_each(|(sum, count)| *sum += count);
        stored += piece.1;
    }
    (hits, stored)
}
