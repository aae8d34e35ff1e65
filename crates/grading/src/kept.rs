//! Signatures as they are kept: each under what its hypothesis is called, [`Hypothesis::key`].

use std::collections::BTreeMap;

use variants::hypotheses::{BOUNCE_OFF_BY_ONE, FAIR, Hypothesis};
use variants::pairs::{OTHER_ROULETTE, PAIR};
use variants::reading::Reading;

/// A bounce fewer shows so little that with fewer photons than this, chance would be most of what
/// it seems to do.
const WITH_FEWER_BOUNCES: u64 = 4_000_000;

/// With how many photons signatures are measured.
#[derive(Clone, Copy, Debug)]
pub struct Effort {
    /// For the reference and the letter of the handout.
    pub main: u64,
    /// For the other fair readings.
    pub fair: u64,
    /// For each misreading that the fast path can trace.
    pub misreading: u64,
    /// For each other misreading.
    pub slow_misreading: u64,
    /// For each that has no name: two misreadings at once, and other roulettes. With 0, none is
    /// looked for.
    pub pair: u64,
}

impl Effort {
    /// For the signatures that are kept.
    pub const FULL: Self = Self {
        main: 100_000_000,
        fair: 30_000_000,
        misreading: 4_000_000,
        slow_misreading: 4_000_000,
        pair: 4_000_000,
    };
    /// For a limit of bounces of a course's own, in a few seconds.
    pub const QUICK: Self = Self {
        main: 8_000_000,
        fair: 2_000_000,
        misreading: 500_000,
        slow_misreading: 100_000,
        pair: 0,
    };
}

impl Effort {
    /// With how many photons `hypothesis` is measured.
    pub fn photons(&self, hypothesis: &Hypothesis) -> u64 {
        let reading = hypothesis.variation.reading;
        match hypothesis.id {
            FAIR if [Reading::REFERENCE, Reading::LETTER_OF_THE_HANDOUT].contains(&reading) => {
                self.main
            }
            FAIR => self.fair,
            PAIR | OTHER_ROULETTE => self.pair,
            BOUNCE_OFF_BY_ONE => self.misreading.max(WITH_FEWER_BOUNCES),
            _ if hypothesis.variation.is_fast() => self.misreading,
            _ => self.slow_misreading,
        }
    }
}

/// Takes the signatures of `hypotheses`, in their order, out of `kept`; of those that have no name,
/// none if none is kept.
pub(crate) fn take<S>(kept: &mut BTreeMap<String, S>, hypotheses: &[Hypothesis]) -> Vec<S> {
    let is_kept = hypotheses.first().is_some_and(|first| kept.contains_key(&first.key()));
    if !is_kept && hypotheses.iter().all(|hypothesis| hypothesis.misreading.is_none()) {
        return Vec::new();
    }
    let signature = |hypothesis: &Hypothesis| {
        let key = hypothesis.key();
        kept.remove(&key).unwrap_or_else(|| panic!("no signature is kept for '{key}'"))
    };
    hypotheses.iter().map(signature).collect()
}
