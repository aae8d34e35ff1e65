//! Grades for which nothing is judged, and remarks.

use super::limits::FEW_EMITTED;
use super::limits::submission::FEW_STORED;
use super::submission::{Because, Graded, Settings, Submission};
use super::text::printable;
use super::verdict::{Finding, Verdict, Weight};
use variants::section::Section;

/// The remark that `records` photons are too few to tell a fair reading from a misreading.
pub(super) fn too_few(records: u64) -> Finding {
    remark(
        "enough to tell",
        &format!("the photons of at least {FEW_EMITTED} emitted: about {FEW_STORED}"),
        &format!("{records} photons, too few to tell a correct program from others"),
        "Hand in the list of a run of 1,000,000 photons. If you meant to emit so few, grade with \
         --emitted.",
    )
}

/// A finding that costs nothing.
pub fn remark(check: &'static str, expected: &str, found: &str, advice: &'static str) -> Finding {
    Finding::new(check, expected, printable(found), advice)
}

/// The grade of a submission that is none, for `reason`.
pub fn unreadable(submission: &Submission, settings: &Settings, reason: &str) -> Graded {
    let because = Because { findings: vec![not_readable(reason)], ..Because::default() };
    because.graded(submission, settings, Verdict::Unreadable, None)
}

pub(super) fn not_readable(reason: &str) -> Finding {
    let expected = "a photon list (CSV or PLY, with the columns x, y and z), or a picture";
    let advice = "Hand in the list that photon_dump.hpp writes, or the PNG picture as the program \
                  wrote it.";
    remark("readable", expected, reason, advice).weighing(Weight::Grave)
}

/// The grade of a submission with what is `found`, where none may bounce and so none may be stored.
pub(super) fn without_bounces(
    submission: &Submission,
    settings: &Settings,
    stored: Option<u64>,
    found: &str,
    is_right: bool,
) -> Graded {
    let finding = Finding::new(
        "photons",
        "no photon: one is stored only after it has bounced",
        format!("{found}, where no photon may bounce"),
        "Insert a photon only where the size of 'path' is larger than 1, and trace no further than \
         the bounces that are left.",
    );
    let finding = finding.weighing(Weight::Grave).passed_if(is_right).of(Section::PhotonStorage);
    let verdict = if is_right { Verdict::Correct } else { Verdict::Incorrect };
    let because = Because { findings: vec![finding], ..Because::default() };
    because.graded(submission, settings, verdict, stored)
}

pub(super) fn no_photons(submission: &Submission, settings: &Settings) -> Graded {
    let finding = Finding::new(
        "photons",
        "photons that have bounced",
        "the list is empty",
        "Insert a photon where the size of 'path' is larger than 1; check that 'path' grows and \
         that TracePhoton calls itself.",
    );
    let finding = finding.weighing(Weight::Fault).of(Section::PhotonStorage);
    let because = Because { findings: vec![finding], ..Because::default() };
    because.graded(submission, settings, Verdict::NoDots, Some(0))
}
