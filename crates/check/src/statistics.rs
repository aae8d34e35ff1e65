//! The few tests that the sections need.

/// Beyond this many standard deviations, a fraction is another one: a chance of 6e-7.
pub const SIGMAS: f64 = 5.0;
/// Beyond this, two distributions differ: a chance of 5e-7.
const KOLMOGOROV: f64 = 2.75;

/// The test of Kolmogorov and Smirnov: whether `sample` may come from the uniform distribution over
/// [0, 1).
pub fn is_uniform(sample: &[f64]) -> bool {
    let sorted = sorted(sample);
    let n = sorted.len() as f64;
    let distance = sorted.iter().enumerate().map(|(i, x)| {
        let i = i as f64;
        ((i + 1.0) / n - x).max(x - i / n)
    });
    distance.fold(0.0, f64::max) * n.sqrt() < KOLMOGOROV
}

/// Kuiper's statistic beyond which directions are not even around the circle: a chance of 6e-7.
const KUIPER: f64 = 3.05;

/// How far parts of the circle may have more or fewer of `count` directions than is even, by
/// Kuiper's test: the sum of the largest excess and the largest lack, from any start.
pub fn kuiper_limit(count: f64) -> f64 {
    KUIPER / count.max(1.0).sqrt()
}

/// What differs less is the same, but for rounding.
const ROUNDING: f64 = 1e-5;

/// Whether two samples may come from one distribution.
pub fn are_alike(a: &[f64], b: &[f64]) -> bool {
    let (a, b) = (sorted(a), sorted(b));
    if a.is_empty() || b.is_empty() {
        return a.is_empty() == b.is_empty();
    }
    let (mut i, mut j) = (0, 0);
    let mut distance: f64 = 0.0;
    while i < a.len() && j < b.len() {
        let x = a[i].min(b[j]) + ROUNDING;
        while i < a.len() && a[i] <= x {
            i += 1;
        }
        while j < b.len() && b[j] <= x {
            j += 1;
        }
        let (of_a, of_b) = (i as f64 / a.len() as f64, j as f64 / b.len() as f64);
        distance = distance.max((of_a - of_b).abs());
    }
    let effective = (a.len() * b.len()) as f64 / (a.len() + b.len()) as f64;
    distance * effective.sqrt() < KOLMOGOROV
}

fn sorted(sample: &[f64]) -> Vec<f64> {
    let mut sorted = sample.to_vec();
    sorted.sort_unstable_by(f64::total_cmp);
    sorted
}

/// Whether `count` of `total` may happen where each has the chance `p`.
pub fn may_happen(count: usize, total: usize, p: f64) -> bool {
    let n = total as f64;
    if p <= 0.0 || p >= 1.0 {
        return count as f64 == n * p.clamp(0.0, 1.0);
    }
    let sigma = (n * p * (1.0 - p)).sqrt();
    // Half a count more, for the normal law in place of the binomial one.
    (count as f64 - n * p).abs() < SIGMAS * sigma + 0.5
}

/// The mean of `values`; 0 for none.
pub fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / (values.len() as f64).max(1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn uniform_numbers_pass_and_squares_fail() {
        let even: Vec<_> = (0..2000).map(|i| (f64::from(i) + 0.5) / 2000.0).collect();
        let squares: Vec<_> = even.iter().map(|x| x * x).collect();
        assert!(is_uniform(&even) && !is_uniform(&squares));
        assert!(are_alike(&even, &even) && !are_alike(&even, &squares));
        let every_third: Vec<_> = even.iter().copied().step_by(3).collect();
        assert!(are_alike(&even, &every_third));
        // Ties count on both sides at once.
        assert!(are_alike(&[0.0; 500], &[1e-7; 700]) && !are_alike(&[0.0; 500], &[1e-3; 700]));
    }

    /// The tail of Kuiper's statistic (1960).
    #[test]
    fn the_limit_for_the_circle_has_its_chance() {
        let term = |j: i32| {
            let square = (f64::from(j) * KUIPER).powi(2);
            2.0 * (4.0 * square - 1.0) * libm::exp(-2.0 * square)
        };
        let chance: f64 = (1..9).map(term).sum();
        assert!((5e-7..1e-6).contains(&chance), "{chance}");
    }

    #[test]
    fn fractions_have_their_margin() {
        assert!(may_happen(480, 1000, 0.5) && !may_happen(400, 1000, 0.5));
        assert!(may_happen(0, 400, 0.0) && !may_happen(1, 400, 0.0));
        assert!(may_happen(400, 400, 1.0) && !may_happen(399, 400, 1.0));
    }
}
