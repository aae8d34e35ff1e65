//! What two meshes tell: the error of the finer one, and the covariance.

use super::bounces::Bounces;
use super::expectation::{Bounded, Expectation};

/// Bounces of which the relative differences are compared: later ones are alike.
const BOUNCES_COMPARED: usize = 6;

/// Which part of the difference between two meshes bounds the error of the finer one. It has
/// `refinement` times as many cells. Functions that are linear on each cell err as the cells' area,
/// or less (Richardson 1911). `safety` times that, but no more than all of it.
pub(crate) fn left_over(refinement: f64, safety: f64) -> f64 {
    (safety / (refinement - 1.0).max(f64::MIN_POSITIVE)).min(1.0)
}

/// Adds the errors of the bounces that the meshes have followed.
///
/// How the two meshes differ on a facet at one bounce may be small by chance, where the difference
/// changes its sign from bounce to bounce. So each facet's largest relative difference counts at
/// all of its bounces, and a quarter of the usual one besides; of that, `left_over` is the finer
/// mesh's.
pub(crate) fn add_differences(
    errors: &mut Vec<Vec<f64>>,
    coarse: &Bounces,
    fine: &Bounces,
    left_over: f64,
) {
    let followed = errors.len()..fine.hits.len();
    let before =
        |bounce: usize, plate: usize| coarse.hits.get(bounce).map_or(0.0, |hits| hits[plate]);
    let difference =
        |bounce: usize, plate: usize| (fine.hits[bounce][plate] - before(bounce, plate)).abs();
    let relative = |bounce: usize, plate: usize| {
        let hits = fine.hits[bounce][plate];
        if hits > 0.0 { difference(bounce, plate) / hits } else { 0.0 }
    };
    for bounce in followed.clone() {
        let hits = &fine.hits[bounce];
        let plates = 0..hits.len();
        let all: f64 = plates.clone().map(|plate| difference(bounce, plate)).sum();
        let total: f64 = hits.iter().sum();
        let usual = if total > 0.0 { 0.25 * all / total } else { 0.0 };
        let error = |plate: usize| {
            let compared = followed.clone().take(BOUNCES_COMPARED);
            let largest = compared.map(|other| relative(other, plate)).fold(0.0, f64::max);
            left_over * (difference(bounce, plate).max(largest * hits[plate]) + usual * hits[plate])
        };
        errors.push(plates.map(error).collect());
    }
}

/// Covariance of the stored hits: E[S_a S_b] counts every ordered pair of two hits of a path, and
/// each hit with itself.
pub(crate) fn covariance(
    result: &Expectation,
    coarse: &Bounces,
    fine: &Bounces,
) -> Vec<Vec<Bounded>> {
    let stored: Vec<Bounded> =
        result.surfaces.iter().map(|&surface| result.on_surface_from(surface, 2)).collect();
    let entry = |pairs: &[Vec<f64>], a: usize, b: usize| {
        let at =
            |a: usize, b: usize| pairs.get(a).and_then(|row| row.get(b)).copied().unwrap_or(0.0);
        at(a, b) + at(b, a) - stored[a].value * stored[b].value
            + if a == b { stored[a].value } else { 0.0 }
    };
    (0..stored.len())
        .map(|a| {
            (0..stored.len())
                .map(|b| {
                    let value = entry(&fine.ordered_pairs, a, b);
                    let difference = (value - entry(&coarse.ordered_pairs, a, b)).abs();
                    let of_means =
                        stored[a].error * stored[b].value + stored[b].error * stored[a].value;
                    let of_self = if a == b { stored[a].error } else { 0.0 };
                    Bounded { value, error: difference + of_means + of_self }
                })
                .collect()
        })
        .collect()
}
