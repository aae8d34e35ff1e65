//! The few formulas of the report. All means are over independent runs.

use statrs::distribution::{ContinuousCDF, StudentsT};

/// A cell that expects fewer photons than this has an error far from normal. It gets no interval
/// and no part in a slope.
pub const FEWEST: f64 = 20.0;

/// The squared relative errors of one run: one for each cell, of which all runs have the same.
pub type Squares = Vec<f64>;

/// The runs at one number of photons.
pub type Runs = Vec<Squares>;

/// A number estimated from runs, with its 95 % interval.
#[derive(Clone, Copy, Debug)]
pub struct Estimate {
    /// The estimate.
    pub value: f64,
    /// The low end of the interval.
    pub low: f64,
    /// The high end.
    pub high: f64,
}

impl Estimate {
    /// Applies an increasing function to all three.
    fn map(self, function: impl Fn(f64) -> f64) -> Self {
        let [value, low, high] = [self.value, self.low, self.high].map(function);
        Self { value, low, high }
    }
}

/// `statistic` of `groups` of runs, with its interval by Tukey's jackknife (1958). Each run in turn
/// is left out. The changes estimate the bias and the standard error of the statistic. This assumes
/// no distribution of the errors, and allows for correlated cells within a run.
pub fn jackknife(groups: &[Runs], statistic: impl Fn(&[Runs]) -> f64) -> Estimate {
    let value = statistic(groups);
    let (mut bias, mut variance, mut fewest) = (0.0, 0.0, usize::MAX);
    let mut left = groups.to_vec();
    for group in 0..groups.len() {
        let runs = groups[group].len();
        let without = |run: usize| {
            let left_out = left[group].swap_remove(run);
            let found = statistic(&left);
            left[group].push(left_out);
            left[group].swap(run, runs - 1);
            found
        };
        let found: Vec<_> = (0..runs).map(without).collect();
        let all_but_one = (runs - 1) as f64;
        let mean = found.iter().sum::<f64>() / runs as f64;
        bias += all_but_one * (mean - value);
        let scatter: f64 = found.iter().map(|found| (found - mean).powi(2)).sum();
        variance += all_but_one / runs as f64 * scatter;
        fewest = fewest.min(runs);
    }
    let reach = student95(fewest - 1) * variance.sqrt();
    Estimate { value, low: value - bias - reach, high: value - bias + reach }
}

/// The root of the mean square over all runs and cells of one group.
pub fn rms(runs: &Runs) -> Estimate {
    jackknife(std::slice::from_ref(runs), |groups| log_rms(&groups[0])).map(f64::exp)
}

/// The ratio of the variances of two groups of runs.
pub fn variance_ratio(above: &Runs, below: &Runs) -> Estimate {
    let groups = [above.clone(), below.clone()];
    jackknife(&groups, |groups| 2.0 * (log_rms(&groups[0]) - log_rms(&groups[1]))).map(f64::exp)
}

/// The variance of a run of one photon, if variances fall as one over the `sizes` of the groups:
/// the mean over the groups.
pub fn variance_of_one(sizes: &[u64], groups: &[Runs]) -> Estimate {
    let of_one = |groups: &[Runs]| {
        let squares =
            sizes.iter().zip(groups).map(|(size, runs)| *size as f64 * (2.0 * log_rms(runs)).exp());
        (squares.sum::<f64>() / sizes.len() as f64).ln()
    };
    jackknife(groups, of_one).map(f64::exp)
}

