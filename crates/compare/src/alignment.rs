//! Which record of one list belongs to which of the other.

use std::borrow::Cow;
use std::collections::HashMap;
use std::ops::Range;

use glam::Vec3;

use super::common_subsequence::common_subsequence;
use super::differences::same_to_light;
use super::partners::{ALONE, partners};
use super::position_index::{PositionIndex, is_near};
use photon_list::reader::PhotonList;
use photon_mapping::photon_list::PhotonRecord;

/// A record of the reference (the first number) and of the submission (the second), by their places
/// in the lists, that belong together; or one that has no counterpart.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pairing {
    /// Both lists have the record; it need not be in the same place.
    Both(usize, usize),
    /// Only the reference has it.
    Missing(usize),
    /// Only the submission has it.
    Extra(usize),
}

/// Pairs the records of two lists, in the reference's order.
///
/// Lists that both tell the emitted photon are paired photon by photon, and within a photon by
/// bounce where both tell it (see [`with_bounces`]); unless more records of that photon come to lie
/// upon each other when paired by order, as they do when a submission counts from another bounce.
/// All other lists are paired by order: the longest sequence of records, in the order of both
/// lists, that lie within `tolerance` world units of each other, stays together, and what lies
/// between is paired one by one; unless far more records match when their order is passed over, as
/// in a list that comes out of a tree. So a missing or extra record puts nothing out of step. Time
/// grows as n log n.
pub fn align(reference: &PhotonList, submission: &PhotonList, tolerance: f32) -> Vec<Pairing> {
    let lists = AlignedLists { reference, submission, tolerance };
    if !(reference.columns.photon && submission.columns.photon) {
        let all = |list: &PhotonList| (0..list.records.len()).collect::<Vec<_>>();
        let reordered = lists.are_reordered().then(|| lists.by_place(0)).flatten();
        let mut pairings = reordered.unwrap_or_else(|| {
            let by_order = lists.by_order(&all(reference), &all(submission));
            lists.by_place(lists.near_pairs(&by_order)).unwrap_or(by_order)
        });
        lists.uncross(&mut pairings);
        return pairings;
    }
    let (reference_order, submission_order) = (sorted(reference), sorted(submission));
    let mut pairings = Vec::new();
    let (mut i, mut j) = (0, 0);
    while i < reference_order.len() || j < submission_order.len() {
        let photons = (
            reference_order.get(i).map(|place| reference.records[*place].photon),
            submission_order.get(j).map(|place| submission.records[*place].photon),
        );
        let photon = match photons {
            (Some(a), Some(b)) => a.min(b),
            (a, b) => a.or(b).unwrap_or_default(),
        };
        let of_reference = group(&reference.records, &reference_order, i, photon);
        let of_submission = group(&submission.records, &submission_order, j, photon);
        (i, j) = (of_reference.end, of_submission.end);
        lists.one_photon(
            &reference_order[of_reference],
            &submission_order[of_submission],
            &mut pairings,
        );
    }
    pairings
}

/// The list with bounces where it tells only the photon: 1, 2, 3 in the order of its records, as if
/// each photon's first hit, and only that one, were left out.
pub fn with_bounces(list: &PhotonList) -> Cow<'_, PhotonList> {
    if !list.columns.photon || list.columns.bounce {
        return Cow::Borrowed(list);
    }
    let mut numbered = list.clone();
    numbered.columns.bounce = true;
    let mut bounces: HashMap<u32, u16> = HashMap::new();
    for record in &mut numbered.records {
        let bounce = bounces.entry(record.photon).or_default();
        *bounce = bounce.saturating_add(1);
        record.bounce = *bounce;
    }
    Cow::Owned(numbered)
}

/// The places of a list's records in order of photon, then bounce.
fn sorted(list: &PhotonList) -> Vec<usize> {
    let mut places: Vec<_> = (0..list.records.len()).collect();
    // Absent bounces are all alike, and leave records in their order.
    places.sort_unstable_by_key(|place| {
        let record = &list.records[*place];
        (record.photon, record.bounce, *place)
    });
    places
}

/// The records from place `start` of `order` on that belong to `photon`.
fn group(records: &[PhotonRecord], order: &[usize], start: usize, photon: u32) -> Range<usize> {
    let belongs = |place: &&usize| records[**place].photon == photon;
    start..start + order[start..].iter().take_while(belongs).count()
}

struct AlignedLists<'lists> {
    reference: &'lists PhotonList,
    submission: &'lists PhotonList,
    tolerance: f32,
}

