//! What a point light can hit in which direction, found out once for all of its photons.
//!
//! All photons of a point light start at one point, and three in four of the handout's leave the
//! scene at once. So the directions are divided into cells, six faces of a cube with a grid on each,
//! and each cell keeps the triangles that a ray through it *may* meet: often none, mostly one.
//!
//! The bits cannot change, because a triangle is left out of a cell only where the test of
//! [`crate::scene::triangle`] is certain to refuse it. That test sees a corner at
//! `x' = x - s z`, where (x, y, z) lead from the light to the corner in the order of the ray's axes
//! and the shear s = d_x / d_z lies in [-1, 1]. Rounding is monotonic, so the *rounded* x' of all
//! rays of a cell lies between the rounded x' of its two ends, and what is said of these intervals
//! holds for what the test computes. It refuses every ray of the cell when
//!
//! - no corner has positive depth: t is then a mean of numbers <= 0, never > 0;
//! - all corners have x' > 0 (or x' < 0, or the same of y'): since `a_x u + b_x v + c_x w = 0`, the
//!   true edge functions have mixed signs or are all zero;
//! - one edge function is certainly positive and another certainly negative.
//!
//! The test's signs are the true ones unless an edge function underflows to zero. Shears of a
//! photon's direction are 0 or at least 2^-24, so they cannot where each coordinate is 0 or at least
//! 2^-25; a triangle with smaller ones is in every cell.

use glam::Vec3;

use super::closest_hit::{NONE, mask};
use crate::scene::Scene;
use crate::scene::triangle::{ShearedRay, meet};

/// Cells along the edge of a face of the cube; a power of two, so that the cells' ends are exact.
const EDGE: usize = 32;
/// How many cells there are.
const CELLS: usize = 6 * EDGE * EDGE;
/// How far a cell reaches over its ends, 2^-16: four times what [`step`] moves a shear by shrinking
/// the grid and rounding.
const MARGIN: f32 = 1.0 / 65_536.0;
/// Coordinates below this, 2^-25, may underflow in the edge functions.
const SMALLEST: f32 = 1.0 / 33_554_432.0;
/// Coordinates beyond this may overflow in them.
const LARGEST: f32 = 1e9;

/// The triangles of a scene as one light sees them.
#[derive(Clone, Debug)]
pub struct Outlook {
    /// The triangles seen from the light, once for each axis that a ray runs along.
    seen: [Vec<Seen>; 3],
    /// The triangles of cell c are `triangles[starts[c]..starts[c + 1]]`, in ascending order.
    starts: Vec<u32>,
    triangles: Vec<u32>,
    occupied: Vec<u8>,
}

/// The corners of a triangle, by coordinate. The fourth place fills a vector of four; it holds the
/// first corner once more.
#[derive(Clone, Copy, Debug)]
#[repr(align(16))]
struct Seen([[f32; 4]; 3]);

impl Seen {
    fn new([a, b, c]: &[Vec3; 3]) -> Self {
        Self([0, 1, 2].map(|axis| [a[axis], b[axis], c[axis], a[axis]]))
    }

    /// The test of [`meet`] without its branches, since which of two triangles a ray meets cannot be
    /// predicted: whether, and at which distance.
    #[inline(always)]
    fn meet(&self, shear: Vec3) -> (bool, f32) {
        let Self([x, y, z]) = self;
        let (mut sx, mut sy, mut sz) = ([0.0; 4], [0.0; 4], [0.0; 4]);
        for corner in 0..4 {
            sx[corner] = x[corner] - shear.x * z[corner];
            sy[corner] = y[corner] - shear.y * z[corner];
            sz[corner] = shear.z * z[corner];
        }
        // u, v, w, and u once more.
        let (px, py) = ([sx[2], sx[0], sx[1], sx[2]], [sy[2], sy[0], sy[1], sy[2]]);
        let (qx, qy) = ([sx[1], sx[2], sx[0], sx[1]], [sy[1], sy[2], sy[0], sy[1]]);
        let mut edges = [0.0; 4];
        for edge in 0..4 {
            edges[edge] = px[edge] * qy[edge] - py[edge] * qx[edge];
        }
        let (mut is_negative, mut is_positive, mut is_zero) = (false, false, false);
        for edge in edges {
            is_negative |= edge < 0.0;
            is_positive |= edge > 0.0;
            is_zero |= edge == 0.0;
        }
        if is_zero {
            let second_look = meet([0, 1, 2].map(|c| Vec3::new(sx[c], sy[c], sz[c])));
            return (second_look.is_some(), second_look.unwrap_or(0.0));
        }
        let [u, v, w, _] = edges;
        let determinant = u + v + w;
        let t = (u * sz[0] + v * sz[1] + w * sz[2]) / determinant;
        (!(is_negative & is_positive) & (determinant != 0.0) & (t > 0.0), t)
    }
}

