//! The cells into which the directions from a point are divided: six faces of a cube with a grid on
//! each.

use glam::Vec3;

use super::axes::{axis_of, turn};

/// Cells along the edge of a face of the cube; a power of two, so that the cells' ends are exact.
pub const EDGE: usize = 32;
/// How many cells a face has.
pub const OF_FACE: usize = EDGE * EDGE;
/// How many cells there are.
pub const CELLS: usize = 6 * OF_FACE;
/// How far a cell reaches over its ends, 2^-16: four times what [`step`] moves a shear by shrinking
/// the grid and rounding, and [`cell_of`] by five roundings more.
const MARGIN: f32 = 1.0 / 65_536.0;

/// The cell of `direction`, of any length.
///
/// Its shears are off by a few roundings, for which a cell has its margin. The face of a point that
/// a photon drew is that of the normalized direction. Coordinates are drawn as multiples of 2^-23
/// and only grow by normalizing. So two that differ still differ by more than 2^-24, to which a
/// unit vector's are rounded.
#[inline(always)]
pub fn cell_of(direction: Vec3) -> u32 {
    let axis = axis_of(direction);
    let turned = turn(axis, direction);
    let face = 2 * axis + i32::from(turned.z < 0.0);
    let reciprocal = 1.0 / turned.z;
    let (column, row) = (step(turned.x * reciprocal), step(turned.y * reciprocal));
    ((face * EDGE as i32 + row) * EDGE as i32 + column) as u32
}

/// The place along an edge of the grid of the shear `shear`, in [-1, 1].
#[inline(always)]
fn step(shear: f32) -> i32 {
    // 2^18 - 1 parts in 2^18, so that the shear 1 stays within the last cell.
    const PLACES: f32 = EDGE as f32 / 2.0 * (1.0 - 1.0 / 262_144.0);
    // Adding 1.5 * 2^23 rounds to a whole number and leaves it in the lowest bits: a conversion
    // with its checks for overflow would not stay in lanes.
    const WHOLE: f32 = 12_582_912.0;
    let place = (shear + 1.0) * PLACES - 0.5;
    (place + WHOLE).to_bits() as i32 & (EDGE as i32 - 1)
}

/// The least and the greatest shear of `count` cells along an edge from `step` on, and the margin.
pub fn ends(step: usize, count: usize) -> [f32; 2] {
    let end = |step: usize| step as f32 * (2.0 / EDGE as f32) - 1.0;
    [(end(step) - MARGIN).max(-1.0), (end(step + count) + MARGIN).min(1.0)]
}
