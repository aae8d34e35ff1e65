//! Photons leave a point light: the draws and the rejection loop of
//! [`crate::scene::lights::point_light`] in lanes.

use glam::Vec3;
use pulp::NullaryFnOnce;

use super::chacha::{self, WORDS, number};
use super::outlook::{aim, rough_cell};

/// How many photons a kernel call sends out. Their blocks fill half of a small first-level cache.
pub const GROUP: usize = 128;
/// How many tries the first block has numbers for. Of 42 photons one needs more.
const TRIES: usize = 5;
/// How many numbers the tries of the first block take.
pub const DRAWN_IN_VAIN: u32 = 3 * TRIES as u32;

/// The points in the sphere that [`GROUP`] photons drew.
#[derive(Clone, Debug)]
pub struct Emission {
    /// The accepted point in the unit sphere, by coordinate.
    pub point: [[f32; GROUP]; 3],
    /// How many numbers were drawn; 0 when the block held no point in the sphere.
    pub drawn: [u32; GROUP],
    /// The three words after them, if the block has them all, else zeros.
    pub next: [[u32; GROUP]; 3],
    /// The [`rough_cell`] of the point.
    pub cell: [u32; GROUP],
}

impl Default for Emission {
    fn default() -> Self {
        Self {
            point: [[0.0; GROUP]; 3],
            drawn: [0; GROUP],
            next: [[0; GROUP]; 3],
            cell: [0; GROUP],
        }
    }
}

/// Sends out the photons from number `first` on.
pub struct Emit<'a> {
    /// The key of all random numbers.
    pub seed: u64,
    /// The number of the first photon; [`GROUP`] follow, and all are below 2^32 or not looked at.
    pub first: u32,
    /// Where the blocks go.
    pub words: &'a mut [[u32; GROUP]; WORDS],
    /// Where the points go.
    pub emission: &'a mut Emission,
}

impl NullaryFnOnce for Emit<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let words = self.words;
        let Emission { point, drawn, next, cell } = self.emission;
        let mut photons = [0; GROUP];
        for (lane, photon) in photons.iter_mut().enumerate() {
            *photon = self.first.wrapping_add(lane as u32);
        }
        // The same block for all: what does not depend on the photon is computed once.
        chacha::blocks(self.seed, &photons, |_| 0, words);
        let [xs, ys, zs] = point;
        let [next_0, next_1, next_2] = next;
        for lane in 0..GROUP {
            let (mut x, mut y, mut z) = (0.0, 0.0, 0.0);
            let mut count = 0;
            let (mut n0, mut n1, mut n2) = (0, 0, 0);
            // From the last try to the first, so that the first accepted one remains.
            for t in (0..TRIES).rev() {
                let (tx, ty, tz) = (
                    2.0 * number(words[3 * t][lane]) - 1.0,
                    2.0 * number(words[3 * t + 1][lane]) - 1.0,
                    2.0 * number(words[3 * t + 2][lane]) - 1.0,
                );
                let is_accepted = is_in_sphere(Vec3::new(tx, ty, tz));
                let after = 3 * (t + 1);
                x = if is_accepted { tx } else { x };
                y = if is_accepted { ty } else { y };
                z = if is_accepted { tz } else { z };
                count = if is_accepted { after as u32 } else { count };
                if after + 2 < WORDS {
                    n0 = if is_accepted { words[after][lane] } else { n0 };
                    n1 = if is_accepted { words[after + 1][lane] } else { n1 };
                    n2 = if is_accepted { words[after + 2][lane] } else { n2 };
                }
            }
            (xs[lane], ys[lane], zs[lane]) = (x, y, z);
            drawn[lane] = count;
            (next_0[lane], next_1[lane], next_2[lane]) = (n0, n1, n2);
            cell[lane] = rough_cell(Vec3::new(x, y, z));
        }
    }
}

/// Directions of [`GROUP`] photons, and what [`aim`] makes of them.
#[derive(Clone, Debug)]
pub struct Aims {
    /// The unit vectors, by coordinate.
    pub direction: [[f32; GROUP]; 3],
    /// The cells.
    pub cell: [u32; GROUP],
    /// The shears, by coordinate.
    pub shear: [[f32; GROUP]; 3],
}

impl Default for Aims {
    fn default() -> Self {
        Self { direction: [[0.0; GROUP]; 3], cell: [0; GROUP], shear: [[0.0; GROUP]; 3] }
    }
}

/// Normalises points in the sphere.
pub struct Aim<'a> {
    /// The points.
    pub point: &'a [[f32; GROUP]; 3],
    /// Where the directions go.
    pub aims: &'a mut Aims,
}

impl NullaryFnOnce for Aim<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let [x, y, z] = self.point;
        let Aims { direction: [dx, dy, dz], cell, shear: [sx, sy, sz] } = self.aims;
        for lane in 0..GROUP {
            let direction = Vec3::new(x[lane], y[lane], z[lane]).normalize();
            let (cell_of_lane, shear) = aim(direction);
            (dx[lane], dy[lane], dz[lane]) = (direction.x, direction.y, direction.z);
            cell[lane] = cell_of_lane;
            (sx[lane], sy[lane], sz[lane]) = (shear.x, shear.y, shear.z);
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
