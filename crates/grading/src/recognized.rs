//! Is there anything of the photon map in what a submission shows?
//!
//! A misreading, also one that is in no table, moves some photons of the map and leaves others.
//! What was made up has nothing to do with the light: it lies elsewhere, or evenly.

use super::evidence::Evidence;
use super::expected::size_with_total;
use super::limits::{CROWDED, EVEN, FEWEST_PLACES, MADE_UP, MANY_PLACES, MORE_EVEN, ONE_SURFACE};
use super::verdict::{Finding, Verdict, Weight};

/// The check of what a grade is given for at all.
pub const RECOGNIZED: &str = "photon map";
/// The check of whether that can be told.
pub const RECOGNIZABLE: &str = "enough to recognize";
/// The check of whether what has no name has enough photons to be more than chance.
pub const TELLING: &str = "enough without a name";

/// The verdict whose points a submission gets: of too few photons those of an undecided one, and of
/// what is no photon map those of an unreadable one.
pub fn scored_as(verdict: Verdict, findings: &[Finding]) -> Verdict {
    let fails = |check: &str| findings.iter().any(|it| it.is_fault() && it.check == check);
    match verdict {
        _ if fails(RECOGNIZED) => Verdict::Unreadable,
        _ if fails(RECOGNIZABLE) || fails(TELLING) => Verdict::Undecided,
        verdict => verdict,
    }
}

/// Whether something of a photon map is in what has these `findings`, whatever it is worth.
pub(crate) fn is_recognized(findings: &[Finding]) -> bool {
    findings.iter().all(|it| !it.is_fault() || ![RECOGNIZED, RECOGNIZABLE].contains(&it.check))
}

/// The finding that nothing of the photon map is in `evidence`, which is wrong, or that so little
/// is in it that this cannot be told. `is_crowded` tells whether it crowds on spots or lines, and
/// `is_named` whether a misreading explains it.
pub(crate) fn not_recognized<E: Evidence>(
    evidence: &E,
    is_crowded: bool,
    is_named: bool,
) -> Option<Finding> {
    let counts = evidence.of_cells();
    let (unit, on_cells) = (E::WORDS.unit, counts.iter().sum::<f64>());
    let places = on_cells + evidence.strays();
    if places < FEWEST_PLACES {
        let finding = Finding::new(
            RECOGNIZABLE,
            format!("{unit} at {FEWEST_PLACES} places or more"),
            format!("{unit} at {places} places, too few to recognize a photon map"),
            "So few look the same whether a program made them or a hand: a person must look. Hand \
             in the list of a run of 1,000,000 photons.",
        );
        return Some(finding.weighing(Weight::Fault));
    }
    let limit = if is_crowded { CROWDED } else { MADE_UP };
    let apart = to_nearest(evidence, limit);
    let on_one = evidence.of_facets().into_iter().fold(0.0, f64::max) / on_cells.max(1.0);
    let found = if apart > limit {
        format!("{:.0} % of the {unit} lie where nothing that is known leaves them", 100.0 * apart)
    } else if on_one > ONE_SURFACE {
        format!("{:.0} % of the {unit} lie on one surface, where light reaches all", 100.0 * on_one)
    } else {
        // Fewer are even by chance.
        if places < MANY_PLACES {
            return (!is_named).then(|| too_few_without_name(unit, places));
        }
        let uneven = to_even(evidence);
        let even_enough = uneven + MORE_EVEN;
        if uneven >= EVEN || to_nearest(evidence, even_enough) <= even_enough {
            return None;
        }
        format!("{unit} that lie evenly all over the surfaces, as no light leaves them")
    };
    Some(made_up(found))
}

/// The finding that what was `found` is no photon map.
pub(crate) fn made_up(found: String) -> Finding {
    let finding = Finding::new(
        RECOGNIZED,
        "a photon map of this scene, with or without mistakes",
        found,
        "Nothing of the photon map is recognizable: a person must look. Check which file was \
         handed in, and which program made it.",
    );
    finding.weighing(Weight::Grave)
}

/// The finding that what lies at `places` has no name, and is too little to be more than chance.
fn too_few_without_name(unit: &str, places: f64) -> Finding {
    let finding = Finding::new(
        TELLING,
        format!("{unit} at {MANY_PLACES} places or more, or a known misreading that explains them"),
        format!("{unit} at {places} places, which no known misreading explains"),
        "Points that a hand strewed would look the same: a person must look. Hand in the list of a \
         run of 1,000,000 photons.",
    );
    finding.weighing(Weight::Fault)
}

/// The part of the counts that would have to move until they are as the nearest hypothesis leaves
/// them, fair or not: all that are in no cell too. A hypothesis for which no more than `enough`
/// would have to move ends the search, for there are hundreds.
pub(crate) fn to_nearest<E: Evidence>(evidence: &E, enough: f64) -> f64 {
    let counts = evidence.of_cells();
    let (found, strays) = (counts.iter().sum::<f64>(), evidence.strays());
    let table = evidence.table();
    let part = |moved: f64| (moved + strays) / (found + strays);
    let mut nearest = part(found);
    for known in table.fair.iter().chain(table.faults()) {
        if nearest <= enough {
            break;
        }
        let means = |emitted| evidence.means(known, emitted);
        let emitted = size_with_total(found, |emitted| means(emitted).iter().sum());
        nearest = nearest.min(part(to_move(counts, &means(emitted))));
    }
    nearest
}

/// The same until they are even all over each facet.
fn to_even<E: Evidence>(evidence: &E) -> f64 {
    let (counts, sizes) = (evidence.of_cells(), evidence.sizes());
    let facets = evidence.facets_of_cells();
    let on = |values: &[f64], facet: usize| {
        let all = values.iter().zip(facets);
        all.filter(|(_, other)| **other == facet).map(|(value, _)| value).sum::<f64>()
    };
    let even = |(size, facet): (&f64, &usize)| size * on(counts, *facet) / on(&sizes, *facet);
    let means: Vec<f64> = sizes.iter().zip(facets).map(even).collect();
    to_move(counts, &means).max(0.0) / counts.iter().sum::<f64>().max(1.0)
}

/// How many of `counts` would have to move until they are `means`, without what chance
/// moves.
fn to_move(counts: &[f64], means: &[f64]) -> f64 {
    let apart = counts.iter().zip(means).map(|(count, mean)| {
        // Nearly the mean deviation of a Poisson variable.
        let by_chance = (2.0 * mean).min((2.0 * mean / std::f64::consts::PI).sqrt());
        (count - mean).abs() - by_chance
    });
    0.5 * apart.sum::<f64>()
}
