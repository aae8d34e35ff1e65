//! Two misreadings at once. None of them is named: they are there so that a single one is not named for what two
//! have done, and so that the student hears of both.

use super::hypotheses::{BOUNCE_OFF_BY_ONE, Hypothesis, misreadings, to_the_letter};
use super::variation::{Hemisphere, Roulette, Variation};
use crate::reading::{Reading, TangentBasis};

/// The name of all pairs for programs.
pub const PAIR: &str = "two-at-once";

/// Pairs of misreadings that can be made together, and of which one does not hide the other. Where photons scatter
/// below the surface, or always, little else shows.
pub fn pairs() -> Vec<Hypothesis> {
    let singles: Vec<Hypothesis> = misreadings().into_iter().filter(can_be_of_two).collect();
    let mut pairs = Vec::new();
    for (at, first) in singles.iter().enumerate() {
        for second in &singles[at + 1..] {
            let Some(variation) = both(first.variation, second.variation) else { continue };
            let title = format!("{}; and {}", first.title, second.title);
            let pair = Hypothesis { id: PAIR, title, misreading: None, variation };
            let is_normalised = variation.reading == Reading::REFERENCE;
            let literal = is_normalised.then(|| to_the_letter(&pair));
            pairs.push(pair);
            pairs.extend(literal);
        }
    }
    pairs
}

/// Whether `hypothesis` is a misreading of one step that another one may join.
pub fn can_be_of_two(hypothesis: &Hypothesis) -> bool {
    let is_wide = matches!(hypothesis.variation.roulette, Roulette::Constant(_));
    let is_literal = hypothesis.variation.reading.tangent_basis == TangentBasis::LetterOfTheHandout;
    let hides = ["nan-frame", "flipped-normal", BOUNCE_OFF_BY_ONE].contains(&hypothesis.id);
    !is_wide && !is_literal && !hides
}

/// `first` and `second` together, unless both change the same step.
fn both(first: Variation, second: Variation) -> Option<Variation> {
    Some(Variation {
        reading: one_of(first.reading, second.reading, Reading::REFERENCE)?,
        roulette: one_of(first.roulette, second.roulette, Roulette::Largest)?,
        hemisphere: one_of(first.hemisphere, second.hemisphere, Hemisphere::Cosine)?,
        cube_directions: first.cube_directions || second.cube_directions,
        direct_stored: first.direct_stored || second.direct_stored,
        zero_frame: first.zero_frame || second.zero_frame,
        ..Variation::default()
    })
}

/// Which of `first` and `second` is not `plain`; nothing where neither is.
fn one_of<T: PartialEq>(first: T, second: T, plain: T) -> Option<T> {
    match (first == plain, second == plain) {
        (false, false) => None,
        (false, true) => Some(first),
        (true, _) => Some(second),
    }
}
