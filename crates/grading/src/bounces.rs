//! What the bounces of a list say, where it has them.

use super::judge_list::{Expectations, LEEWAY, SIGNIFICANCE, joined};
use super::observation::Observation;
use super::signature::{Signature, classes};
use super::statistics::{corrected, fit, grouped};
use super::verdict::{Finding, Weight};
use variants::section::Section;

/// Holds the bounces of `observation` against `signature`: whether the last that is allowed occurs, and
/// the counts of each.
pub fn bounce_findings(
    observation: &Observation,
    emitted: Option<f64>,
    signature: &Signature,
    expectations: &Expectations,
) -> Vec<Finding> {
    let (Some(by_bounce), Some([first, last])) = (&observation.by_bounce, observation.bounces)
    else {
        return Vec::new();
    };
    let places = &expectations.places;
    let max_bounces = expectations.signatures.max_bounces;
    let allowed = usize::try_from(max_bounces).unwrap_or(0);
    let size = emitted.unwrap_or_else(|| {
        observation.counts.on_surfaces() / signature.classes.iter().sum::<f64>()
    });
    let mut findings = Vec::new();
    let expected_at = |bounce: usize| size * signature.by_bounce[bounce].iter().sum::<f64>();
    if (1..=by_bounce.len()).contains(&allowed) {
        // As many bounces must occur as are allowed.
        let expected = expected_at(allowed - 1);
        let seen = usize::from(last - first) + 1;
        let p_value = if seen < allowed { (-expected).exp() } else { 1.0 };
        let passed = p_value >= SIGNIFICANCE;
        findings.push(Finding {
            check: "last bounce",
            section: Some(Section::PhotonStorage.title()),
            expected: format!(
                "photons after {allowed} bounces, which are allowed: about {expected:.0}"
            ),
            found: format!("photons after up to {seen} bounces"),
            p_value: Some(p_value),
            passed,
            weight: Weight::Fault,
            advice: if passed {
                "".into()
            } else {
                "TracePhoton ends when remainingBounces is LESS THAN 0, not when it is 0. If the limit was \
                 meant to be another one, grade with --max-bounces."
                    .into()
            },
        });
    }
    let mut smallest = 1.0_f64;
    let mut tests = 0;
    for (bounce, counts) in by_bounce.iter().enumerate().take(allowed) {
        let counts = classes(counts, places);
        let law = signature.law_of_bounce(bounce, LEEWAY);
        let (groups, count) = joined(&law.mean, size);
        if count < 2 {
            continue;
        }
        let fit = fit(&grouped(&counts, &groups, count), &law.grouped(&groups, count), emitted);
        smallest = smallest.min(fit.p_value);
        tests += 1;
    }
    let p_value = corrected(smallest, tests.max(1));
    let passed = p_value >= SIGNIFICANCE;
    findings.push(Finding {
        check: "bounces",
        section: Some(Section::PhotonStorage.title()),
        expected: "on every facet as many photons of every bounce as the scene leaves there"
            .to_owned(),
        found: if passed { "as many as expected" } else { "not as many as expected" }.to_owned(),
        p_value: Some(p_value),
        passed,
        // Positions alone are asked for; a column that counts otherwise is no fault.
        weight: Weight::Remark,
        advice: if passed { "" } else { "Check how your list counts bounces." }.into(),
    });
    findings
}
