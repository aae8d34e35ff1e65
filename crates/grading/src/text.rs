//! A grade as people read it.

use super::verdict::{Finding, Grade, Verdict, Weight};

/// `text` without what would move the cursor or end the line.
pub fn printable(text: &str) -> String {
    text.chars().map(|letter| if letter.is_control() { '\u{fffd}' } else { letter }).collect()
}

/// What `verdict` is called.
pub fn verdict_in_words(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Correct => "correct",
        Verdict::Undecided => "undecided, needs a look",
        Verdict::Incorrect => "incorrect",
        Verdict::NoDots => "no dots",
        Verdict::Unreadable => "unreadable",
    }
}

/// `grade`, of at most `best` points.
pub fn text(grade: &Grade, best: f64) -> String {
    let mut text = heading(grade, best);
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

/// The verdict, and what it is about.
pub fn heading(grade: &Grade, best: f64) -> String {
    let verdict = verdict_in_words(grade.verdict);
    let mut text = format!("{}: {verdict}, {} of {best} points\n", grade.submission, grade.score);
    if let Some(stored) = grade.stored {
        let emitted = match grade.emitted {
            Some(emitted) => format!("{emitted} emitted"),
            None => {
                "how many were emitted is not known, so only their shares are judged".to_owned()
            }
        };
        text += &format!("  {stored} photons stored, {emitted}\n");
    }
    if let Some(misreading) = grade.misreading {
        let confidence = grade.misreading_confidence.unwrap_or_default();
        let title = grade.misreading_title.as_deref().unwrap_or_default();
        let sure = 100.0 * confidence;
        text += &format!("  misreading: {misreading} ({sure:.1} % sure): {title}\n");
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
