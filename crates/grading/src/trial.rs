//! The tests of a submission against the fair readings.

use std::cell::LazyCell;

use super::evidence::{Evidence, Joined};
use super::expected::{Expected, Groups};
use super::kept::Known;
use super::limits::{LEAST_OF_WAY, LEAST_POWER, POWER_KEPT, RATE_OF_WAYS, SIGNIFICANCE};
use super::naming::{Explanation, can_show};
use super::statistics::{corrected, normal_quantile, normal_tail, tails_of_count};
use super::text::{difference, rounded};
use super::verdict::{Finding, Weight};

/// What one test found.
pub(crate) struct Test {
    check: &'static str,
    expected: &'static str,
    /// The chance of this, or of something stranger, with regard to how many tests there are.
    p_value: f64,
    found: String,
}

/// The tests of a submission against one fair reading.
pub(crate) struct Trial {
    pub(crate) reading: usize,
    tests: Vec<Test>,
    /// The smallest p-value, corrected for the number of tests.
    pub(crate) p_value: f64,
    pub(crate) emitted: f64,
    /// How many groups of cells there are.
    pub(crate) groups: usize,
}

impl Trial {
    /// The chance that `check` found.
    pub(crate) fn p_value_of(&self, check: &str) -> f64 {
        let test = self.tests.iter().find(|test| test.check == check);
        test.map_or(1.0, |test| test.p_value)
    }

    /// What the tests found. Their advice is that of the misreading that explains them, else
    /// `unexplained`.
    pub(crate) fn findings<'a>(
        &'a self,
        reading: &'a str,
        explanation: Option<&'a Explanation>,
        unexplained: &'a str,
    ) -> impl Iterator<Item = Finding> + 'a {
        let misreading = explanation.and_then(|explanation| explanation.hypothesis.misreading);
        self.tests.iter().map(move |test| {
            let expected = format!("{} ({reading})", test.expected);
            let finding = Finding::new(test.check, expected, test.found.clone(), "");
            let advice = misreading.map_or_else(
                || unexplained.to_owned().into(),
                |misreading| misreading.advice.into(),
            );
            let section = misreading.map(|misreading| misreading.section.title());
            let finding = Finding { section, advice, ..finding };
            finding.weighing(Weight::Fault).by_chance(test.p_value)
        })
    }
}

/// The fair reading under which `evidence` is least strange. Where it is strange under all of them,
/// what was found is told beside the reference's numbers, which people know.
pub(crate) fn best_trial<E: Evidence>(evidence: &E) -> Trial {
    let joined = evidence.joined();
    let reference = attempt(evidence, &joined, 0);
    let mut best: Option<Trial> = None;
    for reading in (1..evidence.table().fair.len()).rev() {
        let least = best.as_ref().unwrap_or(&reference).p_value;
        best = attempt_above(evidence, &joined, reading, least).or(best);
    }
    match best {
        Some(best) if best.p_value >= SIGNIFICANCE => best,
        Some(best) => {
            let p_values = best.tests.iter().map(|test| test.p_value);
            let mut told = Trial { p_value: best.p_value, ..reference };
            told.tests.iter_mut().zip(p_values).for_each(|(test, p_value)| test.p_value = p_value);
            told
        }
        None => reference,
    }
}

/// Holds `evidence` against one fair reading: by the shares of its places alone, and, where the
/// number of photons is known, by their numbers as well. Each of both parts decides alone, so that
/// what is rejected without the number is rejected with it.
fn attempt<E: Evidence>(evidence: &E, joined: &Joined, reading: usize) -> Trial {
    attempt_above(evidence, joined, reading, -1.0).expect("no p-value is below zero")
}

/// The same, or nothing if its p-value is at most `least`. The tests of all ways to misreadings
/// take the longest, and are left out where an earlier test has decided.
pub(crate) fn attempt_above<E: Evidence>(
    evidence: &E,
    joined: &Joined,
    reading: usize,
    least: f64,
) -> Option<Trial> {
    let known = &evidence.table().fair[reading];
    let fitted = evidence.fit_size(known);
    let mut tests = part(evidence, joined, known, fitted, true, least)?;
    if let Some(p_value) = evidence.of_few(reading) {
        let facets = tests.iter_mut().filter(|test| test.check == E::WORDS.facets[0]);
        facets.for_each(|facets| facets.p_value = facets.p_value.min(p_value));
    }
    if let Some(emitted) = evidence.emitted() {
        let mut with_number = part(evidence, joined, known, emitted, false, least)?;
        for test in &mut with_number {
            if let Some(other) = tests.iter().find(|other| other.check == test.check) {
                test.p_value = test.p_value.min(other.p_value);
            }
        }
        tests = with_number;
    }
    let p_value = tests.iter().map(|test| test.p_value).fold(1.0, f64::min);
    (p_value > least).then(|| Trial {
        reading,
        p_value,
        tests,
        emitted: evidence.emitted().unwrap_or(fitted),
        groups: joined.cells.count,
    })
}

