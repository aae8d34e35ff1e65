//! How many lanes the processor has, asked when the program runs.

use pulp::NullaryFnOnce;

/// A set of vector instructions. The bits do not depend on it. No operation of the kernels is
/// rounded differently in a vector, and Rust never fuses a product and a sum of its own accord.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Width {
    /// What every processor of the target has: SSE2 on x86-64, NEON on aarch64.
    Baseline,
    /// 8 lanes of 32 bits, on x86-64.
    Avx2,
    /// 16 lanes of 32 bits, on x86-64.
    Avx512,
}

impl Width {
    /// The widths of this processor, the narrowest first.
    pub fn available() -> Vec<Self> {
        [Self::Baseline, Self::Avx2, Self::Avx512]
            .into_iter()
            .filter(|width| width.is_available())
            .collect()
    }

    /// The width of this processor that is used unless another is asked for.
    pub fn widest() -> Self {
        Self::available().last().copied().unwrap_or(Self::Baseline)
    }

    #[cfg(target_arch = "x86_64")]
    fn is_available(self) -> bool {
        match self {
            Self::Baseline => true,
            Self::Avx2 => pulp::x86::V3::is_available(),
            Self::Avx512 => pulp::x86::V4::is_available(),
        }
    }

    #[cfg(not(target_arch = "x86_64"))]
    fn is_available(self) -> bool {
        self == Self::Baseline
    }

    /// Runs `kernel` compiled for this width. Everything that it calls must be inlined into it: a
    /// function that is not keeps the baseline's instructions.
    ///
    /// # Panics
    /// When the processor does not have the width.
    #[cfg(target_arch = "x86_64")]
    pub fn run<K: NullaryFnOnce>(self, kernel: K) -> K::Output {
        match self {
            Self::Baseline => kernel.call(),
            Self::Avx2 => pulp::x86::V3::try_new().expect("has AVX2").vectorize(kernel),
            Self::Avx512 => pulp::x86::V4::try_new().expect("has AVX-512").vectorize(kernel),
        }
    }

    /// Runs `kernel` compiled for this width.
    #[cfg(not(target_arch = "x86_64"))]
    pub fn run<K: NullaryFnOnce>(self, kernel: K) -> K::Output {
        kernel.call()
    }
}
