//! Lists with the same photons, also if they are rounded, reordered or numbered anew.

use std::collections::BTreeSet;

use glam::Vec3;
use photon_mapping::photon_list::PhotonRecord;

/// Of the cells that a list's photons lie in, so many with the smallest hashes stand for all.
const KEPT: usize = 1024;
/// Fewer different cells say nothing, nor do fewer that two lists share.
const FEWEST: usize = 20;
const FEWEST_SHARED: usize = 10;
/// The size of cells, which rounding to two, three or four digits leaves as they are. In larger
/// cells, long lists are all alike.
const LARGE_CELL: f32 = 1e-2;
const SMALL_CELL: f32 = 1e-3;
const TINY_CELL: f32 = 1e-4;
/// Longer lists are compared in small cells alone.
const MOST_IN_LARGE_CELLS: usize = 60_000;
/// Of all cells that one of two lists has, this part is in both only if they have the same
/// photons. Two runs of MOST_IN_LARGE_CELLS records share 0.32 of the large cells.
const SAME: f64 = 0.45;
/// Of the small cells of the shorter list, the other has this part only if it has part of its
/// photons. Two runs of MOST_FOR_PART records share 0.03. Of tiny cells, lists of any length do:
/// where photons lie densest, one in a unit of area for each that is stored, two of 5,000,000
/// records share 0.05.
const PART: f64 = 0.2;
const MOST_FOR_PART: usize = 300_000;

/// What tells the photons of a list from others'.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fingerprint {
    records: usize,
    large: Vec<u64>,
    small: Vec<u64>,
    tiny: Vec<u64>,
}

impl Fingerprint {
    /// That of `records`; none where they lie in too few places to tell.
    pub fn of(records: &[PhotonRecord]) -> Option<Self> {
        let [large, small, tiny] =
            [LARGE_CELL, SMALL_CELL, TINY_CELL].map(|size| smallest(records, size));
        (large.len() >= FEWEST).then_some(Self { records: records.len(), large, small, tiny })
    }

    /// Whether the two have more in common than two runs.
    pub fn is_like(&self, other: &Self) -> bool {
        let longer = self.records.max(other.records);
        let small = shared(&self.small, &other.small);
        small.of_all >= SAME
            || longer <= MOST_FOR_PART && small.of_fewer >= PART
            || shared(&self.tiny, &other.tiny).of_fewer >= PART
            || longer <= MOST_IN_LARGE_CELLS && shared(&self.large, &other.large).of_all >= SAME
    }
}

/// The smallest hashes of cells of this `size` that have photons in them, in ascending order.
fn smallest(records: &[PhotonRecord], size: f32) -> Vec<u64> {
    let mut kept = BTreeSet::new();
    let mut largest = u64::MAX;
    let mut before = Vec3::NAN;
    for record in records {
        // Lists of one place, again and again, are long.
        if record.position == before || !record.position.is_finite() {
            continue;
        }
        before = record.position;
        let hash = hash(before, size);
        if hash <= largest {
            kept.insert(hash);
            if kept.len() > KEPT {
                kept.pop_last();
            }
            if kept.len() == KEPT
                && let Some(last) = kept.last()
            {
                largest = *last;
            }
        }
    }
    kept.into_iter().collect()
}

fn hash(position: Vec3, size: f32) -> u64 {
    // The middle of a cell is a rounded number, which rounding leaves where it is.
    let [x, y, z] = (position / size).round().to_array();
    mixed(mixed(mixed(0, x), y), z)
}

