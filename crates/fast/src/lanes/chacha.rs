//! ChaCha blocks of many photons side by side: the numbers of [`photon_mapping::random`].

/// How many numbers a block holds.
pub const WORDS: usize = 16;

/// "expand 32-byte k", the first row of ChaCha's state.
const CONSTANTS: [u32; 4] = [0x6170_7865, 0x3320_646e, 0x7962_2d32, 0x6b20_6574];

/// Block `block` of the stream `photon` under the key `seed`.
///
/// D. J. Bernstein's ChaCha with 8 rounds, a 64-bit counter in words 12 and 13 and a 64-bit stream
/// in 14 and 15; counter and stream are below 2^32 here. In a loop over photons the compiler takes
/// as many of them at once as there are lanes.
#[inline(always)]
pub fn block(seed: u64, photon: u32, block: u32) -> [u32; WORDS] {
    let [c0, c1, c2, c3] = CONSTANTS;
    let (low, high) = (seed as u32, (seed >> 32) as u32);
    let start = [c0, c1, c2, c3, low, high, 0, 0, 0, 0, 0, 0, block, 0, photon, 0];
    let mut s = start;
    double_round(&mut s);
    double_round(&mut s);
    double_round(&mut s);
    double_round(&mut s);
    // Written out, since a loop would not be unrolled before lanes are made.
    [
        s[0].wrapping_add(start[0]),
        s[1].wrapping_add(start[1]),
        s[2].wrapping_add(start[2]),
        s[3].wrapping_add(start[3]),
        s[4].wrapping_add(start[4]),
        s[5].wrapping_add(start[5]),
        s[6].wrapping_add(start[6]),
        s[7].wrapping_add(start[7]),
        s[8].wrapping_add(start[8]),
        s[9].wrapping_add(start[9]),
        s[10].wrapping_add(start[10]),
        s[11].wrapping_add(start[11]),
        s[12].wrapping_add(start[12]),
        s[13].wrapping_add(start[13]),
        s[14].wrapping_add(start[14]),
        s[15].wrapping_add(start[15]),
    ]
}

#[inline(always)]
fn double_round(s: &mut [u32; 16]) {
    quarter_round(s, 0, 4, 8, 12);
    quarter_round(s, 1, 5, 9, 13);
    quarter_round(s, 2, 6, 10, 14);
    quarter_round(s, 3, 7, 11, 15);
    quarter_round(s, 0, 5, 10, 15);
    quarter_round(s, 1, 6, 11, 12);
    quarter_round(s, 2, 7, 8, 13);
    quarter_round(s, 3, 4, 9, 14);
}

#[inline(always)]
fn quarter_round(s: &mut [u32; 16], a: usize, b: usize, c: usize, d: usize) {
    s[a] = s[a].wrapping_add(s[b]);
    s[d] = (s[d] ^ s[a]).rotate_left(16);
    s[c] = s[c].wrapping_add(s[d]);
    s[b] = (s[b] ^ s[c]).rotate_left(12);
    s[a] = s[a].wrapping_add(s[b]);
    s[d] = (s[d] ^ s[a]).rotate_left(8);
    s[c] = s[c].wrapping_add(s[d]);
    s[b] = (s[b] ^ s[c]).rotate_left(7);
}

/// The number of [`photon_mapping::random::photon_random`] that the word `word` gives.
#[inline(always)]
pub fn number(word: u32) -> f32 {
    // Below 2^24 a signed number converts to the same float, and faster.
    (word >> 8) as i32 as f32 * (1.0 / 16_777_216.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use photon_mapping::random::photon_random;

    #[test]
    fn words_are_the_numbers_of_the_photons() {
        for seed in [0, 148, u64::MAX - 5] {
            for photon in [0, 1, 77, u32::MAX] {
                let mut random = photon_random(seed, photon.into());
                for word in (0..3).flat_map(|at| block(seed, photon, at)) {
                    assert_eq!(number(word).to_bits(), random().to_bits());
                }
            }
        }
    }
}
