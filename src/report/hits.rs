//! Hits by facet and bounce, direct hits too, counted by looking on.

use std::ops::Range;

use rayon::prelude::*;

use crate::rendering::photon_mapping_renderer::{PathVertex, PhotonMappingRenderer};
use crate::scene::Scene;
use crate::scene::triangle::Triangle;

/// Photons a thread traces before it takes the next piece.
const PIECE: usize = 4096;

/// For every triangle of `scene` the number of its facet, from 0 over the whole scene, in the order
/// of the oracle's table.
pub fn facet_of_triangles(scene: &Scene) -> Vec<usize> {
    let id = |triangle: &Triangle| (triangle.parent_mesh_object, triangle.facet);
    let mut facet = 0;
    let mut last = None;
    let mut facets = Vec::new();
    for triangle in scene.triangles() {
        facet += usize::from(last.is_some_and(|last| last != id(triangle)));
        last = Some(id(triangle));
        facets.push(facet);
    }
    facets
}

/// The surface hits of a path, after its light.
pub fn surface_hits(
    path: &[PathVertex],
) -> impl Iterator<Item = &crate::scene::intersection_state::IntersectionState> {
    path.iter().filter_map(|vertex| match vertex {
        PathVertex::Light => None,
        PathVertex::Surface(state) => Some(state),
    })
}

/// Traces `photons` on all cores, shows every path to `look` together with a fresh `T` for each
/// piece of the work, and gives those in order.
pub fn look_at_paths<T: Default + Send>(
    renderer: &PhotonMappingRenderer,
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
        let mut photon_map = Vec::new();
        renderer.generic_photon_map_generation(&mut photon_map, piece, |photon, path, _| {
            look(&mut found, photon, path);
        });
        found
    };
    pieces.into_par_iter().map(one_piece).collect()
}

/// How many photons hit anything at their first hit, second hit, and so on, to the last that
/// counts; then how many were stored altogether.
pub fn hits_by_bounce<const HITS: usize>(
    renderer: &PhotonMappingRenderer,
    photons: Range<u64>,
) -> ([u64; HITS], u64) {
    let pieces = look_at_paths(renderer, photons, |found: &mut (Vec<u64>, u64), _, path| {
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
