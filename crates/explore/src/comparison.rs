//! Another list, laid over the run's: a submission, or what a misreading stores.

use std::collections::BTreeSet;

use compare::alignment::{Pairing, align, with_bounces};
use compare::explain::{Hit, explain, vector};
use compare::report::{Outcome, RandomNumbers, Report, compare, scene_size};
use glam::Vec3;
use photon_list::reader::PhotonList;
use photon_mapping::photon_list::PhotonRecord;
use serde_json::{Value, json};
use variants::run::Run;
use variants::section::Section;

use super::misreading::ShownMisreading;

/// How far apart two positions may be that count as one, as a part of the scene's longest edge: the
/// default of `compare`.
const TOLERANCE: f32 = 1e-4;

/// [`TOLERANCE`] in the scene of `run`, in world units.
pub(crate) fn tolerance(run: &Run) -> f32 {
    TOLERANCE * run.placement.length_to_world(scene_size(run.scene()))
}

/// A record closer than this to the hit before it, in world units, tells no direction.
const NEAREST: f32 = 0.01;

/// What the other list is.
#[derive(Clone, Debug)]
pub enum Other {
    /// A submission.
    Submission {
        /// The name of its file.
        name: String,
        /// The misreading that explains it.
        misreading: Option<ShownMisreading>,
    },
    /// What a misreading of the table stores.
    Misreading(ShownMisreading),
}

/// A list held against the run's.
#[derive(Debug)]
pub struct ListComparison {
    other: Other,
    report: Report,
    pub(crate) pairings: Vec<Pairing>,
    pub(crate) reference: PhotonList,
    pub(crate) submission: PhotonList,
    pub(crate) tolerance: f32,
    step: Option<PartingStep>,
}

/// The step of a photon at which the lists part.
#[derive(Debug)]
struct PartingStep {
    photon: u64,
    bounce: usize,
    name: &'static str,
    /// Label, the reference's value, the other list's.
    sides: Vec<[String; 3]>,
    /// Where the other list has its record, if it has one.
    other: Option<[f32; 3]>,
}

impl ListComparison {
    /// Compares `submission` with `reference`, the list of `run`.
    pub fn new(other: Other, reference: PhotonList, submission: PhotonList, run: &Run) -> Self {
        let tolerance = tolerance(run);
        let report = compare(&reference, &submission, Some(run), tolerance, 0.0);
        let reference = with_bounces(&reference).into_owned();
        let submission = with_bounces(&submission).into_owned();
        let mut pairings = align(&reference, &submission, tolerance);
        if report.random_numbers == RandomNumbers::Other {
            pairings = apart(&pairings);
        }
        let mut comparison =
            Self { other, report, pairings, reference, submission, tolerance, step: None };
        comparison.step = comparison.find_step(run);
        comparison
    }

    /// The name of the other list.
    pub fn name(&self) -> &str {
        match &self.other {
            Other::Submission { name, .. } => name,
            Other::Misreading(misreading) => misreading.id,
        }
    }

    /// What explains the difference, if it is a misreading of the table.
    fn misreading(&self) -> Option<&ShownMisreading> {
        match &self.other {
            Other::Submission { misreading, .. } => misreading.as_ref(),
            Other::Misreading(misreading) => Some(misreading),
        }
        .filter(|_| self.report.outcome == Outcome::Different)
    }

    /// The photon at which the lists part first.
    pub fn photon(&self) -> Option<u64> {
        self.step.as_ref().map(|step| step.photon)
    }

    /// The bounce, and the name of the step, at which they part.
    pub fn step(&self) -> Option<(usize, &'static str)> {
        self.step.as_ref().map(|step| (step.bounce, step.name))
    }

    /// The section to which the difference belongs: of a misreading it is known.
    pub fn section(&self) -> Option<Section> {
        let divergence = || self.report.first_divergence.as_ref()?.section;
        self.misreading().map_or_else(divergence, |misreading| Some(misreading.section))
    }

    /// The photons of the records that only the other list has.
    pub(crate) fn photons_of_extra(&self) -> BTreeSet<u64> {
        if !self.submission.columns.photon {
            return BTreeSet::new();
        }
        let photons = self.pairings.iter().filter_map(|pairing| match *pairing {
            Pairing::Extra(j) => Some(u64::from(self.submission.records[j].photon)),
            _ => None,
        });
        photons.collect()
    }