/// A ray from the light, ready for the triangle test.
#[derive(Clone, Copy, Debug)]
pub struct ShearedDirection {
    /// The cell of the direction.
    pub cell: u32,
    /// The shears along x and y, and the reciprocal of the direction along z.
    pub shear: Vec3,
}

impl ShearedDirection {
    /// Prepares the unit vector `direction`, as [`ShearedRay::new`] does.
    #[inline(always)]
    pub fn new(direction: Vec3) -> Self {
        let Vec3 { x, y, z } = direction;
        let size = direction.abs();
        // The choice of `ShearedRay::axes`, without its branches.
        let along_x = size.x >= size.y && size.x >= size.z;
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
        let face = 2 * axis + i32::from(turned.z < 0.0);
        let shear = Vec3::new(turned.x / turned.z, turned.y / turned.z, 1.0 / turned.z);
        let cell = (face * EDGE as i32 + step(shear.y)) * EDGE as i32 + step(shear.x);
        Self { cell: cell as u32, shear }
    }
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
    /// The triangles of `scene` as seen from `origin`.
    pub fn new(scene: &Scene, origin: Vec3) -> Self {
        let turned = |[x, y, z]: [usize; 3]| -> Vec<[Vec3; 3]> {
            let turn = |corner: Vec3| {
                let from_origin = corner - origin;
                Vec3::new(from_origin[x], from_origin[y], from_origin[z])
            };
            scene.triangles().iter().map(|triangle| triangle.vertices.map(turn)).collect()
        };
        let corners = [Vec3::X, Vec3::Y, Vec3::Z].map(|axis| turned(ShearedRay::axes(axis)));
        let mut starts = vec![0];
        let mut triangles = Vec::new();
        for face in 0..6 {
            let is_negative = face % 2 == 1;
            let corners = &corners[face / 2];
            let of_face =
                may_be_met(0..corners.len() as u32, corners, is_negative, [-1.0, 1.0], [-1.0, 1.0]);
            for row in 0..EDGE {
                let of_row = may_be_met(
                    of_face.iter().copied(),
                    corners,
                    is_negative,
                    [-1.0, 1.0],
                    ends(row),
                );
                for column in 0..EDGE {
                    triangles.extend(may_be_met(
                        of_row.iter().copied(),
                        corners,
                        is_negative,
                        ends(column),
                        ends(row),
                    ));
                    starts.push(triangles.len() as u32);
                }
            }
        }
        let occupied = starts.windows(2).map(|ends| u8::from(ends[0] < ends[1])).collect();
        debug_assert_eq!(starts.len(), CELLS + 1);
        let seen = corners.map(|corners| corners.iter().map(Seen::new).collect());
        Self { seen, starts, triangles, occupied }
    }

    /// 1 if a ray through `cell` may meet anything, else 0.
    #[inline(always)]
    pub fn occupied(&self, cell: u32) -> u8 {
        self.occupied[cell as usize]
    }

    /// The closest triangle that a ray in `direction` meets and its distance: what
    /// [`Scene::trace`] would say.
    #[inline(always)]
    pub fn closest(&self, direction: ShearedDirection) -> Option<(u32, f32)> {
        let ShearedDirection { cell, shear } = direction;
        let cell = cell as usize;
        let seen = &self.seen[cell / (2 * EDGE * EDGE)];
        let mut closest_t = f32::INFINITY;
        let mut closest = NONE;
        let candidates =
            &self.triangles[self.starts[cell] as usize..self.starts[cell + 1] as usize];
        for &triangle in candidates {
            let (is_met, t) = seen[triangle as usize].meet(shear);
            let is_closer = mask(is_met & (t < closest_t));
            closest_t =
                f32::from_bits((t.to_bits() & is_closer) | (closest_t.to_bits() & !is_closer));
            closest = (triangle & is_closer) | (closest & !is_closer);
        }
        (closest != NONE).then_some((closest, closest_t))
    }
}

fn ends(step: usize) -> [f32; 2] {
    let end = |step: usize| step as f32 * (2.0 / EDGE as f32) - 1.0;
    [(end(step) - MARGIN).max(-1.0), (end(step + 1) + MARGIN).min(1.0)]
}

/// Which of `triangles` a ray with shears in the intervals `x` and `y` may meet.
fn may_be_met(
    triangles: impl Iterator<Item = u32> + Clone,
    corners: &[[Vec3; 3]],
    is_negative: bool,
    x: [f32; 2],
    y: [f32; 2],
) -> Vec<u32> {
    triangles
        .filter(|triangle| !is_refused(&corners[*triangle as usize], is_negative, x, y))
        .collect()
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
        let [low, high] = [f32::min, f32::max]
            .map(|choose| values.into_iter().reduce(choose).expect("there is a value"));
        Self(low, high)
    }

    fn times(self, other: Self) -> Self {
        Self::around([self.0 * other.0, self.0 * other.1, self.1 * other.0, self.1 * other.1])
    }

    fn minus(self, other: Self) -> Self {
        Self(self.0 - other.1, self.1 - other.0)
    }
}
