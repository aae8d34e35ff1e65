//! How far counts are from what is expected, where photons of one path are not independent.

use statrs::function::erf::erfc;
use statrs::function::gamma::{gamma_lr, gamma_ur};

/// A symmetric matrix, row by row.
pub type Matrix = Vec<Vec<f64>>;

/// How well counts agree with a law.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fit {
    /// The squared distance between counts and expectation, in units of the covariance.
    pub distance: f64,
    /// How many of the counts are free to differ.
    pub degrees: usize,
    /// The chance of so large a distance or a larger one, were the law true.
    pub p_value: f64,
    /// The logarithm of the likelihood, but for a constant.
    pub log_likelihood: f64,
    /// How many photons were emitted: as given, or as it fits best.
    pub emitted: f64,
}

/// The law of counts: their means and covariance for one photon emitted.
#[derive(Clone, Debug, PartialEq)]
pub struct Law {
    /// The means.
    pub mean: Vec<f64>,
    /// The covariance.
    pub covariance: Matrix,
    /// With how many photons the means were themselves measured.
    pub measured_with: f64,
    /// By which part of itself each mean may be off for reasons that a course cannot fault, such as
    /// where exactly a ray starts, or how far off its surface a position is stored.
    pub leeway: Vec<f64>,
}

/// Holds `counts` against `law` for `emitted` photons, or for as many as fit best: the test of
/// Wald.
pub fn fit(counts: &[f64], law: &Law, emitted: Option<f64>) -> Fit {
    let Some(emitted) = emitted else {
        return fit_of_any_size(counts, law);
    };
    let factor = Cholesky::new(&law.of(emitted));
    let residual: Vec<f64> =
        counts.iter().zip(&law.mean).map(|(count, mean)| count - emitted * mean).collect();
    conclude(&factor, &residual, counts.len(), emitted)
}

fn fit_of_any_size(counts: &[f64], law: &Law) -> Fit {
    let total: f64 = counts.iter().sum();
    let mut emitted = (total / law.mean.iter().sum::<f64>()).max(1.0);
    for _ in 0..3 {
        let factor = Cholesky::new(&law.of(emitted));
        let (whitened_mean, whitened) = (factor.whiten(&law.mean), factor.whiten(counts));
        emitted = (dot(&whitened_mean, &whitened) / dot(&whitened_mean, &whitened_mean)).max(1.0);
    }
    let factor = Cholesky::new(&law.of(emitted));
    let residual: Vec<f64> =
        counts.iter().zip(&law.mean).map(|(count, mean)| count - emitted * mean).collect();
    conclude(&factor, &residual, counts.len() - 1, emitted)
}

fn conclude(factor: &Cholesky, residual: &[f64], degrees: usize, emitted: f64) -> Fit {
    let whitened = factor.whiten(residual);
    let distance = dot(&whitened, &whitened);
    Fit {
        distance,
        degrees,
        p_value: chi_squared_tail(distance, degrees),
        log_likelihood: -0.5 * (distance + factor.log_determinant()),
        emitted,
    }
}

impl Law {
    /// The covariance of counts of `emitted` photons about this law's means.
    fn of(&self, emitted: f64) -> Matrix {
        let scale = emitted * (1.0 + emitted / self.measured_with);
        let mut covariance: Matrix = self
            .covariance
            .iter()
            .map(|row| row.iter().map(|entry| scale * entry).collect())
            .collect();
        for (at, mean) in self.mean.iter().enumerate() {
            // A count of less than one is as good as one.
            covariance[at][at] += (self.leeway[at] * emitted * mean).powi(2) + 0.1;
        }
        covariance
    }

    /// The standard deviations of counts of `emitted` photons about this law's means, leeway
    /// included.
    pub fn deviations(&self, emitted: f64) -> Vec<f64> {
        self.of(emitted).iter().enumerate().map(|(at, row)| row[at].sqrt()).collect()
    }

    /// The law of the sums of counts that have the same number in `groups`, of which there are
    /// `count`.
    pub fn grouped(&self, groups: &[usize], count: usize) -> Self {
        let mut covariance = vec![vec![0.0; count]; count];
        for (a, group) in groups.iter().enumerate() {
            for (b, other) in groups.iter().enumerate() {
                covariance[*group][*other] += self.covariance[a][b];
            }
        }
        let mean = grouped(&self.mean, groups, count);
        // What one count is short of, its neighbours may have: the larger the group, the less is
        // left.
        let off = self.mean.iter().zip(&self.leeway).map(|(mean, leeway)| (mean * leeway).powi(2));
        let off = grouped(&off.collect::<Vec<_>>(), groups, count);
        let leeway = mean.iter().zip(&off).map(|(mean, off)| off.sqrt() / mean.max(1e-300));
        Self { leeway: leeway.collect(), mean, covariance, measured_with: self.measured_with }
    }
}

/// The sums of `counts` that have the same number in `groups`.
pub fn grouped(counts: &[f64], groups: &[usize], count: usize) -> Vec<f64> {
    let mut sums = vec![0.0; count];
    for (value, group) in counts.iter().zip(groups) {
        sums[*group] += value;
    }
    sums
}

/// How `counts` differ from a law, to be held against many other laws.
pub struct Residual<'a> {
    law: &'a Law,
    factor: Cholesky,
    whitened: Vec<f64>,
    size: f64,
    /// The law's means, where the number of photons may explain a difference.
    mean: Option<Vec<f64>>,
}

