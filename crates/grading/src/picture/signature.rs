//! How likely each hypothesis turns which pixels red, measured by tracing it.

use std::collections::BTreeMap;
use std::ops::Range;

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::view::View;
use crate::kept::{Effort, take};
use crate::places::Places;
use crate::statistics::Matrix;
use photon_mapping::assignment8::MAX_PHOTON_BOUNCES;
use photon_mapping::photon_list::PhotonRecord;
use variants::hypotheses::{Hypothesis, fair_readings, misreadings, no_offset};
use variants::pairs::{PAIR, can_be_of_two, pairs};
use variants::variation::{FACETS, Simulation, Variation};

/// How many photons a thread traces at once.
const PIECE: u64 = 1 << 16;
/// The seed of the signatures.
const SEED: u64 = 0x9_2019;
/// Photons of one path that are closer together than this, in world units, show as one dot.
const SAME_PLACE: f32 = 1e-4;
/// Without an offset, which part of the scattered photons meets its own surface depends on
/// rounding: on facets that are at right angles to an axis, and on the others.
const SELF_HITS: ([f32; 3], [f32; 3]) = ([0.1, 0.25, 0.4], [0.3, 0.45, 0.6]);

/// How often the photons of one hypothesis turn pixels red.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PictureSignature {
    /// How many photons were emitted to measure it.
    pub emitted: f64,
    /// By patch of the view: how many pixels were turned red, all photons taken on their own.
    pub red: Vec<f64>,
    /// By facet in sight, and for each photon emitted: the sum over pairs of photons of its path of
    /// the product of the pixels that they turn red.
    pub pairs: Matrix,
}

/// The signatures of all hypotheses, for a view without a shift.
#[derive(Clone, Debug, PartialEq)]
pub struct PictureSignatures {
    /// How often photons may bounce.
    pub max_bounces: i32,
    /// For [`fair_readings`], in their order.
    pub fair: Vec<PictureSignature>,
    /// For [`known_misreadings`], in their order.
    pub misreadings: Vec<PictureSignature>,
    /// For [`known_pairs`], in their order.
    pub pairs: Vec<PictureSignature>,
}

/// Signatures as they are kept: each under what its hypothesis is called.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Kept {
    /// By [`Hypothesis::key`].
    pub of: BTreeMap<String, PictureSignature>,
}

impl Kept {
    /// Those of the assignment as it stands: a test measures some of them again.
    pub fn of_assignment8() -> Self {
        let json = include_str!("../../golden/signatures-of-pictures.json");
        serde_json::from_str(json)
            .expect("the signatures that are part of the program are well formed")
    }

    /// Measures what is missing, for photons that may bounce `max_bounces` times.
    pub fn complete(&mut self, places: &Places, view: &View, max_bounces: i32, effort: Effort) {
        let all = [fair_readings(), known_misreadings(places), known_pairs(places)].concat();
        for hypothesis in all.into_iter().filter(|it| effort.photons(it) > 0) {
            let measure = || measure(&hypothesis, view, effort.photons(&hypothesis), max_bounces);
            self.of.entry(hypothesis.key()).or_insert_with(measure);
        }
    }
}

impl PictureSignatures {
    /// Those of the assignment as it stands, measured beforehand.
    pub fn of_assignment8(places: &Places) -> Self {
        Self::new(places, MAX_PHOTON_BOUNCES, Kept::of_assignment8())
    }

    /// Measures all signatures for photons that may bounce `max_bounces` times.
    pub fn measure(places: &Places, view: &View, max_bounces: i32, effort: Effort) -> Self {
        let mut kept = Kept::default();
        kept.complete(places, view, max_bounces, effort);
        Self::new(places, max_bounces, kept)
    }

    fn new(places: &Places, max_bounces: i32, Kept { mut of }: Kept) -> Self {
        Self {
            max_bounces,
            fair: take(&mut of, &fair_readings()),
            misreadings: take(&mut of, &known_misreadings(places)),
            pairs: take(&mut of, &known_pairs(places)),
        }
    }
}

/// All misreadings that a picture can show: those of lists, and photons without an offset, of which
/// a picture does not show how many lie at the same place.
pub fn known_misreadings(places: &Places) -> Vec<Hypothesis> {
    let mut all = misreadings();
    for straight in SELF_HITS.0 {
        for askew in SELF_HITS.1 {
            all.push(no_offset(self_hits(straight, askew, places)));
        }
    }
    all
}

