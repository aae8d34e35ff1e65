//! Photons leave a point light: the draws and the rejection loop of
//! [`photon_mapping::scene::point_light`] in lanes.

use glam::Vec3;
use pulp::NullaryFnOnce;

use super::cells::cell_of;
use super::chacha;
use super::draws::Draws;
use super::first_hit::EmittedPhoton;
use super::outlook::UNKNOWN;
use photon_mapping::random::photon_random;

/// How many photons a kernel call emits. Their blocks fill half of a small first-level cache.
pub const GROUP: usize = 128;
/// How many numbers the five tries of the first block take. Of 42 photons one needs more.
pub const DRAWN_IN_VAIN: u32 = 15;

/// How many photons draw again at a time.
pub const AGAIN: usize = 16;

/// The points in the sphere that photons drew.
#[derive(Clone, Debug)]
pub struct LaneEmission<const LANES: usize> {
    /// The accepted point in the sphere, by [`coordinate`].
    pub point: [[f32; LANES]; 3],
    /// How many numbers were drawn; 0 when no try gave a point in the sphere.
    pub drawn: [u32; LANES],
    /// The three words after them; zeros in [`Emit`] after [`DRAWN_IN_VAIN`] numbers.
    pub next: [[u32; LANES]; 3],
    /// The [`cell_of`] of the point, or [`UNKNOWN`].
    pub cell: [u32; LANES],
}

impl<const LANES: usize> Default for LaneEmission<LANES> {
    fn default() -> Self {
        Self {
            point: [[0.0; LANES]; 3],
            drawn: [0; LANES],
            next: [[0; LANES]; 3],
            cell: [0; LANES],
        }
    }
}

/// The first accepted of the tries of one photon.
#[derive(Default)]
struct Accepted {
    point: Vec3,
    drawn: u32,
    next: [u32; 3],
}

impl Accepted {
    /// Makes the try with `words` count if it is accepted. It is the one before those so far;
    /// `drawn` numbers are drawn after it, and `next` are the words that come then.
    #[inline(always)]
    fn earlier(&mut self, drawn: u32, words: [u32; 3], next: [u32; 3]) {
        let point = Vec3::from_array(words.map(coordinate));
        let is_accepted = is_in_sphere(point);
        self.point.x = if is_accepted { point.x } else { self.point.x };
        self.point.y = if is_accepted { point.y } else { self.point.y };
        self.point.z = if is_accepted { point.z } else { self.point.z };
        self.drawn = if is_accepted { drawn } else { self.drawn };
        self.next[0] = if is_accepted { next[0] } else { self.next[0] };
        self.next[1] = if is_accepted { next[1] } else { self.next[1] };
        self.next[2] = if is_accepted { next[2] } else { self.next[2] };
    }

    #[inline(always)]
    fn put<const LANES: usize>(self, emission: &mut LaneEmission<LANES>, lane: usize) {
        let LaneEmission { point: [x, y, z], drawn, next: [next_0, next_1, next_2], cell } =
            emission;
        (x[lane], y[lane], z[lane]) = (self.point.x, self.point.y, self.point.z);
        drawn[lane] = self.drawn;
        (next_0[lane], next_1[lane], next_2[lane]) = (self.next[0], self.next[1], self.next[2]);
        let cell_of_point = cell_of(self.point);
        cell[lane] = if self.drawn == 0 { UNKNOWN } else { cell_of_point };
    }
}

/// Emits the photons from number `first` on.
pub struct Emit<'a> {
    /// The key of all random numbers.
    pub seed: u64,
    /// The number of the first photon; [`GROUP`] follow, and all are below 2^32 or not looked at.
    pub first: u32,
    /// Where the points go.
    pub emission: &'a mut LaneEmission<GROUP>,
}

impl NullaryFnOnce for Emit<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        for lane in 0..GROUP {
            // The same block for all: what does not depend on the photon is computed once.
            let w = chacha::block(self.seed, self.first.wrapping_add(lane as u32), 0);
            let mut accepted = Accepted::default();
            accepted.earlier(DRAWN_IN_VAIN, [w[12], w[13], w[14]], [0; 3]);
            accepted.earlier(12, [w[9], w[10], w[11]], [w[12], w[13], w[14]]);
            accepted.earlier(9, [w[6], w[7], w[8]], [w[9], w[10], w[11]]);
            accepted.earlier(6, [w[3], w[4], w[5]], [w[6], w[7], w[8]]);
            accepted.earlier(3, [w[0], w[1], w[2]], [w[3], w[4], w[5]]);
            accepted.put(self.emission, lane);
        }
    }
}

