//! A grade as people read it.

use std::borrow::Cow;
use std::path::Path;

use compare::numbers::thousands;

use super::verdict::{Finding, Grade, Verdict, Weight};

/// `text` without what would move the cursor, end the line, hide or turn other letters round.
pub fn printable(text: &str) -> String {
    let is_odd = |letter: char| letter.is_control() || is_invisible(letter);
    text.chars().map(|letter| if is_odd(letter) { '\u{fffd}' } else { letter }).collect()
}

/// Whether `letter` has no shape of its own: it separates lines, has no width, sets the direction
/// of text, or is blank without being a space. Unicode's property Default_Ignorable_Code_Point, and
/// what else is like that.
pub fn is_invisible(letter: char) -> bool {
    matches!(
        letter,
        '\u{ad}'
            | '\u{34f}'
            | '\u{61c}'
            | '\u{115f}'..='\u{1160}'
            | '\u{17b4}'..='\u{17b5}'
            | '\u{180b}'..='\u{180f}'
            | '\u{200b}'..='\u{200f}'
            | '\u{2028}'..='\u{202e}'
            | '\u{2060}'..='\u{206f}'
            | '\u{2800}'
            | '\u{3164}'
            | '\u{fe00}'..='\u{fe0f}'
            | '\u{feff}'
            | '\u{ffa0}'
            | '\u{fff0}'..='\u{fffb}'
            | '\u{1bca0}'..='\u{1bca3}'
            | '\u{1d173}'..='\u{1d17a}'
            | '\u{e0000}'..='\u{e0fff}'
    )
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

/// `number`, rounded, as `1,234,567`.
pub fn rounded(number: f64) -> String {
    thousands(number.round() as u64)
}

/// The largest of several differences: `place` has `found` of `what`, `away` standard deviations
/// from what is expected.
pub fn difference(place: &str, found: f64, what: &str, expected: f64, away: f64) -> String {
    let side = if away < 0.0 { "fewer" } else { "more" };
    format!(
        "largest difference: {place} has {} {what}; expected {} ({:.1} standard deviations {side})",
        rounded(found),
        rounded(expected),
        away.abs()
    )
}

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
