//! The judgement of a photon list.

use std::borrow::Cow;
use std::sync::OnceLock;

use super::bounces::{BOUNCES_BY_PLACE, bounce_findings};
use super::direct::{is_ruled_out, shows_direct};
use super::facts::{enough, plain_findings, remarks};
use super::naming::{Explanation, Known, bounces_show, explain};
use super::number::{SLIPS, cannot_be, contradiction, impossible, slip_finding};
use super::observation::Observation;
use super::picture::expectations::PictureExpectations;
use super::places::Places;
use super::signature::{Signature, Signatures, classes};
use super::statistics::{Law, corrected, fit, grouped, normal_tails, tails_of_count, towards};
use super::test::Test;
use super::verdict::Finding;
use variants::hypotheses::{BOUNCE_OFF_BY_ONE, Hypothesis, fair_readings, misreadings};
use variants::pairs::pairs;

/// A submission that is as strange as this by chance alone is called incorrect. Of ten thousand
/// submissions that are correct, one may be; a tenth of that leaves room for what the tests assume.
pub const SIGNIFICANCE: f64 = 1e-5;
/// By which part of itself an expectation may be off for reasons that a course cannot fault: where
/// exactly a ray starts, and how far off the surface a position is stored. Of 4,000,000 photons sent out, an
/// offset of 1e-3 and positions 0.007 off moved 0.5 % of a facet's photons, or 1 % where they are few.
pub(super) const LEEWAY: f64 = 0.006;
/// The same for cells, of which a larger part lies along an edge.
const LEEWAY_OF_CELLS: f64 = 0.025;
/// Cells are joined until so many photons are expected in each: below, counts are too far from normal.
const LEAST_EXPECTED: f64 = 25.0;

/// What the photons of a list say.
#[derive(Clone, Debug, PartialEq)]
pub struct Judgement {
    /// The findings.
    pub findings: Vec<Finding>,
    /// The misreading, if a known one explains them.
    pub explanation: Option<Explanation>,
    /// Two misreadings that explain them together, if none does alone.
    pub pair: Option<Explanation>,
    /// The fair reading that fits best.
    pub reading: Hypothesis,
    /// That reading's signature.
    pub signature: Signature,
    /// How many photons were sent out: as known, or as it fits best.
    pub emitted: f64,
}

/// All that lists are held against.
#[derive(Clone, Debug)]
pub struct Expectations {
    /// The scene's places.
    pub places: Places,
    /// The signatures of all hypotheses.
    pub signatures: Signatures,
    fair: Vec<Hypothesis>,
    pub(super) misreadings: Vec<Hypothesis>,
    pairs: Vec<Hypothesis>,
    /// What pictures are held against: most classes hand in none.
    pictures: OnceLock<PictureExpectations>,
}

impl Expectations {
    /// For photons that may bounce as often as `signatures` says.
    pub fn new(places: Places, signatures: Signatures) -> Self {
        Self {
            places,
            signatures,
            fair: fair_readings(),
            misreadings: misreadings(),
            pairs: pairs(),
            pictures: OnceLock::new(),
        }
    }

    /// What pictures are held against.
    pub fn pictures(&self) -> &PictureExpectations {
        let new = || PictureExpectations::new(&self.places, self.signatures.max_bounces);
        self.pictures.get_or_init(new)
    }
}

/// A constant factor of the intensity with which the photons are less likely than this does not excuse them: a list
/// that lost as many photons by chance is as likely.
const LEAST_LIKELY_SLIP: f64 = 0.02;

/// Of the records, at least this part lies on surfaces where their number is held against the intensity.
const MOSTLY: f64 = 0.5;

/// The tests of a list against one fair reading.
struct Trial {
    reading: usize,
    tests: Vec<Test>,
    /// The smallest p-value, corrected for the number of tests.
    p_value: f64,
    emitted: f64,
}

