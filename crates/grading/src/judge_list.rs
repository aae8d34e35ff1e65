//! The judgement of a photon list.

use std::borrow::Cow;
use std::sync::OnceLock;

use super::bounces::{BOUNCES_BY_PLACE, bounce_findings};
use super::direct::{is_ruled_out, shows_direct};
use super::facts::{enough, plain_findings, remarks};
use super::naming::{Explanation, explain};
use super::number::{SLIPS, cannot_be, contradiction, impossible, slip_finding};
use super::observation::Observation;
use super::picture::expectations::PictureExpectations;
use super::places::Places;
use super::signature::{Signature, Signatures};
use super::trial::best_trial;
use super::verdict::Finding;
use variants::hypotheses::{BOUNCE_OFF_BY_ONE, Hypothesis, fair_readings, misreadings};
use variants::pairs::unnamed;

/// A submission that is as strange as this by chance alone is called incorrect. Of ten thousand
/// submissions that are correct, one may be; a tenth of that leaves room for what the tests assume.
pub const SIGNIFICANCE: f64 = 1e-5;
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
    /// How many photons were emitted: as known, or as it fits best.
    pub emitted: f64,
}

/// All that lists are held against.
#[derive(Clone, Debug)]
pub struct Expectations {
    /// The scene's places.
    pub places: Places,
    /// The signatures of all hypotheses.
    pub signatures: Signatures,
    pub(super) fair: Vec<Hypothesis>,
    pub(super) misreadings: Vec<Hypothesis>,
    pub(super) pairs: Vec<Hypothesis>,
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
            pairs: unnamed(),
            pictures: OnceLock::new(),
        }
    }

    /// What pictures are held against.
    pub fn pictures(&self) -> &PictureExpectations {
        let new = || PictureExpectations::new(&self.places, self.signatures.max_bounces);
        self.pictures.get_or_init(new)
    }
}

/// A constant factor of the intensity with which the photons are less likely than this does not
/// excuse them: a list that lost as many photons by chance is as likely.
const LEAST_LIKELY_SLIP: f64 = 0.02;

/// Of the records, at least this part lies on surfaces where their number is held against the
/// intensity.
const MOSTLY: f64 = 0.5;

/// Judges `observation`, of a list with at least one finite position, where `emitted` photons were
/// emitted by the word of the user, or of the list itself.
pub fn judge(
    observation: &Observation,
    emitted: Option<f64>,
    emitted_by_user: bool,
    expectations: &Expectations,
) -> Judgement {
    let places = &expectations.places;
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
                "no-offset" | "repeated-paths" | "stored-twice" => shows("same place"),
                BOUNCE_OFF_BY_ONE => shows("last bounce"),
                _ => false,
            }
    };
    let explained = is_off.then(|| explain(observation, emitted, expectations)).flatten();
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
                Some((slip, explain(observation, Some(emitted), expectations)?))
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
    if let Some(misreading) = explanation.as_ref().and_then(|it| it.hypothesis.misreading) {
        // What a name explains has that name's advice.
        let is_explained = |finding: &&mut Finding| {
            finding.is_fault() && ["finite", "footprints", "same place"].contains(&finding.check)
        };
        findings
            .iter_mut()
            .filter(is_explained)
            .for_each(|finding| finding.advice = misreading.advice.into());
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
        test.finding(expected, explanation.as_ref(), unexplained)
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

/// What is to be done where no misreading explains a list.
const UNEXPLAINED: &str = "None of the known misreadings explains it. Print a few photons and \
                           follow them by hand; 'photon-mapping explain' tells one's whole story.";

/// The same where a plain fault is told before.
const ECHO: &str = "No misreading is known for it: it may be an echo of the fault above.";

fn expected_by(check: &str) -> &'static str {
    match check {
        "number" => "as many photons as the scene stores of those emitted",
        "facets" => "on every facet as many photons as the scene leaves there",
        "density" => "the scene's density over every facet",
        "number of bounces" => "photons of as many bounces as are allowed",
        _ => "no tendency towards a known misreading",
    }
}