impl<'a> Residual<'a> {
    /// Of `counts` from `law`, for `emitted` photons, or for as many as fit best.
    pub fn new(counts: &[f64], law: &'a Law, emitted: Option<f64>) -> Self {
        let size = emitted.unwrap_or_else(|| fit(counts, law, None).emitted);
        let factor = Cholesky::new(&law.of(size));
        let residual = counts.iter().zip(&law.mean).map(|(count, mean)| count - size * mean);
        let whitened = factor.whiten(&residual.collect::<Vec<_>>());
        let mean = emitted.is_none().then(|| factor.whiten(&law.mean));
        Self { law, factor, whitened, size, mean }
    }

    /// How many standard deviations the counts are from the law on the way to `other`, the same
    /// law's means in another case: the best single number to tell the two apart. With it, how many
    /// deviations apart the two laws are. Where the number of photons is not known, what it could
    /// explain is left out.
    pub fn towards(&self, other: &[f64]) -> (f64, f64) {
        let way = self.law.mean.iter().zip(other).map(|(a, b)| b - a);
        let mut way = self.factor.whiten(&way.collect::<Vec<_>>());
        if let Some(mean) = &self.mean {
            let along = dot(&way, mean) / dot(mean, mean);
            way.iter_mut().zip(mean).for_each(|(way, mean)| *way -= along * mean);
        }
        let length = dot(&way, &way).sqrt();
        let deviations = if length > 0.0 { dot(&self.whitened, &way) / length } else { 0.0 };
        (deviations, self.size * length)
    }

    /// How much likelier the counts are where an unknown part of the way to one of `others` was
    /// gone, forward or back, than under the law itself: the evidence for something that neither
    /// has.
    pub fn elsewhere(&self, others: impl Iterator<Item = Vec<f64>>) -> f64 {
        let (mut sum, mut count) = (0.0, 0.0);
        for other in others {
            let (deviations, length) = self.towards(&other);
            // The likelihood at its peak, times the part of the way on which it is as high
            // (Laplace).
            let part = ((2.0 * std::f64::consts::PI).sqrt() / (2.0 * length.max(1e-9))).min(1.0);
            sum += (0.5 * deviations * deviations).min(300.0).exp() * part;
            count += 1.0;
        }
        if count > 0.0 { sum / count } else { 0.0 }
    }
}

/// How many standard deviations `counts` are from `law` on the way to `other`, see
/// [`Residual::towards`].
pub fn towards(counts: &[f64], law: &Law, other: &[f64], emitted: Option<f64>) -> f64 {
    Residual::new(counts, law, emitted).towards(other).0
}

/// The chance that a sum of `degrees` squared standard normal numbers is larger than `value`.
pub fn chi_squared_tail(value: f64, degrees: usize) -> f64 {
    if value <= 0.0 || degrees == 0 {
        return 1.0;
    }
    gamma_ur(degrees as f64 / 2.0, value / 2.0)
}

/// The chance that a standard normal number is farther from 0 than `z`, on either side.
pub fn normal_tails(z: f64) -> f64 {
    erfc(z.abs() / std::f64::consts::SQRT_2)
}

/// The chance that a count of photons is farther from `mean`, on either side, than `count`. Photons
/// come in paths, a few of which are long: where few are expected, their count is askew, and large
/// counts are likelier than the normal law has it; the gamma law is more askew still.
pub fn tails_of_count(count: f64, mean: f64, variance: f64) -> f64 {
    let normal = normal_tails((count - mean) / variance.sqrt());
    let (shape, scaled) = (mean * mean / variance, count * mean / variance);
    let gamma = match count {
        count if count <= 0.0 => 0.0,
        count if count < mean => gamma_lr(shape, scaled),
        _ => gamma_ur(shape, scaled),
    };
    normal.max((2.0 * gamma).min(1.0))
}

/// The chance that the smallest of `tests` independent p-values is at most `p_value` (Sidak).
pub fn corrected(p_value: f64, tests: usize) -> f64 {
    // Without the cancellation of 1 - (1 - p)^n.
    -(tests as f64 * (-p_value.min(1.0)).ln_1p()).exp_m1()
}

/// The lower triangle L of a covariance L L^T.
struct Cholesky(Matrix);

impl Cholesky {
    fn new(covariance: &Matrix) -> Self {
        let mut lower = covariance.clone();
        for i in 0..lower.len() {
            for j in 0..=i {
                let sum: f64 = (0..j).map(|k| lower[i][k] * lower[j][k]).sum();
                let rest = covariance[i][j] - sum;
                // Positive but for rounding, since every variance has been given a little more.
                lower[i][j] = if i == j { rest.max(1e-9).sqrt() } else { rest / lower[j][j] };
            }
        }
        Self(lower)
    }

    /// L^-1 `vector`: independent numbers of variance 1, where `vector` has the covariance.
    fn whiten(&self, vector: &[f64]) -> Vec<f64> {
        let mut whitened: Vec<f64> = Vec::with_capacity(vector.len());
        for (row, value) in self.0.iter().zip(vector) {
            let sum: f64 = row.iter().zip(&whitened).map(|(a, b)| a * b).sum();
            whitened.push((value - sum) / row[whitened.len()]);
        }
        whitened
    }

    fn log_determinant(&self) -> f64 {
        self.0.iter().enumerate().map(|(at, row)| 2.0 * row[at].ln()).sum()
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