/// Judges `observation`, of a list with at least one finite position, where `emitted` photons were sent
/// out by the word of the user, or of the list itself.
pub fn judge(
    observation: &Observation,
    emitted: Option<f64>,
    emitted_by_user: bool,
    expectations: &Expectations,
) -> Judgement {
    let places = &expectations.places;
    let known = Known {
        fair: &expectations.fair,
        misreadings: &expectations.misreadings,
        pairs: &expectations.pairs,
        signatures: &expectations.signatures,
    };
    let mut findings = plain_findings(observation, places);
    let mut trial = best_trial(observation, emitted, expectations);
    let signature = &expectations.signatures.fair[trial.reading];
    let mut of_bounces = bounce_findings(observation, emitted, signature, expectations);
    // What is off by its positions is off by its bounces too.
    let is_other = |finding: &&Finding| finding.check != BOUNCES_BY_PLACE && finding.is_fault();
    let is_off = trial.p_value < SIGNIFICANCE
        || findings.iter().chain(&of_bounces).any(|finding| is_other(&finding));
    let shows = |check: &str| {
        findings.iter().chain(&of_bounces).any(|fault| fault.is_fault() && fault.check == check)
    };
    // What else is wrong with a list speaks for no misreading, unless it comes of that one.
    let is_shown = |explanation: &Explanation| {
        trial.p_value < SIGNIFICANCE
            || match explanation.hypothesis.id {
                "nan-frame" => shows("finite"),
                "no-offset" => shows("same place"),
                BOUNCE_OFF_BY_ONE => shows("last bounce"),
                _ => false,
            }
    };
    let explained = is_off.then(|| explain(observation, emitted, places, known)).flatten();
    let (mut explanation, mut pair) = alone_or_pair(explained.filter(is_shown));
    // Of photons that mostly lie elsewhere, the others say nothing of the number.
    let is_told_by_places = observation.counts.on_surfaces() > MOSTLY * observation.records as f64;
    let by_intensity = emitted.filter(|_| !emitted_by_user && is_told_by_places);
    let is_explained = explanation.is_some() || pair.is_some();
    if let (Some(number), false, true) = (by_intensity, is_explained, trial.p_value < SIGNIFICANCE)
    {
        let slips = SLIPS.map(|slip| (slip, slip.emitted(number)));
        let trials = slips
            .map(|(slip, emitted)| (slip, best_trial(observation, Some(emitted), expectations)));
        let by_shape = best_trial(observation, None, expectations);
        let fitting = trials.into_iter().find(|(_, trial)| trial.p_value >= LEAST_LIKELY_SLIP);
        if let Some((slip, of_slip)) = fitting {
            findings.push(slip_finding(slip, number, trial.p_value));
            trial = of_slip;
            of_bounces = bounce_findings(observation, None, signature, expectations);
        } else if by_shape.p_value >= SIGNIFICANCE && cannot_be(number, observation.records as f64)
        {
            findings.push(impossible(number, by_shape.emitted, trial.p_value));
            trial = by_shape;
            of_bounces = bounce_findings(observation, None, signature, expectations);
        } else if by_shape.p_value >= SIGNIFICANCE {
            findings.push(contradiction(number, by_shape.emitted, trial.p_value));
            trial = by_shape;
        } else {
            let named = slips.into_iter().find_map(|(slip, emitted)| {
                Some((slip, explain(observation, Some(emitted), places, known)?))
            });
            if let Some((slip, misreading)) = named {
                findings.push(slip_finding(slip, number, trial.p_value));
                trial = best_trial(observation, Some(slip.emitted(number)), expectations);
                (explanation, pair) = alone_or_pair(Some(misreading));
            }
        }
    }
    let is_ruled_out =
        trial.p_value >= SIGNIFICANCE && is_ruled_out(observation, trial.emitted, expectations);
    let of_columns = remarks(observation, emitted.filter(|_| emitted_by_user), is_ruled_out);
    let is_told = of_columns.iter().chain(&findings).any(Finding::is_fault);
    if is_off && explanation.is_none() && pair.is_none() && !is_told {
        findings.extend(shows_direct(observation, expectations));
    }
    let shows_plainly = findings.iter().any(Finding::is_fault);
    let reading = expectations.fair[trial.reading].clone();
    let signature = expectations.signatures.fair[trial.reading].clone();
    findings.extend(trial.tests.iter().map(|test| {
        let expected = format!("{} ({})", expected_by(test.check), reading.title);
        let unexplained = match &pair {
            Some(pair) => two_at_once(&pair.hypothesis),
            None if shows_plainly => ECHO.into(),
            None => UNEXPLAINED.into(),
        };
        test.finding(trial.tests.len(), expected, explanation.as_ref(), unexplained)
    }));
    findings.push(enough(observation, emitted, trial.emitted));
    // What is wrong elsewhere shows in the bounces too, and is no matter of how they are counted.
    let is_strange = trial.p_value < SIGNIFICANCE || findings.iter().any(Finding::is_fault);
    findings.extend(of_bounces.into_iter().filter(|finding| is_other(&finding) || !is_strange));
    findings.extend(of_columns);
    Judgement { findings, explanation, pair, reading, signature, emitted: trial.emitted }
}

