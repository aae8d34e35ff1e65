//! What a point light can hit in which direction, found out once for all of its photons.
//!
//! All photons of a point light start at one point, and three in four of the handout's leave the
//! scene at once. So the directions are divided into cells: six faces of a cube with a grid on
//! each. Each cell keeps the triangles that a ray through it *may* meet: often none, mostly one.
//!
//! The bits cannot change. A triangle is left out of a cell only where the test of
//! [`photon_mapping::scene::triangle`] is certain to refuse it. That test sees a corner at
//! `x' = x - s z`. Here (x, y, z) lead from the light to the corner in the order of the ray's axes.
//! The shear s = d_x / d_z lies in [-1, 1]. Rounding is monotonic, so the *rounded* x' of all rays
//! of a cell lies between the rounded x' of its two ends. So a statement about these intervals
//! holds for what the test computes. It refuses every ray of the cell when
//!
//! - no corner has positive depth: t is then a mean of numbers <= 0, never > 0;
//! - all corners have x' > 0 (or x' < 0, or the same of y'): since `a_x u + b_x v + c_x w = 0`, the
//!   true edge functions have mixed signs or are all zero;
//! - one edge function is certainly positive and another certainly negative.
//!
//! The test's signs are the true ones unless an edge function underflows to zero. Shears of a
//! photon's direction are 0 or at least [`SMALLEST_SHEAR`]. So none underflows where each
//! coordinate is 0 or at least 2^-25. A triangle with smaller coordinates is in every cell.
//!
//! A photon straight from the light is not stored, so one that is absorbed at its first hit needs
//! no tracing. [`Outlook::may_go_on`] plays its roulette against the largest reflection in its
//! cell. [`super::first_hit`] tests those that remain.

use std::collections::HashMap;
use std::ops::Range;

use glam::Vec3;

use photon_mapping::scene::Scene;
use photon_mapping::scene::triangle::ShearedRay;

/// Cells along the edge of a face of the cube; a power of two, so that the cells' ends are exact.
const EDGE: usize = 32;
/// How many cells there are.
const CELLS: usize = 6 * EDGE * EDGE;
/// The cell of a photon whose direction is not known yet.
pub const UNKNOWN: u32 = CELLS as u32;
/// The cell of a photon that is not there.
pub const NOWHERE: u32 = UNKNOWN + 1;
/// [`CELLS`], [`UNKNOWN`] and [`NOWHERE`], with room up to the next power of two.
const ROUGH_CELLS: usize = (CELLS + 2).next_power_of_two();
/// How far a cell reaches over its ends, 2^-16: four times what [`step`] moves a shear by shrinking
/// the grid and rounding, and [`rough_cell`] by five roundings more.
const MARGIN: f32 = 1.0 / 65_536.0;
/// 2^-24, which no shear of a photon's direction falls below, unless it is 0.
pub const SMALLEST_SHEAR: f32 = 1.0 / 16_777_216.0;
/// Coordinates below this, 2^-25, may underflow in the edge functions.
const SMALLEST: f32 = 1.0 / 33_554_432.0;
/// Coordinates beyond this may overflow in them.
const LARGEST: f32 = 1e9;

/// The triangles of a scene as one light sees them.
#[derive(Clone, Debug)]
pub struct Outlook {
    /// The corners seen from the light, once for each axis that a ray runs along.
    seen: [Vec<[Vec3; 3]>; 3],
    /// The place of each cell's list, in `lists`. The last one is of [`UNKNOWN`].
    list_of_cell: Box<[u16; ROUGH_CELLS]>,
    lists: Vec<CandidateList>,
    triangles: Vec<u32>,
    /// The greatest probability of reflection that a photon through the cell may meet, in 128ths,
    /// rounded up: a byte a cell leaves room in the first-level cache.
    reflection: Box<[u8; ROUGH_CELLS]>,
}

/// What the rays of some cells may meet.
#[derive(Clone, Debug)]
struct CandidateList {
    /// The axis along which these rays run.
    axis: usize,
    /// Where in [`Outlook::triangles`] the triangles are, in ascending order.
    triangles: Range<usize>,
}

