//! Photons straight from the light, by where photons lie.

use super::facts::straight_from_the_light;
use super::judge_list::Expectations;
use super::limits::{APART, FEWEST_ON_FACET, LEFT_OF_DIRECT, PLAINLY};
use super::observation::Observation;
use super::signature::{Signature, Signatures, classes};
use super::text::rounded;
use super::verdict::{Finding, Weight};
use variants::variation::{Emission, Variation};

/// Whether so many photons straight from the light as the directions say are ruled out by the
/// counts, which fit `emitted` emitted: straight from the light come far more to the tops of the
/// boxes, say, than by a bounce.
pub fn is_ruled_out(observation: &Observation, emitted: f64, expectations: &Expectations) -> bool {
    let Some(to_light) = observation.to_light else { return false };
    let Some(stored) = expectations.with_direct() else { return false };
    let reference = expectations.reference();
    let direct = stored.classes.iter().zip(&reference.classes).map(|(all, other)| all - other);
    let direct: Vec<f64> = direct.map(|mean| mean.max(0.0)).collect();
    let part = to_light.to_the_light as f64 / direct.iter().sum::<f64>();
    // The number is left open: a list may be short of others.
    let deviations = |counts: &[f64]| {
        let size = reference.fit_size(counts);
        reference.towards(stored, counts, size, true)
    };
    let means = reference.classes.iter().zip(&direct);
    let expected = means.map(|(mean, direct)| emitted * mean + part * direct);
    let expected = deviations(&expected.collect::<Vec<_>>());
    let found = deviations(&classes(&observation.counts, &expectations.places));
    expected > APART && found < 0.5 * expected
}

/// The fault that a facet has more photons than any mistake leaves there that stores none straight
/// from the light.
pub fn shows_direct(observation: &Observation, expectations: &Expectations) -> Option<Finding> {
    // Where self-hits cannot be told from others, they may be what there is too much of.
    if observation.few_decimals.is_some() {
        return None;
    }
    let places = &expectations.places;
    let counts = classes(&observation.distinct, places);
    let all: f64 = counts.iter().sum();
    let share = |signature: &Signature, class: usize| {
        signature.classes[class] / signature.classes.iter().sum::<f64>()
    };
    // What gets below surfaces shows beneath the boxes.
    // Other ways to leave the light are told by the facets that they leave in the dark.
    let is_indirect = |variation: &Variation| {
        !variation.stores_direct()
            && !variation.goes_below()
            && [Emission::Sphere, Emission::Cube].contains(&variation.emission)
    };
    let Signatures { fair, misreadings, .. } = &expectations.signatures;
    let indirect = misreadings.iter().filter(|it| is_indirect(&it.hypothesis.variation));
    let indirect: Vec<_> = fair.iter().chain(indirect).map(|it| &it.signature).collect();
    (0..places.facets.len()).find_map(|class| {
        let most = indirect.iter().map(|signature| share(signature, class)).fold(0.0, f64::max);
        let is_plain = counts[class] > (PLAINLY * most * all).max(FEWEST_ON_FACET);
        (is_plain && has_all_direct(&counts, class, expectations)).then(|| Finding {
            weight: Weight::Grave,
            ..straight_from_the_light(
                format!(
                    "{} of {} lie on {}, where hardly any come but straight from the light",
                    rounded(counts[class]),
                    rounded(all),
                    places.class_name(class)
                ),
                false,
            )
        })
    })
}

/// Whether every facet has as many photons as come to it straight from the light, where all on
/// `class` do.
fn has_all_direct(counts: &[f64], class: usize, expectations: &Expectations) -> bool {
    let Some(stored) = expectations.with_direct() else { return false };
    let reference = expectations.reference();
    let direct = |facet: usize| (stored.classes[facet] - reference.classes[facet]).max(0.0);
    let emitted = counts[class] / direct(class).max(1e-9);
    (0..expectations.places.facets.len()).all(|facet| {
        let expected = LEFT_OF_DIRECT * emitted * direct(facet);
        counts[facet] >= expected - 4.0 * expected.sqrt()
    })
}
