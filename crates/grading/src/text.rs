//! Words that many findings share.

use compare::numbers::thousands;

use super::verdict::Verdict;

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
