//! A grade as people read it.

use super::verdict::{Finding, Grade, Verdict, Weight};

/// `grade`, of at most `best` points.
pub fn text(grade: &Grade, best: f64) -> String {
    let verdict = match grade.verdict {
        Verdict::Correct => "correct",
        Verdict::Incorrect => "incorrect",
        Verdict::NoDots => "no dots",
        Verdict::Unreadable => "unreadable",
    };
    let mut text = format!("{}: {verdict}, {} of {best} points\n", grade.submission, grade.score);
    if let Some(stored) = grade.stored {
        let emitted = match grade.emitted {
            Some(emitted) => format!("{emitted} sent out"),
            None => {
                "how many were sent out is not known, so only their shares are judged".to_owned()
            }
        };
        text += &format!("  {stored} photons stored, {emitted}\n");
    }
    if let Some(misreading) = grade.misreading {
        let confidence = grade.misreading_confidence.unwrap_or_default();
        text += &format!("  misreading: {misreading} ({:.1} % sure)\n", 100.0 * confidence);
    } else if grade.verdict == Verdict::Incorrect {
        text += "  misreading: none of the known ones explains it\n";
    }
    let mut advised = "";
    for finding in &grade.findings {
        text += &line(finding);
        // The faults of one misreading share their advice.
        if !finding.passed && !finding.advice.is_empty() && finding.advice != advised {
            let section = finding.section.map(|section| format!("[{section}] "));
            text += &format!("         {}{}\n", section.unwrap_or_default(), finding.advice);
            advised = &finding.advice;
        }
    }
    text
}

fn line(finding: &Finding) -> String {
    let mark = match (finding.passed, finding.weight) {
        (true, _) => "ok    ",
        (false, Weight::Remark) => "remark",
        (false, _) => "FAULT ",
    };
    let chance = match finding.p_value {
        Some(p_value) if p_value < 1e-300 => ", p < 1e-300".to_owned(),
        Some(p_value) if p_value < 0.01 => format!(", p = {p_value:.0e}"),
        Some(p_value) => format!(", p = {p_value:.2}"),
        None => String::new(),
    };
    let mut line = format!("  {mark} {}: {}{chance}\n", finding.check, finding.found);
    if !finding.passed {
        line += &format!("         expected: {}\n", finding.expected);
    }
    line
}
