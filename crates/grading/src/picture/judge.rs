//! Are the dots of a picture where the handout leads to expect them?

use super::coverage::{self, coverage};
use super::expectations::PictureExpectations;
use super::expected::{Expected, means, total};
use super::view::View;
use super::words::{self, LEAST_EMITTED};
use crate::judge_list::{SIGNIFICANCE, alone_or_pair, two_at_once};
use crate::naming::Explanation;
use crate::statistics::{
    Fit, Law, Residual, chi_squared_tail, corrected, fit, grouped, normal_tails, towards,
};
use crate::text::rounded;
use crate::verdict::{Finding, Weight};

use super::signature::PictureSignature;
use crate::test::Test;

/// By which part of itself a density may be off for reasons that a course cannot fault.
const LEEWAY: f64 = 0.008;
/// Numbers of pixels must be so many deviations from none and from all to be as good as normal.
const LEAST_DEVIATIONS: f64 = 6.0;
/// Another way to do it right is tried for what is as rare as this.
const RARE: f64 = 0.01;
/// A few odd pixels are no dots.
pub(super) const FEWEST_RED: f64 = 10.0;
/// When no more than this part of the pixels is left, all are red.
const ALL_RED: f64 = 1e-3;
/// With so many photons that less than this part of the pixels is expected to be left, nothing can
/// be told.
const SATURATED: f64 = 0.05;
/// The numbers of photons between which it is sought: with fewer or more no picture can be judged.
pub(super) const SIZES: [f64; 2] = [10.0, 1e8];

/// What the dots of a picture say.
#[derive(Clone, Debug, PartialEq)]
pub struct PictureJudgement {
    /// Whether there are dots at all.
    pub has_dots: bool,
    /// The findings.
    pub findings: Vec<Finding>,
    /// The misreading, if a known one explains them.
    pub explanation: Option<Explanation>,
    /// Two misreadings that explain them together, if none does alone.
    pub pair: Option<Explanation>,
    /// How many photons were emitted: as known, or as it fits best; nothing where nothing fits.
    pub emitted: Option<f64>,
    /// The smallest p-value, corrected for the number of tests, where there were any.
    pub p_value: Option<f64>,
}

impl PictureJudgement {
    /// Whether there are dots, but not those of the handout.
    pub fn is_incorrect(&self) -> bool {
        self.has_dots && self.findings.iter().any(Finding::is_fault)
    }
}

/// The tests of a picture against one fair reading.
pub(super) struct Trial {
    pub(super) reading: usize,
    /// How far off their facets positions are taken to be, in world units.
    pub(super) standoff: Option<f64>,
    pub(super) tests: Vec<Test>,
    pub(super) p_value: f64,
    pub(super) emitted: f64,
    /// How cells were joined, and into how many groups.
    pub(super) groups: (Vec<usize>, usize),
}

/// What is judged: the numbers of red pixels by cell, and what is known beforehand.
#[derive(Clone, Copy)]
pub(super) struct Case<'a> {
    pub(super) counts: &'a [f64],
    pub(super) emitted: Option<f64>,
    pub(super) view: &'a View,
    pub(super) expectations: &'a PictureExpectations,
}

/// Judges the dots `red`, by pixel of `view`, where `emitted` photons were emitted, if that is
/// known.
pub fn judge_dots(
    red: &[bool],
    view: &View,
    emitted: Option<f64>,
    expectations: &PictureExpectations,
) -> PictureJudgement {
    let mut counts = vec![0.0; view.cells.len()];
    for (pixel, _) in red.iter().enumerate().filter(|(_, is_red)| **is_red) {
        if let Some(patch) = view.patch(pixel) {
            counts[view.patches[patch].cell] += 1.0;
        }
    }
    let case = Case { counts: &counts, emitted, view, expectations };
    let (found, all) = (counts.iter().sum::<f64>(), case.pixels());
    let elsewhere = red.iter().filter(|is_red| **is_red).count() as f64 - found;
    let early = |has_dots, finding: Finding, explanation| PictureJudgement {
        has_dots,
        findings: vec![finding],
        explanation,
        pair: None,
        emitted,
        p_value: None,
    };
    if found < FEWEST_RED {
        return early(false, words::no_dots(found, elsewhere), None);
    }
    let reference = &expectations.signatures.fair[0];
    let at_rest = vec![1.0; view.facets.len()];
    if let Some(emitted) = emitted
        && all - total(view, reference, emitted, &at_rest) < SATURATED * all
    {
        return early(true, words::saturated(emitted), None);
    }
    if all - found <= ALL_RED * all {
        let nan = expectations.misreadings.iter().find(|hypothesis| hypothesis.id == "nan-frame");
        let fit =
            Fit { distance: 0.0, degrees: 0, p_value: 1.0, log_likelihood: 0.0, emitted: 0.0 };
        // No number of photons of any other known misreading leaves nothing unlit.
        let explanation =
            nan.map(|nan| Explanation { hypothesis: nan.clone(), fit, confidence: 1.0 });
        return early(true, words::all_red(), explanation);
    }
    judge_pattern(case)
}

