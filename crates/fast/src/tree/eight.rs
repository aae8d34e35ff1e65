//! Eight numbers side by side, with the vectors that the processor has.

use pulp::{Scalar256b, Simd, f32x8, m32x8};

use crate::lanes::width::Width;

/// Vector instructions for eight numbers.
pub trait Eight: Simd<f32s = f32x8, m32s = m32x8> {
    /// A bit for each number that `mask` takes, the first one lowest.
    fn bits(self, mask: m32x8) -> u32;

    /// The greater of two numbers, or `b` if one is not a number.
    fn greater(self, a: f32x8, b: f32x8) -> f32x8;

    /// The smaller of two numbers, or `b` if one is not a number.
    fn smaller(self, a: f32x8, b: f32x8) -> f32x8;

    /// `a` times `b` minus `c` times `d`, each rounded.
    #[inline(always)]
    fn cross(self, a: f32x8, b: f32x8, c: f32x8, d: f32x8) -> f32x8 {
        self.sub_f32s(self.mul_f32s(a, b), self.mul_f32s(c, d))
    }
}

impl Eight for Scalar256b {
    #[inline(always)]
    fn bits(self, mask: m32x8) -> u32 {
        let lanes: [u32; 8] = pulp::cast(mask);
        lanes.iter().enumerate().fold(0, |bits, (lane, mask)| bits | (mask & 1) << lane)
    }

    #[inline(always)]
    fn greater(self, a: f32x8, b: f32x8) -> f32x8 {
        self.select_f32s(self.greater_than_f32s(a, b), a, b)
    }

    #[inline(always)]
    fn smaller(self, a: f32x8, b: f32x8) -> f32x8 {
        self.select_f32s(self.less_than_f32s(a, b), a, b)
    }
}

#[cfg(target_arch = "x86_64")]
impl Eight for pulp::x86::V3 {
    #[inline(always)]
    fn bits(self, mask: m32x8) -> u32 {
        self.avx._mm256_movemask_ps(pulp::cast(mask)) as u32
    }

    #[inline(always)]
    fn greater(self, a: f32x8, b: f32x8) -> f32x8 {
        pulp::cast(self.avx._mm256_max_ps(pulp::cast(a), pulp::cast(b)))
    }

    #[inline(always)]
    fn smaller(self, a: f32x8, b: f32x8) -> f32x8 {
        pulp::cast(self.avx._mm256_min_ps(pulp::cast(a), pulp::cast(b)))
    }
}

/// What is done with eight numbers side by side. Everything that it calls must be inlined into it.
pub trait WithEight {
    /// What comes of it.
    type Output;

    /// Does it.
    fn with<E: Eight>(self, eight: E) -> Self::Output;
}

/// Does `kernel` with the vectors of `width`.
#[cfg(target_arch = "x86_64")]
#[inline(always)]
pub fn with_eight<K: WithEight>(width: Width, kernel: K) -> K::Output {
    struct InV3<K>(pulp::x86::V3, K);
    impl<K: WithEight> pulp::NullaryFnOnce for InV3<K> {
        type Output = K::Output;

        #[inline(always)]
        fn call(self) -> K::Output {
            self.1.with(self.0)
        }
    }
    match pulp::x86::V3::try_new().filter(|_| width != Width::Baseline) {
        Some(v3) => v3.vectorize(InV3(v3, kernel)),
        None => kernel.with(Scalar256b),
    }
}

/// Does `kernel` with the vectors of `width`.
#[cfg(not(target_arch = "x86_64"))]
#[inline(always)]
pub fn with_eight<K: WithEight>(_: Width, kernel: K) -> K::Output {
    kernel.with(Scalar256b)
}
