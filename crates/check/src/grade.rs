//! The grade of a checked submission, by the handout's rubric or a course's policy.

use grading::judge_list::Expectations;
use grading::submission::{Graded, Settings, Submission, grade_list, remark};
use grading::verdict::{Finding, Grade, Verdict, Weight};

use crate::report::{Builds, CheckReport};
use crate::sections::{self, Status};

/// The names of the checks besides the sections.
const BUILDS: &str = "builds";
const WHOLE: &str = "whole run";
const REMARK: &str = "remark";
/// The faults that nobody takes for the reference's picture.
const GRAVE: [&str; 2] = ["direct-stored", "wrong-position"];

/// The grade of `report`, with the photon list and what its statistics say where it stored any.
///
/// A section that is wrong makes a submission incorrect. Where all five are right and the whole run
/// is not the reference's, as with random numbers of its own, the statistics of its list decide.
pub fn grade(report: &CheckReport, settings: &Settings, expectations: &Expectations) -> Graded {
    let statistics = report.list.as_ref().filter(|_| !report.sections.is_empty()).map(|list| {
        let submission = Submission { name: report.submission.clone(), ..Submission::default() };
        grade_list(&submission, list.clone(), settings, expectations)
    });
    let mut findings = vec![builds(report)];
    findings.extend(report.sections.iter().flat_map(section));
    findings.extend(whole(report));
    let of_list = statistics.as_ref().map(|graded| &graded.grade);
    let has_fault = findings.iter().any(Finding::is_fault);
    let follows = report.whole.is_reference();
    let verdict = match (&report.builds, of_list) {
        (Builds::Yes, Some(of_list)) if of_list.verdict == Verdict::NoDots => Verdict::NoDots,
        (Builds::Yes, Some(_)) if has_fault => Verdict::Incorrect,
        (Builds::Yes, Some(_)) if follows => Verdict::Correct,
        (Builds::Yes, Some(of_list)) => of_list.verdict,
        (Builds::Yes, None) => Verdict::NoDots,
        _ => Verdict::Unreadable,
    };
    // What the sections and the exact comparison say is surer than statistics, which then only
    // repeat it.
    let decides = !has_fault && !follows;
    for finding in of_list.iter().flat_map(|grade| &grade.findings) {
        let is_exact = finding.check == "exact comparison";
        if decides && !is_exact {
            findings.push(finding.clone());
        }
    }
    findings.extend(report.remarks.iter().map(|text| remark(REMARK, "", text, "")));
    let faults = || report.sections.iter().flat_map(|verdict| &verdict.faults);
    let named = faults().find(|fault| fault.name.is_some());
    // What was seen to run needs no statistics.
    let by_list = of_list.filter(|_| decides && named.is_none());
    let misreading =
        named.and_then(|fault| fault.name).or_else(|| by_list.and_then(|grade| grade.misreading));
    let is_grave = |finding: &Finding| finding.is_fault() && finding.weight == Weight::Grave;
    // Where sections are wrong, they say more than the list.
    let is_plausible = match faults().next() {
        Some(_) => faults().all(|fault| !GRAVE.iter().any(|name| fault.name == Some(name))),
        None => !of_list.is_some_and(|grade| grade.findings.iter().any(is_grave)),
    };
    let right = || {
        let right = report.sections.iter().filter(|verdict| verdict.is_right());
        right.map(|verdict| verdict.section.title())
    };
    // With all sections right, the whole run decides.
    let is_partly_right = right().count() < report.sections.len();
    let of_sections = is_partly_right.then(|| settings.policy.of_sections(right())).flatten();
    let grade = Grade {
        submission: report.submission.clone(),
        emitted: Some(report.whole.photons),
        stored: report.whole.stored,
        score: of_sections
            .unwrap_or_else(|| settings.policy.score(verdict, misreading, is_plausible)),
        verdict,
        misreading,
        misreading_confidence: by_list.and_then(|grade| grade.misreading_confidence),
        misreading_title: named
            .map(|fault| fault.found.clone())
            .or_else(|| by_list.and_then(|grade| grade.misreading_title.clone())),
        findings,
        for_course: Vec::new(),
    };
    let list = statistics.and_then(|graded| graded.list);
    Graded { grade, list, try_again: false }
}

/// The findings of `grade` that come from the statistics of the list.
pub(crate) fn of_statistics(grade: &Grade) -> impl Iterator<Item = &Finding> {
    let own = [BUILDS, WHOLE, REMARK];
    grade.findings.iter().filter(move |finding| {
        !own.contains(&finding.check) && finding.section != Some(finding.check)
    })
}

fn builds(report: &CheckReport) -> Finding {
    let passed = report.builds == Builds::Yes;
    Finding {
        check: BUILDS,
        section: None,
        expected: "two C++ files that compile and run".to_owned(),
        found: report.builds.sentence(),
        p_value: None,
        passed,
        weight: Weight::Grave,
        advice: "".into(),
    }
}

/// A finding for each fault of a section; one for a section without.
fn section(verdict: &sections::SectionVerdict) -> Vec<Finding> {
    let title = verdict.section.title();
    let finding = |found: String, passed, weight, advice: &'static str| Finding {
        check: title,
        section: Some(title),
        expected: "what the handout asks for".to_owned(),
        found,
        p_value: None,
        passed,
        weight,
        advice: advice.into(),
    };
    let mut findings: Vec<_> = verdict
        .faults
        .iter()
        .map(|fault| finding(fault.in_words(), false, Weight::Fault, fault.advice))
        .collect();
    match verdict.status {
        Status::Right | Status::RightUnderAnotherReading => {
            findings.push(finding(verdict.in_words(), true, Weight::Fault, ""));
        }
        Status::NotReached => {
            let advice = "Mend what keeps this section from being reached.";
            findings.push(finding(verdict.in_words(), false, Weight::Remark, advice));
        }
        Status::Wrong => {}
    }
    let remarks = verdict.remarks.iter();
    findings.extend(remarks.map(|text| finding(text.clone(), false, Weight::Remark, "")));
    findings
}

fn whole(report: &CheckReport) -> Option<Finding> {
    if report.sections.is_empty() {
        return None;
    }
    let passed = report.whole.death.is_none() && report.whole.is_reference();
    // With right sections and numbers of its own, a run need not be the reference's.
    let weight = if report.whole.death.is_some() { Weight::Fault } else { Weight::Remark };
    Some(Finding {
        check: WHOLE,
        section: None,
        expected: "the reference's photons, or as many of them everywhere".to_owned(),
        found: report.whole.sentence(&report.sections),
        p_value: None,
        passed,
        weight,
        advice: "".into(),
    })
}
