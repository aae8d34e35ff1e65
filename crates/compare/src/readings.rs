//! Does another fair reading of the handout explain the submission?

use std::collections::BTreeMap;

use glam::Vec3;

use super::position_index::{PositionIndex, is_near};
use fast::lanes::offset::Offset;
use variants::reading::{Reading, TangentBasis};
use variants::run::Run;

/// A photon whose records differ, and what the submission stored of it, if that is known.
pub type Sample = BTreeMap<u64, Option<Vec<Vec3>>>;

/// The reading under which most photons of a sample match.
#[derive(Clone, Debug, PartialEq)]
pub struct BestReading {
    /// What it does in another way than the reference.
    pub name: String,
    /// How many photons of the sample match under it.
    pub matched: usize,
    /// How many photons of the sample could tell.
    pub tried: usize,
}

/// All readings that are tried, those that differ least from `base` first.
fn candidates(base: Reading) -> Vec<Reading> {
    let bases = [TangentBasis::Normalised, TangentBasis::LetterOfTheHandout];
    let thresholds = [0.99, 0.8, 0.9999];
    let axes = [Vec3::Y, Vec3::Z];
    let along_normal = [1e-5, 1e-6, 1e-4, 1e-3].map(Offset::AlongNormal);
    // An offset along the direction stays on the ray: its length moves nothing.
    let others = [Offset::AlongDirection(1e-4), Offset::None];
    let offsets: Vec<_> = [base.offset].into_iter().chain(along_normal).chain(others).collect();
    let mut readings = Vec::new();
    for tangent_basis in bases {
        for fallback_threshold in thresholds {
            for fallback_axis in axes {
                for offset in &offsets {
                    let offset = *offset;
                    readings.push(Reading {
                        tangent_basis,
                        fallback_threshold,
                        fallback_axis,
                        offset,
                    });
                }
            }
        }
    }
    readings.retain(|reading| *reading != base);
    readings.sort_by_key(|reading| changes(reading, &base).len());
    readings
}

/// What `reading` does in another way than `base`.
fn changes(reading: &Reading, base: &Reading) -> Vec<String> {
    let mut changes = Vec::new();
    if reading.tangent_basis != base.tangent_basis {
        changes.push(match reading.tangent_basis {
            TangentBasis::Normalised => "t and b normalised".to_owned(),
            TangentBasis::LetterOfTheHandout => {
                "t and b to the letter of the handout, not normalised".to_owned()
            }
            TangentBasis::Transposed => "t, b and n as rows".to_owned(),
        });
    }
    if reading.fallback_threshold != base.fallback_threshold {
        changes.push(format!("fallback threshold {}", reading.fallback_threshold));
    }
    if reading.fallback_axis != base.fallback_axis {
        let [x, y, z] = reading.fallback_axis.to_array();
        changes.push(format!("fallback axis ({x}, {y}, {z})"));
    }
    if reading.offset != base.offset {
        changes.push(match reading.offset {
            Offset::AsNeeded => "offset as the hit needs".to_owned(),
            Offset::None => "no offset".to_owned(),
            Offset::AlongNormal(length) => format!("offset {length:e} along the normal"),
            Offset::AlongDirection(_) => "offset along the new direction".to_owned(),
        });
    }
    changes
}

/// Tries every fair reading on the photons of `sample` and gives the one under which most of them
/// match `submission` (positions in world space) within `tolerance` world units; `None` when under
/// no reading more than half of them match. Of readings that match equally many, it is the one that
/// comes closest, and of those that come equally close the one with the fewest changes.
///
/// Only photons stored where `run` stores none of theirs can tell: many readings make a photon
/// escape, and that one does so which the submission lacks says nothing.
pub fn best_reading(
    run: &Run,
    sample: &Sample,
    submission: &[Vec3],
    tolerance: f32,
) -> Option<BestReading> {
    let index = PositionIndex::new(submission, tolerance);
    let mut witnesses: Vec<_> = sample
        .iter()
        .map(|(photon, expected)| Witness {
            photon: *photon,
            expected: expected.as_deref(),
            of_reference: stored(run, *photon),
        })
        .collect();
    witnesses.retain(|witness| {
        witness.expected.is_none_or(|expected| witness.is_elsewhere(expected, tolerance))
    });
    let mut best: Option<(Score, Reading)> = None;
    let mut run = run.clone();
    let base = run.reading;
    for reading in candidates(base) {
        run.reading = reading;
        let score = score(&run, &witnesses, &index, submission, tolerance);
        let is_better = best.as_ref().is_none_or(|(best, _)| {
            score.matched > best.matched
                // A clear margin: rounding alone must not prefer the more complicated reading.
                || (score.matched == best.matched && score.distance < 0.8 * best.distance)
        });
        if 2 * score.matched > score.tried && is_better {
            best = Some((score, reading));
        }
    }
    best.map(|(score, reading)| BestReading {
        name: changes(&reading, &base).join(", "),
        matched: score.matched,
        tried: score.tried,
    })
}

struct Witness<'sample> {
    photon: u64,
    expected: Option<&'sample [Vec3]>,
    of_reference: Vec<Vec3>,
}

impl Witness<'_> {
    /// Whether any of `positions` is none of the reference's.
    fn is_elsewhere(&self, positions: &[Vec3], tolerance: f32) -> bool {
        positions.iter().any(|a| self.of_reference.iter().all(|b| !is_near(*a, *b, tolerance)))
    }
}

/// Where `run` stores photon `photon`.
fn stored(run: &Run, photon: u64) -> Vec<Vec3> {
    run.trace_piece(photon..photon + 1).iter().map(|record| record.position).collect()
}

#[derive(Default)]
struct Score {
    tried: usize,
    matched: usize,
    /// The sum of the distances between the positions matched.
    distance: f32,
}

fn score(
    run: &Run,
    witnesses: &[Witness],
    index: &PositionIndex,
    submission: &[Vec3],
    tolerance: f32,
) -> Score {
    let mut score = Score::default();
    for witness in witnesses {
        let stored = stored(run, witness.photon);
        let distances: Option<Vec<f32>> = match witness.expected {
            Some(expected) if expected.len() != stored.len() => None,
            Some(expected) => expected
                .iter()
                .zip(&stored)
                .map(|(a, b)| is_near(*a, *b, tolerance).then(|| a.distance(*b)))
                .collect(),
            None if !witness.is_elsewhere(&stored, tolerance) => continue,
            None => stored
                .iter()
                .map(|position| {
                    let near = index.near(*position, 0).into_iter();
                    near.map(|place| submission[place].distance(*position)).reduce(f32::min)
                })
                .collect(),
        };
        score.tried += 1;
        if let Some(distances) = distances {
            score.matched += 1;
            score.distance = distances.iter().fold(score.distance, |sum, distance| sum + distance);
        }
    }
    score
}
