//! Which triangles a ray from or to a point *may* meet, for each of the cells that directions from
//! there are divided into.
//!
//! **No triangle is left out that the test of [`photon_mapping::scene::triangle`] could accept.**
//! Let M be the largest coordinate of a corner seen from the point. A ray that the test accepts
//! passes the exact triangle within 6 * 2^-24 times its largest distance from a corner: see
//! [`crate::tree`]. That distance is at most M for a ray that starts at the point, and at most 2 M
//! for a shadow ray that ends there. A shadow ray misses the point by a few roundings, since its
//! direction is a rounded difference. Together these are less than 2^-19 M on each axis.
//!
//! So here every corner may lie anywhere within [`SLACK`] M = 2^-17 M. A direction of a cell has
//! shears x / z and y / z between the ends of the cell. It sees a corner at `x' = x - s z`, within
//! an interval. No ray along it can meet the triangle when
//!
//! - no corner has positive depth z;
//! - all corners have x' > 0 (or x' < 0, or the same of y');
//! - one edge function is certainly positive and another certainly negative.
//!
//! Rounding is monotonic, so the intervals' ends have the right order in f32 too.

use glam::Vec3;

use super::cells::{EDGE, OF_FACE, ends};
use photon_mapping::scene::Scene;
use photon_mapping::scene::triangle::ShearedRay;

/// How far a corner may lie from its place, in units of M.
const SLACK: f32 = 1.0 / 131_072.0;
/// Coordinates beyond this may overflow in the edge functions.
const LARGEST: f32 = 1e9;

/// The corners of `scene`'s triangles seen from `origin`, once for each axis that a ray runs along
/// and in the order of its axes.
pub fn seen_from(scene: &Scene, origin: Vec3) -> [Vec<[Vec3; 3]>; 3] {
    [Vec3::X, Vec3::Y, Vec3::Z].map(|axis| {
        let [x, y, z] = ShearedRay::axes(axis);
        let turn = |corner: Vec3| {
            let from_origin = corner - origin;
            Vec3::new(from_origin[x], from_origin[y], from_origin[z])
        };
        scene.triangles().iter().map(|triangle| triangle.vertices.map(turn)).collect()
    })
}

/// Gives `found` every cell in which a ray may meet some of the triangles with the corners `seen`,
/// with these, in ascending order.
pub fn find_candidates(seen: &[Vec<[Vec3; 3]>; 3], found: &mut impl FnMut(usize, &[u32])) {
    let all: Vec<u32> = (0..seen[0].len() as u32).collect();
    let coordinates = seen[0].iter().flatten().flat_map(|corner| corner.abs().to_array());
    let slack = SLACK * coordinates.fold(0.0, f32::max);
    for face in 0..6 {
        let (corners, is_negative) = (&seen[face / 2], face % 2 == 1);
        let face = OccluderFace { corners, is_negative, first_cell: face * OF_FACE, slack };
        face.divide(&all, [0, 0], EDGE, found);
    }
}

/// One face of the cube of directions.
struct OccluderFace<'a> {
    /// The corners of all triangles, in the order of a ray through this face.
    corners: &'a [[Vec3; 3]],
    is_negative: bool,
    first_cell: usize,
    slack: f32,
}

impl OccluderFace<'_> {
    /// As [`find_candidates`], for the square of `edge` cells from row and column `start` on, and
    /// `triangles`. What a quarter does not meet, none of its cells does.
    fn divide(
        &self,
        triangles: &[u32],
        start: [usize; 2],
        edge: usize,
        found: &mut impl FnMut(usize, &[u32]),
    ) {
        let [y, x] = start.map(|start| ends(start, edge));
        let triangles: Vec<u32> =
            triangles.iter().copied().filter(|triangle| !self.refuses(*triangle, x, y)).collect();
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

    /// Whether no ray with shears from `x` and `y` meets `triangle`.
    fn refuses(&self, triangle: u32, x: [f32; 2], y: [f32; 2]) -> bool {
        let corners = &self.corners[triangle as usize];
        if !corners.iter().all(|corner| corner.abs().max_element() < LARGEST) {
            return false;
        }
        let depth = |corner: &Vec3| if self.is_negative { -corner.z } else { corner.z };
        if corners.iter().all(|corner| depth(corner) <= -self.slack) {
            return true;
        }
        let [a, b, c] = corners.map(|corner| {
            let seen = |place: f32, shear: [f32; 2]| {
                Interval::around(shear.map(|s| place - s * corner.z)).widened(self.slack)
            };
            (seen(corner.x, x), seen(corner.y, y))
        });
        let beside = |p: [Interval; 3]| p.iter().all(|p| p.0 > 0.0) || p.iter().all(|p| p.1 < 0.0);
        if beside([a.0, b.0, c.0]) || beside([a.1, b.1, c.1]) {
            return true;
        }
        let edge =
            |p: (Interval, Interval), q: (Interval, Interval)| p.0.times(q.1).minus(p.1.times(q.0));
        let edges = [edge(c, b), edge(a, c), edge(b, a)];
        edges.iter().any(|edge| edge.0 > 0.0) && edges.iter().any(|edge| edge.1 < 0.0)
    }
}

/// The least and the greatest that a number can be.
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

    fn widened(self, slack: f32) -> Self {
        Self(self.0 - slack, self.1 + slack)
    }

    fn times(self, other: Self) -> Self {
        Self::around([self.0 * other.0, self.0 * other.1, self.1 * other.0, self.1 * other.1])
    }

    fn minus(self, other: Self) -> Self {
        Self(self.0 - other.1, self.1 - other.0)
    }
}
