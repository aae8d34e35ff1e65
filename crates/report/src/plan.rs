//! How much is measured.

use super::rules::cases;

/// How much of each is measured, in photons and seeds.
#[derive(Clone, Debug)]
pub struct Plan {
    /// The options that select this plan.
    pub(crate) options: &'static str,
    /// Emitted photons of the runs of speed against error, ascending.
    pub(crate) sizes: Vec<u64>,
    /// Runs at each of these sizes.
    pub(crate) seeds: u64,
    /// Photons traced in both precisions.
    pub(crate) precision_photons: u64,
    /// Photons for each offset in each place.
    pub(crate) offset_photons: u64,
    /// Runs with each sampler at each of its sizes.
    pub(crate) sampler_seeds: u64,
    /// Emitted photons of the runs with both samplers, ascending powers of two.
    pub(crate) sampler_sizes: Vec<u64>,
}

impl Plan {
    /// Under 20 seconds on two cores.
    pub fn quick() -> Self {
        Self {
            options: " --quick",
            sizes: vec![1_000, 10_000, 100_000],
            seeds: 32,
            sampler_seeds: 16,
            precision_photons: 300_000,
            offset_photons: 10_000,
            sampler_sizes: [10, 12, 14, 16].map(|power| 1 << power).to_vec(),
        }
    }

    /// A few minutes.
    pub fn usual() -> Self {
        Self {
            options: "",
            sizes: vec![1_000, 10_000, 100_000, 1_000_000, 10_000_000],
            seeds: 32,
            sampler_seeds: 16,
            precision_photons: 4_000_000,
            offset_photons: 250_000,
            sampler_sizes: [10, 12, 14, 16, 18, 20].map(|power| 1 << power).to_vec(),
        }
    }

    /// As usual, and runs of 10^8 photons.
    pub fn long() -> Self {
        let mut plan = Self { options: " --long", ..Self::usual() };
        plan.sizes.push(100_000_000);
        plan
    }

    /// The seed of run `run` at size number `size`: no two runs share a photon, so that their
    /// errors are independent.
    pub(crate) fn seed(size: usize, run: u64) -> u64 {
        1_000 * (size as u64 + 1) + run
    }

    /// All photons that are traced, counting each tracing.
    pub fn photons(&self) -> u64 {
        let speed = self.sizes.iter().sum::<u64>() * self.seeds;
        let samplers = 2 * self.sampler_sizes.iter().sum::<u64>() * self.sampler_seeds;
        let offsets = cases().len() as u64 * self.offset_photons;
        speed + samplers + offsets + 3 * self.precision_photons
    }
}
