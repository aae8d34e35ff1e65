//! Photons leave a point light: the draws and the rejection loop of
//! [`photon_mapping::scene::point_light`] in lanes.

use glam::Vec3;
use pulp::NullaryFnOnce;

use super::chacha;
use super::outlook::{UNKNOWN, rough_cell};

/// How many photons a kernel call emits. Their blocks fill half of a small first-level cache.
pub const GROUP: usize = 128;
/// How many numbers the five tries of the first block take. Of 42 photons one needs more.
pub const DRAWN_IN_VAIN: u32 = 15;

/// The points in the sphere that [`GROUP`] photons drew.
#[derive(Clone, Debug)]
pub struct LaneEmission {
    /// The accepted point in the sphere, by [`coordinate`].
    pub point: [[f32; GROUP]; 3],
    /// How many numbers were drawn; 0 when the block held no point in the sphere.
    pub drawn: [u32; GROUP],
    /// The three words after them, if the block has them all, else zeros.
    pub next: [[u32; GROUP]; 3],
    /// The [`rough_cell`] of the point, or [`UNKNOWN`] where point or words are missing.
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
            let is_known = (count != 0) & (count != DRAWN_IN_VAIN);
            cell[lane] = if is_known { rough_cell } else { UNKNOWN };
        }
    }
}

/// The radius of the sphere in which points are drawn, 2^31. With such coordinates a word becomes
/// one in two operations. What is rounded is the same as in the unit sphere, since a power of two
/// changes no digit, and normalising takes it away.
pub const RADIUS: f32 = 2_147_483_648.0;

/// 2 r - 1 for the number r of `word`, times [`RADIUS`]: exact, with 24 digits.
#[inline(always)]
pub fn coordinate(word: u32) -> f32 {
    ((word & !0xff) ^ (1 << 31)) as i32 as f32
}

/// Whether the rejection loop takes `point`.
#[inline(always)]
pub fn is_in_sphere(point: Vec3) -> bool {
    let length_squared = point.length_squared();
    // Both comparisons always, where `&&` would branch.
    (length_squared <= RADIUS * RADIUS) & (length_squared > 0.0)
}
