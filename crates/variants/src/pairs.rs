//! Two misreadings at once. None of them is named: they are there so that a single one is not named for what two
//! have done, and so that the student hears of both.

use super::hypotheses::{Hypothesis, misreadings, to_the_letter};
use super::variation::{Roulette, Storage, Variation};
use crate::reading::{Reading, TangentBasis};
use crate::sampling::{Emission, Hemisphere};

/// The name of all pairs for programs.
pub const PAIR: &str = "two-at-once";

/// The misreadings that are seen most, of which one does not hide the other. Where photons scatter below the surface,
/// or always, little else shows.
const COMMON: [&str; 10] = [
    "direct-stored",
    "uniform-hemisphere",
    "no-square-root",
    "cube-directions",
    "no-absolute-value",
    "mean-roulette",
    "red-roulette",
    "smallest-roulette",
    "luminance-roulette",
    "transposed-frame",
];

/// Misreadings of one step that another one may join: the first way to each that is common.
pub fn can_be_of_two() -> Vec<Hypothesis> {
    let all = misreadings();
    let is_literal = |hypothesis: &Hypothesis| {
        hypothesis.variation.reading.tangent_basis == TangentBasis::LetterOfTheHandout
    };
    let first = |id| all.iter().find(|way| way.id == id && !is_literal(way)).cloned();
    COMMON.into_iter().filter_map(first).collect()
}

/// Pairs of misreadings that can be made together.
pub fn pairs() -> Vec<Hypothesis> {
    let singles = can_be_of_two();
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

/// `first` and `second` together, unless both change the same step.
fn both(first: Variation, second: Variation) -> Option<Variation> {
    Some(Variation {
        reading: one_of(first.reading, second.reading, Reading::REFERENCE)?,
        roulette: one_of(first.roulette, second.roulette, Roulette::Largest)?,
        hemisphere: one_of(first.hemisphere, second.hemisphere, Hemisphere::Cosine)?,
        emission: one_of(first.emission, second.emission, Emission::Sphere)?,
        storage: one_of(first.storage, second.storage, Storage::Indirect)?,
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
