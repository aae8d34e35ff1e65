//! What is expected of counts, of photons or of red pixels.

use super::statistics::{Law, Matrix};
use crate::limits::expected::{FEW, SIZES, STEPS, VARIANCE_OF_ONE};

/// What is expected of some counts, for one number of photons emitted.
#[derive(Clone, Debug, PartialEq)]
pub struct Expected {
    /// The means.
    pub mean: Vec<f64>,
    /// How fast each mean grows with the logarithm of the photons emitted.
    pub slope: Vec<f64>,
    /// The covariance, with what is not known of the means since they were measured.
    pub covariance: Matrix,
    /// The variance of each that a course cannot fault.
    pub slack: Vec<f64>,
    /// The largest count that there can be.
    pub most: Vec<f64>,
}

/// How counts are joined: the number of its group for each, and how many groups there are.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Groups {
    /// By count.
    pub of: Vec<usize>,
    /// How many.
    pub count: usize,
}

impl Groups {
    /// All counts in one group.
    pub fn whole(counts: usize) -> Self {
        Self { of: vec![0; counts], count: 1 }
    }

    /// The sums of `counts`, group by group.
    pub fn sums(&self, counts: &[f64]) -> Vec<f64> {
        let mut sums = vec![0.0; self.count];
        for (value, group) in counts.iter().zip(&self.of) {
            sums[*group] += value;
        }
        sums
    }
}

impl Expected {
    /// Of `emitted` paths, of each of which `mean` and `covariance` were measured with `measured`
    /// paths. Each mean may be off by the part `leeway` of itself.
    pub fn of_paths(
        mean: &[f64],
        covariance: impl Fn(usize, usize) -> f64,
        measured: f64,
        leeway: &[f64],
        emitted: f64,
    ) -> Self {
        let scale = emitted * (1.0 + emitted / measured);
        let row = |a| (0..mean.len()).map(|b| scale * covariance(a, b)).collect();
        let covariance = (0..mean.len()).map(row).collect();
        let mean: Vec<f64> = mean.iter().map(|mean| emitted * mean).collect();
        let slack = mean.iter().zip(leeway).map(|(mean, part)| (part * mean).powi(2)).collect();
        let most = vec![f64::INFINITY; mean.len()];
        Self { slope: mean.clone(), mean, covariance, slack, most }
    }

    /// What is expected of the sums of counts.
    pub fn grouped(&self, groups: &Groups) -> Self {
        let mut covariance = vec![vec![0.0; groups.count]; groups.count];
        for (row, group) in self.covariance.iter().zip(&groups.of) {
            let sums = &mut covariance[*group];
            row.iter().zip(&groups.of).for_each(|(entry, other)| sums[*other] += entry);
        }
        Self {
            mean: groups.sums(&self.mean),
            slope: groups.sums(&self.slope),
            covariance,
            slack: groups.sums(&self.slack),
            most: groups.sums(&self.most),
        }
    }

    /// Groups of counts that are so large beside their deviations, and so far from the largest that
    /// there can be, that they are as good as normal: `least` deviations. What is not is joined
    /// within `kinds`, then over all.
    pub fn joined(&self, kinds: &[usize], least: f64) -> Groups {
        let mut of: Vec<usize> = (0..self.mean.len()).collect();
        let by_kind: Vec<usize> = kinds.iter().map(|kind| self.mean.len() + kind).collect();
        let most = self.mean.len() + kinds.iter().max().map_or(0, |kind| kind + 1);
        let sums = |of: &[usize]| self.grouped(&Groups { of: of.to_vec(), count: most + 1 });
        for wider in [by_kind, vec![most; of.len()]] {
            let sums = sums(&of);
            for (group, wider) in of.iter_mut().zip(wider) {
                if !sums.is_normal(*group, least) {
                    *group = wider;
                }
            }
        }
        if !sums(&of).is_normal(most, least) {
            // Too few even together: they go with the first others that there are.
            let first = of.iter().find(|group| **group != most).copied().unwrap_or(most);
            of.iter_mut().filter(|group| **group == most).for_each(|group| *group = first);
        }
        let mut names = of.clone();
        names.sort_unstable();
        names.dedup();
        let of = of.iter().map(|group| names.partition_point(|name| name < group)).collect();
        Groups { of, count: names.len() }
    }

