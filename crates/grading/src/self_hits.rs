//! Photons that hit the triangle they leave, told by their marks: places at which several photons
//! lie.

use super::judge_list::Expectations;
use super::limits::{FIRST_HITS_SHOW, LEAST_SCATTERED, LEEWAY_OF_LOSS, MOST_FIRST_HITS};
use super::observation::Observation;
use super::signature::classes;
use variants::variation::{FACETS, survival_of_facets};

/// Whether photons at the same place are there because rays start below the surface: by rounding,
/// or since they come from behind it. Directions below the surface lead back to it from the front,
/// and from farther away.
pub(super) fn shows_self_hits(observation: &Observation) -> bool {
    let is_from_behind = observation.to_light.is_some_and(|to_light| {
        let from_behind = to_light.from_behind as f64;
        // Of more than half of all photons, it is the sign of the column.
        (0.5 * observation.repeated..0.5 * to_light.set as f64).contains(&from_behind)
    });
    observation.repeats_by_rounding || is_from_behind
}

/// Whether self-hits explain places at which several photons lie. How many there are depends on
/// rounding, from facet to facet and from bounce to bounce, so their counts follow no law; but what
/// they leave when every place counts once does: the places of scattered photons, of which a part
/// is lost, and of first hits, of which a part becomes known.
pub(super) fn explain_by_self_hits(
    observation: &Observation,
    emitted: Option<f64>,
    expectations: &Expectations,
) -> bool {
    let places = &expectations.places;
    let reference = expectations.reference();
    let Some(with_direct) = expectations.with_direct() else { return false };
    let with_first_hits = &with_direct.classes;
    let distinct = classes(&observation.distinct, places);
    let size = emitted.unwrap_or_else(|| reference.fit_size(&distinct));
    let shows_first_hits =
        reference.towards(with_direct, &distinct, size, emitted.is_none()) > FIRST_HITS_SHOW;
    let is_between = |class: usize| {
        let scattered = size * reference.classes[class];
        let first = size * (with_first_hits[class] - reference.classes[class]).max(0.0);
        let by_chance = 5.0 * (scattered + first).sqrt() + 5.0;
        let least = LEAST_SCATTERED * scattered - by_chance;
        let most = 1.1 * scattered + MOST_FIRST_HITS * first + by_chance;
        // Of an unknown size, only the shape of what is left tells.
        emitted.is_none() || (least..most).contains(&distinct[class])
    };
    shows_first_hits
        && (0..places.facets.len()).all(is_between)
        && emitted.is_none_or(|emitted| {
            let counts = classes(&observation.counts, places);
            loses_what_self_hits_lose(emitted, &counts, &distinct, with_first_hits, expectations)
        })
}

/// Whether facets that the light does not reach have as many photons fewer as self-hits lose on
/// their way: `counts`, at `distinct` places, of `emitted` emitted.
fn loses_what_self_hits_lose(
    emitted: f64,
    counts: &[f64],
    distinct: &[f64],
    with_first_hits: &[f64],
    expectations: &Expectations,
) -> bool {
    let reference = expectations.reference();
    let first_hits =
        |facet: usize| emitted * (with_first_hits[facet] - reference.classes[facet]).max(0.0);
    let scattered = |facet: usize| emitted * reference.classes[facet];
    let (lit, dark): (Vec<usize>, Vec<usize>) =
        (0..FACETS).partition(|facet| first_hits(*facet) > scattered(*facet));
    let of_dark = |of: &dyn Fn(usize) -> f64| dark.iter().map(|facet| of(*facet)).sum::<f64>();
    let found = of_dark(&|facet| distinct[facet]);
    let left = found / of_dark(&scattered).max(1.0);

    let survival = survival_of_facets();
    let (mut survive, mut leave) = (0.0, 0.0);
    for facet in lit {
        let (first, survival) = (first_hits(facet), f64::from(survival[facet]));
        let arriving = left * scattered(facet) + first;
        // Of first hits, those are known that a self-hit followed. What follows that may be rarer:
        // on some planes rounding brings no point below twice.
        let again = ((distinct[facet] - left * scattered(facet)) / first).clamp(0.0, survival);
        let known_again = counts[facet] - distinct[facet] + first * again;
        let once_more = (1.0 - arriving * again / known_again.max(1.0)).clamp(0.0, survival);
        survive += first * survival;
        leave += first
            * (survival - again + again * (survival - once_more) / (1.0 - once_more).max(1e-9));
    }
    let part = leave / survive;
    let of_bounce = |bounce: usize| of_dark(&|facet| reference.by_bounce[bounce][facet]);
    let bounces = 0..reference.by_bounce.len();
    let all: f64 = bounces.clone().map(of_bounce).sum();
    let lost: f64 =
        bounces.map(|bounce| part.powi(bounce as i32 + 1) * of_bounce(bounce)).sum::<f64>() / all;
    let by_chance = 3.0 / found.max(1.0).sqrt();
    (left / lost - 1.0).abs() < LEEWAY_OF_LOSS + by_chance
}
