//! What the bounces of a list say, where it has them.

use super::judge_list::Expectations;
use super::limits::{LAST_FIRST_BOUNCE, LEAST_DEVIATIONS, LEEWAY_OF_LONG_PATHS, SIGNIFICANCE};
use super::observation::{BOUNCES, CountsByPlace, Observation};
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
        let finding = Finding::new(
            "last bounce",
            format!("photons after {allowed} bounces, which are allowed: about {expected:.0}"),
            format!("photons after up to {seen} bounces"),
            "TracePhoton ends when remainingBounces is LESS THAN 0, not when it is 0. If the limit \
             was meant to be another one, grade with --max-bounces.",
        );
        let finding = finding.of(Section::PhotonStorage).weighing(Weight::Fault);
        findings.push(finding.by_chance(if seen < allowed { (-expected).exp() } else { 1.0 }));
    }
    findings.extend(longest_path([first, last], allowed, size, signature));
    // Where a fair reading leaves photons, it leaves them after every bounce.
    let fair = expectations.signatures.fair.iter().map(|known| &known.signature);
    let p_values = fair.map(|it| of_each_bounce(by_bounce, max_bounces, size, is_free, it, places));
    let p_value = p_values.fold(0.0, f64::max);
    let found = if p_value < SIGNIFICANCE { "not as many" } else { "as many" };
    let finding = Finding::new(
        BOUNCES_BY_PLACE,
        "on every facet as many photons of every bounce as the scene leaves there",
        format!("{found} as expected"),
        "Check how your list counts bounces.",
    );
    // A column that counts otherwise is no fault: positions alone are asked for.
    let finding = match first <= LAST_FIRST_BOUNCE {
        false => finding,
        true => Finding {
            weight: Weight::Fault,
            advice: "Check that every hit draws new random numbers, that the chance to scatter is \
                     that of the material that was hit, and how your list counts bounces."
                .into(),
            ..finding
        },
    };
    findings.push(finding.of(Section::PhotonScatteringAbsorption).by_chance(p_value));
    findings
}

/// The check of each bounce's photons by place.
pub const BOUNCES_BY_PLACE: &str = "bounces";

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
    let finding = Finding::new(
        "longest path",
        format!("about {expected:.0} paths of more than {seen} stored photons"),
        format!("paths of up to {seen} stored photons"),
        "Paths end too early: look for a limit of bounces other than the one that is asked for. If \
         it was meant, grade with --max-bounces.",
    );
    let finding = finding.of(Section::PhotonStorage).weighing(Weight::Fault);
    Some(finding.by_chance((-expected * (1.0 - LEEWAY_OF_LONG_PATHS)).exp()))
}

/// The chance that the photons of each bounce lie where they do by `signature`, of `emitted`
/// photons or, if that is free, about as many.
pub(super) fn of_each_bounce(
    by_bounce: &[CountsByPlace],
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
