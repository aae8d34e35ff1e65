//! A photon list as evidence: its photons, counted by place.

use std::ops::Deref;

use super::bounces::of_each_bounce;
use super::evidence::{Evidence, Words};
use super::expected::Expected;
use super::judge_list::Expectations;
use super::kept::{Known, SignatureTable};
use super::limits::{
    ALL_COPIED, FEW_PHOTONS, HARDLY_ANY, LEAST_LIKELY, MANY_REPEATED, MOSTLY, NAN_FRAME,
    SMALL_LIMIT, SUREST,
};
use super::naming::{Explanation, candidates, most_likely};
use super::observation::Observation;
use super::self_hits::{explain_by_self_hits, shows_self_hits};
use super::signature::{Signature, classes};
use super::verdict::Finding;
use variants::hypotheses::{FAIR, Hypothesis, no_offset, repeated_paths, stored_twice};
use variants::variation::{FACETS, Start, Storage};

/// A photon list, of `emitted` photons if that is known.
#[derive(Clone, Copy)]
pub(crate) struct OfList<'a> {
    pub(crate) observation: &'a Observation,
    pub(crate) emitted: Option<f64>,
    pub(crate) expectations: &'a Expectations,
}

impl Evidence for OfList<'_> {
    type Signature = Signature;
    const WORDS: Words = Words {
        unit: "photons",
        number: ["number", "as many photons as the scene stores of those emitted"],
        facets: ["facets", "on every facet as many photons as the scene leaves there"],
        density: ["density", "the scene's density over every facet"],
        unexplained: "None of the known misreadings explains it. Print a few photons and follow \
                      them by hand; 'photon-mapping explain' tells one's whole story.",
    };
    const LEAST_LIKELY: f64 = LEAST_LIKELY;

    fn table(&self) -> &SignatureTable<Signature> {
        &self.expectations.signatures
    }

    fn emitted(&self) -> Option<f64> {
        self.emitted
    }

    fn of_facets(&self) -> Vec<f64> {
        classes(&self.observation.counts, &self.expectations.places)
    }

    fn of_cells(&self) -> &[f64] {
        &self.observation.counts.cells
    }

    fn strays(&self) -> f64 {
        let counts = &self.observation.counts;
        counts.off_surface + counts.footprint + counts.corner
    }

    fn sizes(&self) -> Vec<f64> {
        self.expectations.places.areas_of_cells()
    }

    fn facets_of_cells(&self) -> &[usize] {
        &self.expectations.places.facet_of_cell
    }

    fn facet_name(&self, facet: usize) -> String {
        self.expectations.places.class_name(facet)
    }

    fn cell_name(&self, cell: usize) -> String {
        self.expectations.places.cell_name(cell)
    }

    fn means(&self, known: &Known<Signature>, emitted: f64) -> Vec<f64> {
        known.signature.cells.iter().map(|mean| emitted * mean).collect()
    }

    fn expect_cells(&self, known: &Known<Signature>, emitted: f64) -> Expected {
        let Expectations { signatures, places, .. } = self.expectations;
        known.signature.of_cells(&signatures.correlation, &places.leeway_of_cells(), emitted)
    }

    fn expect_facets(
        &self,
        known: &Known<Signature>,
        emitted: f64,
        _: &impl Deref<Target = Expected>,
    ) -> Expected {
        known.signature.of_classes(emitted)
    }

    fn may_be(&self, Hypothesis { id, variation, .. }: &Hypothesis) -> bool {
        let Self { observation, .. } = self;
        let of_nan = observation.counts.not_finite / observation.records.max(1) as f64;
        if *id == "nan-frame" {
            return of_nan > NAN_FRAME;
        }
        if *id == FAIR {
            return of_nan == 0.0 && !self.is_short();
        }
        let is_below = variation.goes_below();
        let straight = observation.to_light.and_then(|to_light| to_light.part_straight());
        let is_straight = match straight {
            Some(part) if variation.stores_direct() => part > MOSTLY,
            Some(part) => is_below || variation.fewer_bounces > 0 || part < HARDLY_ANY,
            None => true,
        };
        let is_long = !self.is_short()
            || is_below
            || variation.storage != Storage::Indirect
            || variation.most_bounces.is_some()
            || variation.fewer_bounces > 0;
        // Directions below the surface lead back to it, but not to the very same place; one start
        // for all does.
        let may_repeat =
            is_below && (!observation.repeats_by_rounding || variation.start != Start::Hit);
        let is_repeated = self.part_repeated() >= MANY_REPEATED;
        of_nan == 0.0 && (may_repeat || !is_repeated) && is_straight && is_long
    }

    fn of_bounces(&self, known: &Known<Signature>, emitted: f64) -> Option<f64> {
        let by_bounce = self.observation.by_bounce.as_ref()?;
        let Expectations { signatures, places, .. } = self.expectations;
        let (allowed, signature) = (signatures.max_bounces, &known.signature);
        Some(of_each_bounce(by_bounce, allowed, emitted, false, signature, places))
    }

    fn of_few(&self, reading: usize) -> Option<f64> {
        let counts = self.of_facets();
        let is_few = counts.iter().sum::<f64>() <= FEW_PHOTONS as f64;
        is_few.then(|| self.expectations.paths()[reading].p_value(&counts))?
    }

    fn other_lengths(&self, known: &Known<Signature>, emitted: f64) -> Vec<Vec<f64>> {
        let Signature { classes, by_bounce, .. } = &known.signature;
        let with_more = |more: &Vec<f64>| {
            classes.iter().zip(more).map(|(mean, more)| emitted * (mean + more)).collect()
        };
        by_bounce.iter().map(with_more).collect()
    }
}