/// The slope of the logarithm of the RMS over that of `sizes`, by least squares. All cells share
/// one slope, and each has a height, so a cell may be missing at some sizes. `expected` is how many
/// photons each cell expects for one that is emitted. None where no cell expects enough at two
/// sizes.
pub fn log_log_slope(sizes: &[u64], groups: &[Runs], expected: &[f64]) -> Option<Estimate> {
    let kept = |cell: usize| -> Vec<usize> {
        let is_enough = |size: &usize| sizes[*size] as f64 * expected[cell] >= FEWEST;
        (0..sizes.len()).filter(is_enough).collect()
    };
    let kept: Vec<_> = (0..expected.len()).map(kept).collect();
    let slope = |groups: &[Runs]| {
        let (mut product, mut spread) = (0.0, 0.0);
        for (cell, kept) in kept.iter().enumerate() {
            let x: Vec<_> = kept.iter().map(|size| (sizes[*size] as f64).ln()).collect();
            let x_mean = x.iter().sum::<f64>() / x.len() as f64;
            for (x, size) in x.iter().zip(kept) {
                let runs = &groups[*size];
                let square = runs.iter().map(|run| run[cell]).sum::<f64>() / runs.len() as f64;
                // Heights drop out: the deviations of x sum to nothing.
                product += (x - x_mean) * 0.5 * square.ln();
                spread += (x - x_mean).powi(2);
            }
        }
        product / spread
    };
    kept.iter().any(|kept| kept.len() > 1).then(|| jackknife(groups, slope))
}

fn log_rms(runs: &[Squares]) -> f64 {
    let cells: usize = runs.iter().map(Vec::len).sum();
    0.5 * (runs.iter().flatten().sum::<f64>() / cells as f64).ln()
}

/// The upper 95 % limit on events per million tries if `tries` tries had none: the rule of three.
pub fn most_per_million(tries: u64) -> f64 {
    3e6 / tries as f64
}

/// The two-sided 95 % point of Student's t distribution with `freedom` degrees of freedom.
fn student95(freedom: usize) -> f64 {
    let law = StudentsT::new(0.0, 1.0, freedom as f64).expect("there is at least one degree");
    law.inverse_cdf(0.975)
}

/// The `fraction`-quantile of `sorted`, which is not empty.
pub fn quantile(sorted: &[f64], fraction: f64) -> f64 {
    sorted[((sorted.len() - 1) as f64 * fraction).round() as usize]
}

#[cfg(test)]
mod tests {
    use super::*;
    use photon_mapping::random::photon_random;

    #[test]
    fn slope_of_a_power_law() {
        let sizes = [1_000, 10_000, 100_000];
        let square = |size: u64, cell: f64| cell / size as f64;
        let run = |size| vec![square(size, 9.0), square(size, 400.0)];
        let groups = sizes.map(|size| vec![run(size); 3]);
        let fit = log_log_slope(&sizes, &groups, &[0.1, 0.001]).unwrap();
        for slope in [fit.value, fit.low, fit.high] {
            assert!((slope + 0.5).abs() < 1e-12);
        }
        assert!(log_log_slope(&sizes, &groups, &[0.0002]).is_none());
    }

    #[test]
    fn jackknife_of_a_mean_is_students_interval() {
        let runs: Runs = [1.0, 2.0, 4.0, 9.0].map(|square| vec![square]).to_vec();
        let mean =
            |groups: &[Runs]| groups[0].iter().flatten().sum::<f64>() / groups[0].len() as f64;
        let found = jackknife(&[runs], mean);
        // Mean 4, sum of squares 38: the deviation of the mean is the root of 38 / 3 / 4.
        let reach = student95(3) * (38.0 / 12.0_f64).sqrt();
        assert_eq!(found.value, 4.0);
        assert!((found.low - (4.0 - reach)).abs() < 1e-12);
        assert!((found.high - (4.0 + reach)).abs() < 1e-12);
    }

    #[test]
    fn students_law() {
        for (freedom, known) in [(1, 12.706_205), (2, 4.302_653), (15, 2.131_450), (31, 2.039_513)]
        {
            assert!((student95(freedom) - known).abs() < 1e-4, "{freedom}");
        }
    }

    #[test]
    fn quantiles_of_few() {
        assert_eq!(quantile(&[1.0, 2.0, 3.0], 0.5), 2.0);
        assert_eq!(quantile(&[1.0], 0.99), 1.0);
    }

