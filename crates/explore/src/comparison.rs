//! Another list, laid over the run's: a submission, or what a misreading stores.

use std::collections::BTreeSet;

use compare::alignment::{Pairing, align, with_bounces};
use compare::differences::Differences;
use compare::numbers::thousands;
use compare::report::{Outcome, RandomNumbers, Report, TOLERANCE, compare};
use photon_list::reader::PhotonList;
use serde_json::{Value, json};
use variants::run::Run;
use variants::section::Section;

use super::html::{escape, fill, prose};
use super::misreading::ShownMisreading;
use super::parting::PartingStep;
use super::step_link;

/// For lists of other random numbers, whose counts alone can be compared.
const SAME_NUMBER: &str = "If your program emitted another number of photons than this page, run \
                           explore again with --photons and that number. Else the table compares \
                           runs of different sizes.";
/// Up to so many differing dots are drawn large.
const MOST_LARGE: u64 = 2000;

const HEAD: &str = include_str!("../assets/comparison.html");

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
    pub(crate) report: Report,
    pub(crate) pairings: Vec<Pairing>,
    pub(crate) reference: PhotonList,
    pub(crate) submission: PhotonList,
    pub(crate) tolerance: f32,
    pub(crate) step: Option<PartingStep>,
}

impl ListComparison {
    /// Compares `submission` with `reference`, the list of `run`.
    pub fn new(other: Other, reference: PhotonList, submission: PhotonList, run: &Run) -> Self {
        let tolerance = TOLERANCE * run.size();
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

    /// The photon, the bounce and the step at which the lists part first.
    pub(crate) fn parting(&self) -> Option<(u64, usize, &'static str)> {
        self.step.as_ref().map(|step| (step.photon, step.bounce, step.name))
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

    /// What the list is.
    pub(crate) fn kind(&self) -> &'static str {
        match &self.other {
            Other::Submission { .. } => "submission",
            Other::Misreading(_) => "misreading",
        }
    }

    /// Whether the lists come from the same random numbers: under a misreading they do.
    fn random_numbers(&self) -> RandomNumbers {
        match self.misreading() {
            Some(_) => RandomNumbers::Same,
            None => self.report.random_numbers,
        }
    }

    /// What the page shows above the box.
    pub(crate) fn head(&self) -> String {
        let Report { outcome, first_divergence, .. } = &self.report;
        let (name, kind, numbers) = (self.name(), self.kind(), self.random_numbers());
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
        let (reason, advice) = match (self.misreading(), numbers.told()) {
            (_, Some([meaning, advice])) => {
                let advice = format!("{advice} {SAME_NUMBER}");
                (meaning.to_owned(), advice)
            }
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
        let link = self.parting().map(step_link).unwrap_or_default();
        let hidden = if link.is_empty() { "hidden" } else { "" };
        let parts = [
            ("outcome", outcome.to_owned()),
            ("verdict", prose(&verdict)),
            ("reason", prose(&reason)),
            ("advice", prose(&advice)),
            ("link", escape(&link)),
            ("hidden", hidden.to_owned()),
            ("report", prose(&self.report.text())),
        ];
        fill(HEAD, &parts)
    }

    /// What the script reads.
    pub(crate) fn meta(&self) -> Value {
        let Differences { matched, missing, moved, extra, .. } = self.report.differences;
        let is_counted = self.random_numbers() != RandomNumbers::Other;
        let kinds = ["matched", "missing", "moved", "extra"];
        let legend = if is_counted {
            let counts = kinds.iter().zip([matched, missing, moved, extra]);
            counts.map(|(kind, count)| format!("{} {kind}", thousands(count))).collect()
        } else {
            // Nothing is paired: each dot is of one of the two lists.
            ["matched", "reference", "moved", "submission"].map(str::to_owned).to_vec()
        };
        json!({
            "legend": legend,
            "areFew": is_counted && missing + moved + extra <= MOST_LARGE,
            "other": self.step.as_ref().and_then(|step| step.other),
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
