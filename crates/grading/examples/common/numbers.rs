//! Random numbers as other programs draw them.

use photon_mapping::random::photon_random;

/// Numbers for the settings of a simulated submission.
pub struct Settings(pub Box<dyn FnMut() -> f32 + Send>);

impl Settings {
    /// A number between both, even in proportion.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low * (high / low).powf(f64::from((self.0)()))
    }

    /// One of `choices`.
    pub fn one_of<T: Copy>(&mut self, choices: &[T]) -> T {
        choices[((self.0)() * choices.len() as f32) as usize]
    }
}

/// The generator behind C's `drand48`.
pub struct Drand48(u64);

impl Drand48 {
    /// With this seed.
    pub fn new(seed: u64) -> Self {
        Self((seed << 16) | 0x330E)
    }
}

impl Iterator for Drand48 {
    type Item = f32;

    fn next(&mut self) -> Option<f32> {
        self.0 = (self.0.wrapping_mul(0x5_DEEC_E66D).wrapping_add(0xB)) & ((1 << 48) - 1);
        Some((self.0 >> 24) as f32 * (1.0 / 16_777_216.0))
    }
}

/// A generator of 15 bits, as behind `rand` where `RAND_MAX` is 32767.
pub struct FifteenBits(pub u32);

impl Iterator for FifteenBits {
    type Item = f32;

    fn next(&mut self) -> Option<f32> {
        self.0 = self.0.wrapping_mul(214_013).wrapping_add(2_531_011);
        Some(((self.0 >> 16) & 0x7FFF) as f32 / 32_768.0)
    }
}

/// The numbers of one photon by Halton, each base moved round by a random part as Cranley and
/// Patterson do; after the bases given here, random ones.
pub fn halton(photon: u64, seed: u64) -> impl FnMut() -> f32 {
    let mut bases = [2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37].into_iter();
    let (mut moved, mut random) = (photon_random(seed, 1 << 31), photon_random(seed, photon));
    move || {
        match bases.next() {
            Some(base) => (radical_inverse(photon, base) + f64::from(moved())).fract() as f32,
            None => random(),
        }
        .min(1.0_f32.next_down())
    }
}

/// The digits of `number` to `base`, mirrored at the point.
fn radical_inverse(mut number: u64, base: u64) -> f64 {
    let (mut inverse, mut unit) = (0.0, 1.0);
    while number > 0 {
        unit /= base as f64;
        inverse += unit * (number % base) as f64;
        number /= base;
    }
    inverse
}

/// For each of a photon's first five numbers, the strata in a random order: as many as photons.
pub fn strata(emitted: u64, seed: u64) -> [Vec<u64>; 5] {
    let mut random = photon_random(seed, 1 << 31);
    std::array::from_fn(|_| {
        let mut order: Vec<u64> = (0..emitted).collect();
        for last in (1..order.len()).rev() {
            let other = (f64::from(random()) * (last + 1) as f64) as usize;
            order.swap(last, other);
        }
        order
    })
}

/// The numbers of one photon, each of the first five within its stratum.
pub fn stratified(photon: u64, strata: &[Vec<u64>; 5], seed: u64) -> impl FnMut() -> f32 {
    let mut of_photon = strata.each_ref().map(|order| order[photon as usize]).into_iter();
    let of_one = strata[0].len() as f64;
    let mut random = photon_random(seed, photon);
    move || {
        let within = f64::from(random());
        let number = of_photon.next().map_or(within, |stratum| (stratum as f64 + within) / of_one);
        (number as f32).min(1.0_f32.next_down())
    }
}