    /// What a path stores in the scene of the simulation: one, two, ... photons, with these
    /// chances.
    const STORED: [f64; 3] = [0.022, 0.008, 0.004];
    /// Each of them on one of these cells, with these chances.
    const SHARES: [f64; 4] = [0.45, 0.35, 0.15, 0.05];
    const SIZES: [u64; 3] = [1_000, 4_000, 16_000];
    const RUNS: u64 = 32;

    fn mean_and_square(share: f64) -> (f64, f64) {
        let moment = |power: i32| -> f64 {
            let of = |(k, chance): (usize, &f64)| chance * ((k + 1) as f64).powi(power);
            STORED.iter().enumerate().map(of).sum()
        };
        // A binomial part of what the path stores.
        (share * moment(1), share * (1.0 - share) * moment(1) + share * share * moment(2))
    }

    /// Relative squares of the total and of each cell, of a run of `size` photons.
    fn simulated(size: u64, rand: &mut impl FnMut() -> f32) -> Squares {
        let mut counts = [0_u64; SHARES.len()];
        let pick = |chances: &[f64], number: f64| {
            let mut sum = 0.0;
            chances.iter().position(|chance| {
                sum += chance;
                number < sum
            })
        };
        for _ in 0..size {
            let stored = pick(&STORED, rand().into()).map_or(0, |k| k + 1);
            for _ in 0..stored {
                counts[pick(&SHARES, rand().into()).unwrap_or(0)] += 1;
            }
        }
        let square = |count: u64, share: f64| {
            (count as f64 / (size as f64 * mean_and_square(share).0) - 1.0).powi(2)
        };
        let cells = counts.iter().zip(SHARES).map(|(count, share)| square(*count, share));
        [square(counts.iter().sum(), 1.0)].into_iter().chain(cells).collect()
    }

    #[test]
    fn intervals_hold_as_often_as_they_say() {
        let shares: Vec<_> = [1.0].into_iter().chain(SHARES).collect();
        let expected: Vec<_> = shares.iter().map(|share| mean_and_square(*share).0).collect();
        let of_cells = |runs: &Runs, cells: std::ops::Range<usize>| -> Runs {
            runs.iter().map(|run| run[cells.clone()].to_vec()).collect()
        };
        let mut held = [0_u32; 6];
        let tables = 400;
        for table in 0..tables {
            let mut rand = photon_random(7, table);
            let groups =
                SIZES.map(|size| (0..RUNS).map(|_| simulated(size, &mut rand)).collect::<Runs>());
            let total = groups.each_ref().map(|runs| of_cells(runs, 0..1));
            let cells = groups.each_ref().map(|runs| of_cells(runs, 1..shares.len()));
            let holds = |found: Estimate, truth: f64| found.low <= truth && truth <= found.high;
            let relative = |share: f64| {
                let (mean, square) = mean_and_square(share);
                square / (mean * mean)
            };
            let all_cells = SHARES.map(relative).iter().sum::<f64>() / SHARES.len() as f64;
            let size = SIZES[2] as f64;
            let slope = |groups: &[Runs], cells: std::ops::Range<usize>| {
                log_log_slope(&SIZES, groups, &expected[cells]).unwrap()
            };
            let answers = [
                holds(rms(&total[0]), (relative(1.0) / SIZES[0] as f64).sqrt()),
                holds(rms(&cells[2]), (all_cells / size).sqrt()),
                holds(variance_of_one(&SIZES, &total), relative(1.0)),
                holds(variance_ratio(&total[0], &total[2]), SIZES[2] as f64 / SIZES[0] as f64),
                holds(slope(&total, 0..1), -0.5),
                holds(slope(&cells, 1..shares.len()), -0.5),
            ];
            held.iter_mut().zip(answers).for_each(|(held, answer)| *held += u32::from(answer));
        }
        for (number, held) in held.iter().enumerate() {
            let part = f64::from(*held) / tables as f64;
            assert!((0.90..=0.98).contains(&part), "interval {number} holds in {part}: {held:?}");
        }
    }
}
