//! How far counts are from what is expected, where photons of one path are not independent.

use std::f64::consts::SQRT_2;

use statrs::function::erf::{erfc, erfc_inv};
use statrs::function::gamma::{gamma_lr, gamma_ur};

/// A symmetric matrix, row by row.
pub type Matrix = Vec<Vec<f64>>;

/// How well counts agree with a law.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fit {
    /// The chance of so large a distance or a larger one, were the law true.
    pub p_value: f64,
    /// The logarithm of the likelihood, but for a constant.
    pub log_likelihood: f64,
}

impl Fit {
    /// Of what needs no counts.
    pub const CERTAIN: Self = Self { p_value: 1.0, log_likelihood: 0.0 };
}

/// The normal law of some counts.
#[derive(Clone, Debug)]
pub struct Law {
    mean: Vec<f64>,
    factor: Cholesky,
    /// The way on which nothing is known, whitened and of length 1.
    free: Option<Vec<f64>>,
}

impl Law {
    /// The law with this `mean` and `covariance`, where the counts may be off by any part of
    /// `free`.
    pub fn new(mean: &[f64], covariance: &Matrix, free: Option<&Vec<f64>>) -> Self {
        let factor = Cholesky::new(covariance);
        let free = free.map(|way| {
            let way = factor.whiten(way);
            let length = dot(&way, &way).sqrt().max(f64::MIN_POSITIVE);
            way.into_iter().map(|along| along / length).collect()
        });
        Self { mean: mean.to_vec(), factor, free }
    }

    /// From `from` to `to`, whitened, without what is free.
    fn whiten(&self, to: &[f64], from: &[f64]) -> Vec<f64> {
        let way: Vec<f64> = to.iter().zip(from).map(|(to, from)| to - from).collect();
        let mut way = self.factor.whiten(&way);
        if let Some(free) = &self.free {
            let along = dot(&way, free);
            way.iter_mut().zip(free).for_each(|(way, free)| *way -= along * free);
        }
        way
    }

    /// Holds `counts` against this law: the test of Wald.
    pub fn fit(&self, counts: &[f64]) -> Fit {
        let whitened = self.whiten(counts, &self.mean);
        let distance = dot(&whitened, &whitened);
        Fit {
            p_value: chi_squared_tail(distance, counts.len() - usize::from(self.free.is_some())),
            log_likelihood: -0.5 * (distance + self.factor.log_determinant()),
        }
    }

    /// How many standard deviations `counts` are from this law on the way to each of `others`, the
    /// means in other cases: the best single number to tell the two apart. With it, how many
    /// deviations apart the two laws are.
    pub fn towards<'a>(
        &'a self,
        counts: &[f64],
        others: impl Iterator<Item = Vec<f64>> + 'a,
    ) -> impl Iterator<Item = (f64, f64)> + 'a {
        let residual = self.whiten(counts, &self.mean);
        others.map(move |other| {
            let way = self.whiten(&other, &self.mean);
            let length = dot(&way, &way).sqrt();
            let deviations = if length > 1e-9 { dot(&residual, &way) / length } else { 0.0 };
            (deviations, length)
        })
    }

    /// How much likelier `counts` are where an unknown part of the way to one of `others` was gone,
    /// forward or back, than under this law itself: the evidence for something that neither has.
    pub fn elsewhere(&self, counts: &[f64], others: impl Iterator<Item = Vec<f64>>) -> f64 {
        let others: Vec<_> = others.collect();
        let mean_over = others.len().max(1) as f64;
        let evidence = self.towards(counts, others.into_iter()).map(|(deviations, length)| {
            // The likelihood at its peak, times the part of the way on which it is as high
            // (Laplace).
            let part = ((2.0 * std::f64::consts::PI).sqrt() / (2.0 * length.max(1e-9))).min(1.0);
            (0.5 * deviations * deviations).min(300.0).exp() * part
        });
        evidence.sum::<f64>() / mean_over
    }
}

/// The chance that a sum of `degrees` squared standard normal numbers is larger than `value`.
pub fn chi_squared_tail(value: f64, degrees: usize) -> f64 {
    if value <= 0.0 || degrees == 0 {
        return 1.0;
    }
    gamma_ur(degrees as f64 / 2.0, value / 2.0)
}

/// The chance that a standard normal number is larger than `z`.
pub fn normal_tail(z: f64) -> f64 {
    0.5 * erfc(z / SQRT_2)
}

/// What a standard normal number is larger than with the chance `p`.
pub fn normal_quantile(p: f64) -> f64 {
    SQRT_2 * erfc_inv(2.0 * p)
}

/// The chance that a count of photons is farther from `mean`, on either side, than `count`. Photons
/// come in paths, a few of which are long: where few are expected, their count is askew, and large
/// counts are likelier than the normal law has it; the gamma law is more askew still.
pub fn tails_of_count(count: f64, mean: f64, variance: f64) -> f64 {
    if mean <= 0.0 {
        return if count > 0.0 { 0.0 } else { 1.0 };
    }
    let normal = 2.0 * normal_tail((count - mean).abs() / variance.sqrt());
    let (shape, scaled) = (mean * mean / variance, count * mean / variance);
    let gamma = match count {
        count if count <= 0.0 => 0.0,
        count if count < mean => gamma_lr(shape, scaled),
        _ => gamma_ur(shape, scaled),
    };
    normal.max((2.0 * gamma).min(1.0))
}

/// The chance that the smallest of `tests` independent p-values, of which there is at least one, is
/// at most `p_value` (Sidak).
pub fn corrected(p_value: f64, tests: usize) -> f64 {
    // Without the cancellation of 1 - (1 - p)^n.
    -(tests.max(1) as f64 * (-p_value.min(1.0)).ln_1p()).exp_m1()
}

/// The lower triangle L of a covariance L L^T, column by column: each from the diagonal down.
///
/// Of a column, each number is independent of the others, so that a processor works on several.
#[derive(Clone, Debug)]
struct Cholesky(Matrix);

impl Cholesky {
    fn new(covariance: &Matrix) -> Self {
        let size = covariance.len();
        // The sums so far, of what is on the left of each number.
        let mut columns: Matrix = (0..size).map(|column| vec![0.0; size - column]).collect();
        for at in 0..size {
            let (done, rest) = columns.split_at_mut(at + 1);
            let column = &mut done[at];
            // Positive but for rounding, since every variance has been given a little more.
            let diagonal = (covariance[at][at] - column[0]).max(1e-9).sqrt();
            for (row, sum) in column.iter_mut().enumerate() {
                *sum = (covariance[at + row][at] - *sum) / diagonal;
            }
            column[0] = diagonal;
            for (below, sums) in (1..).zip(rest) {
                let factor = column[below];
                sums.iter_mut().zip(&column[below..]).for_each(|(sum, it)| *sum += it * factor);
            }
        }
        Self(columns)
    }

    /// L^-1 `vector`: independent numbers of variance 1, where `vector` has the covariance.
    fn whiten(&self, vector: &[f64]) -> Vec<f64> {
        let mut whitened = vec![0.0; vector.len()];
        for (at, column) in self.0.iter().enumerate() {
            // So far, it is the sum of what is on the left.
            let value = (vector[at] - whitened[at]) / column[0];
            whitened[at..].iter_mut().zip(column).for_each(|(sum, it)| *sum += it * value);
            whitened[at] = value;
        }
        whitened
    }

    fn log_determinant(&self) -> f64 {
        self.0.iter().map(|column| 2.0 * column[0].ln()).sum()
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
