//! Two misreadings at once. None of them is named: they are there so that a single one is not named
//! for what two have done, and so that the student hears of both.

use super::hypotheses::{Hypothesis, misreadings, to_the_letter};
use super::variation::{Roulette, Storage, Variation};
use crate::reading::{Reading, TangentBasis};
use crate::sampling::{Emission, Hemisphere};

/// The name of all pairs for programs.
pub const PAIR: &str = "two-at-once";

/// The misreadings that are seen most, of which one does not hide the other. Where photons scatter
/// below the surface, or always, little else shows.
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

/// The name of all roulettes that have none, for programs.
pub const OTHER_ROULETTE: &str = "other-roulette";

/// Roulettes that are no misreading of the table: a grid of the chances of the scene's two diffuse
/// responses. They are there so that no roulette is named for one that only resembles it.
fn other_roulettes() -> Vec<Hypothesis> {
    let mut all = Vec::new();
    for bright in 3..=10_u8 {
        for dark in (0..10_u8).filter(|dark| *dark != bright) {
            let chances = [bright, dark].map(|tenths| f32::from(tenths) / 10.0);
            all.push(Hypothesis {
                id: OTHER_ROULETTE,
                title: format!(
                    "photons survive with {} or {}, by material",
                    chances[0], chances[1]
                ),
                misreading: None,
                variation: Variation {
                    roulette: Roulette::ByMaterial(chances),
                    ..Variation::default()
                },
            });
        }
    }
    all
}

/// All that no name of the table tells: two misreadings at once, and other roulettes.
pub fn unnamed() -> Vec<Hypothesis> {
    [pairs(), other_roulettes()].concat()
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
            let is_normalized = variation.reading == Reading::REFERENCE;
            let literal = is_normalized.then(|| to_the_letter(&pair));
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
