//! Which misreading explains what a submission shows?

use std::cell::LazyCell;

use super::evidence::{Evidence, Joined};
use super::kept::Known;
use super::limits::{
    OUTSIDE, RARER_NUMBER, RARER_PAIR, RARER_ROULETTE, RULED_OUT, SELF_HITS_LEAST,
    SELF_HITS_OUTSIDE, SMALL_LIMIT, SURE, SUREST,
};
use super::statistics::{Fit, corrected};
use super::trial::means_like;
use variants::hypotheses::{BOUNCE_OFF_BY_ONE, FAIR, Hypothesis};
use variants::pairs::{OTHER_ROULETTE, PAIR};
use variants::variation::Storage;

/// A misreading that explains a submission, or two at once.
#[derive(Clone, Debug, PartialEq)]
pub struct Explanation {
    /// The misreading, or one of [`variants::pairs`].
    pub hypothesis: Hypothesis,
    /// How well it fits.
    pub fit: Fit,
    /// How many photons were emitted: as known, or as it fits best.
    pub emitted: f64,
    /// Its likelihood beside those of all others.
    pub confidence: f64,
}

impl Explanation {
    /// Of `hypothesis`, whose marks are certain.
    pub(crate) fn by_marks(hypothesis: Hypothesis, emitted: f64) -> Self {
        Self { hypothesis, fit: Fit::CERTAIN, emitted, confidence: SUREST }
    }

    /// Whether it is two misreadings at once, which have no name of their own.
    pub fn is_pair(&self) -> bool {
        self.hypothesis.id == PAIR
    }

    /// Where it is one misreading, and where it is two at once.
    pub(crate) fn alone_or_pair(explained: Option<Self>) -> [Option<Self>; 2] {
        match explained {
            Some(pair) if pair.is_pair() => [None, Some(pair)],
            alone => [alone, None],
        }
    }

    /// What is to be done where two misreadings explain what is seen, and none does alone.
    pub(crate) fn two_at_once(&self) -> String {
        format!(
            "No known misreading explains it alone, but two together do: {}. Look at both.",
            self.hypothesis.title
        )
    }

    pub(crate) fn is_same_misreading(&self, other: &Self) -> bool {
        let [one, other] = [&self.hypothesis, &other.hypothesis];
        // With t and b as they are written, a title is longer.
        let is_same_pair =
            one.title.starts_with(&other.title) || other.title.starts_with(&one.title);
        one.id == other.id && (!self.is_pair() || is_same_pair)
    }
}

/// Whether `hypothesis` can show at all, where `max_bounces` are allowed.
pub(crate) fn can_show(hypothesis: &Hypothesis, max_bounces: i32) -> bool {
    hypothesis.id != BOUNCE_OFF_BY_ONE || max_bounces <= SMALL_LIMIT
}

/// A hypothesis is held against facets, cells, and bounces where they are known.
const MOST_TESTS: usize = 3;

/// How well each misreading, two at once, or another number of photons explains `evidence`, of
/// those that its marks do not rule out.
pub(crate) fn candidates<E: Evidence>(evidence: &E, joined: &Joined) -> Vec<Explanation> {
    let table = evidence.table();
    let can_be_seen = |known: &&Known<E::Signature>| {
        let Known { hypothesis, .. } = known;
        // Of two bounces, the first alone is left by one bounce fewer as well.
        let has_other_name =
            hypothesis.variation.storage == Storage::FirstBounce && table.max_bounces <= 2;
        let shows = can_show(hypothesis, table.max_bounces);
        evidence.may_be(hypothesis) && shows && !has_other_name
    };
    let faults = table.faults().filter(can_be_seen);
    let faults = faults.filter_map(|it| hold_against(evidence, joined, it, evidence.emitted()));
    // Photons lost or stored twice all over the scene are no misreading, and neither is what only
    // resembles one.
    let fair = table.fair.iter().filter(can_be_seen);
    faults.chain(fair.filter_map(|it| hold_against(evidence, joined, it, None))).collect()
}

