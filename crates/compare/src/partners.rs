//! Which position of one list belongs to which of another, whatever their order.

use std::collections::HashSet;

use glam::Vec3;

use super::position_index::PositionIndex;

/// Of the free positions of a cell, so many are looked at.
const MOST_FREE: usize = 64;
/// So many others are looked at for one that finds no free position, to see whether they can move;
/// and so many for each position in all, so that crowds take no quadratic time.
const MOST_TRIED: usize = 256;
const MOST_TRIED_IN_ALL: usize = 4;

/// For each position of `reference` the place of its partner in `submission`, which is within
/// `tolerance`: as many as there can be, except among crowds.
pub fn partners(reference: &[Vec3], submission: &[Vec3], tolerance: f32) -> Vec<Option<u32>> {
    let index = PositionIndex::new(reference, tolerance);
    let mut pairs = Pairs {
        reference,
        submission,
        tolerance,
        partners: vec![None; reference.len()],
        next_free: (0..=reference.len() as u32).collect(),
        index: &index,
        left_to_try: MOST_TRIED_IN_ALL * submission.len(),
    };
    let alone: Vec<u32> =
        (0..submission.len() as u32).filter(|j| !pairs.take_nearest(*j)).collect();
    for j in alone {
        pairs.make_room(j, &mut HashSet::new());
    }
    pairs.partners
}

struct Pairs<'a> {
    reference: &'a [Vec3],
    submission: &'a [Vec3],
    tolerance: f32,
    partners: Vec<Option<u32>>,
    /// For each entry of the index, one at or behind it that may be free: those between are not.
    next_free: Vec<u32>,
    index: &'a PositionIndex<'a>,
    left_to_try: usize,
}

impl Pairs<'_> {
    /// Pairs `j` with the nearest free position, if there is one. Copies always find theirs, since
    /// no other is nearer.
    fn take_nearest(&mut self, j: u32) -> bool {
        let position = self.submission[j as usize];
        let mut nearest: Option<(f32, usize)> = None;
        for cell in self.index.cells_near(position) {
            let mut at = self.free_from(cell.start);
            for _ in 0..MOST_FREE {
                if at >= cell.end {
                    break;
                }
                let distance = distance(self.reference[self.index.place(at)], position);
                if distance <= self.tolerance && nearest.is_none_or(|(least, _)| distance < least) {
                    nearest = Some((distance, at));
                }
                if distance == 0.0 {
                    break;
                }
                at = self.free_from(at + 1);
            }
        }
        let Some((_, at)) = nearest else { return false };
        self.next_free[at] = at as u32 + 1;
        self.partners[self.index.place(at)] = Some(j);
        true
    }

    /// The first free entry from `at` on.
    fn free_from(&mut self, at: usize) -> usize {
        let mut free = at;
        while self.next_free[free] as usize != free {
            free = self.next_free[free] as usize;
        }
        let mut passed = at;
        while passed != free {
            passed = std::mem::replace(&mut self.next_free[passed], free as u32) as usize;
        }
        free
    }

    /// Pairs `j` with a position whose partner can go to another one.
    ///
    /// H. W. Kuhn, *The Hungarian Method for the Assignment Problem* (1955): an augmenting path.
    fn make_room(&mut self, j: u32, tried: &mut HashSet<usize>) -> bool {
        if self.take_nearest(j) {
            return true;
        }
        for i in self.index.near(self.submission[j as usize], j as usize) {
            let Some(partner) = self.partners[i].filter(|_| tried.insert(i)) else { continue };
            if tried.len() > MOST_TRIED || self.left_to_try == 0 {
                return false;
            }
            self.left_to_try -= 1;
            if self.make_room(partner, tried) {
                self.partners[i] = Some(j);
                return true;
            }
        }
        false
    }
}

/// How far apart two positions are; those that are no numbers are alike.
fn distance(a: Vec3, b: Vec3) -> f32 {
    if a == b || (a.is_nan() && b.is_nan()) { 0.0 } else { a.distance(b) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn copies_in_any_order_and_neighbours_in_a_row_find_each_other() {
        let tolerance = 1e-3;
        let crowd = |count: usize| -> Vec<Vec3> {
            let at = |k: usize| (k * 7919 % count) as f32;
            (0..count).map(|k| Vec3::new(at(k) * 1e-4, (k % 10) as f32 * 4e-4, 0.0)).collect()
        };
        let copies = crowd(20_000);
        let reversed: Vec<_> = copies.iter().rev().copied().collect();
        assert!(partners(&copies, &reversed, tolerance).iter().all(Option::is_some));
        let same = vec![Vec3::ONE; 20_000];
        assert!(partners(&same, &same, tolerance).iter().all(Option::is_some));
        // All take the next one, which is nearer than their own, and the last must move them all.
        let row = |start: f32| -> Vec<Vec3> {
            (0..100).map(|k| Vec3::new(start + 1.5 * tolerance * k as f32, 0.0, 0.0)).collect()
        };
        let moved = row(0.8 * tolerance);
        assert!(partners(&row(0.0), &moved, tolerance).iter().all(Option::is_some));
    }

    #[test]
    fn what_has_no_counterpart_stays_alone() {
        let one = [Vec3::ZERO, Vec3::ONE, Vec3::NAN];
        let other = [Vec3::NAN, Vec3::ONE, 2.0 * Vec3::ONE, Vec3::NAN];
        assert_eq!(partners(&one, &other, 0.1), [None, Some(1), Some(0)]);
        assert_eq!(partners(&[], &other, 0.1), []);
        assert_eq!(partners(&one, &[], 0.0), [None; 3]);
    }
}
