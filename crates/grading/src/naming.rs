//! Which misreading explains what a submission shows?

use super::bounces::of_each_bounce;
use super::judge_list::Expectations;
use super::observation::Observation;
use super::places::Places;
use super::self_hits::{explain_by_self_hits, shows_self_hits};
use super::signature::{Signature, Signatures, classes};
use super::statistics::{Fit, Law, Matrix, Residual, corrected, fit, grouped};
use super::trial::{LEAST_EXPECTED, LEEWAY, LEEWAY_OF_CELLS};
use variants::hypotheses::{
    BOUNCE_OFF_BY_ONE, FAIR, Hypothesis, no_offset, repeated_paths, stored_twice,
};
use variants::pairs::{OTHER_ROULETTE, PAIR};
use variants::variation::{FACETS, Start, Storage};

/// A misreading that would show what is seen, or something stranger, less often than this explains
/// nothing.
const LEAST_LIKELY: f64 = 3e-3;
/// The same of self-hits, whose law is only roughly known.
const SELF_HITS_LEAST: f64 = 1e-4;
/// One that is as rare as this is ruled out, whatever its cells say.
const RULED_OUT: f64 = 1e-9;
/// By hundreds of planted faults: how much likelier, before a list is seen, all faults that are not
/// in the table are together than one that is.
const OUTSIDE: f64 = 0.01;
/// The same beside self-hits, whose law is only roughly known: much seems to be elsewhere.
const SELF_HITS_OUTSIDE: f64 = 1e-4;
/// A name is given when it is as sure as this.
const SURE: f64 = 0.95;
/// Nothing is surer than this: there may be mistakes of which nobody has thought.
const SUREST: f64 = 0.999;
/// Of identical positions, more than this part of all makes every path a copy of another.
const ALL_COPIED: f64 = 0.95;
/// When as large a part of all photons is at the same place as another one, self-hits are looked
/// for, and misreadings without them explain nothing.
const MANY_REPEATED: f64 = 0.03;
/// Of more bounces than these, hardly a path has the last.
const SMALL_LIMIT: i32 = 12;
/// The logarithm of how much rarer than one misreading of the table two of them at once are.
const RARER_PAIR: f64 = -6.0;
/// The same of each roulette that has no name.
const RARER_ROULETTE: f64 = -3.0;
/// The same of photons that are right but for their number.
const RARER_NUMBER: f64 = -2.0;

/// A misreading that explains a submission, or two at once.
#[derive(Clone, Debug, PartialEq)]
pub struct Explanation {
    /// The misreading, or one of [`variants::pairs`].
    pub hypothesis: Hypothesis,
    /// How well it fits.
    pub fit: Fit,
    /// Its likelihood beside those of all others.
    pub confidence: f64,
}

impl Explanation {
    /// Of `hypothesis`, whose counts agree with those seen as `fit` says; a likelihood comes with
    /// all others'.
    pub(super) fn new(hypothesis: &Hypothesis, mut fit: Fit) -> Self {
        fit.log_likelihood += match hypothesis.id {
            PAIR => RARER_PAIR,
            OTHER_ROULETTE => RARER_ROULETTE,
            FAIR => RARER_NUMBER,
            _ => 0.0,
        };
        Self { hypothesis: hypothesis.clone(), fit, confidence: 0.0 }
    }

    /// Whether it is two misreadings at once, which have no name of their own.
    pub fn is_pair(&self) -> bool {
        self.hypothesis.id == PAIR
    }

    fn is_same_misreading(&self, other: &Self) -> bool {
        let [one, other] = [&self.hypothesis, &other.hypothesis];
        // With t and b as they are written, a title is longer.
        let is_same_pair =
            one.title.starts_with(&other.title) || other.title.starts_with(&one.title);
        one.id == other.id && (!self.is_pair() || is_same_pair)
    }
}

/// Whether a bounce fewer than `max_bounces`, which are allowed, can show at all.
pub fn bounces_show(max_bounces: i32) -> bool {
    max_bounces <= SMALL_LIMIT
}

