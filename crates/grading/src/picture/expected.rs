//! How many pixels are expected to be red, and how much that varies.
//!
//! Each of N paths turns a pixel red with a small chance p, on its own: the pixel stays as it is
//! with the chance (1 - p)^N = exp(-N p), and two pixels both do with exp(-N (p + q - pq)), where
//! pq is the chance that one path turns both red. From this the mean and covariance of the numbers
//! of red pixels follow. One path turns two pixels red by one photon, if their cubes overlap, or by
//! two, which is rare enough to be known by facet only.

use super::signature::PictureSignature;
use super::view::{SHARES, View};
use crate::statistics::{Law, Matrix};

/// The numbers of red pixels that are expected.
#[derive(Clone, Debug, PartialEq)]
pub struct Expected {
    /// The means.
    pub mean: Vec<f64>,
    /// How fast each mean grows with the logarithm of the photons emitted.
    pub slope: Vec<f64>,
    /// The covariance.
    pub covariance: Matrix,
    /// How many pixels there are.
    pub pixels: Vec<f64>,
}

/// Which part of the photons over each patch's pixels is near enough to show, by facet in sight: 1
/// for photons that lie on their facet.
pub type Coverage = [f64];

/// The number of red pixels over all cells, for `emitted` photons.
pub fn total(view: &View, signature: &PictureSignature, emitted: f64, coverage: &Coverage) -> f64 {
    let rates = rates(view, signature, emitted, coverage);
    view.patches
        .iter()
        .zip(rates)
        .map(|(patch, rate)| -f64::from(patch.pixels) * (-rate).exp_m1())
        .sum()
}

/// By cell of the view, the means alone.
pub fn means(
    view: &View,
    signature: &PictureSignature,
    emitted: f64,
    coverage: &Coverage,
) -> Vec<f64> {
    let mut means = vec![0.0; view.cells.len()];
    for (patch, rate) in view.patches.iter().zip(rates(view, signature, emitted, coverage)) {
        means[patch.cell] -= f64::from(patch.pixels) * (-rate).exp_m1();
    }
    means
}

/// By patch, how many photons are expected in the cube around a pixel.
fn rates(view: &View, signature: &PictureSignature, emitted: f64, coverage: &Coverage) -> Vec<f64> {
    let scale = emitted / signature.emitted;
    let rate = |(patch, red): (&super::view::Patch, &f64)| {
        scale * red / f64::from(patch.measured) * coverage[patch.facet_in_sight]
    };
    view.patches.iter().zip(&signature.red).map(rate).collect()
}

impl Expected {
    /// What is expected of the cells of `view` under the hypothesis of `signature` for `emitted`
    /// photons.
    pub fn new(
        view: &View,
        signature: &PictureSignature,
        emitted: f64,
        coverage: &Coverage,
    ) -> Self {
        let cells = view.cells.len();
        let rates = rates(view, signature, emitted, coverage);
        let mut expected = Self {
            mean: vec![0.0; cells],
            slope: vec![0.0; cells],
            covariance: vec![vec![0.0; cells]; cells],
            pixels: vec![0.0; cells],
        };
        let mut of_facet = vec![0.0; view.facets.len()];
        let mut facet_of = vec![0; cells];
        for ((patch, rate), red) in view.patches.iter().zip(&rates).zip(&signature.red) {
            let pixels = f64::from(patch.pixels);
            expected.pixels[patch.cell] += pixels;
            expected.mean[patch.cell] -= pixels * (-rate).exp_m1();
            expected.slope[patch.cell] += pixels * rate * (-rate).exp();
            of_facet[patch.facet_in_sight] += red / signature.emitted;
            facet_of[patch.cell] = patch.facet_in_sight;
        }
        for overlap in &view.overlaps {
            let [a, b] = overlap.patches;
            let (both, common) = (rates[a] + rates[b], (rates[a] * rates[b]).sqrt());
            let mut sum = 0.0;
            for (at, pairs) in overlap.pairs.iter().enumerate().filter(|(_, pairs)| **pairs > 0) {
                let share = ((at as f64 + 0.5) / SHARES as f64).min(1.0);
                sum += f64::from(*pairs) * (common * share).exp_m1();
            }
            let (a, b) = (view.patches[a].cell, view.patches[b].cell);
            expected.covariance[a][b] += (-both).exp() * sum;
        }
        // The slope is the number of photons times the pixels that one more would turn red.
        // Of the pairs of a facet, each of its cells has a part like its part of the photons.
        for (a, row) in expected.covariance.iter_mut().enumerate() {
            for (b, entry) in row.iter_mut().enumerate() {
                let (f, g) = (facet_of[a], facet_of[b]);
                let together = signature.pairs[f][g] / (of_facet[f] * of_facet[g]).max(1e-300);
                *entry += expected.slope[a] * expected.slope[b] * (together - 1.0) / emitted;
                *entry *= 1.0 + emitted / signature.emitted;
            }
        }
        expected
    }

