//! Lists that say the same in other words: other axes, photons counted from another number.

use std::borrow::Cow;
use std::collections::HashMap;

use glam::{Mat3, Vec3};

use super::alignment::Pairing;
use super::numbers::thousands;
use super::position_index::{PositionIndex, is_near};
use photon_list::reader::PhotonList;

/// So many records are tried.
const PROBES: usize = 200;
/// Fewer prove nothing.
const FEWEST: usize = 20;

/// `submission` in the reference's axes and numbers, and what was done to it.
///
/// Axes are changed only where most records match afterwards, and twice as many as before;
/// photons are renumbered only where hardly any record matches as it stands.
pub fn to_reference<'list>(
    reference: &PhotonList,
    submission: &'list PhotonList,
    tolerance: f32,
) -> (Cow<'list, PhotonList>, Vec<String>) {
    let mut notes = Vec::new();
    let mut list = Cow::Borrowed(submission);
    if let Some((axes, name)) = other_axes(reference, submission, tolerance) {
        let changed = list.to_mut();
        for record in &mut changed.records {
            record.position = axes * record.position;
            record.to_light = axes * record.to_light;
        }
        notes.push(name);
    }
    if let Some(shift) = photon_shift(reference, &list, tolerance) {
        for record in &mut list.to_mut().records {
            record.photon = record.photon.saturating_add_signed(shift);
        }
        let by = shift.unsigned_abs();
        let way = if shift < 0 {
            "counted from a larger number"
        } else {
            "counted from a smaller number"
        };
        notes.push(format!("photon is shifted by {by} ({way}); compared as the reference counts"));
    }
    (list, notes)
}

/// Up to [`PROBES`] things, spread over all.
fn probes<T>(all: &[T]) -> impl Iterator<Item = &T> {
    all.iter().step_by(all.len() / PROBES + 1)
}

/// The axes in which the submission has the reference's positions, if not the reference's own.
fn other_axes(
    reference: &PhotonList,
    submission: &PhotonList,
    tolerance: f32,
) -> Option<(Mat3, String)> {
    let index = PositionIndex::new(&reference.records, tolerance);
    let all: Vec<_> = probes(&submission.records).map(|record| record.position).collect();
    let matched = |axes: &Mat3| {
        let is_found = |position: &&Vec3| {
            position.is_finite() && !index.near(*axes * **position, 0).is_empty()
        };
        all.iter().filter(is_found).count()
    };
    // Photons on the floor stay where they are if only z is turned round.
    let unchanged = matched(&Mat3::IDENTITY);
    if all.len() < FEWEST || 2 * unchanged > all.len() {
        return None;
    }
    let orders = [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]];
    let every = orders.into_iter().flat_map(|order| {
        (0..8).map(move |signs| {
            let sign = |axis: usize| if signs >> axis & 1 == 1 { -1.0 } else { 1.0 };
            (order, [sign(0), sign(1), sign(2)])
        })
    });
    let (order, signs) =
        every.into_iter().max_by_key(|(order, signs)| matched(&matrix(*order, *signs)))?;
    let axes = matrix(order, signs);
    let found = matched(&axes);
    if 2 * found < all.len() || found < 2 * unchanged {
        return None;
    }
    let names = ["x", "y", "z"];
    let parts: [String; 3] = std::array::from_fn(|axis| {
        let sign = if signs[axis] < 0.0 { "-" } else { "" };
        format!("{sign}{}", names[order[axis]])
    });
    let kind = match (order, signs) {
        ([0, 2, 1], [_, -1.0, 1.0]) => "axes are y-up",
        _ => "axes are others",
    };
    let note = format!(
        "{kind}: ({}) of the list is (x, y, z) of the reference; compared in the reference's axes",
        parts.join(", ")
    );
    Some((axes, note))
}

/// The matrix that gives axis `i` the coordinate number `order[i]`, times `signs[i]`.
fn matrix(order: [usize; 3], signs: [f32; 3]) -> Mat3 {
    let row = |axis: usize| signs[axis] * [Vec3::X, Vec3::Y, Vec3::Z][order[axis]];
    Mat3::from_cols(row(0), row(1), row(2)).transpose()
}

/// What to add to the submission's photon numbers, so that most records have the reference's.
fn photon_shift(reference: &PhotonList, submission: &PhotonList, tolerance: f32) -> Option<i32> {
    if !(reference.columns.photon && submission.columns.photon) {
        return None;
    }
    let all: Vec<_> = probes(&submission.records).collect();
    let matched = |shift: i32| {
        let mut wanted: HashMap<u32, Vec<(Vec3, bool)>> = HashMap::new();
        for record in &all {
            if let Some(number) = record.photon.checked_add_signed(shift) {
                wanted.entry(number).or_default().push((record.position, false));
            }
        }
        for record in &reference.records {
            for (position, is_found) in wanted.get_mut(&record.photon).into_iter().flatten() {
                *is_found |= is_near(record.position, *position, tolerance);
            }
        }
        wanted.values().flatten().filter(|(_, is_found)| *is_found).count()
    };
    if all.len() < FEWEST || 10 * matched(0) > all.len() {
        return None;
    }
    // The shift of the first record that is found anywhere says which shifts are worth a trial.
    let index = PositionIndex::new(&reference.records, tolerance);
    let shifts = all.iter().filter(|record| record.position.is_finite()).filter_map(|record| {
        let place = *index.near(record.position, 0).first()?;
        let shift = i64::from(reference.records[place].photon) - i64::from(record.photon);
        i32::try_from(shift).ok()
    });
    shifts.take(10).find(|shift| *shift != 0 && 2 * matched(*shift) > all.len())
}

/// In how many of the records that both have, 'bounce' differs: it tells nothing of where a photon
/// is, so the lists may be the same.
pub fn other_bounces(
    reference: &PhotonList,
    submission: &PhotonList,
    pairings: &[Pairing],
) -> Option<String> {
    if !(reference.columns.bounce && submission.columns.bounce) {
        return None;
    }
    let is_other = |pairing: &&Pairing| match **pairing {
        Pairing::Both(i, j) => reference.records[i].bounce != submission.records[j].bounce,
        _ => false,
    };
    let other = pairings.iter().filter(is_other).count() as u64;
    let records = thousands(other);
    (other > 0).then(|| {
        format!(
            "'bounce' differs in {records} records: the reference counts the bounces made, from 1 \
             on"
        )
    })
}
