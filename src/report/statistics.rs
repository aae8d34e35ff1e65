//! The few formulas of the report. All means are over independent runs.

/// The root of the mean square.
pub fn rms(errors: &[f64]) -> f64 {
    (errors.iter().map(|error| error * error).sum::<f64>() / errors.len() as f64).sqrt()
}

/// By which factor the true RMS error may be larger or smaller than that of `runs` errors, at 95 %,
/// when the errors are normal: the logarithm of the RMS then has the variance 1 / (2 runs).
pub fn rms_factor(runs: u64) -> f64 {
    (Z95 / (2.0 * runs as f64).sqrt()).exp()
}

/// 95 % of a normal law lie within this many standard deviations.
pub const Z95: f64 = 1.96;

/// A straight line through logarithms.
#[derive(Clone, Copy, Debug)]
pub struct Slope {
    /// The slope by least squares.
    pub slope: f64,
    /// Half the width of its 95 % confidence interval.
    pub half_width: f64,
}

/// The slope of the logarithm of `errors`, each the RMS of `runs` errors, over that of `sizes`. The
/// confidence interval comes from the known spread of an RMS, not from the few residuals.
pub fn log_log_slope(sizes: &[u64], errors: &[f64], runs: u64) -> Slope {
    let count = sizes.len() as f64;
    let x: Vec<_> = sizes.iter().map(|size| (*size as f64).ln()).collect();
    let y: Vec<_> = errors.iter().map(|error| error.ln()).collect();
    let mean = |values: &[f64]| values.iter().sum::<f64>() / count;
    let (x_mean, y_mean) = (mean(&x), mean(&y));
    let spread: f64 = x.iter().map(|x| (x - x_mean).powi(2)).sum();
    let product: f64 = x.iter().zip(&y).map(|(x, y)| (x - x_mean) * (y - y_mean)).sum();
    let deviation = 1.0 / (2.0 * runs as f64).sqrt();
    Slope { slope: product / spread, half_width: Z95 * deviation / spread.sqrt() }
}

/// The `fraction`-quantile of `sorted`, which is not empty.
pub fn quantile(sorted: &[f64], fraction: f64) -> f64 {
    sorted[((sorted.len() - 1) as f64 * fraction).round() as usize]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slope_of_a_power_law() {
        let sizes = [10, 100, 1000];
        let errors = sizes.map(|size| 3.0 / (size as f64).sqrt());
        let fit = log_log_slope(&sizes, &errors, 16);
        assert!((fit.slope + 0.5).abs() < 1e-12);
        // Three points a decade apart: 1.96 sqrt(1 / 32) / (sqrt(2) ln 10).
        assert!((fit.half_width - 0.106_4).abs() < 1e-4);
    }

    #[test]
    fn quantiles_of_few() {
        assert_eq!(quantile(&[1.0, 2.0, 3.0], 0.5), 2.0);
        assert_eq!(quantile(&[1.0], 0.99), 1.0);
    }
}
