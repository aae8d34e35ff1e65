//! Which records of a list lie near a point?

use std::ops::Range;

use glam::Vec3;
use photon_mapping::photon_list::PhotonRecord;

/// More records than these in one cell are not all looked at: lists whose records all lie in one
/// point would take quadratic time.
const MOST_PER_CELL: usize = 16;
/// The edge of a cell when lists are compared without any tolerance, in world units.
const CELL_WITHOUT_TOLERANCE: f32 = 1e-6;
/// So many entries share a bucket.
const PER_BUCKET: usize = 4;

/// Whether two positions are the same within `tolerance`. What is not a number is like whatever is
/// not a number either: those who look for the first real difference want to look past it.
pub fn is_near(a: Vec3, b: Vec3, tolerance: f32) -> bool {
    a == b || a.distance(b) <= tolerance || (a.is_nan() && b.is_nan())
}

/// What lies somewhere. World space.
pub trait Located {
    /// Where.
    fn position(&self) -> Vec3;
}

impl Located for Vec3 {
    fn position(&self) -> Vec3 {
        *self
    }
}

impl Located for PhotonRecord {
    fn position(&self) -> Vec3 {
        self.position
    }
}

/// Positions in the cells of a hashed grid: 9 bytes for each.
#[derive(Debug)]
pub struct PositionIndex<'list, T = Vec3> {
    pub(super) positions: &'list [T],
    pub(super) tolerance: f32,
    /// The hash of each position's cell, then its place in the list, in ascending order. Cells of
    /// the same hash are mixed; who asks looks at the distance.
    entries: Vec<u64>,
    /// Where the entries start whose hashes start with each number of so many bits, and the end.
    buckets: Vec<u32>,
    bits: u32,
}

impl<'list, T: Located> PositionIndex<'list, T> {
    /// Sorts `positions` (world space) into the grid, for questions about points within
    /// `tolerance` world units.
    pub fn new(positions: &'list [T], tolerance: f32) -> Self {
        let bits = (positions.len() / PER_BUCKET).max(2).ilog2();
        let mut index = Self { positions, tolerance, entries: Vec::new(), buckets: vec![0], bits };
        let entry = |(place, located): (u64, &T)| {
            u64::from(hash(index.cell(located.position()))) << 32 | place
        };
        let mut entries: Vec<u64> = (0..).zip(positions).map(entry).collect();
        entries.sort_unstable();
        let mut start = 0;
        for bucket in 0..1 << bits {
            start += entries[start..]
                .iter()
                .take_while(|entry| **entry >> (64 - bits) == bucket)
                .count();
            index.buckets.push(start as u32);
        }
        index.entries = entries;
        index
    }

    /// The places in the list of the positions within the tolerance of `point`, in ascending order.
    /// Of a cell with many, only those next to place `around`.
    pub fn near(&self, point: Vec3, around: usize) -> Vec<usize> {
        let mut found = Vec::new();
        for cell in self.cells_near(point) {
            let places = &self.entries[cell];
            let middle = places.partition_point(|entry| place(*entry) < around);
            let start = middle.saturating_sub(MOST_PER_CELL / 2);
            let window = places[start..].iter().take(MOST_PER_CELL).map(|entry| place(*entry));
            found.extend(window.filter(|place| self.is_near(*place, point)));
        }
        found.sort_unstable();
        found.dedup();
        found
    }

    /// The entries of the cells that have positions within the tolerance of `point`.
    pub(super) fn cells_near(&self, point: Vec3) -> impl Iterator<Item = Range<usize>> {
        let reach = Vec3::splat(self.tolerance);
        let (low, high) = (self.cell(point - reach), self.cell(point + reach));
        let cells = (low[0]..=high[0]).flat_map(move |x| {
            (low[1]..=high[1]).flat_map(move |y| (low[2]..=high[2]).map(move |z| [x, y, z]))
        });
        cells.map(|cell| self.entries_of(hash(cell))).filter(|entries| !entries.is_empty())
    }

    /// The place in the list that the entry `at` stands for.
    pub(super) fn place(&self, at: usize) -> usize {
        place(self.entries[at])
    }

    /// The position of the entry `at`.
    pub(super) fn position(&self, at: usize) -> Vec3 {
        self.positions[self.place(at)].position()
    }

    /// Whether the position in `place` is within the tolerance of `point`.
    fn is_near(&self, place: usize, point: Vec3) -> bool {
        is_near(self.positions[place].position(), point, self.tolerance)
    }

    fn entries_of(&self, hash: u32) -> Range<usize> {
        let bucket = (hash >> (32 - self.bits)) as usize;
        let start = self.buckets[bucket] as usize;
        let entries = &self.entries[start..self.buckets[bucket + 1] as usize];
        let first = entries.partition_point(|entry| ((entry >> 32) as u32) < hash);
        let count = entries[first..].partition_point(|entry| (entry >> 32) as u32 == hash);
        start + first..start + first + count
    }

    fn cell(&self, position: Vec3) -> [i64; 3] {
        let edge = if self.tolerance > 0.0 { 4.0 * self.tolerance } else { CELL_WITHOUT_TOLERANCE };
        position.to_array().map(|coordinate| (coordinate / edge).floor() as i64)
    }
}

fn place(entry: u64) -> usize {
    entry as u32 as usize
}

fn hash(cell: [i64; 3]) -> u32 {
    let mixed = cell.into_iter().fold(0, |hash: u64, coordinate| {
        // The multiplier of Steele, Lea, Flood: "Fast Splittable Pseudorandom Number Generators"
        // (2014), figure 14.
        let mixed = (hash ^ coordinate as u64).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        mixed ^ (mixed >> 31)
    });
    (mixed.wrapping_mul(0x94d0_49bb_1331_11eb) >> 32) as u32
}
