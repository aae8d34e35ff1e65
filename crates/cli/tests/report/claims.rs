//! Every number of a section of the page, held against what the data say.

use super::data::REPORT;

/// A number of the page, as it follows from the data.
#[derive(Clone, Copy, Debug)]
pub enum Number {
    /// Right to the last digit printed.
    Exact(f64),
    /// With three digits that count, should it have more before the point.
    Rounded(f64),
}

pub use Number::{Exact, Rounded};

/// The numbers of the one line of a section that has `part`.
pub struct Claim {
    pub part: String,
    pub numbers: Vec<Number>,
}

pub fn claim(part: impl Into<String>, numbers: impl IntoIterator<Item = Number>) -> Claim {
    Claim { part: part.into(), numbers: numbers.into_iter().collect() }
}

/// A claim of numbers that only the text has.
pub fn fixed(part: &str, numbers: &[f64]) -> Claim {
    claim(part, numbers.iter().copied().map(Exact))
}

/// Asserts that each line of section `number` that has a number belongs to one of `claims`, that
/// each claim has its line, and that the numbers are those.
pub fn assert_section(number: usize, claims: &[Claim]) {
    let page = &REPORT["report.md"];
    let section = page.split("\n## ").nth(number).unwrap();
    let lines: Vec<_> = section
        .lines()
        .filter(|line| !line.starts_with("![") && !numbers(line).is_empty())
        .collect();
    for line in &lines {
        let fitting: Vec<_> = claims.iter().filter(|claim| line.contains(&claim.part)).collect();
        let [claim] = fitting[..] else {
            panic!("{} claims speak of the line:\n{line}", fitting.len());
        };
        let found = numbers(line);
        assert_eq!(
            found.len(),
            claim.numbers.len(),
            "{:?}, but the page has\n{line}",
            claim.numbers
        );
        for (text, known) in found.iter().zip(&claim.numbers) {
            assert!(agrees(text, *known), "{text} is not {known:?} in\n{line}");
        }
    }
    for claim in claims {
        let fitting = lines.iter().filter(|line| line.contains(&claim.part)).count();
        assert_eq!(fitting, 1, "lines with '{}'", claim.part);
    }
}

/// The numbers of a line; digits within words, as in f32, are none.
fn numbers(line: &str) -> Vec<String> {
    let characters: Vec<char> = line.chars().collect();
    let at = |place: usize| characters.get(place).copied().unwrap_or(' ');
    let mut found = Vec::new();
    let mut place = 0;
    while place < characters.len() {
        let is_signed = "+-".contains(at(place)) && at(place + 1).is_ascii_digit();
        if !at(place).is_ascii_digit() && !is_signed {
            place += 1;
            continue;
        }
        let start = place;
        place += 1;
        while at(place).is_ascii_digit()
            || at(place) == '.' && at(place + 1).is_ascii_digit()
            || at(place) == 'e' && (at(place + 1).is_ascii_digit() || at(place + 1) == '-')
            || at(place) == '-' && at(place - 1) == 'e'
        {
            place += 1;
        }
        if start == 0 || !at(start - 1).is_alphanumeric() {
            found.push(characters[start..place].iter().collect());
        }
    }
    found
}

fn agrees(text: &str, known: Number) -> bool {
    let value: f64 = text.parse().unwrap_or_else(|_| panic!("'{text}' is no number"));
    let (digits, exponent) = text.split_once('e').unwrap_or((text, "0"));
    let decimals = digits.split_once('.').map_or(0, |(_, decimals)| decimals.len() as i32);
    let mut power = exponent.parse::<i32>().unwrap() - decimals;
    let known = match known {
        Exact(known) => known,
        Rounded(known) => {
            let before_the_point = digits.split('.').next().unwrap().trim_start_matches(['+', '-']);
            if decimals == 0 {
                power += before_the_point.len().saturating_sub(3) as i32;
            }
            known
        }
    };
    // Half a unit of the last digit, and what the ten digits of the data leave open.
    (value - known).abs() <= 0.502 * 10_f64.powi(power)
}

#[test]
fn numbers_are_found_and_held_to_their_digits() {
    assert_eq!(
        numbers("f32: -0.5 (1e-9 to 2^32), | 12 | -> N4 +- 3"),
        ["-0.5", "1e-9", "2", "32", "12", "3"]
    );
    assert!(agrees("1.23", Exact(1.2349)) && !agrees("1.23", Exact(1.2361)));
    assert!(agrees("253000", Rounded(252_962.0)) && !agrees("253000", Exact(252_962.0)));
    assert!(agrees("4e-3", Exact(0.0039)) && !agrees("4e-3", Exact(0.0046)));
}