/// The face of the cube through which `direction`, of any length, leaves, and the direction in the
/// order of a ray's axes. The choice is that of `ShearedRay::axes`, without its branches.
#[inline(always)]
fn turn(direction: Vec3) -> (i32, Vec3) {
    let Vec3 { x, y, z } = direction;
    let size = direction.abs();
    // Both comparisons always, where `&&` would branch.
    let along_x = (size.x >= size.y) & (size.x >= size.z);
    let along_y = size.y >= size.z;
    let turned = Vec3::new(
        if along_x {
            y
        } else if along_y {
            z
        } else {
            x
        },
        if along_x {
            z
        } else if along_y {
            x
        } else {
            y
        },
        if along_x {
            x
        } else if along_y {
            y
        } else {
            z
        },
    );
    let axis = if along_x {
        0
    } else if along_y {
        1
    } else {
        2
    };
    (2 * axis + i32::from(turned.z < 0.0), turned)
}

#[inline(always)]
fn cell_of(face: i32, shear_x: f32, shear_y: f32) -> u32 {
    ((face * EDGE as i32 + step(shear_y)) * EDGE as i32 + step(shear_x)) as u32
}

/// The cell of the unit vector `direction` and what [`ShearedRay::new`] makes of it: the shears
/// along x and y, and the reciprocal of the direction along z.
#[inline(always)]
pub fn aim(direction: Vec3) -> (u32, Vec3) {
    let (face, turned) = turn(direction);
    let shear = Vec3::new(turned.x / turned.z, turned.y / turned.z, 1.0 / turned.z);
    (cell_of(face, shear.x, shear.y), shear)
}

