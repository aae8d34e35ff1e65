//! Photons leave a point light: the draws and the rejection loop of
//! [`photon_mapping::scene::point_light`] in lanes.

use glam::Vec3;
use pulp::NullaryFnOnce;

use super::chacha;
use super::first_hit::Aimed;
use super::outlook::{UNKNOWN, aim, rough_cell};

/// How many photons a kernel call emits. Their blocks fill half of a small first-level cache.
pub const GROUP: usize = 128;
/// How many numbers the five tries of the first block take. Of 42 photons one needs more.
pub const DRAWN_IN_VAIN: u32 = 15;

/// The points in the sphere that [`GROUP`] photons drew.
#[derive(Clone, Debug)]
pub struct LaneEmission {
    /// The accepted point in the unit sphere, by coordinate.
    pub point: [[f32; GROUP]; 3],
    /// How many numbers were drawn; 0 when the block held no point in the sphere.
    pub drawn: [u32; GROUP],
    /// The three words after them, if the block has them all, else zeros.
    pub next: [[u32; GROUP]; 3],
    /// The [`rough_cell`] of the point, or [`UNKNOWN`].
    pub cell: [u32; GROUP],
}

impl Default for LaneEmission {
    fn default() -> Self {
        Self {
            point: [[0.0; GROUP]; 3],
            drawn: [0; GROUP],
            next: [[0; GROUP]; 3],
            cell: [0; GROUP],
        }
    }
}

/// Emits the photons from number `first` on.
pub struct Emit<'a> {
    /// The key of all random numbers.
    pub seed: u64,
    /// The number of the first photon; [`GROUP`] follow, and all are below 2^32 or not looked at.
    pub first: u32,
    /// Where the points go.
    pub emission: &'a mut LaneEmission,
}

impl NullaryFnOnce for Emit<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let LaneEmission { point, drawn, next, cell } = self.emission;
        let [xs, ys, zs] = point;
        let [next_0, next_1, next_2] = next;
        for lane in 0..GROUP {
            // The same block for all: what does not depend on the photon is computed once.
            let w = chacha::block(self.seed, self.first.wrapping_add(lane as u32), 0);
            let (mut x, mut y, mut z) = (0.0, 0.0, 0.0);
            let (mut count, mut n0, mut n1, mut n2) = (0, 0, 0, 0);
            let mut attempt = |after: u32, words: [u32; 3], next: [u32; 3]| {
                let [tx, ty, tz] = words.map(coordinate);
                let is_accepted = is_in_sphere(Vec3::new(tx, ty, tz));
                x = if is_accepted { tx } else { x };
                y = if is_accepted { ty } else { y };
                z = if is_accepted { tz } else { z };
                count = if is_accepted { after } else { count };
                n0 = if is_accepted { next[0] } else { n0 };
                n1 = if is_accepted { next[1] } else { n1 };
                n2 = if is_accepted { next[2] } else { n2 };
            };
            // From the last try to the first, so that the first accepted one remains.
            attempt(DRAWN_IN_VAIN, [w[12], w[13], w[14]], [0; 3]);
            attempt(12, [w[9], w[10], w[11]], [w[12], w[13], w[14]]);
            attempt(9, [w[6], w[7], w[8]], [w[9], w[10], w[11]]);
            attempt(6, [w[3], w[4], w[5]], [w[6], w[7], w[8]]);
            attempt(3, [w[0], w[1], w[2]], [w[3], w[4], w[5]]);
            (xs[lane], ys[lane], zs[lane]) = (x, y, z);
            drawn[lane] = count;
            (next_0[lane], next_1[lane], next_2[lane]) = (n0, n1, n2);
            let rough_cell = rough_cell(Vec3::new(x, y, z));
            cell[lane] = if count == 0 { UNKNOWN } else { rough_cell };
        }
    }
}

/// 2 r - 1 for the number r of `word`. Twice a multiple of 2^-24 is exact, so it may be taken at
/// once.
#[inline(always)]
pub fn coordinate(word: u32) -> f32 {
    (word >> 8) as i32 as f32 * (1.0 / 8_388_608.0) - 1.0
}

/// Directions of [`GROUP`] photons, and what [`aim`] makes of them.
#[derive(Clone, Debug)]
pub struct Aims {
    /// The unit vectors, by coordinate.
    pub direction: [[f32; GROUP]; 3],
    /// The cells.
    pub cell: [u32; GROUP],
    /// The shears, and which photon it is.
    pub aimed: [Aimed; GROUP],
}

impl Default for Aims {
    fn default() -> Self {
        Self { direction: [[0.0; GROUP]; 3], cell: [0; GROUP], aimed: [[0.0; 4]; GROUP] }
    }
}

/// Normalises points in the sphere.
pub struct Aim<'a> {
    /// The points.
    pub point: &'a [[f32; GROUP]; 3],
    /// The place of the first photon.
    pub first: u32,
    /// Where the directions go.
    pub aims: &'a mut Aims,
}

impl NullaryFnOnce for Aim<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let [x, y, z] = self.point;
        let Aims { direction: [dx, dy, dz], cell, aimed } = self.aims;
        for lane in 0..GROUP {
            let direction = Vec3::new(x[lane], y[lane], z[lane]).normalize();
            let (cell_of_lane, shear) = aim(direction);
            (dx[lane], dy[lane], dz[lane]) = (direction.x, direction.y, direction.z);
            cell[lane] = cell_of_lane;
            let place = f32::from_bits(self.first + lane as u32);
            aimed[lane] = [shear.x, shear.y, shear.z, place];
        }
    }
}

/// Whether the rejection loop takes `point`.
#[inline(always)]
pub fn is_in_sphere(point: Vec3) -> bool {
    let length_squared = point.length_squared();
    // Both comparisons always, where `&&` would branch.
    (length_squared <= 1.0) & (length_squared > 0.0)
}
