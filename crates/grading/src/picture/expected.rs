//! How many pixels are expected to be red, and how much that varies.
//!
//! Each of N paths turns a pixel red with a small chance p, on its own: the pixel stays as it is
//! with the chance (1 - p)^N = exp(-N p), and two pixels both do with exp(-N (p + q - pq)), where
//! pq is the chance that one path turns both red. From this the mean and covariance of the numbers
//! of red pixels follow. One path turns two pixels red by one photon, if their cubes overlap, or by
//! two, which is rare enough to be known by facet only.

use super::signature::PictureSignature;
use super::view::View;
use crate::expected::Expected;
use crate::limits::view::SHARES;

/// Which part of the photons over each patch's pixels is near enough to show, by facet in sight: 1
/// for photons that lie on their facet.
pub type Coverage = [f64];

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

/// What is expected of the cells of `view` under the hypothesis of `signature` for `emitted`
/// photons, where the density of each may be off by the part `leeway` of itself.
pub fn expect(
    view: &View,
    signature: &PictureSignature,
    emitted: f64,
    coverage: &Coverage,
    leeway: &[f64],
) -> Expected {
    let cells = view.cells.len();
    let rates = rates(view, signature, emitted, coverage);
    let unlit: Vec<f64> = rates.iter().map(|rate| (-rate).exp()).collect();
    let mut expected = Expected {
        mean: vec![0.0; cells],
        slope: vec![0.0; cells],
        covariance: vec![vec![0.0; cells]; cells],
        slack: vec![0.0; cells],
        most: vec![0.0; cells],
    };
    let mut of_facet = vec![0.0; view.facets.len()];
    let mut facet_of = vec![0; cells];
    let of_patches = rates.iter().zip(&unlit).zip(&signature.red);
    for (patch, ((rate, unlit), red)) in view.patches.iter().zip(of_patches) {
        let pixels = f64::from(patch.pixels);
        expected.most[patch.cell] += pixels;
        expected.mean[patch.cell] -= pixels * (-rate).exp_m1();
        expected.slope[patch.cell] += pixels * rate * unlit;
        of_facet[patch.facet_in_sight] += red / signature.emitted;
        facet_of[patch.cell] = patch.facet_in_sight;
    }
    for overlap in &view.overlaps {
        let [a, b] = overlap.patches;
        let common = (rates[a] * rates[b]).sqrt();
        let together = unlit[a] * unlit[b] * turned_together(&overlap.pairs, common);
        let cells = [view.patches[a].cell, view.patches[b].cell];
        expected.covariance[cells[0]][cells[1]] += together;
        if a != b {
            expected.covariance[cells[1]][cells[0]] += together;
        }
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
    expected.slack =
        expected.slope.iter().zip(leeway).map(|(slope, part)| (part * slope).powi(2)).collect();
    expected
}

/// The sum of exp(share * `common`) - 1 over pairs of pixels, counted by share in `pairs`.
pub(crate) fn turned_together(pairs: &[u32; SHARES + 1], common: f64) -> f64 {
    // exp(x + y) - 1 of exp(x) - 1 and exp(y) - 1: shares are half a step apart.
    let add = |x: f64, y: f64| x + y + x * y;
    let half = exp_m1(0.5 * common / SHARES as f64);
    let (step, mut of_share, mut sum) = (add(half, half), half, 0.0);
    for pairs in &pairs[..SHARES] {
        sum += f64::from(*pairs) * of_share;
        of_share = add(of_share, step);
    }
    // What is in `of_share` now is half a step beyond a share of one.
    sum + f64::from(pairs[SHARES]) * (of_share - half) / (1.0 + half)
}

/// exp(x) - 1. Where x is small, as nearly always, seven terms of its series are exact to 1e-15 and
/// faster.
fn exp_m1(x: f64) -> f64 {
    if x > 1.0 / 32.0 {
        return x.exp_m1();
    }
    (1..=7).rev().fold(0.0, |sum, n| x / f64::from(n) * (1.0 + sum))
}
