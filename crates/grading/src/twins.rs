//! Lists with the same photons, also if they are rounded, reordered or numbered anew.

use crate::limits::twins::{FEWEST, KEPT, LARGE_CELL, MOST_IN_LARGE_CELLS, SAME, SMALL_CELL};
use std::collections::BTreeSet;

use glam::Vec3;
use photon_mapping::photon_list::PhotonRecord;

/// What tells the photons of a list from others'.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fingerprint {
    records: usize,
    large: Vec<u64>,
    small: Vec<u64>,
}

impl Fingerprint {
    /// That of `records`; none where they lie in too few places to tell.
    pub fn of(records: &[PhotonRecord]) -> Option<Self> {
        let large = smallest(records, LARGE_CELL);
        let small = smallest(records, SMALL_CELL);
        (large.len() >= FEWEST).then_some(Self { records: records.len(), large, small })
    }

    /// Whether the two have more in common than two runs.
    pub fn is_like(&self, other: &Self) -> bool {
        match self.records.max(other.records) > MOST_IN_LARGE_CELLS {
            true => shared(&self.small, &other.small) >= SAME,
            false => shared(&self.large, &other.large) >= SAME,
        }
    }
}

/// The smallest hashes of cells of this `size` that have photons in them, in ascending order.
fn smallest(records: &[PhotonRecord], size: f32) -> Vec<u64> {
    let mut kept = BTreeSet::new();
    for record in records.iter().filter(|record| record.position.is_finite()) {
        let hash = hash(record.position, size);
        if kept.len() < KEPT || kept.last().is_some_and(|last| hash < *last) {
            kept.insert(hash);
            if kept.len() > KEPT {
                kept.pop_last();
            }
        }
    }
    kept.into_iter().collect()
}

fn hash(position: Vec3, size: f32) -> u64 {
    // The middle of a cell is a rounded number, which rounding leaves where it is.
    let cell = (position / size).round().to_array();
    cell.into_iter().fold(0, |hash: u64, coordinate| {
        // Steele, Lea, Flood: "Fast Splittable Pseudorandom Number Generators" (2014), figure 14.
        let mixed = (hash ^ (coordinate as i64 as u64)).wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mixed = (mixed ^ (mixed >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        mixed ^ (mixed >> 31)
    })
}

/// Which part of the cells of both is in both, estimated from the smallest hashes.
fn shared(a: &[u64], b: &[u64]) -> f64 {
    let (mut i, mut j) = (0, 0);
    let (mut all, mut both) = (0, 0);
    while all < KEPT && (i < a.len() || j < b.len()) {
        let [of_a, of_b] = [a.get(i), b.get(j)].map(|hash| hash.copied().unwrap_or(u64::MAX));
        all += 1;
        both += usize::from(of_a == of_b);
        i += usize::from(of_a <= of_b);
        j += usize::from(of_b <= of_a);
    }
    both as f64 / all.max(1) as f64
}

/// For each of `all`, which others have the same photons.
pub fn twins(all: &[Option<&Fingerprint>]) -> Vec<Vec<usize>> {
    let is_like = |at: usize, other: usize| match (all[at], all[other]) {
        (Some(one), Some(other)) => one.is_like(other),
        _ => false,
    };
    let others = |at: usize| (0..all.len()).filter(move |other| *other != at);
    (0..all.len()).map(|at| others(at).filter(|other| is_like(at, *other)).collect()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn list(seed: u64, photons: u64) -> Vec<PhotonRecord> {
        fixtures::list(&fixtures::handout(seed, photons))
    }

    fn moved(records: &[PhotonRecord], by: impl Fn(f32) -> f32) -> Vec<PhotonRecord> {
        let moved = |record: &PhotonRecord| PhotonRecord {
            position: Vec3::from_array(record.position.to_array().map(&by)),
            ..*record
        };
        records.iter().map(moved).collect()
    }

    fn are_like(a: &[PhotonRecord], b: &[PhotonRecord]) -> bool {
        Fingerprint::of(a).unwrap().is_like(&Fingerprint::of(b).unwrap())
    }

    #[test]
    fn same_photons_in_another_guise_are_twins() {
        for photons in [20_000, 1_000_000, 4_000_000] {
            let all = list(1, photons);
            let mut reversed = all.clone();
            reversed.reverse();
            reversed.iter_mut().for_each(|record| record.photon += 1);
            let rounded = |digits: f32| moved(&all, |number| (number * digits).round() / digits);
            let most = all[all.len() / 3..].to_vec();
            for other in [reversed, rounded(1000.0), rounded(1e5), most] {
                assert!(are_like(&all, &other), "{photons}");
            }
            if photons <= 1_000_000 {
                assert!(are_like(&all, &rounded(100.0)), "{photons}");
            }
            assert!(!are_like(&all, &list(2, photons)), "{photons}");
        }
    }

    #[test]
    fn few_places_say_nothing() {
        let one_place = moved(&list(1, 2000), |_| 0.5);
        assert_eq!(Fingerprint::of(&one_place), None);
        assert_eq!(Fingerprint::of(&[]), None);
    }
}
