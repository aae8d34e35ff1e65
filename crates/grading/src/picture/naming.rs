//! Which misreading explains the dots of a picture?

use super::expectations::PictureExpectations;
use super::expected::{Expected, means, total};
use super::judge::{Case, Trial, loosen};
use super::signature::PictureSignature;
use crate::naming::{Explanation, bounces_show, most_likely};
use crate::statistics::{Law, Residual, chi_squared_tail, fit, grouped};
use variants::hypotheses::{BOUNCE_OFF_BY_ONE, Hypothesis};

/// By which part of itself the density of a known misreading may be off, of which the student's
/// program may have another form.
const LEEWAY_OF_MISREADING: f64 = 0.02;
/// Self-hits depend on rounding, from facet to facet.
const LEEWAY_OF_SELF_HITS: f64 = 0.25;
/// A misreading with which the picture is less likely than this does not explain it alone: two
/// together often look a little like one. Pictures with this one alone are as rare, but for
/// self-hits, whose law is only roughly known.
const LEAST_LIKELY: f64 = 0.02;

impl Case<'_> {
    /// The misreading that explains the picture, or two at once, if no other does as well.
    pub(super) fn explain(&self, trial: &Trial) -> Option<Explanation> {
        let groups = (trial.groups.0.as_slice(), trial.groups.1);
        let signatures = &self.expectations.signatures;
        let known = self.expectations.misreadings.iter().chain(&self.expectations.pairs);
        let signatures = signatures.misreadings.iter().chain(&signatures.pairs);
        let max_bounces = self.expectations.signatures.max_bounces;
        let can_be_seen = |id| id != BOUNCE_OFF_BY_ONE || bounces_show(max_bounces);
        let candidates = known
            .zip(signatures)
            .filter(|(hypothesis, _)| can_be_seen(hypothesis.id))
            .map(|(hypothesis, signature)| self.hold_against(hypothesis, signature, groups));
        // Dots lost all over the scene are no misreading.
        let of_any_number = Self { emitted: None, ..*self };
        let fair = self.expectations.fair.iter().zip(&self.expectations.signatures.fair);
        let fair = fair
            .filter(|_| self.emitted.is_some())
            .map(|(reading, signature)| of_any_number.hold_against(reading, signature, groups));
        let outside = |best: &Explanation| self.elsewhere(best, groups);
        most_likely(candidates.chain(fair).collect(), outside)
            .filter(|it| it.hypothesis.id == "no-offset" || it.fit.p_value >= LEAST_LIKELY)
    }

    /// The evidence for something that is not in the table, beside `best`.
    fn elsewhere(&self, best: &Explanation, (groups, count): (&[usize], usize)) -> f64 {
        let PictureExpectations { misreadings, pairs, signatures, .. } = self.expectations;
        let known = || {
            let signatures = signatures.misreadings.iter().chain(&signatures.pairs);
            misreadings.iter().chain(pairs).zip(signatures)
        };
        let is_best = |hypothesis: &Hypothesis| hypothesis.key() == best.hypothesis.key();
        let Some((_, signature)) = known().find(|(hypothesis, _)| is_best(hypothesis)) else {
            return 0.0;
        };
        let at_rest = vec![1.0; self.view.facets.len()];
        let (size, counts) = (best.fit.emitted, grouped(self.counts, groups, count));
        let expected = Expected::new(self.view, signature, size, &at_rest);
        let law = self.law_of_misreading(&best.hypothesis, &expected, (groups, count));
        let residual = Residual::new(&counts, &law, Some(1.0));
        let all: f64 = expected.mean.iter().sum();
        let others = known().filter(|(other, _)| other.id != best.hypothesis.id);
        residual.elsewhere(others.map(|(_, other)| {
            let size = match self.emitted {
                Some(emitted) => emitted,
                None => size * all / total(self.view, other, size, &at_rest).max(1.0),
            };
            grouped(&means(self.view, other, size, &at_rest), groups, count)
        }))
    }

    /// How well `hypothesis` explains the picture, whose cells are joined into `groups`, so many of
    /// them.
    fn hold_against(
        &self,
        hypothesis: &Hypothesis,
        signature: &PictureSignature,
        (groups, count): (&[usize], usize),
    ) -> Explanation {
        let counts = grouped(self.counts, groups, count);
        let at_rest = vec![1.0; self.view.facets.len()];
        let size = self.emitted.unwrap_or_else(|| self.fit_size(signature, &at_rest));
        let expected = Expected::new(self.view, signature, size, &at_rest);
        let law = self.law_of_misreading(hypothesis, &expected, (groups, count));
        let mut fit = fit(&counts, &law, Some(1.0));
        fit.degrees -= usize::from(self.emitted.is_none());
        fit.p_value = chi_squared_tail(fit.distance, fit.degrees);
        fit.emitted = size;
        Explanation::new(hypothesis, fit)
    }

    /// The law of groups of cells under a misreading, of which the student's program may have
    /// another form.
    fn law_of_misreading(
        &self,
        hypothesis: &Hypothesis,
        expected: &Expected,
        (groups, count): (&[usize], usize),
    ) -> Law {
        let at_rest = vec![1.0; self.view.facets.len()];
        let mut law = self.law(expected, (groups, count), LEEWAY_OF_MISREADING, &at_rest);
        if hypothesis.id == "no-offset" {
            for facet in 0..self.view.facets.len() {
                let way = grouped(&self.slope_of_facet(expected, facet), groups, count);
                loosen(&mut law, &way, LEEWAY_OF_SELF_HITS);
            }
        }
        law
    }
}
