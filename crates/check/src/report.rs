//! What is said about one submission.

use compare::differences::Differences;
use compare::numbers::thousands;
use compare::report::{Outcome, RandomNumbers};
use photon_list::reader::PhotonList;
use serde::Serialize;
use variants::section::Section;

use crate::diagnostics::BuildError;
use crate::find::CppSubmission;
use crate::sections::SectionVerdict;

/// Whether the submission builds.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case", tag = "status")]
pub enum Builds {
    /// It does.
    Yes,
    /// A file was not handed in.
    MissingFile {
        /// Which.
        file: &'static str,
    },
    /// It does not.
    No(BuildError),
    /// It does, but ends before any function of the assignment is called.
    EndsAtOnce {
        /// What happens.
        what: String,
    },
}

/// The whole run on the handout's scene.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Whole {
    /// How many photons were to be emitted.
    pub photons: u64,
    /// How many were stored, if the run ended.
    pub stored: Option<u64>,
    /// How many random numbers were drawn from `rand()` and its like.
    pub drawn: Option<u64>,
    /// How the run died.
    pub death: Option<String>,
    /// How its list compares with the reference's.
    pub comparison: Option<compare::report::Report>,
}

impl Whole {
    /// Whether its photons are the reference's, under one of the fair readings.
    pub fn is_reference(&self) -> bool {
        self.death.is_none()
            && self.comparison.as_ref().is_some_and(|report| report.outcome != Outcome::Different)
    }

    /// Whether it draws the reference's numbers: from `rand()` and its like, and as often.
    fn draws_nothing(&self) -> bool {
        self.drawn.is_some_and(|drawn| drawn < self.photons)
    }

    /// How the run went, in one line, beside what `sections` say. Where all of them are right, a
    /// list that is not the reference's comes of other random numbers.
    pub fn sentence(&self, sections: &[SectionVerdict]) -> String {
        if let Some(death) = &self.death {
            return death.clone();
        }
        let (Some(report), Some(stored)) = (&self.comparison, self.stored) else {
            return "not reached".to_owned();
        };
        if stored == 0 {
            let expected = thousands(report.reference_records);
            return format!("nothing is stored; the reference stores {expected} photons");
        }
        let records = thousands(stored);
        match report.outcome {
            Outcome::Identical => format!("identical in {records} records"),
            Outcome::WithinTolerance => {
                format!(
                    "the reference's photons, {} of {records} records",
                    thousands(report.differences.matched)
                )
            }
            Outcome::SameUnderAnotherReading => format!(
                "the reference's photons under another fair reading: {}",
                report.reading.as_deref().unwrap_or_default()
            ),
            Outcome::Different if self.draws_nothing() => format!(
                "random numbers of its own (not from rand()), so that only statistics can tell; \
                 {records} photons stored"
            ),
            Outcome::Different if are_right(sections) => format!(
                "other photons than the reference's (numbers drawn or used in another way), so \
                 that only statistics can tell; {records} photons stored"
            ),
            Outcome::Different => self.divergence(report, sections),
        }
    }

    /// What shows that the roulette of some hit is wrong, though that of the probes is right: the
    /// reference's numbers are drawn, as most records are the same, and yet a photon that was where
    /// the reference has it decides otherwise. A run that uses its numbers in another way has
    /// hardly a record in common beyond the first bounce: a third of all. If it does so at late
    /// hits alone, it loses as many photons as it wins; a wrong chance mostly loses or mostly wins.
    pub(crate) fn late_roulette(&self) -> Option<String> {
        const STILL_THE_SAME: f64 = 0.2;
        let report = self.comparison.as_ref().filter(|_| self.death.is_none())?;
        let Differences { missing, extra, moved, .. } = report.differences;
        let differing = report.reading_left.unwrap_or(missing + extra + moved);
        let first = report.first_divergence.as_ref().filter(|first| {
            first.certain && first.section == Some(Section::PhotonScatteringAbsorption)
        })?;
        let shares_numbers = report.random_numbers == RandomNumbers::Same
            && differing as f64 <= STILL_THE_SAME * report.reference_records as f64
            && 2 * report.submission_records.abs_diff(report.reference_records) >= differing;
        let (photon, reason) = (first.photon?, first.reason.as_ref()?);
        shares_numbers.then(|| {
            format!(
                "in the whole run, {} records are not the reference's; photon {photon} is the \
                 first: {reason}",
                thousands(differing)
            )
        })
    }

    fn divergence(&self, report: &compare::report::Report, sections: &[SectionVerdict]) -> String {
        let Some(first) = &report.first_divergence else {
            return "not the reference's photons".to_owned();
        };
        // A photon that is not stored looks like one that was absorbed. The sections know better.
        let section = first.section.filter(|section| {
            sections.iter().any(|verdict| verdict.section == *section && !verdict.is_right())
        });
        let what = match (section, &first.reason) {
            (Some(section), Some(reason)) => format!(": [{}] {reason}", section.title()),
            (Some(section), None) => format!(": [{}]", section.title()),
            (None, _) => String::new(),
        };
        let explain = |photon| {
            format!(
                "; what should have happened: photon-mapping explain {photon} --seed 148 --photons \
                 {}",
                self.photons
            )
        };
        // The photon that shows it is the one to look at.
        let shown = what.split_once("as photon ").and_then(|(_, rest)| rest.split_once(" shows"));
        let shown = shown.and_then(|(number, _)| number.replace(',', "").parse().ok());
        let photon = shown.or(first.photon).map(explain).unwrap_or_default();
        format!("it differs from the reference{what}{photon}")
    }
}

/// Whether there are sections, and all are right.
pub(crate) fn are_right(sections: &[SectionVerdict]) -> bool {
    !sections.is_empty() && sections.iter().all(SectionVerdict::is_right)
}

impl Builds {
    /// Whether it builds, in one line.
    pub fn sentence(&self) -> String {
        match self {
            Self::Yes => "yes".to_owned(),
            Self::MissingFile { file } => format!("no, there is no file {file}"),
            Self::EndsAtOnce { what } => format!(
                "yes, but the program {what} before any function of the assignment is called: look \
                 at static variables and their constructors"
            ),
            Self::No(error) => format!("no: {}", error.sentence()),
        }
    }
}

/// The report on one submission.
#[derive(Clone, Debug, Serialize)]
pub struct CheckReport {
    /// Its name.
    pub submission: String,
    /// Whether it builds.
    pub builds: Builds,
    /// The sections, in the handout's order; none where it does not build.
    pub sections: Vec<SectionVerdict>,
    /// The whole run.
    pub whole: Whole,
    /// What is worth saying about the whole submission.
    pub remarks: Vec<String>,
    /// Seconds for compiling and running.
    pub seconds: [f64; 2],
    /// The photon list of the whole run.
    #[serde(skip)]
    pub list: Option<PhotonList>,
}

impl CheckReport {
    /// On a submission of which nothing is known yet, with so many photons in the whole run.
    pub(crate) fn new(submission: &CppSubmission, photons: u64) -> Self {
        Self {
            submission: submission.name.clone(),
            builds: Builds::Yes,
            sections: Vec::new(),
            whole: Whole { photons, ..Whole::default() },
            remarks: submission.notes.clone(),
            seconds: [0.0; 2],
            list: None,
        }
    }
}
