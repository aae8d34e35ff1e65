//! What the bounces of a list say, where it has them.

use super::judge_list::Expectations;
use super::limits::{LEAST_DEVIATIONS, SIGNIFICANCE};
use super::observation::{BOUNCES, Counts, Observation};
use super::places::Places;
use super::signature::{Signature, classes};
use super::statistics::corrected;
use super::verdict::{Finding, Weight};
use variants::section::Section;

/// Holds the bounces of `observation` against `signature`: whether the last that is allowed occurs,
/// and the counts of each.
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
    let is_free = emitted.is_none();
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
                "TracePhoton ends when remainingBounces is LESS THAN 0, not when it is 0. If the \
                 limit was meant to be another one, grade with --max-bounces."
                    .into()
            },
        });
    }
    findings.extend(longest_path([first, last], allowed, size, signature));
    // Where a fair reading leaves photons, it leaves them after every bounce.
    let fair = expectations.signatures.fair.iter().map(|known| &known.signature);
    let p_values = fair.map(|it| of_each_bounce(by_bounce, max_bounces, size, is_free, it, places));
    let p_value = p_values.fold(0.0, f64::max);
    let passed = p_value >= SIGNIFICANCE;
    // A column that counts otherwise is no fault: positions alone are asked for.
    let counts_hits = first <= LAST_FIRST_BOUNCE;
    findings.push(Finding {
        check: BOUNCES_BY_PLACE,
        section: Some(Section::PhotonScatteringAbsorption.title()),
        expected: "on every facet as many photons of every bounce as the scene leaves there"
            .to_owned(),
        found: if passed { "as many as expected" } else { "not as many as expected" }.to_owned(),
        p_value: Some(p_value),
        passed,
        weight: if counts_hits { Weight::Fault } else { Weight::Remark },
        advice: match (passed, counts_hits) {
            (true, _) => "",
            (_, true) => {
                "Check that every hit draws new random numbers, that the chance to scatter is that \
                          of the material that was hit, and how your list counts bounces."
            }
            (_, false) => "Check how your list counts bounces.",
        }
        .into(),
    });
    findings
}

/// The check of each bounce's photons by place.
pub const BOUNCES_BY_PLACE: &str = "bounces";
/// Hits are counted from 0 or from 1, and the second is the first that is stored: so the first
/// bounce of a list is 2 at most.
const LAST_FIRST_BOUNCE: u16 = 2;
/// By which part of itself the number of long paths may be smaller: beyond the bounces of a
/// signature, they are taken to end at the same rate.
const LEEWAY_OF_LONG_PATHS: f64 = 0.15;

/// The fault that no path has more bounces than the list has, where many should.
fn longest_path(
    [first, last]: [u16; 2],
    allowed: usize,
    size: f64,
    signature: &Signature,
) -> Option<Finding> {
    let seen = usize::from(last - first) + 1;
    let beyond = seen.checked_sub(BOUNCES)?;
    if first > LAST_FIRST_BOUNCE || seen >= allowed {
        return None;
    }
    let of_bounce = |bounce: usize| signature.by_bounce[bounce].iter().sum::<f64>();
    let all = signature.classes.iter().sum::<f64>();
    let later = (all - (0..BOUNCES).map(of_bounce).sum::<f64>()).max(0.0);
    let ratio = later / (later + of_bounce(BOUNCES - 1));
    let expected = size * later * (1.0 - ratio) * ratio.powi(beyond as i32);
    let p_value = (-expected * (1.0 - LEEWAY_OF_LONG_PATHS)).exp();
    let passed = p_value >= SIGNIFICANCE;
    Some(Finding {
        check: "longest path",
        section: Some(Section::PhotonStorage.title()),
        expected: format!("about {expected:.0} paths of more than {seen} stored photons"),
        found: format!("paths of up to {seen} stored photons"),
        p_value: Some(p_value),
        passed,
        weight: Weight::Fault,
        advice: if passed {
            "".into()
        } else {
            "Paths end too early: look for a limit of bounces other than the one that is asked \
             for. If it was meant, grade with --max-bounces."
                .into()
        },
    })
}

/// The chance that the photons of each bounce lie where they do by `signature`, of `emitted`
/// photons or, if that is free, about as many.
pub(super) fn of_each_bounce(
    by_bounce: &[Counts],
    max_bounces: i32,
    emitted: f64,
    is_free: bool,
    signature: &Signature,
    places: &Places,
) -> f64 {
    let mut smallest = 1.0_f64;
    let mut tests = 0;
    let allowed = usize::try_from(max_bounces).unwrap_or(0);
    for (bounce, counts) in by_bounce.iter().enumerate().take(allowed) {
        let expected = signature.of_bounce(bounce, emitted);
        let groups = expected.joined(&vec![0; expected.mean.len()], LEAST_DEVIATIONS);
        if groups.count < 2 {
            continue;
        }
        let law = expected.grouped(&groups).law(is_free);
        smallest = smallest.min(law.fit(&groups.sums(&classes(counts, places))).p_value);
        tests += 1;
    }
    corrected(smallest, tests.max(1))
}
