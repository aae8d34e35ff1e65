//! The random numbers: a stream of its own for every photon.

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

/// The numbers of photon `photon` (counted over all lights) of the run with `seed`: a function that
/// gives the next number, evenly distributed over the multiples of 2^-24 in [0, 1).
///
/// ChaCha with 8 rounds; the key is the seed as 8 little-endian bytes and 24 zero bytes, the stream
/// is the photon's number, and a number is the upper 24 bits of 32. Since no photon's numbers
/// depend on another's, any part of a run can be traced alone, in any order, on any number of
/// threads. These rules are part of the value-stability policy in `CHANGELOG.md`.
pub fn photon_random(seed: u64, photon: u64) -> impl FnMut() -> f32 {
    let mut key = [0; 32];
    key[..8].copy_from_slice(&seed.to_le_bytes());
    let mut generator = ChaCha8Rng::from_seed(key);
    generator.set_stream(photon);
    move || (generator.next_u32() >> 8) as f32 * (1.0 / 16_777_216.0)
}