/// The cell of a point in the unit sphere for [`Outlook::may_go_on`], before it is normalized.
///
/// Its shears are off by a few roundings, for which a cell has its margin. Its face is that of the
/// normalized direction. Coordinates are drawn as multiples of 2^-23 and only grow by normalizing.
/// So two that differ still differ by more than 2^-24, to which a unit vector's are rounded.
#[inline(always)]
pub fn rough_cell(direction: Vec3) -> u32 {
    let (face, turned) = turn(direction);
    let reciprocal = 1.0 / turned.z;
    cell_of(face, turned.x * reciprocal, turned.y * reciprocal)
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

impl Outlook {
    /// The triangles of `scene` as seen from `origin`; `reflection` is each one's probability of
    /// reflection.
    pub fn new(scene: &Scene, origin: Vec3, reflection: &[f32]) -> Self {
        let turned = |[x, y, z]: [usize; 3]| -> Vec<[Vec3; 3]> {
            let turn = |corner: Vec3| {
                let from_origin = corner - origin;
                Vec3::new(from_origin[x], from_origin[y], from_origin[z])
            };
            scene.triangles().iter().map(|triangle| triangle.vertices.map(turn)).collect()
        };
        let seen = [Vec3::X, Vec3::Y, Vec3::Z].map(|axis| turned(ShearedRay::axes(axis)));
        // Of the cells in which there is nothing.
        let mut lists = vec![CandidateList { axis: 0, triangles: 0..0 }];
        let mut triangles = Vec::new();
        let mut list_of_cell = Box::new([0_u16; ROUGH_CELLS]);
        let mut places = HashMap::new();
        for face in 0..6 {
            let corners = &seen[face / 2];
            let occluders = OccluderFace {
                corners,
                is_negative: face % 2 == 1,
                first_cell: face * EDGE * EDGE,
            };
            let axis = face / 2;
            let all: Vec<u32> = (0..corners.len() as u32).collect();
            occluders.divide(&all, [0, 0], EDGE, &mut |cell, of_cell| {
                list_of_cell[cell] = *places.entry((axis, of_cell.to_vec())).or_insert_with(|| {
                    let start = triangles.len();
                    triangles.extend_from_slice(of_cell);
                    lists.push(CandidateList { axis, triangles: start..triangles.len() });
                    (lists.len() - 1) as u16
                });
            });
        }
        // Of the cells that nothing is known of.
        list_of_cell[CELLS..].fill(lists.len() as u16);
        let greatest = |places: &mut dyn Iterator<Item = f32>| places.fold(0.0, f32::max);
        let of_scene = greatest(&mut reflection.iter().copied());
        let of_cell = |cell: usize| {
            if cell == UNKNOWN as usize {
                return of_scene;
            }
            if cell > CELLS {
                return 0.0;
            }
            let of_cell = &triangles[lists[usize::from(list_of_cell[cell])].triangles.clone()];
            greatest(&mut of_cell.iter().map(|triangle| reflection[*triangle as usize]))
        };
        let of_cells = Box::new(std::array::from_fn(|cell| {
            (of_cell(cell) * 128.0).ceil().clamp(0.0, 128.0) as u8
        }));
        let reflection = of_cells;
        Self { seen, list_of_cell, lists, triangles, reflection }
    }

    /// Whether a photon through [`rough_cell`] `cell` may meet something and be reflected there
    /// when its roulette's number is that of `word`.
    #[inline(always)]
    pub fn may_go_on(&self, cell: u32, word: u32) -> bool {
        // The number is at least this many 128ths.
        word >> 25 < u32::from(self.reflection[cell as usize % ROUGH_CELLS])
    }

    /// How many lists of triangles there are.
    pub fn lists(&self) -> usize {
        self.lists.len()
    }

    /// The place of the list of `cell`: [`Self::lists`] for [`UNKNOWN`].
    #[inline(always)]
    pub fn list(&self, cell: u32) -> usize {
        self.list_of_cell[cell as usize % ROUGH_CELLS].into()
    }

    /// The axis along which the rays of `list` run, and the triangles that they may meet, in
    /// ascending order.
    pub fn candidates(&self, list: usize) -> (usize, &[u32]) {
        let CandidateList { axis, triangles } = &self.lists[list];
        (*axis, &self.triangles[triangles.clone()])
    }

    /// The corners of `triangle` as rays along `axis` see them from the light, not yet sheared.
    pub fn seen(&self, axis: usize, triangle: u32) -> &[Vec3; 3] {
        &self.seen[axis][triangle as usize]
    }
}

/// One face of the cube.
struct OccluderFace<'a> {
    /// The corners of all triangles, in the order of a ray through this face.
    corners: &'a [[Vec3; 3]],
    is_negative: bool,
    first_cell: usize,
}

impl OccluderFace<'_> {
    /// Gives `found` every cell of the square of `edge` cells from row and column `start` on
    /// through which a ray may meet some of `triangles`, with these. What a quarter does not meet,
    /// none of its cells does.
    fn divide(
        &self,
        triangles: &[u32],
        start: [usize; 2],
        edge: usize,
        found: &mut impl FnMut(usize, &[u32]),
    ) {
        let [y, x] = start.map(|start| ends(start, edge));
        let is_refused = |t: &u32| is_refused(&self.corners[*t as usize], self.is_negative, x, y);
        let triangles: Vec<u32> = triangles.iter().copied().filter(|t| !is_refused(t)).collect();
        let [row, column] = start;
        if triangles.is_empty() {
            return;
        }
        if edge == 1 {
            found(self.first_cell + row * EDGE + column, &triangles);
        } else {
            let half = edge / 2;
            for quarter in [[0, 0], [0, half], [half, 0], [half, half]] {
                self.divide(&triangles, [row + quarter[0], column + quarter[1]], half, found);
            }
        }
    }
}

/// The ends of `count` steps from `step` on, and the margin.
fn ends(step: usize, count: usize) -> [f32; 2] {
    let end = |step: usize| step as f32 * (2.0 / EDGE as f32) - 1.0;
    [(end(step) - MARGIN).max(-1.0), (end(step + count) + MARGIN).min(1.0)]
}

