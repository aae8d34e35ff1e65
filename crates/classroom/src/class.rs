//! The grades of a whole class, where no submission stops the others.

use std::panic::{AssertUnwindSafe, catch_unwind};

use super::intake::HandedIn;
use grading::submission::{Graded, Settings, Submission, remark, unreadable};
use grading::text::printable;
use grading::verdict::SAME_FILES;

/// The grade of `handed_in`, by `grade` unless its files say before that there is nothing to grade.
/// A fault of the grader is no fault of the student, but the grade must say what happened. None if
/// `grade` gives none.
pub fn grade_one(
    handed_in: &HandedIn,
    settings: &Settings,
    grade: impl Fn(&Submission) -> Option<Graded>,
) -> Option<Graded> {
    let submission = &handed_in.submission;
    if let Some(problem) = &handed_in.problem {
        let graded = unreadable(submission, settings, problem);
        return Some(Graded { try_again: handed_in.try_again, ..graded });
    }
    let graded = catch_unwind(AssertUnwindSafe(|| grade(submission)));
    let mut graded = graded.unwrap_or_else(|panic| {
        let words = panic.downcast_ref::<String>().map(String::as_str);
        let words = words.or(panic.downcast_ref::<&str>().copied()).unwrap_or("no reason given");
        let reason = printable(words);
        let reason = format!("the grader itself failed, please grade by hand and report: {reason}");
        Some(unreadable(submission, settings, &reason))
    })?;
    let notes = handed_in
        .notes
        .iter()
        .map(|note| remark("files", "one photon list, one picture, or both", note, ""));
    let twins = handed_in
        .twins
        .iter()
        .map(|note| remark(SAME_FILES, "files of the student's own", note, ""));
    graded.grade.findings.extend(notes.chain(twins));
    Some(graded)
}