fn judge_pattern(case: Case) -> PictureJudgement {
    let mut trial = case.best_trial();
    let is_off = trial.p_value < RARE && case.may_be_off_surface(&trial);
    let is_sparse = case.emitted.is_none() && trial.emitted < LEAST_EMITTED;
    let off_surface = (is_off || is_sparse).then(|| case.best_trial_off_surface()).flatten();
    if let Some(off) = off_surface.filter(|off| is_sparse || off.p_value > trial.p_value) {
        trial = off;
    }
    let explained = (trial.p_value < SIGNIFICANCE).then(|| case.explain(&trial)).flatten();
    let (explanation, pair) = alone_or_pair(explained);
    let reading = &case.expectations.fair[trial.reading];
    let mut findings: Vec<Finding> = trial
        .tests
        .iter()
        .map(|test| {
            let expected = format!("{} ({})", words::expected_by(test.check), reading.title);
            let unexplained = pair
                .as_ref()
                .map_or(words::UNEXPLAINED.into(), |pair| two_at_once(&pair.hypothesis));
            test.finding(expected, explanation.as_ref(), unexplained)
        })
        .collect();
    if case.emitted.is_none() {
        findings.push(words::enough(case.counts.iter().sum(), trial.emitted));
    }
    if let Some(standoff) = trial.standoff {
        findings.push(words::off_surface(standoff));
    }
    if let Some(Explanation { hypothesis, fit, .. }) = &explanation {
        if case.emitted.is_none() {
            findings.push(words::number_under(hypothesis.id, fit.emitted));
        }
        if hypothesis.id == "no-offset" {
            findings.push(words::self_hits());
        }
    }
    debug_assert!(findings.iter().all(|finding| finding.weight != Weight::Grave));
    PictureJudgement {
        has_dots: true,
        findings,
        explanation,
        pair,
        emitted: Some(trial.emitted),
        p_value: Some(trial.p_value),
    }
}