/// `explanation`, where it is one misreading, and where it is two at once.
pub(super) fn alone_or_pair(
    explanation: Option<Explanation>,
) -> (Option<Explanation>, Option<Explanation>) {
    match explanation {
        Some(pair) if pair.is_pair() => (None, Some(pair)),
        alone => (alone, None),
    }
}

/// What is to be done where `pair` explains what is seen, and no misreading alone does.
pub(super) fn two_at_once(pair: &Hypothesis) -> Cow<'static, str> {
    format!(
        "No known misreading explains it alone, but two together do: {}. Look at both.",
        pair.title
    )
    .into()
}

/// The fair reading under which `observation` is least strange. Where it is strange under all of them, what
/// was found is told beside the reference's numbers, which people know.
fn best_trial(
    observation: &Observation,
    emitted: Option<f64>,
    expectations: &Expectations,
) -> Trial {
    let signatures = expectations.signatures.fair.iter().enumerate();
    let mut trials = signatures.map(|(reading, signature)| {
        attempt(observation, emitted, reading, signature, expectations)
    });
    let reference = trials.next().expect("the reference is the first of the fair readings");
    if reference.p_value >= 0.01 {
        return reference;
    }
    let best = trials.max_by(|a, b| a.p_value.total_cmp(&b.p_value));
    match best {
        Some(best) if best.p_value >= SIGNIFICANCE && best.p_value > reference.p_value => best,
        Some(best) if best.p_value > reference.p_value => {
            let p_values = best.tests.iter().map(|test| test.p_value);
            let mut told = Trial { p_value: best.p_value, ..reference };
            told.tests.iter_mut().zip(p_values).for_each(|(test, p_value)| test.p_value = p_value);
            told
        }
        _ => reference,
    }
}

fn attempt(
    observation: &Observation,
    emitted: Option<f64>,
    reading: usize,
    signature: &Signature,
    expectations: &Expectations,
) -> Trial {
    let places = &expectations.places;
    let counts = classes(&observation.counts, places);
    let law = signature.law_of_classes(LEEWAY);
    // A footprint has a check of its own.
    let (law, counts) = without_last(&law, &counts);
    let size = emitted.unwrap_or_else(|| fit(&counts, &law, None).emitted);
    let mut tests = Vec::new();

    if let Some(emitted) = emitted {
        let whole = law.grouped(&vec![0; counts.len()], 1);
        let (expected, found) = (emitted * whole.mean[0], counts.iter().sum::<f64>());
        let deviation = whole.deviations(emitted)[0];
        tests.push(Test {
            check: "number",
            p_value: tails_of_count(found, expected, deviation.powi(2)),
            found: format!("{found:.0} photons where {expected:.0} are expected"),
        });
    }

    let (of_classes, count) = joined(&law.mean, size);
    let (joined_law, joined_counts) =
        (law.grouped(&of_classes, count), grouped(&counts, &of_classes, count));
    let of_facets = fit(&joined_counts, &joined_law, emitted);
    let has_facets = count > 1;
    tests.push(Test {
        check: "facets",
        p_value: if has_facets {
            // All together find what is spread over many facets, the farthest what is wrong with one.
            let all = of_facets.p_value;
            let one = smallest_tails(&joined_counts, &joined_law, size);
            corrected(all.min(one), 2)
        } else {
            1.0
        },
        found: if has_facets {
            farthest(&counts, &law, size, |class| places.class_name(class))
        } else {
            "too few photons to tell facets apart".to_owned()
        },
    });

    let of_cells = signature.law_of_cells(&expectations.signatures.correlation, LEEWAY_OF_CELLS);
    let groups = expectations.places.joined_cells(&of_cells.mean, size, LEAST_EXPECTED);
    let count = groups.iter().max().map_or(0, |last| last + 1);
    let law_of_groups = of_cells.grouped(&groups, count);
    let counts_of_groups = grouped(&observation.counts.cells, &groups, count);
    let has_cells = count > 1;
    let cells = &observation.counts.cells;
    tests.push(Test {
        check: "density",
        p_value: if has_cells {
            fit(&counts_of_groups, &law_of_groups, emitted).p_value
        } else {
            1.0
        },
        found: if has_cells {
            farthest(cells, &of_cells, size, |cell| places.cell_name(cell))
        } else {
            "too few photons to tell places apart".to_owned()
        },
    });

    let on_the_way = |is_wanted: fn(&Hypothesis) -> bool| {
        let hypotheses = expectations.misreadings.iter().zip(&expectations.signatures.misreadings);
        if !has_cells {
            return (0.0, 1.0);
        }
        let deviations: Vec<f64> = hypotheses
            .filter(|(hypothesis, _)| is_wanted(hypothesis))
            .map(|(_, other)| {
                let other = grouped(&other.cells, &groups, count);
                towards(&counts_of_groups, &law_of_groups, &other, emitted)
            })
            .collect();
        let farthest = deviations.iter().copied().fold(0.0, f64::max);
        // As many tests as there are misreadings, of one side each.
        (farthest, corrected(0.5 * normal_tails(farthest), deviations.len()))
    };
    let (farthest, p_value) = on_the_way(|hypothesis| hypothesis.id != BOUNCE_OFF_BY_ONE);
    tests.push(Test {
        check: "known misreadings",
        p_value,
        // Whose way it is says little: the one that explains all is named for the whole.
        found: format!("{farthest:.1} standard deviations on the way to one of them"),
    });
    if bounces_show(expectations.signatures.max_bounces) {
        // It shows so little that it needs a test of its own.
        let (farthest, p_value) = on_the_way(|hypothesis| hypothesis.id == BOUNCE_OFF_BY_ONE);
        let found = format!("{farthest:.1} standard deviations on the way to one bounce fewer");
        tests.push(Test { check: "number of bounces", p_value, found });
    }

    let smallest = tests.iter().map(|test| test.p_value).fold(1.0, f64::min);
    Trial {
        reading,
        p_value: corrected(smallest, tests.len()),
        tests,
        emitted: emitted.unwrap_or(of_facets.emitted),
    }
}

