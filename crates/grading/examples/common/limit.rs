//! What the best possible test finds, which no judge can better.

use grading::expected::{Expected, fit_size};
use grading::judge_list::SIGNIFICANCE;
use grading::statistics::{normal_quantile, normal_tail};

/// How often a test finds a misreading with the means `counts` that knows two laws: this one, and
/// that of the closest of the `fair` readings, of which `law` has what is expected of as many
/// photons.
pub fn best_test<T>(
    counts: &[f64],
    emitted: Option<f64>,
    fair: impl Iterator<Item = T>,
    law: impl Fn(&T, f64) -> Expected,
) -> f64 {
    let found = fair.map(|fair| {
        let fitted = || fit_size(counts, |size| law(&fair, size).mean, |size| law(&fair, size));
        let law = law(&fair, emitted.unwrap_or_else(fitted)).law(emitted.is_none());
        let apart: f64 = law.towards(counts, [counts.to_vec()].into_iter()).map(|it| it.1).sum();
        normal_tail(normal_quantile(SIGNIFICANCE) - apart)
    });
    found.fold(1.0, f64::min)
}