/// The misreading that explains `observation`, or two at once, if no other does as well.
pub fn explain(
    observation: &Observation,
    emitted: Option<f64>,
    expectations: &Expectations,
) -> Option<Explanation> {
    let Expectations { places, fair, misreadings, pairs, signatures, .. } = expectations;
    let max_bounces = signatures.max_bounces;
    let repeated = observation.repeated / observation.counts.on_surfaces().max(1.0);
    let of_nan = observation.counts.not_finite / observation.records.max(1) as f64;
    let straight = observation.to_light.and_then(|to_light| to_light.part_straight());
    let is_short = observation.bounces.is_some_and(|[first, last]| {
        i32::from(last - first) + 1 < max_bounces && max_bounces <= SMALL_LIMIT
    });
    if let Some(copied) = copied(observation) {
        return Some(copied);
    }
    let is_possible = |Hypothesis { id, variation, .. }: &Hypothesis| {
        if *id == "nan-frame" {
            return of_nan > 0.2;
        }
        let is_below = variation.goes_below();
        let is_straight = match straight {
            Some(part) if variation.stores_direct() => part > 0.5,
            Some(part) => is_below || variation.fewer_bounces > 0 || part < 0.01,
            None => true,
        };
        let is_long = !is_short
            || is_below
            || variation.storage != Storage::Indirect
            || variation.most_bounces.is_some()
            || variation.fewer_bounces > 0;
        // Directions below the surface lead back to it, but not to the very same place; one start
        // for all does.
        let may_repeat =
            is_below && (!observation.repeats_by_rounding || variation.start != Start::Hit);
        of_nan == 0.0 && (may_repeat || repeated < MANY_REPEATED) && is_straight && is_long
    };
    let comparison = Comparison::new(observation, emitted, places, signatures);
    let of_misreadings = signatures.misreadings.iter().chain(&signatures.pairs);
    let mut candidates: Vec<Explanation> = (misreadings.iter().chain(pairs))
        .zip(of_misreadings)
        .filter(|(hypothesis, _)| is_possible(hypothesis))
        .filter(|(hypothesis, _)| hypothesis.id != BOUNCE_OFF_BY_ONE || bounces_show(max_bounces))
        .map(|(hypothesis, signature)| Explanation::new(hypothesis, comparison.fit(signature)))
        .collect();
    let others = candidates.iter().map(|candidate| candidate.fit.p_value).fold(0.0, f64::max);
    if others < LEAST_LIKELY && repeated > MANY_REPEATED && of_nan == 0.0 {
        if !shows_self_hits(observation) {
            return None;
        }
        let fit = explain_by_self_hits(observation, emitted, expectations)?;
        let hypothesis = no_offset([0.0; FACETS]);
        return Some(Explanation { hypothesis, fit, confidence: SUREST.min(1.0 - others) });
    }
    if of_nan == 0.0 && !is_short {
        // Photons lost or stored twice all over the scene are no misreading, and neither is what
        // only resembles one.
        let of_any_number = Comparison { emitted: None, ..comparison.clone() };
        let fair = fair.iter().zip(&signatures.fair);
        candidates.extend(
            fair.map(|(reading, signature)| {
                Explanation::new(reading, of_any_number.fit(signature))
            }),
        );
    }
    most_likely(candidates, |best| comparison.elsewhere(best, expectations))
}

/// What made every photon come more than once, to the last bit.
fn copied(observation: &Observation) -> Option<Explanation> {
    let copies = observation.copies?;
    let fit = Fit { distance: 0.0, degrees: 0, p_value: 1.0, log_likelihood: 0.0, emitted: 0.0 };
    let hypothesis =
        if copies.side_by_side > ALL_COPIED { stored_twice() } else { repeated_paths() };
    let confidence = SUREST;
    (copies.all > ALL_COPIED).then_some(Explanation { hypothesis, fit, confidence })
}

/// Counts to be held against signatures: the classes, and cells of so many photons that their law
/// is nearly normal.
#[derive(Clone)]
struct Comparison<'a> {
    observation: &'a Observation,
    places: &'a Places,
    max_bounces: i32,
    emitted: Option<f64>,
    of_classes: Vec<f64>,
    of_cells: Vec<f64>,
    groups: (Vec<usize>, usize),
    correlation: &'a Matrix,
}

impl<'a> Comparison<'a> {
    fn new(
        observation: &'a Observation,
        emitted: Option<f64>,
        places: &'a Places,
        signatures: &'a Signatures,
    ) -> Self {
        let of_classes = classes(&observation.counts, places);
        let reference = &signatures.fair[0];
        // By the photons there are: a misreading may have stored far fewer than are expected.
        let size = of_classes.iter().sum::<f64>() / reference.classes.iter().sum::<f64>();
        let groups = places.joined_cells(&reference.cells, size, LEAST_EXPECTED);
        let count = groups.iter().max().map_or(0, |last| last + 1);
        Self {
            observation,
            places,
            max_bounces: signatures.max_bounces,
            emitted,
            of_classes,
            of_cells: grouped(&observation.counts.cells, &groups, count),
            groups: (groups, count),
            correlation: &signatures.correlation,
        }
    }

