//! Lists that have the same rows, in whatever order.

use std::hash::{BuildHasher, RandomState};

use rayon::prelude::*;

use photon_list::reader::PhotonList;
use photon_list::record::{ABSENT, Columns};
use photon_mapping::photon_list::PhotonRecord;

/// So many rows are summed at a time.
const PIECE: usize = 65_536;

/// Whether both lists have the same bits.
pub fn has_same_bits(a: &PhotonList, b: &PhotonList) -> bool {
    a.columns == b.columns
        && a.records.len() == b.records.len()
        && a.records.iter().zip(&b.records).all(|(a, b)| a.to_row() == b.to_row())
}

/// Whether the positions come in the same order.
pub fn has_same_order(a: &PhotonList, b: &PhotonList) -> bool {
    let bits = |record: &PhotonRecord| record.position.to_array().map(f32::to_bits);
    a.records.iter().map(bits).eq(b.records.iter().map(bits))
}

/// Whether both lists have the same rows, in any order, as far as both have the columns. No memory
/// is taken for that: the sums of two keyed hashes of all rows are compared.
pub fn has_same_rows(a: &PhotonList, b: &PhotonList) -> bool {
    let common = common(a.columns, b.columns);
    let keys = [RandomState::new(), RandomState::new()];
    let hashes = |record: &PhotonRecord| {
        let row = only(common, record).to_row();
        [0, 1].map(|key: usize| keys[key].hash_one(row))
    };
    let sum = |list: &PhotonList| {
        let add = |a: [u64; 2], b: [u64; 2]| [a[0].wrapping_add(b[0]), a[1].wrapping_add(b[1])];
        let of_piece = |piece: &[PhotonRecord]| piece.iter().map(hashes).fold([0; 2], add);
        let pieces: Vec<_> = list.records.par_chunks(PIECE).map(of_piece).collect();
        pieces.into_iter().fold([0; 2], add)
    };
    a.records.len() == b.records.len() && sum(a) == sum(b)
}

fn common(a: Columns, b: Columns) -> Columns {
    Columns {
        intensity: a.intensity && b.intensity,
        to_light: a.to_light && b.to_light,
        photon: a.photon && b.photon,
        bounce: a.bounce && b.bounce,
        // Nothing is said of surfaces.
        surface: false,
    }
}

/// `record` without what is not in `columns`.
fn only(columns: Columns, record: &PhotonRecord) -> PhotonRecord {
    let mut only = ABSENT;
    only.position = record.position;
    if columns.intensity {
        only.intensity = record.intensity;
    }
    if columns.to_light {
        only.to_light = record.to_light;
    }
    if columns.photon {
        only.photon = record.photon;
    }
    if columns.bounce {
        only.bounce = record.bounce;
    }
    only
}
