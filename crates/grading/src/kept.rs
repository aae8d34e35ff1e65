//! What is known of hypotheses: signatures, each kept under what its hypothesis is called,
//! [`Hypothesis::key`].

use std::collections::BTreeMap;
use std::ops::Range;

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::statistics::Matrix;
use photon_mapping::photon_list::PhotonRecord;
use variants::hypotheses::{FAIR, Hypothesis};
use variants::reading::Reading;
use variants::variation::Simulation;

/// How many photons a thread traces at once.
const PIECE: u64 = 1 << 18;
/// How many pieces wait for each other, so that memory does not grow with the photons.
const WAVE: usize = 256;
/// The seed of the signatures. Submissions that follow our streams have another.
const SEED: u64 = 0x9_2019;
/// What chance does to a signature seems to be the misreading's doing, and hides what is: with
/// 4,000,000 photons, 1.9 standard deviations of a list of 200,000. These misreadings are hard to
/// see in such a list.
const WEAK: [&str; 4] = ["numbers-again", "half-normalised", "half-directions", "polar-directions"];

/// With how many photons signatures are measured.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Effort {
    /// For the reference and the letter of the handout.
    pub(crate) main: u64,
    /// For the other fair readings.
    pub(crate) fair: u64,
    /// For all else that takes little time.
    pub(crate) fast: u64,
    /// For those of [`WEAK`].
    pub(crate) weak: u64,
    /// For all others.
    pub(crate) other: u64,
}

impl Effort {
    /// With how many photons `hypothesis` is measured.
    pub(crate) fn photons(&self, hypothesis: &Hypothesis) -> u64 {
        let Hypothesis { id, variation, .. } = hypothesis;
        let main = [Reading::REFERENCE, Reading::LETTER_OF_THE_HANDOUT];
        match *id {
            FAIR if main.contains(&variation.reading) => self.main,
            FAIR => self.fair,
            // Of two that are close, the likelier must not be the one measured better: so roulettes
            // that have no name are known as well as those that have one, and what takes long to
            // measure as well as "no-roulette", which it resembles.
            _ if variation.is_fast() || *id == "late-roulette" => self.fast,
            id if WEAK.contains(&id) => self.weak,
            _ => self.other,
        }
    }
}

/// A hypothesis, and where it leaves photons.
#[derive(Clone, Debug, PartialEq)]
pub struct Known<S> {
    /// The hypothesis.
    pub hypothesis: Hypothesis,
    /// What is measured of it.
    pub signature: S,
}

/// All hypotheses.
#[derive(Clone, Debug, PartialEq)]
pub struct SignatureTable<S> {
    /// How often photons may bounce.
    pub max_bounces: i32,
    /// The fair readings, the reference's first.
    pub fair: Vec<Known<S>>,
    /// The misreadings that have a name.
    pub misreadings: Vec<Known<S>>,
    /// What has none; nothing where it is not looked for.
    pub unnamed: Vec<Known<S>>,
    /// How the numbers of photons in two cells go together under the reference: their correlation.
    /// Pictures have none.
    pub correlation: Matrix,
}

impl<S> SignatureTable<S> {
    /// All that is not fair.
    pub(crate) fn faults(&self) -> impl Iterator<Item = &Known<S>> {
        self.misreadings.iter().chain(&self.unnamed)
    }
}

/// The fair readings, the misreadings, and what has no name.
pub(crate) type Hypotheses = [Vec<Hypothesis>; 3];

/// Signatures as they are kept.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct KeptSignatures<S> {
    /// See [`SignatureTable::correlation`].
    #[serde(default = "Vec::new", skip_serializing_if = "Vec::is_empty")]
    pub correlation: Matrix,
    /// By [`Hypothesis::key`].
    pub of: BTreeMap<String, S>,
}

impl<S> Default for KeptSignatures<S> {
    fn default() -> Self {
        Self { correlation: Matrix::new(), of: BTreeMap::new() }
    }
}

impl<S: Send> KeptSignatures<S> {
    /// Measures with `measure` what is missing of `hypotheses`, or was measured with fewer photons:
    /// `emitted` tells with how many.
    pub(crate) fn measure_missing(
        &mut self,
        hypotheses: &Hypotheses,
        effort: Effort,
        emitted: impl Fn(&S) -> f64,
        measure: impl Fn(&Hypothesis, u64) -> S + Sync,
    ) {
        let missing = |it: &&Hypothesis| {
            self.of.get(&it.key()).is_none_or(|kept| emitted(kept) < effort.photons(it) as f64)
        };
        let missing: Vec<_> = hypotheses.iter().flatten().filter(missing).collect();
        let measured: Vec<_> = (missing.into_par_iter())
            .map(|it| (it.key(), measure(it, effort.photons(it))))
            .collect();
        self.of.extend(measured);
    }

    /// The table of `hypotheses`, of which every signature is kept.
    pub(crate) fn table(mut self, max_bounces: i32, hypotheses: Hypotheses) -> SignatureTable<S> {
        let [fair, misreadings, unnamed] = hypotheses.map(|part| {
            let known = |hypothesis: Hypothesis| {
                let key = hypothesis.key();
                let signature = self.of.remove(&key);
                let signature =
                    signature.unwrap_or_else(|| panic!("no signature is kept for '{key}'"));
                Known { hypothesis, signature }
            };
            part.into_iter().map(known).collect()
        });
        SignatureTable { max_bounces, fair, misreadings, unnamed, correlation: self.correlation }
    }
}

/// Sums over paths, such as make a signature.
pub(crate) trait Sums: Send + Sync {
    /// Adds what one path stores.
    fn add_path(&mut self, path: &[PhotonRecord]);
    /// Adds the sums of other paths.
    fn add(&mut self, other: &Self);
}

/// The sums over the paths of `emitted` photons under `hypothesis`, beginning with `none`.
pub(crate) fn sum<S: Sums>(
    hypothesis: &Hypothesis,
    emitted: u64,
    max_bounces: i32,
    none: impl Fn() -> S + Sync,
) -> S {
    let simulation = Simulation::new(hypothesis.variation, SEED, emitted, max_bounces);
    let piece = |photons: Range<u64>| {
        let mut sums = none();
        let records = simulation.trace(photons);
        records.chunk_by(|a, b| a.photon == b.photon).for_each(|path| sums.add_path(path));
        sums
    };
    let starts: Vec<u64> = (0..emitted).step_by(PIECE as usize).collect();
    let mut all = none();
    for wave in starts.chunks(WAVE) {
        let pieces: Vec<S> =
            wave.par_iter().map(|start| piece(*start..emitted.min(start + PIECE))).collect();
        // They are whole numbers: their order does not matter.
        pieces.iter().for_each(|of_piece| all.add(of_piece));
    }
    all
}

/// Adds `others` to `sums`, one by one.
pub(crate) fn add(sums: &mut [f64], others: &[f64]) {
    sums.iter_mut().zip(others).for_each(|(sum, other)| *sum += other);
}

/// The same for matrices.
pub(crate) fn add_matrix(sums: &mut Matrix, others: &Matrix) {
    sums.iter_mut().zip(others).for_each(|(row, other)| add(row, other));
}