/// All pairs of misreadings that a picture can show: those of lists, and photons without an offset
/// together with another one.
pub fn known_pairs(places: &Places) -> Vec<Hypothesis> {
    let [_, straight, _] = SELF_HITS.0;
    let [_, askew, _] = SELF_HITS.1;
    let no_offset = no_offset(self_hits(straight, askew, places));
    let mut all = pairs();
    for other in can_be_of_two() {
        let self_hits = no_offset.variation.self_hits;
        all.push(Hypothesis {
            id: PAIR,
            title: format!("{}; and {}", no_offset.title, other.title),
            misreading: None,
            variation: Variation { self_hits, ..other.variation },
        });
    }
    all
}

/// The part of self-hits on every facet.
fn self_hits(straight: f32, askew: f32, places: &Places) -> [f32; FACETS] {
    let mut self_hits = [straight; FACETS];
    for (facet, part) in places.facets.iter().zip(&mut self_hits) {
        if facet.normal.abs().max_element() < 0.99 {
            *part = askew;
        }
    }
    self_hits
}

/// Sums over photons, and over pairs of photons of one path.
struct Sums {
    red: Vec<f64>,
    pairs: Matrix,
}

impl Sums {
    fn new(view: &View) -> Self {
        let facets = view.facets.len();
        Self { red: vec![0.0; view.patches.len()], pairs: vec![vec![0.0; facets]; facets] }
    }

    /// Adds what one path stores.
    fn add_path(&mut self, path: &[PhotonRecord], view: &View) {
        let mut pixels = vec![0.0; view.facets.len()];
        let mut own = pixels.clone();
        for (at, record) in path.iter().enumerate() {
            let is_near = |other: &PhotonRecord| {
                (other.position - record.position).abs().max_element() < SAME_PLACE
            };
            if path[..at].iter().any(is_near) {
                continue;
            }
            let (mut facet, mut count) = (0, 0.0);
            view.for_each_pixel_of(record.position, |pixel| {
                if let Some(patch) = view.patch(pixel) {
                    self.red[patch] += 1.0;
                    facet = view.patches[patch].facet_in_sight;
                    count += 1.0;
                }
            });
            pixels[facet] += count;
            own[facet] += count * count;
        }
        for (a, row) in self.pairs.iter_mut().enumerate() {
            for (b, pairs) in row.iter_mut().enumerate() {
                *pairs += pixels[a] * pixels[b] - if a == b { own[a] } else { 0.0 };
            }
        }
    }

    fn add(&mut self, other: &Self) {
        let add = |sums: &mut Vec<f64>, others: &Vec<f64>| {
            sums.iter_mut().zip(others).for_each(|(sum, other)| *sum += other);
        };
        add(&mut self.red, &other.red);
        self.pairs.iter_mut().zip(&other.pairs).for_each(|(a, b)| add(a, b));
    }
}

/// Measures the signature of `hypothesis` with `emitted` photons.
pub fn measure(
    hypothesis: &Hypothesis,
    view: &View,
    emitted: u64,
    max_bounces: i32,
) -> PictureSignature {
    let simulation = Simulation::new(hypothesis.variation, SEED, emitted, max_bounces);
    let piece = |photons: Range<u64>| {
        let mut sums = Sums::new(view);
        let records = simulation.trace(photons);
        records.chunk_by(|a, b| a.photon == b.photon).for_each(|path| sums.add_path(path, view));
        sums
    };
    let starts: Vec<u64> = (0..emitted).step_by(PIECE as usize).collect();
    let mut sums = Sums::new(view);
    // In waves, so that memory does not grow with the photons; sums of whole numbers have no order.
    for wave in starts.chunks(256) {
        let pieces: Vec<Sums> =
            wave.par_iter().map(|start| piece(*start..emitted.min(start + PIECE))).collect();
        pieces.iter().for_each(|of_piece| sums.add(of_piece));
    }
    let emitted = emitted as f64;
    let pairs = sums.pairs.iter().map(|row| row.iter().map(|sum| sum / emitted).collect());
    PictureSignature { emitted, red: sums.red, pairs: pairs.collect() }
}