impl OfList<'_> {
    /// How many photons were emitted: as known, or as fits the reference best.
    fn size(&self) -> f64 {
        self.emitted.unwrap_or_else(|| self.fit_size(&self.table().fair[0]))
    }

    fn part_repeated(&self) -> f64 {
        self.observation.repeated / self.observation.counts.on_surfaces().max(1.0)
    }

    /// Whether paths end before a small limit.
    fn is_short(&self) -> bool {
        let max_bounces = self.expectations.signatures.max_bounces;
        self.observation.bounces.is_some_and(|[first, last]| {
            i32::from(last - first) + 1 < max_bounces && max_bounces <= SMALL_LIMIT
        })
    }

    /// The misreading that explains the list, or two at once, if no other does as well.
    pub(crate) fn explain(&self) -> Option<Explanation> {
        let Self { observation, .. } = self;
        let copies = observation.copies.filter(|copies| copies.all > ALL_COPIED);
        if let Some(copies) = copies {
            let is_twice = copies.side_by_side > ALL_COPIED && !copies.are_few_places();
            let hypothesis = if is_twice { stored_twice() } else { repeated_paths() };
            return Some(Explanation::by_marks(hypothesis, self.size()));
        }
        let joined = self.joined();
        let candidates = candidates(self, &joined);
        let others = candidates.iter().filter(|candidate| candidate.hypothesis.id != FAIR);
        let others = others.map(|candidate| candidate.fit.p_value).fold(0.0, f64::max);
        let is_repeated = self.part_repeated() > MANY_REPEATED;
        if others < LEAST_LIKELY && is_repeated && observation.counts.not_finite == 0.0 {
            let is_self_hits = shows_self_hits(observation)
                && explain_by_self_hits(observation, self.emitted, self.expectations);
            let of_marks = Explanation::by_marks(no_offset([0.0; FACETS]), self.size());
            let confidence = SUREST.min(1.0 - others);
            return is_self_hits.then_some(Explanation { confidence, ..of_marks });
        }
        most_likely(self, &joined, candidates)
    }

    /// As [`Self::explain`]; but what else is wrong with a list speaks for no misreading, unless it
    /// comes of that one: `findings` has what is wrong.
    pub(crate) fn explain_what_shows<'f>(
        &self,
        are_places_off: bool,
        findings: impl Iterator<Item = &'f Finding> + Clone,
    ) -> Option<Explanation> {
        let shows = |check: &str| findings.clone().any(|it| it.is_fault() && it.check == check);
        let is_shown = |explanation: &Explanation| {
            are_places_off
                || match explanation.hypothesis.id {
                    "nan-frame" => shows("finite"),
                    "no-offset" | "repeated-paths" | "stored-twice" => shows("same place"),
                    variants::hypotheses::BOUNCE_OFF_BY_ONE => shows("last bounce"),
                    _ => false,
                }
        };
        self.explain().filter(is_shown)
    }
}