/// Goes on with photons whose first four tries were in vain.
pub struct EmitAgain<'a> {
    /// The key of all random numbers.
    pub seed: u64,
    /// The numbers of the photons.
    pub photons: &'a [u32; AGAIN],
    /// Where the points go.
    pub emission: &'a mut LaneEmission<AGAIN>,
}

impl NullaryFnOnce for EmitAgain<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        for lane in 0..AGAIN {
            let photon = self.photons[lane];
            let v = chacha::block(self.seed, photon, 0);
            let w = chacha::block(self.seed, photon, 1);
            let mut accepted = Accepted::default();
            accepted.earlier(27, [w[8], w[9], w[10]], [w[11], w[12], w[13]]);
            accepted.earlier(24, [w[5], w[6], w[7]], [w[8], w[9], w[10]]);
            accepted.earlier(21, [w[2], w[3], w[4]], [w[5], w[6], w[7]]);
            accepted.earlier(18, [v[15], w[0], w[1]], [w[2], w[3], w[4]]);
            accepted.earlier(15, [v[12], v[13], v[14]], [v[15], w[0], w[1]]);
            accepted.put(self.emission, lane);
        }
    }
}

/// What the photon numbered `photon` draws, however long that takes.
pub fn emit_one(seed: u64, photon: u32) -> EmittedPhoton {
    let mut random = photon_random(seed, photon.into());
    // Nobody looks at the lowest eight bits of a word.
    let mut words = || [0; 3].map(|_| ((random() * 16_777_216.0) as u32) << 8);
    let mut drawn = 3;
    let mut point = words().map(coordinate);
    while !is_in_sphere(Vec3::from_array(point)) {
        drawn += 3;
        point = words().map(coordinate);
    }
    EmittedPhoton { point, draws: Draws { photon, drawn, words: words() } }
}

/// The radius of the sphere in which points are drawn, 2^31. With such coordinates a word becomes
/// one in two operations. What is rounded is the same as in the unit sphere, since a power of two
/// changes no digit, and normalizing takes it away.
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lanes::width::Width;

    /// Of 10,000 photons some hundred need more than the first block, and some more than the tries
    /// of the second kernel.
    #[test]
    fn photons_are_emitted_as_one_at_a_time() {
        let (mut of_first, mut of_again, mut in_vain) = (0, 0, 0);
        for width in Width::available() {
            let mut emission = LaneEmission::<GROUP>::default();
            let mut again = LaneEmission::<AGAIN>::default();
            for first in (0..10_000).step_by(GROUP) {
                width.run(Emit { seed: 148, first, emission: &mut emission });
                for (lane, photon) in (first..).take(GROUP).enumerate() {
                    let expected = emit_one(148, photon);
                    if matches!(emission.drawn[lane], 1..DRAWN_IN_VAIN) {
                        of_first += 1;
                        check(&emission, lane, &expected);
                        continue;
                    }
                    assert!(expected.draws.drawn >= DRAWN_IN_VAIN, "{photon}");
                    width.run(EmitAgain {
                        seed: 148,
                        photons: &[photon; AGAIN],
                        emission: &mut again,
                    });
                    if again.drawn[lane % AGAIN] == 0 {
                        in_vain += 1;
                        assert!(expected.draws.drawn > 27, "{photon}");
                    } else {
                        of_again += 1;
                        check(&again, lane % AGAIN, &expected);
                    }
                }
            }
        }
        assert!(of_first > 9000 && of_again > 100 && in_vain > 0, "{of_again} {in_vain}");
    }

    fn check<const N: usize>(emission: &LaneEmission<N>, lane: usize, expected: &EmittedPhoton) {
        let EmittedPhoton { point, draws } = expected;
        assert_eq!([0, 1, 2].map(|c| emission.point[c][lane]), *point, "{}", draws.photon);
        assert_eq!(emission.drawn[lane], draws.drawn);
        // A number has 24 bits of its word.
        let words = [0, 1, 2].map(|n| emission.next[n][lane] & !0xff);
        assert_eq!(words, draws.words, "{}", draws.photon);
        assert_eq!(emission.cell[lane], cell_of(Vec3::from_array(*point)));
    }
}