    /// What is expected of the sums of cells that have the same number in `groups`, of which there
    /// are `count`.
    pub fn grouped(&self, groups: &[usize], count: usize) -> Self {
        let sums = |values: &[f64]| {
            let mut sums = vec![0.0; count];
            values.iter().zip(groups).for_each(|(value, group)| sums[*group] += value);
            sums
        };
        let mut covariance = vec![vec![0.0; count]; count];
        for (row, group) in self.covariance.iter().zip(groups) {
            for (entry, other) in row.iter().zip(groups) {
                covariance[*group][*other] += entry;
            }
        }
        Self {
            mean: sums(&self.mean),
            slope: sums(&self.slope),
            covariance,
            pixels: sums(&self.pixels),
        }
    }

    /// The law of these numbers, where a density may be off by the part `leeway` of itself.
    pub fn law(&self, leeway: f64) -> Law {
        let mut covariance = self.covariance.clone();
        for (at, slope) in self.slope.iter().enumerate() {
            // A pixel or two more is left to rounding.
            covariance[at][at] += (leeway * slope).powi(2) + 1.0;
        }
        Law {
            leeway: vec![0.0; self.mean.len()],
            mean: self.mean.clone(),
            covariance,
            measured_with: f64::INFINITY,
        }
    }

    /// Groups of cells whose numbers of red pixels, and of others, are large enough beside their
    /// deviations to be as good as normal: `least` times as large. What is not is joined within
    /// `kinds`, then over all.
    pub fn joined(&self, kinds: &[usize], least: f64) -> (Vec<usize>, usize) {
        let mut groups: Vec<usize> = (0..self.mean.len()).collect();
        let by_kind: Vec<usize> = kinds.iter().map(|kind| self.mean.len() + kind).collect();
        let most = self.mean.len() + kinds.iter().max().map_or(0, |kind| kind + 1);
        for wider in [by_kind, vec![most; groups.len()]] {
            let sums = self.grouped(&groups, most + 1);
            for (group, wider) in groups.iter_mut().zip(wider) {
                if !sums.is_normal(*group, least) {
                    *group = wider;
                }
            }
        }
        let sums = self.grouped(&groups, most + 1);
        if !sums.is_normal(most, least) {
            // Too few even together: they go with the first others that there are.
            let first = groups.iter().find(|group| **group != most).copied().unwrap_or(most);
            groups.iter_mut().filter(|group| **group == most).for_each(|group| *group = first);
        }
        let mut names: Vec<usize> = groups.clone();
        names.sort_unstable();
        names.dedup();
        let groups =
            groups.iter().map(|group| names.partition_point(|name| name < group)).collect();
        (groups, names.len())
    }

    fn is_normal(&self, at: usize, least: f64) -> bool {
        let least = least * self.covariance[at][at].sqrt();
        self.mean[at] > least && self.pixels[at] - self.mean[at] > least
    }
}
