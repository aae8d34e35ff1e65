//! Which records of a list lie near a point?

use std::collections::HashMap;

use glam::Vec3;

/// More records than these in one cell are not all looked at: lists whose records all lie in one
/// point would take quadratic time.
const MOST_PER_CELL: usize = 16;
/// The edge of a cell when lists are compared without any tolerance, in world units.
const CELL_WITHOUT_TOLERANCE: f32 = 1e-6;

/// Whether two positions are the same within `tolerance`. What is not a number is like whatever is
/// not a number either: those who look for the first real difference want to look past it.
pub fn is_near(a: Vec3, b: Vec3, tolerance: f32) -> bool {
    a == b || a.distance(b) <= tolerance || (a.is_nan() && b.is_nan())
}

/// Positions in the cells of a hashed grid.
#[derive(Debug)]
pub struct PositionIndex<'list> {
    positions: &'list [Vec3],
    tolerance: f32,
    cells: HashMap<[i64; 3], Vec<u32>>,
}

impl<'list> PositionIndex<'list> {
    /// Sorts `positions` (world space) into the grid, for questions about points within
    /// `tolerance` world units.
    pub fn new(positions: &'list [Vec3], tolerance: f32) -> Self {
        let mut index = Self { positions, tolerance, cells: HashMap::new() };
        for (place, position) in positions.iter().enumerate() {
            let cell = index.cell(*position);
            index.cells.entry(cell).or_default().push(place as u32);
        }
        index
    }

    /// The places in the list of the positions within the tolerance of `point`, in ascending order.
    /// Of a cell with many, only those next to place `around`.
    pub fn near(&self, point: Vec3, around: usize) -> Vec<usize> {
        let reach = Vec3::splat(self.tolerance);
        let (low, high) = (self.cell(point - reach), self.cell(point + reach));
        let mut found = Vec::new();
        for x in low[0]..=high[0] {
            for y in low[1]..=high[1] {
                for z in low[2]..=high[2] {
                    let Some(places) = self.cells.get(&[x, y, z]) else { continue };
                    let middle = places.partition_point(|place| (*place as usize) < around);
                    let start = middle.saturating_sub(MOST_PER_CELL / 2);
                    let window = places[start..].iter().take(MOST_PER_CELL);
                    found.extend(
                        window
                            .map(|place| *place as usize)
                            .filter(|place| is_near(self.positions[*place], point, self.tolerance)),
                    );
                }
            }
        }
        found.sort_unstable();
        found
    }

    fn cell(&self, position: Vec3) -> [i64; 3] {
        let edge = if self.tolerance > 0.0 { 4.0 * self.tolerance } else { CELL_WITHOUT_TOLERANCE };
        position.to_array().map(|coordinate| (coordinate / edge).floor() as i64)
    }
}
