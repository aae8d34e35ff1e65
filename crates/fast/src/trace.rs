//! Photon lists on all cores, checked against the port.

use std::fmt;
use std::ops::Range;

use photon_mapping::photon_list::{PhotonRecord, records};
use photon_mapping::rendering::photon_mapping_renderer::PhotonMappingRenderer;
use rayon::prelude::*;

use crate::in_order::in_order;
use crate::lanes::LaneTracer;
use crate::lanes::width::Width;

/// How many photons a thread traces before it takes the next piece.
pub const PIECE: u64 = 16_384;
/// How many photons the port traces before their part of the photon map is forgotten. The map of a
/// whole piece would not fit the caches, and its memory would be asked for anew each time.
const PORT_PIECE: u64 = 256;
/// How many groups of photons are traced by the port too, spread evenly over the run.
const CHECKED_GROUPS: u64 = 64;
/// How many photons a group has.
const CHECKED_IN_GROUP: u64 = 64;

/// Where lanes and port differ first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FirstDifference {
    /// The number of the photon.
    pub photon: u64,
    /// How often it had bounced.
    pub bounce: u16,
    /// What differs there.
    pub what: &'static str,
}

impl fmt::Display for FirstDifference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { photon, bounce, what } = self;
        write!(f, "photon {photon}, bounce {bounce}: {what}")
    }
}

/// Traces the photons numbered `photons` on all threads of the current rayon pool. `consume` gets
/// their records in order, with the number of photons done so far: see [`in_order`].
///
/// Before that, a sample of the photons goes through lanes and port. If a bit differs, all photons
/// go through the port, and the difference is returned.
///
/// # Errors
/// The first error of `consume`, which ends the tracing.
pub fn trace_list<E: Send>(
    renderer: &PhotonMappingRenderer,
    photons: Range<u64>,
    mut consume: impl FnMut(&[PhotonRecord], u64) -> Result<(), E> + Send,
) -> Result<Option<FirstDifference>, E> {
    let lanes = LaneTracer::new(renderer, Width::widest());
    let difference = lanes.as_ref().and_then(|lanes| difference(renderer, lanes, &photons));
    let lanes = lanes.filter(|_| difference.is_none());
    let trace = |piece: Range<u64>| match &lanes {
        Some(lanes) => lanes.trace_piece(piece),
        None => trace_with_port(renderer, piece),
    };
    in_order(
        pieces(&photons),
        |piece| (piece.end, trace(piece)),
        |(end, records)| consume(&records, end - photons.start),
    )?;
    Ok(difference)
}

/// `photons` in pieces that a thread traces at once.
pub fn pieces(photons: &Range<u64>) -> impl Iterator<Item = Range<u64>> + Send + use<> {
    in_pieces_of(PIECE, photons)
}

fn in_pieces_of(
    size: u64,
    &Range { start, end }: &Range<u64>,
) -> impl Iterator<Item = Range<u64>> + Send + use<> {
    (start..end).step_by(size as usize).map(move |start| start..end.min(start + size))
}

/// Traces the photons numbered `photons` with `trace_photon`, on this thread.
pub fn trace_with_port(renderer: &PhotonMappingRenderer, photons: Range<u64>) -> Vec<PhotonRecord> {
    let (mut list, mut photon_map) = (Vec::new(), Vec::new());
    for piece in in_pieces_of(PORT_PIECE, &photons) {
        photon_map.clear();
        renderer.generic_photon_map_generation(&mut photon_map, piece, |photon, path, stored| {
            list.extend(records(&renderer.stored_scene, photon, path, stored));
        });
    }
    list
}

/// The first difference between `lanes` and the port in a sample of `photons`.
fn difference(
    renderer: &PhotonMappingRenderer,
    lanes: &LaneTracer,
    photons: &Range<u64>,
) -> Option<FirstDifference> {
    let count = photons.end - photons.start;
    let step = (count / CHECKED_GROUPS).max(CHECKED_IN_GROUP);
    let starts: Vec<u64> = photons.clone().step_by(step as usize).collect();
    starts.into_par_iter().find_map_first(|start| {
        let group = start..photons.end.min(start + CHECKED_IN_GROUP);
        first_difference(&lanes.trace_piece(group.clone()), &trace_with_port(renderer, group))
    })
}

fn first_difference(
    of_lanes: &[PhotonRecord],
    of_port: &[PhotonRecord],
) -> Option<FirstDifference> {
    let rows = |list: &[PhotonRecord]| list.iter().map(PhotonRecord::to_row).collect::<Vec<_>>();
    let (lanes_rows, port_rows) = (rows(of_lanes), rows(of_port));
    let same = lanes_rows.iter().zip(&port_rows).take_while(|(a, b)| a == b).count();
    let place = |record: &PhotonRecord| (record.photon, record.bounce);
    let (record, what) = match (of_lanes.get(same), of_port.get(same)) {
        (None, None) => return None,
        (Some(lanes), Some(port)) if place(lanes) == place(port) => {
            let bits = |a: glam::Vec3, b: glam::Vec3| {
                a.to_array().map(f32::to_bits) != b.to_array().map(f32::to_bits)
            };
            let what = if bits(lanes.to_light, port.to_light) {
                "the direction"
            } else if lanes.surface != port.surface {
                "the surface hit"
            } else if bits(lanes.position, port.position) {
                "the point hit"
            } else {
                "the intensity"
            };
            (port, what)
        }
        (Some(lanes), Some(port)) if place(lanes) < place(port) => {
            (lanes, "not stored by the port")
        }
        (Some(lanes), None) => (lanes, "not stored by the port"),
        (_, Some(port)) => (port, "stored only by the port"),
    };
    Some(FirstDifference { photon: record.photon.into(), bounce: record.bounce, what })
}

#[cfg(test)]
mod tests {
    use photon_mapping::assignment8;

    use super::*;

    #[test]
    fn a_difference_is_found_and_the_port_decides() {
        // Lanes of another run stand for a port that was edited.
        let mut renderer = assignment8::create_renderer(assignment8::create_scene());
        let other = PhotonMappingRenderer { max_photon_bounces: 1, ..renderer.clone() };
        let lanes = LaneTracer::new(&other, Width::widest()).unwrap();
        let found = difference(&renderer, &lanes, &(0..1_000_000)).unwrap();
        assert_eq!((found.bounce, found.what), (2, "stored only by the port"));
        renderer.max_photon_bounces = 0;
        let found = difference(&renderer, &lanes, &(0..1_000_000)).unwrap();
        assert_eq!((found.bounce, found.what), (1, "not stored by the port"));
        renderer.max_photon_bounces = 1;
        assert_eq!(difference(&renderer, &lanes, &(0..1_000_000)), None);
    }
}
