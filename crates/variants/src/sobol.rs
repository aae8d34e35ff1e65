//! An Owen-scrambled Sobol sequence, of which each photon takes one point.
//!
//! Directions are those of Joe and Kuo (*Constructing Sobol sequences with better two-dimensional
//! projections*, SIAM J. Sci. Comput. 2008, their table `new-joe-kuo-6`). Scrambling is by hashing,
//! after Laine and Karras (*Stratified sampling for stochastic transparency*, EGSR 2011) and Burley
//! (*Practical hash-based Owen scrambling*, JCGT 2020), with the hash of Vegdahl (2021), which is
//! closer to a true Owen scramble. Emission and the first two bounces share one point of eight
//! dimensions. Each later bounce takes a point of a sequence of its own, shuffled and scrambled
//! independently: Burley's padding.
//!
//! Limits: 2^32 photons. A number has 24 bits, as those of the reference have, so beyond 2^24
//! photons a single dimension is not stratified further. From the third bounce on, the photons of
//! different bounces are independent, and little is gained there.
//!
//! Written here because the crate `sobol_burley` ends after 2^16 points.

/// Dimensions of the first point: two for the emission, three for each of two bounces.
const DIMENSIONS: usize = 8;
/// Numbers drawn at a bounce: the roulette's, u1 and u2.
const PER_BOUNCE: u32 = 3;

/// Degree, inner coefficients and initial directions of the primitive polynomials, from the second
/// dimension on.
const JOE_KUO: [(usize, u32, &[u32]); DIMENSIONS - 1] = [
    (1, 0, &[1]),
    (2, 1, &[1, 3]),
    (3, 1, &[1, 3, 1]),
    (3, 2, &[1, 1, 1]),
    (4, 1, &[1, 1, 3, 3]),
    (4, 4, &[1, 3, 5, 13]),
    (5, 2, &[1, 1, 5, 5, 17]),
];

/// For each dimension, what each bit of the index adds (without carry) to the point.
const DIRECTIONS: [[u32; 32]; DIMENSIONS] = directions();

const fn directions() -> [[u32; 32]; DIMENSIONS] {
    let mut all = [[0; 32]; DIMENSIONS];
    let mut bit = 0;
    while bit < 32 {
        all[0][bit] = 1 << (31 - bit);
        bit += 1;
    }
    let mut dimension = 1;
    while dimension < DIMENSIONS {
        let (degree, coefficients, initial) = JOE_KUO[dimension - 1];
        let mut bit = 0;
        while bit < 32 {
            all[dimension][bit] = if bit < degree {
                initial[bit] << (31 - bit)
            } else {
                let oldest = all[dimension][bit - degree];
                let mut direction = oldest ^ (oldest >> degree);
                let mut k = 1;
                while k < degree {
                    if (coefficients >> (degree - 1 - k)) & 1 == 1 {
                        direction ^= all[dimension][bit - k];
                    }
                    k += 1;
                }
                direction
            };
            bit += 1;
        }
        dimension += 1;
    }
    all
}

/// The numbers of one photon, one after another.
#[derive(Clone, Copy, Debug)]
pub struct SobolPath {
    seed: u64,
    photon: u32,
    drawn: u32,
}

impl SobolPath {
    /// The numbers of photon `photon`, of which the low 32 bits count, in the run with `seed`.
    pub fn new(seed: u64, photon: u64) -> Self {
        Self { seed, photon: photon as u32, drawn: 0 }
    }

    /// The next number, a multiple of 2^-24 in [0, 1). It depends on the seed, the photon, and how
    /// many numbers the photon has drawn before, which tells bounce and dimension.
    pub fn next_number(&mut self) -> f32 {
        let drawn = self.drawn;
        self.drawn += 1;
        let joint = DIMENSIONS as u32;
        let (set, dimension) = match drawn.checked_sub(joint) {
            None => (0, drawn),
            Some(later) => (1 + later / PER_BOUNCE, later % PER_BOUNCE),
        };
        let index = match set {
            0 => self.photon,
            _ => scramble(self.photon, key(self.seed, set, u32::MAX)),
        };
        let point = sobol(index, dimension as usize);
        let scrambled = scramble(point, key(self.seed, set, dimension));
        (scrambled >> 8) as f32 * (1.0 / 16_777_216.0)
    }
}

/// Dimension `dimension` of point `index`, as a fraction of 2^32.
fn sobol(mut index: u32, dimension: usize) -> u32 {
    let mut point = 0;
    while index != 0 {
        point ^= DIRECTIONS[dimension][index.trailing_zeros() as usize];
        index &= index - 1;
    }
    point
}

/// A nested uniform scramble of the 32 bits of `x`: each bit is flipped or not depending on all
/// higher ones.
fn scramble(x: u32, key: u32) -> u32 {
    let mut x = x.reverse_bits();
    x ^= x.wrapping_mul(0x3d20_adea);
    x = x.wrapping_add(key);
    x = x.wrapping_mul((key >> 16) | 1);
    x ^= x.wrapping_mul(0x0552_6c56);
    x ^= x.wrapping_mul(0x53a2_2864);
    x.reverse_bits()
}

/// A key for every seed, set and dimension, by the finalizer of SplitMix64 (Steele et al. 2014).
fn key(seed: u64, set: u32, dimension: u32) -> u32 {
    let mix = |x: u64| {
        let x = (x ^ (x >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let x = (x ^ (x >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        x ^ (x >> 31)
    };
    let place = (u64::from(set) << 32) | u64::from(dimension);
    let seed = mix(seed.wrapping_add(0x9E37_79B9_7F4A_7C15));
    (mix(seed ^ mix(place.wrapping_add(0x9E37_79B9_7F4A_7C15))) >> 32) as u32
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn first_points_fill_every_orthant_once() {
        // Sobol's property A, which the directions of Joe and Kuo have.
        let mut seen = [false; 1 << DIMENSIONS];
        for index in 0..1 << DIMENSIONS {
            let orthant = (0..DIMENSIONS)
                .fold(0, |place, dimension| 2 * place + (sobol(index, dimension) >> 31) as usize);
            assert!(!std::mem::replace(&mut seen[orthant], true));
        }
    }

    #[test]
    fn scrambled_points_fill_every_stratum_once() {
        for seed in [0, 148, u64::MAX] {
            for draw in 0..20 {
                let mut seen = [false; 1024];
                for photon in 0..1024 {
                    let mut path = SobolPath { drawn: draw, ..SobolPath::new(seed, photon) };
                    let stratum = (path.next_number() * 1024.0) as usize;
                    assert!(!std::mem::replace(&mut seen[stratum], true), "draw {draw}");
                }
            }
        }
    }

    #[test]
    fn two_dimensions_of_a_set_make_a_net() {
        // Every elementary interval of area 2^-10 holds one of 2^10 points of dimensions 0 and 1.
        for shift in 0..=10 {
            let mut seen = [false; 1024];
            for photon in 0..1024 {
                let mut path = SobolPath::new(7, photon);
                let column = (path.next_number() * (1 << shift) as f32) as usize;
                let row = (path.next_number() * (1 << (10 - shift)) as f32) as usize;
                let place = (column << (10 - shift)) | row;
                assert!(!std::mem::replace(&mut seen[place], true), "shift {shift}");
            }
        }
    }

    #[test]
    fn sequences_of_different_keys_differ() {
        let first = |seed| SobolPath::new(seed, 0).next_number();
        assert_ne!(first(1), first(2));
        assert_ne!(key(1, 0, 1), key(1, 1, 0));
    }
}