    fn find_step(&self, run: &Run) -> Option<PartingStep> {
        let divergence = self.report.first_divergence.as_ref()?;
        let photon = divergence.photon?;
        let story = explain(run, photon)?;
        let recorded = divergence.bounce.unwrap_or(1).min(story.hits.len());
        // What went wrong happened at the hit before the record.
        let before = recorded.saturating_sub(1);
        let starts_elsewhere =
            divergence.reason.as_ref().is_some_and(|reason| reason.contains("start"));
        let (bounce, name) = match self.section()? {
            Section::PhotonEmission => (0, "emission"),
            Section::PhotonStorage => (recorded.min(story.hits.len().saturating_sub(1)), "stored"),
            Section::PhotonScatteringAbsorption => (before, "roulette"),
            Section::HemisphereSampling => (before, "hemisphere"),
            Section::HemisphereRayTransformation if starts_elsewhere => (before, "ray"),
            Section::HemisphereRayTransformation => (before, "frame"),
        };
        let told = [&divergence.reference, &divergence.submission];
        let (reference, submission) = self.records_of(photon, recorded);
        // Before the photon has scattered, its records tell no direction.
        let has_scattered = !["emission", "stored"].contains(&name);
        let before = story.hits.get(before).filter(|_| recorded > 0 && has_scattered);
        let [ours, theirs] = told.map(String::clone);
        let mut sides = vec![[format!("bounce {recorded}"), ours, theirs]];
        // What was told already is not told again.
        let is_new = |row: &[String; 3]| row[1..].iter().zip(told).any(|(a, b)| !b.contains(a));
        sides.extend(values(before, reference, submission).into_iter().filter(is_new));
        let other = submission.map(|record| record.position).filter(|place| place.is_finite());
        Some(PartingStep {
            photon,
            bounce,
            name,
            sides,
            other: other.map(|place| place.to_array()),
        })
    }

    /// The records of bounce `bounce` of `photon` in both lists.
    fn records_of(
        &self,
        photon: u64,
        bounce: usize,
    ) -> (Option<&PhotonRecord>, Option<&PhotonRecord>) {
        let is_it = |record: &PhotonRecord| {
            u64::from(record.photon) == photon && usize::from(record.bounce) == bounce
        };
        let (reference, submission) = (&self.reference.records, &self.submission.records);
        let pairing = self.pairings.iter().find(|pairing| match **pairing {
            Pairing::Both(i, _) | Pairing::Missing(i) => is_it(&reference[i]),
            Pairing::Extra(j) => self.submission.columns.photon && is_it(&submission[j]),
        });
        match pairing.copied() {
            Some(Pairing::Both(i, j)) => (Some(&reference[i]), Some(&submission[j])),
            Some(Pairing::Missing(i)) => (Some(&reference[i]), None),
            Some(Pairing::Extra(j)) => (None, Some(&submission[j])),
            None => (None, None),
        }
    }

