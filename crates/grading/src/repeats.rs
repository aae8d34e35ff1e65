//! Photons that lie where another one does.

use super::limits::{BY_ROUNDING, FEW_PLACES, MOST_NEIGHBORS, SAME_PLACE};
use super::places::Place;
use glam::{DVec3, Vec3};
use photon_mapping::photon_list::PhotonRecord;

/// Positions that come more than once, to the last bit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Copies {
    /// The part of the photons that lie where another one does.
    pub all: f64,
    /// Of these, the part that has one of its copies beside it in the list.
    pub side_by_side: f64,
    /// The number of different positions, divided by that of the photons.
    pub places: f64,
}

impl Copies {
    /// Whether the list is a few places, each again and again, as when every photon draws the same
    /// numbers.
    pub fn are_few_places(&self) -> bool {
        self.places < FEW_PLACES
    }
}

/// Which part of `records` come more than once, to the last bit.
pub(super) fn copies(records: &[PhotonRecord]) -> Copies {
    // As one number, which is quicker to sort than three.
    let bits = |record: &PhotonRecord| {
        let coordinates = record.position.to_array().into_iter();
        coordinates.fold(0_u128, |all, x| all << 32 | u128::from(x.to_bits()))
    };
    let mut sorted: Vec<u128> = records.iter().map(bits).collect();
    sorted.sort_unstable();
    let all = in_runs(&sorted, |a, b| a == b);
    let side_by_side = in_runs(records, |a, b| bits(a) == bits(b));
    let places = sorted.chunk_by(|a, b| a == b).count() as f64;
    let records = records.len().max(1) as f64;
    Copies {
        all: all / records,
        side_by_side: side_by_side / all.max(1.0),
        places: places / records,
    }
}

/// How many of `all` stand beside one that is the `same`.
fn in_runs<T>(all: &[T], same: impl FnMut(&T, &T) -> bool) -> f64 {
    all.chunk_by(same).map(<[T]>::len).filter(|length| *length > 1).sum::<usize>() as f64
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
    let position = |index: u32| records[index as usize].position.as_dvec3();
    let mut sweep: Vec<(f64, u32)> = (0..)
        .zip(located)
        .filter(|(_, place)| matches!(place, Place::Cell { .. } | Place::Corner { .. }))
        .map(|(index, _)| (position(index).dot(way), index))
        .collect();
    sweep.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
    // In one piece: those abreast may stand anywhere in the list.
    let swept: Vec<Vec3> =
        sweep.iter().map(|(_, index)| records[*index as usize].position).collect();
    let mut repeats = vec![Repeat::No; records.len()];
    for (at, (along, index)) in sweep.iter().enumerate() {
        let abreast = sweep.iter().zip(&swept).skip(at + 1).take(MOST_NEIGHBORS);
        let near = abreast.take_while(|(other, _)| other.0 - along <= SAME_PLACE);
        let position = swept[at].as_dvec3();
        let mut closest = f64::INFINITY;
        for (_, other) in near {
            closest = closest.min(other.as_dvec3().distance_squared(position));
            if closest == 0.0 {
                break;
            }
        }
        repeats[*index as usize] = match closest {
            0.0 => Repeat::Exactly,
            squared if squared <= BY_ROUNDING.powi(2) => Repeat::ByRounding,
            squared if squared <= SAME_PLACE.powi(2) => Repeat::Closely,
            _ => Repeat::No,
        };
    }
    repeats
}