fn without_last(law: &Law, counts: &[f64]) -> (Law, Vec<f64>) {
    let last = counts.len() - 1;
    let covariance = law.covariance[..last].iter().map(|row| row[..last].to_vec()).collect();
    let law = Law {
        mean: law.mean[..last].to_vec(),
        leeway: law.leeway[..last].to_vec(),
        covariance,
        measured_with: law.measured_with,
    };
    (law, counts[..last].to_vec())
}

/// Groups in which at least [`LEAST_EXPECTED`] photons are expected: what has fewer is joined.
pub(super) fn joined(mean: &[f64], emitted: f64) -> (Vec<usize>, usize) {
    let mut groups = Vec::new();
    let mut count = 0;
    let mut small = None;
    for mean in mean {
        let is_small = emitted * mean < LEAST_EXPECTED;
        let group = match small {
            Some(group) if is_small => group,
            _ => {
                count += 1;
                count - 1
            }
        };
        if is_small {
            small = Some(group);
        }
        groups.push(group);
    }
    (groups, count)
}

/// The chance that the strangest of `counts` is as strange as it is.
fn smallest_tails(counts: &[f64], law: &Law, emitted: f64) -> f64 {
    let deviations = law.deviations(emitted);
    let tails = (0..counts.len())
        .map(|at| tails_of_count(counts[at], emitted * law.mean[at], deviations[at].powi(2)));
    corrected(tails.fold(1.0, f64::min), counts.len())
}

/// The count that is farthest from its expectation, in words.
fn farthest(counts: &[f64], law: &Law, emitted: f64, name: impl Fn(usize) -> String) -> String {
    let deviations = law.deviations(emitted);
    let z = |at: usize| (counts[at] - emitted * law.mean[at]) / deviations[at].max(1.0);
    let farthest = (0..counts.len()).max_by(|a, b| z(*a).abs().total_cmp(&z(*b).abs()));
    let at = farthest.unwrap_or_default();
    format!(
        "farthest off: {}, {:.0} photons where {:.0} are expected ({:+.1} standard deviations)",
        name(at),
        counts[at],
        emitted * law.mean[at],
        z(at)
    )
}

/// What is to be done where no misreading explains a list.
const UNEXPLAINED: &str = "None of the known misreadings explains it. Print a few photons and follow them by \
    hand; 'photon-mapping explain' tells one's whole story.";

/// The same where a plain fault is told before.
const ECHO: &str = "No misreading is known for it: it may be an echo of the fault above.";

fn expected_by(check: &str) -> &'static str {
    match check {
        "number" => "as many photons as the scene stores of those sent out",
        "facets" => "on every facet as many photons as the scene leaves there",
        "density" => "the scene's density over every facet",
        "number of bounces" => "photons of as many bounces as are allowed",
        _ => "no tendency towards a known misreading",
    }
}