/// The tests of one part, for `emitted` photons or, if that is free, about as many. Nothing if one
/// of the first has a p-value of at most `least`.
fn part<E: Evidence>(
    evidence: &E,
    joined: &Joined,
    known: &Known<E::Signature>,
    emitted: f64,
    is_free: bool,
    least: f64,
) -> Option<Vec<Test>> {
    let words = E::WORDS;
    let of_facets = evidence.of_facets();
    let cells = LazyCell::new(|| evidence.expect_cells(known, emitted));
    let facets = evidence.expect_facets(known, emitted, &cells);
    let unit = words.unit;
    let mut tests = Vec::new();
    let mut test = |[check, expected]: [&'static str; 2], p_value, found| {
        tests.push(Test { check, expected, p_value, found });
    };
    if !is_free {
        let whole = facets.grouped(&Groups::whole(of_facets.len()));
        let (found, expected) = (of_facets.iter().sum::<f64>(), whole.mean[0]);
        let p_value = tails_of_count(found, expected, whole.variance(0));
        let found = format!("{} {unit}; expected {}", rounded(found), rounded(expected));
        test(words.number, p_value, found);
    }

    let groups = facets.grouped(&joined.facets);
    let of_groups = joined.facets.sums(&of_facets);
    let all = groups.law(is_free).fit(&of_groups).p_value;
    let one = smallest_tails(&of_groups, &groups);
    // All together find what is spread over many facets, the farthest what is wrong with one.
    let (p_value, found) = match joined.facets.count {
        1 => (1.0, format!("too few {unit} to tell facets apart")),
        _ => {
            let name = |facet| evidence.facet_name(facet);
            (corrected(all.min(one), 2), farthest::<E>(&of_facets, &facets, name))
        }
    };
    test(words.facets, p_value, found);

    let law = cells.grouped(&joined.cells).law(is_free);
    let of_groups = joined.cells.sums(evidence.of_cells());
    let (p_value, found) = match joined.cells.count {
        1 => (1.0, format!("too few {unit} to tell places apart")),
        _ => {
            let name = |cell| evidence.cell_name(cell);
            (law.fit(&of_groups).p_value, farthest::<E>(evidence.of_cells(), &cells, name))
        }
    };
    test(words.density, p_value, found);

    // The three look at everything, and share one error rate.
    let count = tests.len();
    tests.iter_mut().for_each(|test| test.p_value = corrected(test.p_value, count));
    if tests.iter().any(|test| test.p_value <= least) {
        return None;
    }
    // Whose way it is says little: the one that explains all is named for the whole.
    let shows = |it: &&Known<E::Signature>| can_show(&it.hypothesis, evidence.table().max_bounces);
    let others = evidence.table().misreadings.iter().filter(shows);
    let others =
        others.map(|it| means_like(evidence, it, &cells, emitted, is_free)).collect::<Vec<_>>();
    // Of all cells, as few as their photons may be: a sum over them is close to normal.
    let law = cells.law(is_free);
    let ways = law.towards(evidence.of_cells(), others.into_iter()).collect();
    let (farthest, p_value) = strangest_way(ways);
    tests.push(Test {
        check: "known misreadings",
        expected: "no tendency towards a known misreading",
        p_value,
        found: format!("{unit} lean {farthest:.1} standard deviations towards one of them"),
    });
    Some(tests)
}

/// Of `ways` to misreadings, each with how many deviations the counts have gone on it and how many
/// it is long, the strangest: its deviations, and its chance, in units of [`SIGNIFICANCE`] of the
/// error rate that it has. They share [`RATE_OF_WAYS`], each in proportion to the rate with which
/// its test finds nearly as many lists as the best one for it alone: for what plainly shows, next
/// to nothing.
fn strangest_way(ways: Vec<(f64, f64)>) -> (f64, f64) {
    let needs: Vec<f64> = ways.iter().map(|(_, length)| rate_to_find(*length)).collect();
    let unit = RATE_OF_WAYS / needs.iter().sum::<f64>();
    let tested = ways.iter().zip(needs).filter(|(_, need)| *need > 0.0);
    let p_values = tested.map(|((deviations, _), need)| {
        (*deviations, SIGNIFICANCE * normal_tail(*deviations) / (unit * need))
    });
    p_values.fold((0.0, 1.0), |a, b| if b.1 < a.1 { b } else { a })
}

/// How often the test of one misreading, `length` standard deviations from a fair reading, would
/// have to call correct lists incorrect to find [`POWER_KEPT`] of what the best one for it alone
/// finds: zero where that one hardly finds any.
pub fn rate_to_find(length: f64) -> f64 {
    let found_by_best = normal_tail(normal_quantile(SIGNIFICANCE) - length);
    let line = length + normal_quantile(POWER_KEPT * found_by_best);
    if found_by_best < LEAST_POWER { 0.0 } else { normal_tail(line).max(LEAST_OF_WAY) }
}

/// The means by cell under `other` for `emitted` photons, or, if their number is free, for as many
/// as leave as many counts as `cells` has.
pub(crate) fn means_like<E: Evidence>(
    evidence: &E,
    other: &Known<E::Signature>,
    cells: &Expected,
    emitted: f64,
    is_free: bool,
) -> Vec<f64> {
    let means = evidence.means(other, emitted);
    if !is_free {
        return means;
    }
    let [all, of_other] = [&cells.mean, &means].map(|means| means.iter().sum::<f64>());
    evidence.means(other, emitted * all / of_other.max(1.0))
}

/// The chance that the strangest of `counts` is as strange as it is.
fn smallest_tails(counts: &[f64], expected: &Expected) -> f64 {
    let tails = (0..counts.len())
        .map(|at| tails_of_count(counts[at], expected.mean[at], expected.variance(at)));
    corrected(tails.fold(1.0, f64::min), counts.len())
}

/// The count that is farthest from its expectation, in words.
fn farthest<E: Evidence>(
    counts: &[f64],
    expected: &Expected,
    name: impl Fn(usize) -> String,
) -> String {
    let (at, z) = expected.farthest(counts);
    difference(&name(at), counts[at], E::WORDS.unit, expected.mean[at], z)
}
