//! The judgment of a photon list.

use std::borrow::Cow;
use std::sync::OnceLock;

use super::bounces::{BOUNCES_BY_PLACE, bounce_findings};
use super::direct::{is_ruled_out, shows_direct};
use super::evidence::Evidence as _;
use super::facts::{ENOUGH_PHOTONS, SPREAD, enough, plain_findings, remarks};
use super::few::StoredByPaths;
use super::limits::MOSTLY;
pub use super::limits::{RATE_OF_WAYS, SIGNIFICANCE};
use super::list::OfList;
use super::naming::Explanation;
use super::number::other_number;
use super::observation::Observation;
use super::picture::expectations::PictureExpectations;
use super::places::Places;
use super::recognized::not_recognized;
use super::signature::{Known, Signature, Signatures};
use super::trial::best_trial;
pub use super::trial::rate_to_find;
use super::verdict::Finding;
use variants::hypotheses::Hypothesis;

/// What the photons of a list say.
#[derive(Clone, Debug, PartialEq)]
pub struct Judgment {
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

/// All that lists are held against. What is made when it is first needed is made on one thread: one
/// of several that share it would grade another submission meanwhile, and wait for itself.
#[derive(Clone, Debug)]
pub struct Expectations {
    /// The scene's places.
    pub places: Places,
    /// The signatures of all hypotheses.
    pub signatures: Signatures,
    /// What pictures are held against: most classes hand in none.
    pictures: OnceLock<PictureExpectations>,
    /// What single paths of the fair readings store: most lists are too long for it.
    paths: OnceLock<Vec<StoredByPaths>>,
}

impl Expectations {
    /// For photons that may bounce as often as `signatures` says.
    pub fn new(places: Places, signatures: Signatures) -> Self {
        Self { places, signatures, pictures: OnceLock::new(), paths: OnceLock::new() }
    }

    /// What pictures are held against.
    pub fn pictures(&self) -> &PictureExpectations {
        let new = || PictureExpectations::new(&self.places, self.signatures.max_bounces);
        self.pictures.get_or_init(new)
    }

    /// What single paths store, by fair reading.
    pub(crate) fn paths(&self) -> &[StoredByPaths] {
        let Self { places, signatures, paths, .. } = self;
        let of_reading = |known: &Known<Signature>| {
            StoredByPaths::new(&known.hypothesis, places, signatures.max_bounces)
        };
        paths.get_or_init(|| signatures.fair.iter().map(of_reading).collect())
    }

    /// The reference's signature.
    pub(crate) fn reference(&self) -> &Signature {
        &self.signatures.fair[0].signature
    }

    /// The same with photons straight from the light.
    pub(crate) fn with_direct(&self) -> Option<&Signature> {
        let mut misreadings = self.signatures.misreadings.iter();
        let direct = misreadings.find(|known| known.hypothesis.id == "direct-stored")?;
        Some(&direct.signature)
    }
}

/// Judges `observation`, of a list with at least one finite position, where `emitted` photons were
/// emitted by the word of the user, or of the list itself.
pub fn judge(
    observation: &Observation,
    emitted: Option<f64>,
    emitted_by_user: bool,
    expectations: &Expectations,
) -> Judgment {
    let list = OfList { observation, emitted, expectations };
    let mut findings = plain_findings(observation, &expectations.places);
    let mut trial = best_trial(&list);
    let known = &expectations.signatures.fair[trial.reading];
    let mut of_bounces = bounce_findings(observation, emitted, &known.signature, expectations);
    // What is off by its positions is off by its bounces too.
    let is_other = |finding: &&Finding| finding.check != BOUNCES_BY_PLACE && finding.is_fault();
    let are_places_off = trial.p_value < SIGNIFICANCE;
    let is_off =
        are_places_off || findings.iter().chain(&of_bounces).any(|finding| is_other(&finding));
    let mut explained = is_off
        .then(|| list.explain_what_shows(are_places_off, findings.iter().chain(&of_bounces)))
        .flatten();
    // Of photons that mostly lie elsewhere, the others say nothing of the number.
    let is_told_by_places = observation.counts.on_surfaces() > MOSTLY * observation.records as f64;
    let by_intensity = emitted.filter(|_| !emitted_by_user && is_told_by_places);
    if let (Some(number), None, true) = (by_intensity, &explained, are_places_off)
        && let Some(other) = other_number(&list, number, trial.p_value)
    {
        findings.push(other.finding);
        trial = other.trial;
        explained = other.explained;
        if other.is_remark {
            of_bounces = bounce_findings(observation, None, &known.signature, expectations);
        }
    }
    let is_ruled_out =
        trial.p_value >= SIGNIFICANCE && is_ruled_out(observation, trial.emitted, expectations);
    let of_columns = remarks(observation, emitted.filter(|_| emitted_by_user), is_ruled_out);
    let is_told = of_columns.iter().chain(&findings).any(Finding::is_fault);
    if is_off && explained.is_none() && !is_told {
        findings.extend(shows_direct(observation, expectations));
    }
    let [explanation, pair] = Explanation::alone_or_pair(explained);
    if let Some(misreading) = explanation.as_ref().and_then(|it| it.hypothesis.misreading) {
        // What a name explains has that name's advice.
        let is_explained = |finding: &&mut Finding| {
            finding.is_fault() && ["finite", "footprints", "same place"].contains(&finding.check)
        };
        let explained = findings.iter_mut().filter(is_explained);
        explained.for_each(|finding| finding.advice = misreading.advice.into());
    }
    let Known { hypothesis: reading, signature } =
        expectations.signatures.fair[trial.reading].clone();
    let unexplained: Cow<'static, str> = match &pair {
        Some(pair) => pair.two_at_once().into(),
        None if findings.iter().any(Finding::is_fault) => ECHO.into(),
        None => OfList::WORDS.unexplained.into(),
    };
    findings.extend(trial.findings(&reading.title, explanation.as_ref(), &unexplained));
    // What is wrong elsewhere shows in the bounces too, and is no matter of how they are counted.
    let is_strange = findings.iter().any(Finding::is_fault);
    findings.push(enough(observation, emitted, trial.emitted, !is_strange));
    let is_strange = is_strange || findings.iter().any(Finding::is_fault);
    findings.extend(of_bounces.into_iter().filter(|finding| is_other(&finding) || !is_strange));
    findings.extend(of_columns);
    if findings.iter().any(|finding| finding.is_fault() && finding.check != ENOUGH_PHOTONS) {
        // Photons that are stored again and again say no more than one.
        let distinct = Observation { counts: observation.distinct.clone(), ..observation.clone() };
        let is_crowded = findings.iter().any(|it| it.is_fault() && it.check == SPREAD);
        let recognized = not_recognized(
            &OfList { observation: &distinct, ..list },
            is_crowded,
            explanation.is_some(),
        );
        findings.splice(..0, recognized);
    }
    Judgment { findings, explanation, pair, reading, signature, emitted: trial.emitted }
}

/// What is to be done where a plain fault is told before, and no misreading explains the counts.
const ECHO: &str = "No misreading is known for it: it may be an echo of the fault above.";