impl AlignedLists<'_> {
    /// Pairs the records of one photon, given by their places in the lists.
    fn one_photon(&self, reference: &[usize], submission: &[usize], out: &mut Vec<Pairing>) {
        if !(self.reference.columns.bounce && self.submission.columns.bounce) {
            out.extend(self.by_order(reference, submission));
            return;
        }
        let by_bounce = self.by_bounce(reference, submission);
        if self.near_pairs(&by_bounce) == reference.len().min(submission.len()) {
            out.extend(by_bounce);
            return;
        }
        let by_order = self.by_order(reference, submission);
        let order_is_better = self.near_pairs(&by_order) > self.near_pairs(&by_bounce);
        out.extend(if order_is_better { by_order } else { by_bounce });
    }

    fn by_bounce(&self, reference: &[usize], submission: &[usize]) -> Vec<Pairing> {
        let mut pairings = Vec::new();
        let (mut i, mut j) = (0, 0);
        while i < reference.len() || j < submission.len() {
            let a = reference.get(i).map(|place| self.reference.records[*place].bounce);
            let b = submission.get(j).map(|place| self.submission.records[*place].bounce);
            if a == b {
                pairings.push(Pairing::Both(reference[i], submission[j]));
                (i, j) = (i + 1, j + 1);
            } else if b.is_none() || a.is_some_and(|a| b.is_some_and(|b| a < b)) {
                pairings.push(Pairing::Missing(reference[i]));
                i += 1;
            } else {
                pairings.push(Pairing::Extra(submission[j]));
                j += 1;
            }
        }
        pairings
    }

    /// Whether long lists have hardly any order in common, which takes long to find out for all.
    fn are_reordered(&self) -> bool {
        const LONG: usize = 100_000;
        const PROBES: usize = 1000;
        let [reference, submission] = [self.reference, self.submission].map(|list| &list.records);
        if reference.len().min(submission.len()) < LONG {
            return false;
        }
        let index = PositionIndex::new(reference, self.tolerance);
        let probes = submission.iter().enumerate().step_by(submission.len() / PROBES);
        let places = probes.filter_map(|(j, record)| {
            let near = index.near(record.position, j);
            near.into_iter().min_by_key(|i| i.abs_diff(j))
        });
        // Of the longest ascending sequences of each length, the last place.
        let (mut ends, mut found) = (Vec::new(), 0);
        for place in places {
            found += 1;
            match ends.partition_point(|end| *end < place) {
                longest if longest == ends.len() => ends.push(place),
                length => ends[length] = place,
            }
        }
        2 * ends.len() < found
    }

    /// Pairs records whatever their order is, each with one that lies near it; `None` when that is
    /// no clear gain over the pairs that are near each other `in_order`.
    fn by_place(&self, in_order: usize) -> Option<Vec<Pairing>> {
        let (reference, submission) = (&self.reference.records, &self.submission.records);
        let most = reference.len().min(submission.len());
        if in_order == most {
            return None;
        }
        let partners = partners(&PositionIndex::new(reference, self.tolerance), submission);
        let found = partners.iter().filter(|partner| **partner != ALONE).count();
        let is_all = found == reference.len() && found == submission.len();
        if !is_all && (2 * found < most || 4 * in_order > 3 * found) {
            return None;
        }
        let mut is_extra = vec![true; submission.len()];
        for partner in partners.iter().filter(|partner| **partner != ALONE) {
            is_extra[*partner as usize] = false;
        }
        let extra = is_extra.into_iter().enumerate().filter(|(_, is_extra)| *is_extra);
        let of_reference = partners.into_iter().enumerate().map(|(i, partner)| match partner {
            ALONE => Pairing::Missing(i),
            j => Pairing::Both(i, j as usize),
        });
        Some(of_reference.chain(extra.map(|(j, _)| Pairing::Extra(j))).collect())
    }

    /// Pairs records that lie upon each other by their directions to the light, where both lists
    /// have them.
    fn uncross(&self, pairings: &mut [Pairing]) {
        if !(self.reference.columns.to_light && self.submission.columns.to_light) {
            return;
        }
        let fits = |i: usize, j: usize| {
            let (a, b) = (&self.reference.records[i], &self.submission.records[j]);
            is_near(a.position, b.position, self.tolerance) && same_to_light(a, b)
        };
        let crossed: Vec<_> = (0..pairings.len())
            .filter(|at| matches!(pairings[*at], Pairing::Both(i, j) if !fits(i, j)))
            .collect();
        let positions: Vec<_> = crossed
            .iter()
            .map(|at| match pairings[*at] {
                Pairing::Both(_, j) => self.submission.records[j].position,
                _ => Vec3::NAN,
            })
            .collect();
        let index = PositionIndex::new(&positions, self.tolerance);
        for (at, place) in crossed.iter().enumerate() {
            let Pairing::Both(i, j) = pairings[*place] else { continue };
            if fits(i, j) {
                continue;
            }
            for other in index.near(self.reference.records[i].position, at) {
                let Pairing::Both(k, l) = pairings[crossed[other]] else { continue };
                if fits(i, l) && !fits(k, l) {
                    pairings[*place] = Pairing::Both(i, l);
                    pairings[crossed[other]] = Pairing::Both(k, j);
                    break;
                }
            }
        }
    }

    fn near_pairs(&self, pairings: &[Pairing]) -> usize {
        let is_near = |pairing: &&Pairing| match **pairing {
            Pairing::Both(i, j) => is_near(
                self.reference.records[i].position,
                self.submission.records[j].position,
                self.tolerance,
            ),
            _ => false,
        };
        pairings.iter().filter(is_near).count()
    }

    fn by_order(&self, reference: &[usize], submission: &[usize]) -> Vec<Pairing> {
        let position = |list: &PhotonList, places: &[usize]| -> Vec<Vec3> {
            places.iter().map(|place| list.records[*place].position).collect()
        };
        let anchors = common_subsequence(
            &position(self.reference, reference),
            &position(self.submission, submission),
            self.tolerance,
        );
        let mut pairings = Vec::new();
        let (mut i, mut j) = (0, 0);
        let end = (reference.len(), submission.len());
        for (anchor_i, anchor_j) in anchors.into_iter().chain([end]) {
            while i < anchor_i && j < anchor_j {
                pairings.push(Pairing::Both(reference[i], submission[j]));
                (i, j) = (i + 1, j + 1);
            }
            pairings.extend(reference[i..anchor_i].iter().map(|place| Pairing::Missing(*place)));
            pairings.extend(submission[j..anchor_j].iter().map(|place| Pairing::Extra(*place)));
            if (anchor_i, anchor_j) != end {
                pairings.push(Pairing::Both(reference[anchor_i], submission[anchor_j]));
            }
            (i, j) = (anchor_i + 1, anchor_j + 1);
        }
        pairings
    }
}
