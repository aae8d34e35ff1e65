//! Which misreading explains what a submission shows?

use super::hypotheses::{Hypothesis, no_offset, to_the_letter};
use super::observation::Observation;
use super::places::Places;
use super::signature::{Signature, classes, measure};
use super::statistics::{Fit, fit};
use super::variation::FACETS;

/// By which part of itself a misreading's mean may be off: the student's program is not ours, and the
/// misreading is not all of it.
const LEEWAY: f64 = 0.02;
/// Self-hits depend on rounding, from facet to facet and from bounce to bounce.
const LEEWAY_OF_SELF_HITS: f64 = 0.1;
/// A misreading that would show so little as what is seen less often than this explains nothing.
const LEAST_LIKELY: f64 = 1e-4;
/// The part of all photons that are at the same place as another one: up to the first, rounding explains
/// it; from the second on, self-hits must.
const FEW_REPEATED: f64 = 0.01;
const MANY_REPEATED: f64 = 0.03;
/// Of more bounces than these, hardly a path has the last.
const SMALL_LIMIT: i32 = 12;
/// With how many photons self-hits are measured.
const PHOTONS_FOR_SELF_HITS: u64 = 1_000_000;

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
    /// How often photons may bounce.
    pub max_bounces: i32,
}

/// The misreading that explains `observation`, if one does and no other does as well. `unread` is the
/// likelihood of the best fair reading, with the same leeway.
pub fn name(
    observation: &Observation,
    emitted: Option<f64>,
    places: &Places,
    known: Known,
) -> Option<Explanation> {
    let counts = classes(&observation.counts, places);
    let all: f64 = observation.on_facet.iter().sum();
    let repeated = observation.repeated.iter().sum::<f64>() / all.max(1.0);
    let of_nan = observation.counts.not_finite / observation.records.max(1) as f64;
    let straight = observation
        .to_light
        .map(|to_light| to_light.to_the_light as f64 / to_light.set.max(1) as f64);
    let is_possible = |hypothesis: &Hypothesis| match hypothesis.id {
        "nan-frame" => of_nan > 0.2,
        "transposed-frame" | "flipped-normal" => of_nan == 0.0,
        "bounce-off-by-one" => {
            of_nan == 0.0 && repeated < MANY_REPEATED && known.max_bounces <= SMALL_LIMIT
        }
        "direct-stored" => {
            of_nan == 0.0 && repeated < MANY_REPEATED && straight.is_none_or(|part| part > 0.5)
        }
        _ => of_nan == 0.0 && repeated < MANY_REPEATED && straight.is_none_or(|part| part < 0.01),
    };
    let mut candidates: Vec<Explanation> = Vec::new();
    let mut consider = |hypothesis: &Hypothesis, signature: &Signature, leeway: f64| {
        let fit = fit(&counts, &signature.law_of_classes(leeway), emitted);
        candidates.push(Explanation { hypothesis: hypothesis.clone(), fit, confidence: 0.0 });
    };
    for (hypothesis, signature) in known.hypotheses.iter().zip(known.signatures) {
        if is_possible(hypothesis) {
            consider(hypothesis, signature, LEEWAY);
        }
    }
    if repeated > FEW_REPEATED && of_nan == 0.0 {
        let normalised = no_offset(self_hits(observation, places));
        for hypothesis in [to_the_letter(&normalised), normalised] {
            let photons = PHOTONS_FOR_SELF_HITS;
            let (signature, _) = measure(&hypothesis, places, photons, known.max_bounces);
            consider(&hypothesis, &signature, LEEWAY_OF_SELF_HITS);
        }
    }
    most_likely(candidates)
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

/// By facet, which part of the scattered photons meets it again: of all its photons, those that survive
/// and meet it again are followed by another one at the same place.
fn self_hits(observation: &Observation, places: &Places) -> [f32; FACETS] {
    let scene = crate::assignment8::create_scene();
    let mut self_hits = [0.0; FACETS];
    for (facet, part) in self_hits.iter_mut().enumerate() {
        let material = scene.mesh_objects()[places.facets[facet].surface].material;
        let survival = f64::from(material.base_diffuse_reflection().max_element());
        let repeated = observation.repeated[facet] / observation.on_facet[facet].max(1.0);
        *part = (repeated / survival).clamp(0.0, 0.99) as f32;
    }
    self_hits
}
