//! Which position of one list belongs to which of another, whatever their order.

use std::collections::HashSet;

use glam::Vec3;

use super::position_index::{Located, PositionIndex};

/// Of the free positions of a cell, so many are looked at.
const MOST_FREE: usize = 64;
/// So many others are looked at for one that finds no free position, to see whether they can move;
/// and so many for each position in all, so that crowds take no quadratic time.
const MOST_TRIED: usize = 256;
const MOST_TRIED_IN_ALL: usize = 4;

/// What stands for no partner.
pub const ALONE: u32 = u32::MAX;

/// For each position of `index` the place of its partner in `submission`, which is within the
/// tolerance of the index, or [`ALONE`]: as many pairs as there can be, except among crowds.
pub fn partners<T: Located>(index: &PositionIndex<T>, submission: &[T]) -> Vec<u32> {
    let count = index.positions.len();
    let mut pairs = Pairs {
        index,
        submission,
        partners: vec![ALONE; count],
        next_free: (0..=count as u32).collect(),
        left_to_try: MOST_TRIED_IN_ALL * submission.len(),
    };
    let alone: Vec<u32> =
        (0..submission.len() as u32).filter(|j| !pairs.take_nearest(*j)).collect();
    for j in alone {
        pairs.make_room(j, &mut HashSet::new());
    }
    pairs.partners
}

struct Pairs<'a, T> {
    index: &'a PositionIndex<'a, T>,
    submission: &'a [T],
    partners: Vec<u32>,
    /// For each entry of the index, one at or behind it that may be free: those between are not.
    next_free: Vec<u32>,
    left_to_try: usize,
}

impl<T: Located> Pairs<'_, T> {
    /// Pairs `j` with the nearest free position, if there is one. Copies always find theirs, since
    /// no other is nearer.
    fn take_nearest(&mut self, j: u32) -> bool {
        let position = self.submission[j as usize].position();
        let mut nearest: Option<(f32, usize)> = None;
        for cell in self.index.cells_near(position) {
            let mut at = self.free_from(cell.start);
            for _ in 0..MOST_FREE {
                if at >= cell.end {
                    break;
                }
                let distance = distance(self.index.position(at), position);
                if distance <= self.index.tolerance
                    && nearest.is_none_or(|(least, _)| distance < least)
                {
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
        self.partners[self.index.place(at)] = j;
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
        for i in self.index.near(self.submission[j as usize].position(), j as usize) {
            if !tried.insert(i) {
                continue;
            }
            if tried.len() > MOST_TRIED || self.left_to_try == 0 {
                return false;
            }
            self.left_to_try -= 1;
            if self.make_room(self.partners[i], tried) {
                self.partners[i] = j;
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
    use std::cell::Cell;

    use super::*;

    #[test]
    fn copies_in_any_order_and_neighbors_in_a_row_find_each_other() {
        let tolerance = 1e-3;
        let are_all_paired = |one: &[Vec3], other: &[Vec3]| {
            !partners(&PositionIndex::new(one, tolerance), other).contains(&ALONE)
        };
        let crowd = |count: usize| -> Vec<Vec3> {
            let at = |k: usize| (k * 7919 % count) as f32;
            (0..count).map(|k| Vec3::new(at(k) * 1e-4, (k % 10) as f32 * 4e-4, 0.0)).collect()
        };
        let copies = crowd(20_000);
        let reversed: Vec<_> = copies.iter().rev().copied().collect();
        assert!(are_all_paired(&copies, &reversed));
        let same = vec![Vec3::ONE; 20_000];
        assert!(are_all_paired(&same, &same));
        // All take the next one, which is nearer than their own, and the last must move them all.
        let row = |start: f32| -> Vec<Vec3> {
            (0..100).map(|k| Vec3::new(start + 1.5 * tolerance * k as f32, 0.0, 0.0)).collect()
        };
        let moved = row(0.8 * tolerance);
        assert!(are_all_paired(&row(0.0), &moved));
    }

    thread_local! {
        /// How many positions were looked at.
        static LOOKED: Cell<usize> = const { Cell::new(0) };
    }

    struct Counted(Vec3);

    impl Located for Counted {
        fn position(&self) -> Vec3 {
            LOOKED.set(LOOKED.get() + 1);
            self.0
        }
    }

    /// So many within less than half a tolerance of 1e-3, no two alike, in the middle of a cell.
    fn crowd(count: usize, shift: f32) -> Vec<Counted> {
        let at = |k: usize| Vec3::new((k * 7919 % count) as f32 / count as f32, shift, 0.0);
        (0..count).map(|k| Counted(2e-3 * Vec3::ONE + 4e-4 * at(k))).collect()
    }

    /// The partners of two lists, and how many positions were looked at for each record.
    fn partners_and_work(reference: &[Counted], submission: &[Counted]) -> (Vec<u32>, usize) {
        let index = PositionIndex::new(reference, 1e-3);
        LOOKED.set(0);
        let partners = partners(&index, submission);
        (partners, LOOKED.get() / submission.len())
    }

    #[test]
    fn crowds_take_no_quadratic_time() {
        let (partners, work) = partners_and_work(&crowd(20_000, 0.0), &crowd(20_000, 0.5));
        assert!(!partners.contains(&ALONE) && work < 100, "{work}");
        // Most find no place, and nobody can make room.
        let (partners, work) = partners_and_work(&crowd(1000, 0.0), &crowd(20_000, 0.5));
        assert!(!partners.contains(&ALONE) && work < 200, "{work}");
    }

    #[test]
    fn a_crowd_in_which_there_is_no_room_leaves_others_theirs() {
        let row = |start: f32| {
            (0..100).map(move |k| Counted(Vec3::new(1.0 + start + 1.5e-3 * k as f32, 0.0, 0.0)))
        };
        let mut reference = crowd(10_000, 0.0);
        let mut submission = crowd(10_100, 0.5);
        reference.extend(row(0.0));
        submission.extend(row(8e-4));
        let (partners, _) = partners_and_work(&reference, &submission);
        assert!(!partners.contains(&ALONE));
    }

    #[test]
    fn what_has_no_counterpart_stays_alone() {
        let one = [Vec3::ZERO, Vec3::ONE, Vec3::NAN];
        let other = [Vec3::NAN, Vec3::ONE, 2.0 * Vec3::ONE, Vec3::NAN];
        assert_eq!(partners(&PositionIndex::new(&one, 0.1), &other), [ALONE, 1, 0]);
        assert_eq!(partners(&PositionIndex::new(&[], 0.1), &other), []);
        assert_eq!(partners(&PositionIndex::new(&one, 0.0), &[]), [ALONE; 3]);
    }
}
