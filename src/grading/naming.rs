//! Which misreading explains what a submission shows?

use super::hypotheses::{Hypothesis, no_offset};
use super::observation::Observation;
use super::places::Places;
use super::signature::{Signature, classes};
use super::statistics::{Fit, fit, towards};
use super::variation::{FACETS, survival_of_facets};

/// By which part of itself a misreading's mean may be off: the student's program is not ours, and the
/// misreading is not all of it.
const LEEWAY: f64 = 0.012;
/// A misreading that would show so little as what is seen less often than this explains nothing.
const LEAST_LIKELY: f64 = 1e-4;
/// When as large a part of all photons is at the same place as another one, self-hits are looked for, and
/// misreadings without them explain nothing.
const MANY_REPEATED: f64 = 0.03;
/// Of more bounces than these, hardly a path has the last.
const SMALL_LIMIT: i32 = 12;
/// How many standard deviations the places of self-hits must be towards those of first hits: what is
/// stored twice for another reason is not.
const FIRST_HITS_SHOW: f64 = 6.0;
/// Of the photons that a hit should scatter, self-hits leave at least so many; and of the first hits,
/// which are not stored, they make at most so many known. Both are out of reach for rounding, which
/// brings half of the starts below the surface.
const LEAST_SCATTERED: f64 = 0.5;
const MOST_FIRST_HITS: f64 = 0.5;
/// By which part of itself the number of photons that self-hits leave may be off: its prediction takes the same
/// loss for all ways to a facet. A roulette with the mean would leave a quarter fewer.
const LEEWAY_OF_LOSS: f64 = 0.12;

/// A misreading that explains a submission.
#[derive(Clone, Debug, PartialEq)]
pub struct Explanation {
    /// The misreading.
    pub hypothesis: Hypothesis,
    /// How well it fits.
    pub fit: Fit,
    /// Its likelihood beside those of all others.
    pub confidence: f64,
}

/// What is known of the misreadings.
#[derive(Clone, Copy, Debug)]
pub struct Known<'a> {
    /// The misreadings.
    pub hypotheses: &'a [Hypothesis],
    /// Their signatures.
    pub signatures: &'a [Signature],
    /// The reference's signature.
    pub reference: &'a Signature,
    /// How often photons may bounce.
    pub max_bounces: i32,
}

/// Whether `hypothesis` stores other photons than the reference at all, where photons may bounce
/// `max_bounces` times.
pub fn can_show(hypothesis: &Hypothesis, max_bounces: i32) -> bool {
    hypothesis.id != "bounce-off-by-one" || max_bounces <= SMALL_LIMIT
}

/// The misreading that explains `observation`, if one does and no other does as well.
pub fn name(
    observation: &Observation,
    emitted: Option<f64>,
    places: &Places,
    known: Known,
) -> Option<Explanation> {
    let counts = classes(&observation.counts, places);
    let repeated = observation.repeated / observation.counts.on_surfaces().max(1.0);
    let of_nan = observation.counts.not_finite / observation.records.max(1) as f64;
    let straight = observation.to_light.and_then(|to_light| to_light.part_straight());
    let is_short = observation.bounces.is_some_and(|[first, last]| {
        i32::from(last - first) + 1 < known.max_bounces && known.max_bounces <= SMALL_LIMIT
    });
    let is_possible = |hypothesis: &Hypothesis| match hypothesis.id {
        "nan-frame" => of_nan > 0.2,
        "transposed-frame" | "flipped-normal" => of_nan == 0.0,
        "bounce-off-by-one" => of_nan == 0.0 && repeated < MANY_REPEATED,
        "direct-stored" => {
            of_nan == 0.0 && repeated < MANY_REPEATED && straight.is_none_or(|part| part > 0.5)
        }
        _ => {
            of_nan == 0.0
                && repeated < MANY_REPEATED
                && straight.is_none_or(|part| part < 0.01)
                && !is_short
        }
    };
    let mut candidates: Vec<Explanation> = Vec::new();
    for (hypothesis, signature) in known.hypotheses.iter().zip(known.signatures) {
        if is_possible(hypothesis) && can_show(hypothesis, known.max_bounces) {
            let fit = fit(&counts, &signature.law_of_classes(LEEWAY), emitted);
            candidates.push(Explanation { hypothesis: hypothesis.clone(), fit, confidence: 0.0 });
        }
    }
    let others = candidates.iter().map(|candidate| candidate.fit.p_value).fold(0.0, f64::max);
    if others < LEAST_LIKELY && repeated > MANY_REPEATED && of_nan == 0.0 {
        let fit = explain_by_self_hits(observation, emitted, places, known)?;
        let hypothesis = no_offset([0.0; FACETS]);
        return Some(Explanation { hypothesis, fit, confidence: 1.0 - others });
    }
    most_likely(candidates)
}