    fn is_normal(&self, at: usize, least: f64) -> bool {
        let least = least * self.covariance[at][at].sqrt();
        self.mean[at] > least && self.most[at] - self.mean[at] > least
    }

    /// Lets the means be off together by `way`.
    pub fn loosen(&mut self, way: &[f64]) {
        for (row, a) in self.covariance.iter_mut().zip(way) {
            row.iter_mut().zip(way).for_each(|(entry, b)| *entry += a * b);
        }
    }

    /// The variance of each count about its mean.
    pub fn variance(&self, at: usize) -> f64 {
        self.covariance[at][at] + self.slack[at] + VARIANCE_OF_ONE
    }

    /// The count that is farthest from its expectation, and by how many standard deviations.
    pub fn farthest(&self, counts: &[f64]) -> (usize, f64) {
        let z = |at: usize| (counts[at] - self.mean[at]) / self.variance(at).sqrt();
        let farthest = (0..counts.len()).max_by(|a, b| z(*a).abs().total_cmp(&z(*b).abs()));
        farthest.map_or((0, 0.0), |at| (at, z(at)))
    }

    /// The law of the counts; `is_free` where the number of photons emitted may be any near this.
    pub fn law(&self, is_free: bool) -> Law {
        let mut covariance = self.covariance.clone();
        for (at, row) in covariance.iter_mut().enumerate() {
            row[at] = self.variance(at);
        }
        Law::new(&self.mean, &covariance, is_free.then_some(&self.slope))
    }
}

/// The number of photons emitted with which `expect` fits `counts` best. `means` are the means
/// alone, which take less time.
pub fn fit_size(
    counts: &[f64],
    means: impl Fn(f64) -> Vec<f64>,
    expect: impl Fn(f64) -> Expected,
) -> f64 {
    let found: f64 = counts.iter().sum();
    let mut size = size_with_total(found, |size| means(size).iter().sum());
    for _ in 0..if found < FEW { 0 } else { STEPS } {
        let expected = expect(size);
        let law = expected.law(false);
        let steeper: Vec<f64> =
            expected.mean.iter().zip(&expected.slope).map(|(a, b)| a + b).collect();
        let (deviations, length) =
            law.towards(counts, [steeper].into_iter()).next().unwrap_or_default();
        let step = deviations / length.max(1e-9);
        size = (size * step.clamp(-1.0, 1.0).exp()).clamp(SIZES[0], SIZES[1]);
    }
    size
}

/// For which number of photons emitted `total`, which grows with it, is `found`: by the method of
/// Ridders, exact where `total` is a power of the number.
pub fn size_with_total(found: f64, total: impl Fn(f64) -> f64) -> f64 {
    let at = |place: f64| (place, total(place.exp()) - found);
    let [mut low, mut high] = SIZES.map(|size| at(size.ln()));
    if !(low.1 < 0.0 && high.1 > 0.0) {
        return if high.1 <= 0.0 { SIZES[1] } else { SIZES[0] };
    }
    let mut last = low.0;
    loop {
        let middle = at(0.5 * (low.0 + high.0));
        let turn = middle.1 / (middle.1 * middle.1 - low.1 * high.1).sqrt();
        let next = at(middle.0 - (middle.0 - low.0) * turn);
        // Each step is about the square of the one before.
        if (next.0 - last).abs() < 1e-6 || high.0 - low.0 < 1e-6 {
            return next.0.exp();
        }
        last = next.0;
        for it in [middle, next] {
            if it.1 < 0.0 && it.0 > low.0 {
                low = it;
            } else if it.1 >= 0.0 && it.0 < high.0 {
                high = it;
            }
        }
    }
}

/// Where between the positive ends of `range` `is_low` ceases to hold, in proportion.
pub fn bisect([mut low, mut high]: [f64; 2], is_low: impl Fn(f64) -> bool) -> f64 {
    for _ in 0..40 {
        let middle = (low * high).sqrt();
        if is_low(middle) {
            low = middle;
        } else {
            high = middle;
        }
    }
    low
}