impl Case<'_> {
    fn pixels(&self) -> f64 {
        self.view.patches.iter().map(|patch| f64::from(patch.pixels)).sum()
    }

    /// The fair reading under which the picture is least strange.
    fn best_trial(&self) -> Trial {
        let mut best = self.attempt(0, None);
        for reading in 1..self.expectations.fair.len() {
            // The first, which is the reference's, unless another one is clearly better.
            if best.p_value >= RARE {
                return best;
            }
            best = better(best, self.attempt(reading, None));
        }
        best
    }

    pub(super) fn attempt(&self, reading: usize, standoff: Option<f64>) -> Trial {
        let Self { counts, view, expectations, .. } = *self;
        let signature = &expectations.signatures.fair[reading];
        let coverage = coverage(view, &expectations.places, standoff.unwrap_or(0.0));
        let size = self.emitted.unwrap_or_else(|| self.fit_size(signature, &coverage));
        let expected = Expected::new(view, signature, size, &coverage);
        let kinds: Vec<usize> = (0..counts.len()).map(|cell| view.facet_of_cell(cell)).collect();
        let mut tests = Vec::new();

        if self.emitted.is_some() {
            let whole = expected.grouped(&vec![0; counts.len()], 1);
            let found = counts.iter().sum::<f64>();
            tests.push(Test {
                check: "number of dots",
                p_value: fit(&[found], &whole.law(LEEWAY), Some(1.0)).p_value,
                found: format!(
                    "{} red pixels; expected {}",
                    rounded(found),
                    rounded(whole.mean[0])
                ),
            });
        }

        let names = self.expectations.names(view);
        let by_facet = expected.grouped(&kinds, view.facets.len());
        let (joined, count) = by_facet.joined(&vec![0; view.facets.len()], LEAST_DEVIATIONS);
        let groups: Vec<usize> = kinds.iter().map(|kind| joined[*kind]).collect();
        let law = self.law(&expected, (&groups, count), LEEWAY, &coverage);
        let of_facets = grouped(counts, &kinds, view.facets.len());
        tests.push(Test {
            check: "dots by facet",
            p_value: self.p_value(&grouped(counts, &groups, count), &law),
            found: words::farthest(&of_facets, &by_facet, |facet| names.0[facet].clone()),
        });

        let groups = expected.joined(&kinds, LEAST_DEVIATIONS);
        let law = self.law(&expected, (&groups.0, groups.1), LEEWAY, &coverage);
        let of_groups = grouped(counts, &groups.0, groups.1);
        tests.push(Test {
            check: "density of dots",
            p_value: self.p_value(&of_groups, &law),
            found: words::farthest(counts, &expected, |cell| names.1[cell].clone()),
        });

        let mut farthest: f64 = 0.0;
        let residual = Residual::new(&of_groups, &law, Some(1.0));
        let all = expected.mean.iter().sum::<f64>();
        for other in &expectations.signatures.misreadings {
            // Where the number is not known, as many photons as leave about as many dots.
            let other_size = match self.emitted {
                Some(emitted) => emitted,
                None => size * all / total(view, other, size, &coverage).max(1.0),
            };
            let other = means(view, other, other_size, &coverage);
            let other = grouped(&other, &groups.0, groups.1);
            farthest = farthest.max(residual.towards(&other).0);
        }
        tests.push(Test {
            check: "known misreadings",
            // As many tests as there are misreadings, of one side each.
            p_value: corrected(0.5 * normal_tails(farthest), expectations.misreadings.len()),
            // Whose way it is says little: the one that explains all is named for the whole.
            found: format!("dots lean {farthest:.1} standard deviations towards one of them"),
        });

        let count = tests.len();
        tests.iter_mut().for_each(|test| test.p_value = corrected(test.p_value, count));
        if self.emitted.is_some() {
            // What is rejected without the number is rejected with it.
            let of_any_number = Self { emitted: None, ..*self }.attempt(reading, standoff);
            for test in &mut tests {
                let other = of_any_number.tests.iter().find(|other| other.check == test.check);
                test.p_value = other.map_or(1.0, |other| other.p_value).min(test.p_value);
            }
        }
        let p_value = tests.iter().map(|test| test.p_value).fold(1.0, f64::min);
        Trial { reading, standoff, tests, p_value, emitted: size, groups }
    }

    /// The law of groups of cells. What cannot be known is left open by a variance along its way:
    /// the number of photons, if it was fitted, and the exact coverage.
    pub(super) fn law(
        &self,
        expected: &Expected,
        (groups, count): (&[usize], usize),
        leeway: f64,
        coverage: &[f64],
    ) -> Law {
        let joined = expected.grouped(groups, count);
        let mut law = joined.law(leeway);
        if self.emitted.is_none() {
            loosen(&mut law, &joined.slope, 1.0);
        }
        for (facet, part) in coverage.iter().enumerate().filter(|(_, part)| **part < 1.0) {
            let way = self.slope_of_facet(expected, facet);
            loosen(&mut law, &grouped(&way, groups, count), coverage::LEEWAY / part.max(0.01));
        }
        law
    }

    /// How fast the means of the cells of one facet grow.
    pub(super) fn slope_of_facet(&self, expected: &Expected, facet: usize) -> Vec<f64> {
        let is_on = |cell| self.view.facet_of_cell(cell) == facet;
        let slope = expected.slope.iter().enumerate();
        slope.map(|(cell, slope)| if is_on(cell) { *slope } else { 0.0 }).collect()
    }

    fn p_value(&self, counts: &[f64], law: &Law) -> f64 {
        let fit = fit(counts, law, Some(1.0));
        chi_squared_tail(fit.distance, fit.degrees - usize::from(self.emitted.is_none()))
    }

    /// The number of photons that fits best.
    pub(super) fn fit_size(&self, signature: &PictureSignature, coverage: &[f64]) -> f64 {
        let found: f64 = self.counts.iter().sum();
        let too_few = |size| total(self.view, signature, size, coverage) < found;
        let mut size = bisect(SIZES, too_few);
        for _ in 0..3 {
            let expected = Expected::new(self.view, signature, size, coverage);
            let law = expected.law(LEEWAY);
            let steeper: Vec<f64> = expected
                .mean
                .iter()
                .zip(&expected.slope)
                .map(|(mean, slope)| mean + slope)
                .collect();
            // The step of Gauss and Newton in the logarithm.
            let length = fit(&steeper, &law, Some(1.0)).distance.sqrt();
            let step = towards(self.counts, &law, &steeper, Some(1.0)) / length.max(1e-9);
            size = (size * step.clamp(-1.0, 1.0).exp()).clamp(SIZES[0], SIZES[1]);
        }
        size
    }
}

/// Where between the positive ends of `range` `is_low` ceases to hold, in proportion.
pub(super) fn bisect([mut low, mut high]: [f64; 2], is_low: impl Fn(f64) -> bool) -> f64 {
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

pub(super) fn better(best: Trial, trial: Trial) -> Trial {
    if trial.p_value > best.p_value { trial } else { best }
}

/// Lets the means of `law` be off together by the part `deviation` of `way`.
pub(super) fn loosen(law: &mut Law, way: &[f64], deviation: f64) {
    for (row, a) in law.covariance.iter_mut().zip(way) {
        for (entry, b) in row.iter_mut().zip(way) {
            *entry += deviation * deviation * a * b;
        }
    }
}