/// Whether self-hits explain places at which several photons lie. How many there are depends on rounding, from
/// facet to facet and from bounce to bounce, so their counts follow no law; but what they leave when every
/// place counts once does: the places of scattered photons, of which a part is lost, and of first hits, of
/// which a part becomes known.
fn explain_by_self_hits(
    observation: &Observation,
    emitted: Option<f64>,
    places: &Places,
    known: Known,
) -> Option<Fit> {
    let direct_stored =
        known.hypotheses.iter().position(|hypothesis| hypothesis.id == "direct-stored")?;
    let with_first_hits = &known.signatures[direct_stored].classes;
    let law = known.reference.law_of_classes(LEEWAY);
    let distinct = classes(&observation.distinct, places);
    let of_distinct = fit(&distinct, &law, emitted);
    let shows_first_hits = towards(&distinct, &law, with_first_hits, emitted) > FIRST_HITS_SHOW;
    let size = of_distinct.emitted;
    let is_between = |class: usize| {
        let scattered = size * law.mean[class];
        let first = size * (with_first_hits[class] - law.mean[class]).max(0.0);
        let by_chance = 5.0 * (scattered + first).sqrt() + 5.0;
        let least = LEAST_SCATTERED * scattered - by_chance;
        let most = 1.1 * scattered + MOST_FIRST_HITS * first + by_chance;
        // Of an unknown size, only the shape of what is left tells.
        emitted.is_none() || (least..most).contains(&distinct[class])
    };
    let explains = shows_first_hits
        && (0..places.facets.len()).all(is_between)
        && emitted.is_none_or(|emitted| {
            let counts = classes(&observation.counts, places);
            loses_what_self_hits_lose(emitted, &counts, &distinct, with_first_hits, known)
        });
    explains.then_some(of_distinct)
}

/// Whether facets that the light does not reach have as many photons fewer as self-hits lose on their way: `counts`,
/// at `distinct` places, of `emitted` sent out.
fn loses_what_self_hits_lose(
    emitted: f64,
    counts: &[f64],
    distinct: &[f64],
    with_first_hits: &[f64],
    known: Known,
) -> bool {
    let reference = known.reference;
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
        // Of first hits, those are known that a self-hit followed. What follows that may be rarer: on some planes
        // rounding brings no point below twice.
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

/// The likeliest of `candidates`, if it explains what is seen, and no other does as well.
pub(super) fn most_likely(mut candidates: Vec<Explanation>) -> Option<Explanation> {
    candidates.sort_by(|a, b| b.fit.log_likelihood.total_cmp(&a.fit.log_likelihood));
    let best = candidates.first()?.clone();
    if best.fit.p_value < LEAST_LIKELY {
        return None;
    }
    // Ways to the same misreading do not compete with each other.
    let mut ids: Vec<&str> = vec![best.hypothesis.id];
    let mut sum = 1.0;
    for other in &candidates {
        if !ids.contains(&other.hypothesis.id) {
            ids.push(other.hypothesis.id);
            sum += (other.fit.log_likelihood - best.fit.log_likelihood).exp();
        }
    }
    let confidence = 1.0 / sum;
    (confidence > 0.95).then_some(Explanation { confidence, ..best })
}
