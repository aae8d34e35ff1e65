//! Tracing a list with all cores: by looking on while the renderer traces, piece by piece.

use std::ops::Range;

use super::in_order::in_order;
use super::record::PhotonRecord;
use crate::lanes::LaneTracer;
use crate::lanes::width::Width;
use crate::rendering::photon::Photon;
use crate::rendering::photon_mapping_renderer::{PathVertex, PhotonMappingRenderer};

/// How many photons a thread traces before it takes the next piece.
const PIECE: u64 = 4096;

/// Traces the photons numbered `photons` on all threads of the current rayon pool and hands their
/// records to `consume` in order, with the number of photons done so far: see [`in_order`].
///
/// # Errors
/// The first error of `consume`, which ends the tracing.
pub fn trace_list<E: Send>(
    renderer: &PhotonMappingRenderer,
    photons: Range<u64>,
    mut consume: impl FnMut(&[PhotonRecord], u64) -> Result<(), E> + Send,
) -> Result<(), E> {
    let lanes = LaneTracer::new(renderer, Width::widest());
    let trace = |piece: Range<u64>| match &lanes {
        Some(lanes) => lanes.trace_piece(piece),
        None => trace_piece(renderer, piece),
    };
    let pieces = photons.clone().step_by(PIECE as usize);
    let pieces = pieces.map(|start| start..photons.end.min(start + PIECE));
    in_order(
        pieces,
        |piece| (piece.end, trace(piece)),
        |(end, records)| consume(&records, end - photons.start),
    )
}

/// Traces the photons numbered `photons` on this thread.
pub fn trace_piece(renderer: &PhotonMappingRenderer, photons: Range<u64>) -> Vec<PhotonRecord> {
    let mut photon_map = Vec::new();
    let mut records = Vec::new();
    renderer.generic_photon_map_generation(&mut photon_map, photons, |photon, path, stored| {
        for (bounce, (vertex, stored)) in path.iter().skip(2).zip(stored).enumerate() {
            records.push(record(renderer, photon, bounce + 1, vertex, stored));
        }
    });
    records
}

fn record(
    renderer: &PhotonMappingRenderer,
    photon: u64,
    bounce: usize,
    vertex: &PathVertex,
    stored: &Photon,
) -> PhotonRecord {
    let PathVertex::Surface(state) = vertex else {
        unreachable!("a path has one light, at its start");
    };
    let surface = state.primitive(&renderer.stored_scene).parent_mesh_object;
    PhotonRecord {
        position: renderer.stored_scene.frame().to_world(stored.position),
        intensity: stored.intensity,
        to_light: stored.to_light_ray.ray_direction(),
        photon: u32::try_from(photon).expect("a run has fewer than 2^32 photons"),
        bounce: u16::try_from(bounce).expect("a photon bounces at most 1000 times"),
        surface: u16::try_from(surface).expect("a scene has fewer than 2^16 mesh objects"),
    }
}
