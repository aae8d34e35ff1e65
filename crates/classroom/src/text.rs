//! A grade as people read it.

use std::borrow::Cow;
use std::path::Path;

use compare::numbers::thousands;
use grading::text::verdict_in_words;
use grading::verdict::{Finding, Grade, Verdict, Weight};

/// The last part of the path `name`: what a student or a course system called a submission.
pub fn last_part(name: &str) -> &str {
    Path::new(name).file_name().and_then(|part| part.to_str()).unwrap_or(name)
}

/// `grade`, of at most `best` points.
pub fn text(grade: &Grade, best: f64) -> String {
    let mut text = heading(grade, best);
    for note in &grade.for_course {
        text += &format!("  for the course: {note}\n");
    }
    let mut advised = "";
    for finding in &grade.findings {
        text += &line(finding);
        // The faults of one misreading share their advice.
        if !finding.passed && finding.advice != advised {
            text += &advice(finding);
            advised = &finding.advice;
        }
    }
    text
}

/// `name` in quotes, where it could be read as a grade: with a colon or what looks like one, a
/// comma, or spaces around it.
fn named(name: &str) -> Cow<'_, str> {
    let is_plain = |letter: char| letter.is_alphanumeric() || "/\\._-+~@()[] ".contains(letter);
    // Letters of other scripts may look like a colon.
    let is_clear = name.is_ascii() || !name.contains(' ');
    let has_edges = name.split(['/', '\\']).any(|part| part.trim() != part);
    match is_clear && name.chars().all(is_plain) && !has_edges {
        true => Cow::Borrowed(name),
        false => Cow::Owned(format!("{name:?}")),
    }
}

/// The verdict, and what it is about.
pub fn heading(grade: &Grade, best: f64) -> String {
    let verdict = verdict_in_words(grade.verdict);
    let name = named(&grade.submission);
    let mut text = format!("{name}: {verdict}, {} of {best} points\n", grade.score);
    if let Some(stored) = grade.stored {
        let emitted = match grade.emitted {
            Some(emitted) => format!("{} emitted", thousands(emitted)),
            None => {
                "how many were emitted is not known, so only their shares are judged".to_owned()
            }
        };
        text += &format!("  {} photons stored, {emitted}\n", thousands(stored));
    }
    if grade.wrong_sections().next().is_some() {
        // Sections that were run say more than the name of one of them.
        for wrong in grade.wrong_sections() {
            text += &format!("  {}: {}\n", wrong.check, wrong.found);
        }
    } else if let Some(misreading) = grade.misreading {
        let confidence = grade.misreading_confidence.unwrap_or_default();
        let title = grade.misreading_title.as_deref().unwrap_or_default();
        let sure = 100.0 * confidence;
        text += &format!("  misreading: {misreading} ({sure:.1} % sure): {title}\n");
        text += &format!("  to see it: photon-mapping explore --misreading {misreading}\n");
    } else if grade.verdict == Verdict::Incorrect {
        text += "  misreading: none of the known ones explains it alone\n";
    }
    text
}

/// `p_value` in words.
pub fn chance(p_value: f64) -> String {
    match p_value {
        p if p < 1e-300 => "p < 1e-300".to_owned(),
        p if p < 0.01 => format!("p = {p:.0e}"),
        p => format!("p = {p:.2}"),
    }
}

/// What one check found, and what to do about it.
pub fn finding(finding: &Finding) -> String {
    let advice = if finding.passed { String::new() } else { advice(finding) };
    line(finding) + &advice
}

fn line(finding: &Finding) -> String {
    let mark = match (finding.passed, finding.weight) {
        (true, _) => "ok    ",
        (false, Weight::Remark) => "remark",
        (false, _) => "FAULT ",
    };
    let chance =
        finding.p_value.map(|p_value| format!(", {}", chance(p_value))).unwrap_or_default();
    let mut line = format!("  {mark} {}: {}{chance}\n", finding.check, finding.found);
    if !finding.passed {
        line += &format!("         expected: {}\n", finding.expected);
    }
    line
}

fn advice(finding: &Finding) -> String {
    if finding.advice.is_empty() {
        return String::new();
    }
    let section = finding.section.map(|section| format!("[{section}] ")).unwrap_or_default();
    format!("         {section}{}\n", finding.advice)
}
