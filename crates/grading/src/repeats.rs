//! Photons that lie where another one does.

use std::collections::HashMap;

use super::limits::{BY_ROUNDING, MOST_NEIGHBOURS, SAME_PLACE};
use super::places::Place;
use glam::DVec3;
use photon_mapping::photon_list::PhotonRecord;

/// Positions that come more than once, to the last bit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Copies {
    /// The part of the photons that lie where another one does.
    pub all: f64,
    /// Of these, the part that has one of its copies beside it in the list.
    pub side_by_side: f64,
}

/// Which part of `records` come more than once, to the last bit.
pub(super) fn copies(records: &[PhotonRecord]) -> Copies {
    let bits = |record: &PhotonRecord| record.position.to_array().map(f32::to_bits);
    let mut counts = HashMap::new();
    records.iter().for_each(|record| *counts.entry(bits(record)).or_insert(0_u32) += 1);
    let all = records.iter().filter(|record| counts[&bits(record)] > 1).count() as f64;
    let runs = records.chunk_by(|a, b| bits(a) == bits(b)).map(<[_]>::len);
    let side_by_side: usize = runs.filter(|length| *length > 1).sum();
    Copies {
        all: all / records.len().max(1) as f64,
        side_by_side: side_by_side as f64 / all.max(1.0),
    }
}

/// Whether a photon lies where another one does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Repeat {
    No,
    /// Within [`SAME_PLACE`].
    Closely,
    /// Within [`BY_ROUNDING`].
    ByRounding,
    Exactly,
}

/// Whether most of the photons that repeat another one are no farther from it than rounding.
pub(super) fn are_by_rounding(repeats: &[Repeat]) -> bool {
    let count = |wanted| repeats.iter().filter(|repeat| **repeat == wanted).count();
    count(Repeat::Exactly) + count(Repeat::ByRounding) > count(Repeat::Closely)
}

/// Which photons have another one at the same place that comes after them on a sweep.
pub(super) fn repeats(records: &[PhotonRecord], located: &[Place]) -> Vec<Repeat> {
    // Askew to all facets, so that few photons are abreast.
    let way = DVec3::new(0.5342, 0.6171, 0.5777);
    let mut sweep: Vec<(f64, DVec3, usize)> = Vec::new();
    for (index, (record, place)) in records.iter().zip(located).enumerate() {
        if matches!(place, Place::Cell { .. } | Place::Corner { .. }) {
            let position = record.position.as_dvec3();
            sweep.push((position.dot(way), position, index));
        }
    }
    sweep.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
    let mut repeats = vec![Repeat::No; records.len()];
    for (at, (along, position, index)) in sweep.iter().enumerate() {
        let abreast = sweep[at + 1..].iter().take(MOST_NEIGHBOURS);
        let near = abreast.take_while(|other| other.0 - along <= SAME_PLACE);
        let closest = near.map(|other| other.1.distance_squared(*position)).reduce(f64::min);
        repeats[*index] = match closest {
            Some(0.0) => Repeat::Exactly,
            Some(squared) if squared <= BY_ROUNDING.powi(2) => Repeat::ByRounding,
            Some(squared) if squared <= SAME_PLACE.powi(2) => Repeat::Closely,
            _ => Repeat::No,
        };
    }
    repeats
}