fn mixed(hash: u64, coordinate: f32) -> u64 {
    // Steele, Lea, Flood: "Fast Splittable Pseudorandom Number Generators" (2014), figure 14.
    let mixed = (hash ^ (coordinate as i64 as u64)).wrapping_add(0x9e37_79b9_7f4a_7c15);
    let mixed = (mixed ^ (mixed >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    mixed ^ (mixed >> 31)
}

/// Which part of the cells of both lists is in both.
struct SharedParts {
    /// Of those that one of them has.
    of_all: f64,
    /// Of those that the list with fewer has.
    of_fewer: f64,
}

/// Estimates it from the smallest hashes: those up to where the first of the two ends.
fn shared(a: &[u64], b: &[u64]) -> SharedParts {
    // A list with fewer cells than are kept has all of its hashes.
    let end =
        [a, b].into_iter().filter(|hashes| hashes.len() >= KEPT).filter_map(|hashes| hashes.last());
    let end = end.min().copied().unwrap_or(u64::MAX);
    let [a, b] = [a, b].map(|hashes| &hashes[..hashes.partition_point(|hash| *hash <= end)]);
    // Both are in ascending order.
    let (mut both, mut at) = (0, 0);
    for hash in a {
        while at < b.len() && b[at] < *hash {
            at += 1;
        }
        both += usize::from(b.get(at) == Some(hash));
    }
    let fewer = a.len().min(b.len());
    let part = |of: usize| if both < FEWEST_SHARED { 0.0 } else { both as f64 / of as f64 };
    SharedParts { of_all: part(a.len() + b.len() - both), of_fewer: part(fewer) }
}

/// For each of `all`, which others have the same photons.
pub fn twins(all: &[Option<&Fingerprint>]) -> Vec<Vec<usize>> {
    let mut twins = vec![Vec::new(); all.len()];
    for (other, two) in all.iter().enumerate() {
        for (at, one) in all[..other].iter().enumerate() {
            if one.zip(*two).is_some_and(|(one, two)| one.is_like(two)) {
                twins[at].push(other);
                twins[other].push(at);
            }
        }
    }
    twins
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
    fn parts_of_others_photons_are_twins() {
        for photons in [20_000, 1_000_000, 8_000_000] {
            let (one, two) = (list(1, photons), list(2, photons));
            let tenth: Vec<_> = one.iter().copied().step_by(10).collect();
            let first = one[..one.len() / 10].to_vec();
            let half = |all: &[PhotonRecord], from: usize| -> Vec<PhotonRecord> {
                all.iter().copied().skip(from).step_by(2).collect()
            };
            let mixed = [half(&one, 0), half(&two, 1)].concat();
            for (part, name) in [(&tenth, "tenth"), (&first, "first"), (&mixed, "mixed")] {
                assert!(are_like(&one, part) && are_like(part, &one), "{name} of {photons}");
            }
            assert!(are_like(&two, &mixed), "{photons}");
            assert!(!are_like(&two, &tenth) && !are_like(&two, &first), "{photons}");
        }
    }

    #[test]
    fn independent_lists_are_no_twins() {
        let in_large = |list: &Fingerprint| list.records <= MOST_IN_LARGE_CELLS;
        for (photons, runs) in [(5_000, 40), (100_000, 20), (1_190_000, 8), (5_900_000, 2)] {
            let all: Vec<_> =
                (0..runs).map(|seed| Fingerprint::of(&list(seed, photons)).unwrap()).collect();
            for (at, one) in all.iter().enumerate() {
                for other in &all[..at] {
                    assert!(!one.is_like(other), "{photons}");
                    // Nor are those of a large class, of which some pairs share more.
                    let small = shared(&one.small, &other.small);
                    let tiny = shared(&one.tiny, &other.tiny);
                    let parts = [small.of_all, small.of_fewer, tiny.of_fewer];
                    assert!(parts.iter().all(|part| *part < PART / 4.0), "{photons}");
                    let large = shared(&one.large, &other.large).of_all;
                    assert!(!in_large(one) || large < 0.8 * SAME, "{photons}: {large}");
                }
            }
            // A short list among the photons of a long one.
            let short = Fingerprint::of(&list(runs, 20_000)).unwrap();
            assert!(all.iter().all(|long| !short.is_like(long)), "{photons}");
        }
        // In large cells these would be alike.
        let [one, other] = [0, 1].map(|seed| Fingerprint::of(&list(seed, 1_900_000)).unwrap());
        assert!(!one.is_like(&other));
    }

    #[test]
    fn few_places_say_nothing() {
        let one_place = moved(&list(1, 2000), |_| 0.5);
        assert_eq!(Fingerprint::of(&one_place), None);
        assert_eq!(Fingerprint::of(&[]), None);
    }
}