/// How well one hypothesis agrees: the likelihood by cells, which tell the most, and the smallest
/// p-value, with regard to their number. Nothing where the facets alone rule it out: they
/// are a few counts, and cells are many.
fn hold_against<E: Evidence>(
    evidence: &E,
    joined: &Joined,
    known: &Known<E::Signature>,
    number: Option<f64>,
) -> Option<Explanation> {
    let is_free = number.is_none();
    let of_facets = joined.facets.sums(&evidence.of_facets());
    let held = |emitted| {
        let cells = LazyCell::new(move || evidence.expect_cells(known, emitted));
        let facets = evidence.expect_facets(known, emitted, &cells);
        let facets = facets.grouped(&joined.facets).law(is_free).fit(&of_facets);
        (cells, facets.p_value)
    };
    let emitted = match number {
        Some(number) => number,
        // The number that fits best is near this one, and the variance grows with it: what is as
        // rare as this at one of them is ruled out at the other.
        None if held(evidence.size_by_total(known)).1 < RULED_OUT.powi(4) => return None,
        None => evidence.fit_size(known),
    };
    let (cells, of_facets) = held(emitted);
    if corrected(of_facets, MOST_TESTS) < RULED_OUT {
        return None;
    }
    let cells = cells.grouped(&joined.cells).law(is_free);
    let cells = cells.fit(&joined.cells.sums(evidence.of_cells()));
    let of_bounces = evidence.of_bounces(known, emitted);
    let p_values: [Option<f64>; MOST_TESTS] = [Some(of_facets), Some(cells.p_value), of_bounces];
    let smallest = p_values.into_iter().flatten().fold(1.0, f64::min);
    let rarer = match known.hypothesis.id {
        PAIR => RARER_PAIR,
        OTHER_ROULETTE => RARER_ROULETTE,
        FAIR => RARER_NUMBER,
        _ => 0.0,
    };
    let fit = Fit {
        p_value: corrected(smallest, p_values.iter().flatten().count()),
        log_likelihood: cells.log_likelihood + rarer,
    };
    Some(Explanation { hypothesis: known.hypothesis.clone(), fit, emitted, confidence: 0.0 })
}

/// The likeliest of `candidates`, if it explains `evidence`, and neither another one does as well
/// nor something that is not in the table.
pub(crate) fn most_likely<E: Evidence>(
    evidence: &E,
    joined: &Joined,
    mut candidates: Vec<Explanation>,
) -> Option<Explanation> {
    candidates.retain(|candidate| candidate.fit.p_value >= RULED_OUT);
    candidates.sort_by(|a, b| b.fit.log_likelihood.total_cmp(&a.fit.log_likelihood));
    let best = candidates.first()?.clone();
    let is_fair = best.hypothesis.misreading.is_none() && !best.is_pair();
    let (least, outside) = match best.hypothesis.id {
        "no-offset" => (SELF_HITS_LEAST, SELF_HITS_OUTSIDE),
        _ => (E::LEAST_LIKELY, OUTSIDE),
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
    sum += outside * elsewhere(evidence, joined, &best);
    let confidence = (1.0 / sum).min(SUREST);
    (confidence > SURE).then_some(Explanation { confidence, ..best })
}

/// The evidence for something that is not in the table, beside `best`: between it and another
/// hypothesis, or with another part of paths of each length.
fn elsewhere<E: Evidence>(evidence: &E, joined: &Joined, best: &Explanation) -> f64 {
    let table = evidence.table();
    let is_best = |known: &&Known<E::Signature>| known.hypothesis.key() == best.hypothesis.key();
    let Some(known) = table.faults().find(is_best) else { return 0.0 };
    let is_free = evidence.emitted().is_none();
    let cells = LazyCell::new(|| evidence.expect_cells(known, best.emitted));
    let others = table.faults().filter(|other| other.hypothesis.id != best.hypothesis.id);
    let others = others.chain(&table.fair);
    let others = others.map(|other| {
        joined.cells.sums(&means_like(evidence, other, &cells, best.emitted, is_free))
    });
    let of_cells = joined.cells.sums(evidence.of_cells());
    let of_cells = cells.grouped(&joined.cells).law(is_free).elsewhere(&of_cells, others);
    let lengths = evidence.other_lengths(known, best.emitted);
    if lengths.is_empty() {
        return of_cells;
    }
    let facets = evidence.expect_facets(known, best.emitted, &cells).grouped(&joined.facets);
    let lengths = lengths.iter().map(|means| joined.facets.sums(means));
    let of_facets = joined.facets.sums(&evidence.of_facets());
    0.5 * (of_cells + facets.law(is_free).elsewhere(&of_facets, lengths))
}