fn is_refused(corners: &[Vec3; 3], is_negative: bool, x: [f32; 2], y: [f32; 2]) -> bool {
    let is_safe = |c: f32| c == 0.0 || (SMALLEST..LARGEST).contains(&c.abs());
    if !corners.iter().all(|corner| corner.to_array().into_iter().all(is_safe)) {
        return false;
    }
    if corners.iter().all(|corner| if is_negative { corner.z >= 0.0 } else { corner.z <= 0.0 }) {
        return true;
    }
    let across = corners.map(|corner| {
        let seen = |c: f32, shear: [f32; 2]| Interval::around(shear.map(|s| c - s * corner.z));
        (seen(corner.x, x), seen(corner.y, y))
    });
    let [a, b, c] = across;
    let beside = |p: [Interval; 3]| p.iter().all(|p| p.0 > 0.0) || p.iter().all(|p| p.1 < 0.0);
    if beside([a.0, b.0, c.0]) || beside([a.1, b.1, c.1]) {
        return true;
    }
    let edge =
        |p: (Interval, Interval), q: (Interval, Interval)| p.0.times(q.1).minus(p.1.times(q.0));
    let edges = [edge(c, b), edge(a, c), edge(b, a)];
    edges.iter().any(|edge| edge.0 > 0.0) && edges.iter().any(|edge| edge.1 < 0.0)
}

/// The least and the greatest that a rounded result can be.
#[derive(Clone, Copy)]
struct Interval(f32, f32);

impl Interval {
    fn around<const N: usize>(values: [f32; N]) -> Self {
        let (mut low, mut high) = (values[0], values[0]);
        for value in values {
            low = if value < low { value } else { low };
            high = if value > high { value } else { high };
        }
        Self(low, high)
    }

    fn times(self, other: Self) -> Self {
        Self::around([self.0 * other.0, self.0 * other.1, self.1 * other.0, self.1 * other.1])
    }

    fn minus(self, other: Self) -> Self {
        Self(self.0 - other.1, self.1 - other.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lanes::emission::{RADIUS, coordinate, is_in_sphere};
    use photon_mapping::assignment8;
    use photon_mapping::random::photon_random;

    #[test]
    fn nobody_is_sorted_out_who_may_meet_something() {
        let scene = assignment8::create_scene();
        let reflection = vec![0.3; scene.triangles().len()];
        let outlook = Outlook::new(&scene, scene.lights()[0].position, &reflection);
        let mut random = photon_random(5, 0);
        let mut kept = 0;
        for number in 0..400_000 {
            let mut words = [0, 1, 2].map(|_| ((random() * 16_777_216.0) as u32) << 8);
            match number % 4 {
                // Along the edges of the cube of directions, to the last place, on both sides.
                0 => words[1] = words[0].wrapping_add(0x100),
                1 => words[2] = !words[0] & !0xff,
                // Along the border of a cell.
                2 => {
                    let [x, _, z] = words.map(coordinate);
                    let border = z * (x * 16.0 / RADIUS).round() / 16.0;
                    words[0] = (((border / RADIUS + 1.0) * 8_388_608.0) as u32) << 8;
                }
                _ => {}
            }
            let point = Vec3::from_array(words.map(coordinate));
            if !is_in_sphere(point) {
                continue;
            }
            let (cell, _) = aim(point.normalize());
            let rough = rough_cell(point);
            let (axis, candidates) = outlook.candidates(outlook.list(cell));
            if !candidates.is_empty() {
                kept += 1;
                let (rough_axis, rough_candidates) = outlook.candidates(outlook.list(rough));
                assert_eq!(rough_axis, axis, "{point:?}");
                assert!(!rough_candidates.is_empty(), "{point:?}");
                assert!(outlook.may_go_on(rough, 0), "{point:?}");
                // 0.3 lies between 38 and 39 of 128.
                assert!(outlook.may_go_on(rough, 38 << 25), "{point:?}");
                assert!(!outlook.may_go_on(rough, 39 << 25), "{point:?}");
            }
        }
        assert!(kept > 30_000, "{kept}");
    }
}