    /// What the page shows above the box.
    pub(crate) fn meta(&self, surfaces: usize) -> Value {
        let Report { outcome, differences, first_divergence, .. } = &self.report;
        let name = self.name();
        let numbers = match self.misreading() {
            Some(_) => RandomNumbers::Same,
            None => self.report.random_numbers,
        };
        let same = match outcome {
            Outcome::Identical => Some("identical"),
            Outcome::WithinTolerance => Some("the same within the tolerance"),
            Outcome::SameUnderAnotherReading => Some("the same under another fair reading"),
            Outcome::Different => None,
        };
        let divergence = first_divergence.as_ref();
        let found = divergence.and_then(|divergence| divergence.reason.as_deref());
        let is_certain = divergence.is_none_or(|divergence| divergence.certain);
        let doubt = if is_certain || self.misreading().is_some() { "" } else { " (perhaps)" };
        let verdict = match (same, self.section()) {
            (Some(same), _) => format!("{name}: {same}"),
            _ if numbers == RandomNumbers::Other => format!("{name}: other random numbers"),
            _ if numbers == RandomNumbers::PerhapsOther => {
                format!("{name}: other random numbers (perhaps)")
            }
            (None, Some(section)) => format!("{name}: {}{doubt}", section.title()),
            (None, None) => format!("{name}: different"),
        };
        let note = self.report.note.as_deref().map(sentence).unwrap_or_default();
        let kind = match &self.other {
            Other::Submission { .. } => "submission",
            Other::Misreading(_) => "misreading",
        };
        let (reason, advice) = match (self.misreading(), numbers.told()) {
            (_, Some([meaning, advice])) => (meaning.to_owned(), advice.to_owned()),
            (Some(ShownMisreading { id, title, advice, .. }), _) if kind == "submission" => {
                let reason = format!("{} This is the misreading {id}.", sentence(title));
                (reason, (*advice).to_owned())
            }
            (Some(ShownMisreading { title, advice, .. }), _) => {
                (sentence(title), (*advice).to_owned())
            }
            (None, None) => (found.map(sentence).unwrap_or_default(), note),
        };
        let outcome = match same {
            Some(_) => "same",
            None if numbers != RandomNumbers::Same => "unknown",
            None => "different",
        };
        json!({
            "kind": kind,
            "outcome": outcome,
            "verdict": verdict,
            "reason": reason,
            "advice": advice,
            "report": self.report.text(),
            "table": self.table(surfaces),
            "counts": (numbers != RandomNumbers::Other).then(|| json!({
                "matched": differences.matched, "missing": differences.missing,
                "moved": differences.moved, "extra": differences.extra,
            })),
            "photon": self.step.as_ref().map(|step| step.photon),
            "bounce": self.step.as_ref().map(|step| step.bounce),
            "step": self.step.as_ref().map(|step| step.name),
            "other": self.step.as_ref().and_then(|step| step.other),
            "sides": self.step.as_ref().map(|step| &step.sides),
        })
    }
}

/// `pairings` without the pairs: all that was paired is missing in one list and extra in the other.
fn apart(pairings: &[Pairing]) -> Vec<Pairing> {
    let parts = pairings.iter().flat_map(|pairing| match *pairing {
        Pairing::Both(i, j) => vec![Pairing::Missing(i), Pairing::Extra(j)],
        alone => vec![alone],
    });
    parts.collect()
}

/// Both lists' values of a record, with labels. `before` is the hit from which its photon came.
fn values(
    before: Option<&Hit>,
    reference: Option<&PhotonRecord>,
    submission: Option<&PhotonRecord>,
) -> Vec<[String; 3]> {
    let none = || "none".to_owned();
    let tell = |value: Option<Vec3>| value.map_or_else(none, |value| vector(&value.to_array()));
    let mut rows = Vec::new();
    // Where only one list has a record, what happens at this bounce tells its place.
    if let Some((a, b)) = reference.zip(submission) {
        let [a, b] = [a, b].map(|record| tell(Some(record.position)));
        rows.push(["position".to_owned(), a, b]);
    }
    // From a point as close as rounding, the way tells no direction.
    let way = before.zip(submission).map(|(before, other)| other.position - before.point());
    if let (Some(before), Some(way)) = (before, way.filter(|way| way.length() > NEAREST)) {
        let way = way.normalize();
        let normal = Vec3::from_array(before.normal);
        let angle = |way: Vec3| format!("{:.1}°", way.angle_between(normal).to_degrees());
        let expected = before.direction.map(Vec3::from_array);
        rows.push(["direction".to_owned(), tell(expected), tell(Some(way))]);
        rows.push(["angle to n".to_owned(), expected.map_or_else(none, angle), angle(way)]);
    }
    rows
}

/// `clause` with a capital and a full stop; symbols, as r and t, keep their case.
fn sentence(clause: &str) -> String {
    let mut letters = clause.chars();
    let is_word = clause.starts_with("a ") || clause.chars().take(2).all(char::is_alphabetic);
    let first: String = match letters.next() {
        Some(first) if is_word => first.to_uppercase().collect(),
        first => first.into_iter().collect(),
    };
    let stop = if clause.ends_with('.') { "" } else { "." };
    first + letters.as_str() + stop
}