    /// How well `signature` agrees: the likelihood by cells, which tell the most, and the smallest
    /// p-value, with regard to their number.
    fn fit(&self, signature: &Signature) -> Fit {
        let by_class = fit(&self.of_classes, &signature.law_of_classes(LEEWAY), self.emitted);
        let by_cell = fit(&self.of_cells, &self.law_of_cells(signature), self.emitted);
        let size = by_class.emitted;
        let allowed = usize::try_from(self.max_bounces).unwrap_or(0);
        let of_bounces = self.observation.by_bounce.as_ref().map(|by_bounce| {
            of_each_bounce(by_bounce, allowed, size, Some(size), signature, self.places)
        });
        let p_values = [Some(by_class.p_value), Some(by_cell.p_value), of_bounces];
        let smallest = p_values.into_iter().flatten().fold(1.0, f64::min);
        let p_value = corrected(smallest, p_values.iter().flatten().count());
        Fit { p_value, log_likelihood: by_cell.log_likelihood, ..by_class }
    }

    fn law_of_cells(&self, signature: &Signature) -> Law {
        let (groups, count) = &self.groups;
        signature.law_of_cells(self.correlation, LEEWAY_OF_CELLS).grouped(groups, *count)
    }

    /// The evidence for something that is not in the table, beside `best`: between it and another
    /// hypothesis, or with another part of paths of each length.
    fn elsewhere(&self, best: &Explanation, expectations: &Expectations) -> f64 {
        let Expectations { misreadings, pairs, signatures, .. } = expectations;
        let (groups, count) = &self.groups;
        let all = || {
            let of_misreadings = signatures.misreadings.iter().chain(&signatures.pairs);
            misreadings.iter().chain(pairs).zip(of_misreadings)
        };
        let is_best = |hypothesis: &Hypothesis| hypothesis.key() == best.hypothesis.key();
        let Some((_, signature)) = all().find(|(hypothesis, _)| is_best(hypothesis)) else {
            return 0.0;
        };
        let law = self.law_of_cells(signature);
        let others = all().filter(|(other, _)| other.id != best.hypothesis.id);
        let fair = signatures.fair.iter();
        let others = others.map(|(_, signature)| signature).chain(fair);
        let of_cells = Residual::new(&self.of_cells, &law, self.emitted)
            .elsewhere(others.map(|other| grouped(&other.cells, groups, *count)));
        let law = signature.law_of_classes(LEEWAY);
        let lengths = signature.by_bounce.iter();
        let with_more = lengths.map(|more| law.mean.iter().zip(more).map(|(a, b)| a + b).collect());
        let of_lengths = Residual::new(&self.of_classes, &law, self.emitted).elsewhere(with_more);
        0.5 * (of_cells + of_lengths)
    }
}

/// The likeliest of `candidates`, if it explains what is seen, and neither another one does as well
/// nor something that is not in the table: `elsewhere` has the evidence for that, beside the best.
pub(super) fn most_likely(
    mut candidates: Vec<Explanation>,
    elsewhere: impl Fn(&Explanation) -> f64,
) -> Option<Explanation> {
    candidates.retain(|candidate| candidate.fit.p_value >= RULED_OUT);
    candidates.sort_by(|a, b| b.fit.log_likelihood.total_cmp(&a.fit.log_likelihood));
    let best = candidates.first()?.clone();
    let is_fair = best.hypothesis.misreading.is_none() && !best.is_pair();
    let (least, outside) = match best.hypothesis.id {
        "no-offset" => (SELF_HITS_LEAST, SELF_HITS_OUTSIDE),
        _ => (LEAST_LIKELY, OUTSIDE),
    };
    if best.fit.p_value < least || is_fair {
        return None;
    }
    // Ways to the same misreading do not compete with each other.
    let mut counted = vec![&best];
    let mut sum = 1.0;
    for other in &candidates[1..] {
        if !counted.iter().any(|known| known.is_same_misreading(other)) {
            counted.push(other);
            sum += (other.fit.log_likelihood - best.fit.log_likelihood).exp();
        }
    }
    sum += outside * elsewhere(&best);
    let confidence = (1.0 / sum).min(SUREST);
    (confidence > SURE).then_some(Explanation { confidence, ..best })
}
