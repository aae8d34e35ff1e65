//! Simulated pictures, to see how often they are judged rightly.

use std::collections::BTreeMap;

use glam::Vec3;
use rayon::prelude::*;

use super::expectations::PictureExpectations;
use super::judge::{PictureJudgement, judge_dots};
use super::view::{PIXELS, View};
use crate::places::Places;
use photon_mapping::random::photon_random;
use variants::hypotheses::{Hypothesis, fair_readings, misreadings, no_offset};
use variants::variation::{FACETS, Simulation, Variation};

/// How many photons are traced at once.
const PIECE: u64 = 1 << 16;

/// The dots of `emitted` photons with `seed` under `variation`, where positions are `standoff` off
/// their facets, in world units: by pixel of `view`.
pub fn simulate_dots(
    variation: Variation,
    seed: u64,
    emitted: u64,
    standoff: f32,
    places: &Places,
    view: &View,
) -> Vec<bool> {
    let simulation =
        Simulation::new(variation, seed, emitted, photon_mapping::assignment8::MAX_PHOTON_BOUNCES);
    let mut red = vec![false; PIXELS];
    for start in (0..emitted).step_by(PIECE as usize) {
        for record in simulation.trace(start..emitted.min(start + PIECE)) {
            let off = match places.facets.get(usize::from(record.surface)) {
                Some(facet) => standoff * facet.normal.as_vec3(),
                None => Vec3::ZERO,
            };
            view.for_each_pixel_of(record.position + off, |pixel| red[pixel] = true);
            if record.position.is_nan() {
                // It is near everything.
                return (0..PIXELS).map(|pixel| view.shows_surface(pixel)).collect();
            }
        }
    }
    red
}

/// What became of the pictures of one kind.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Row {
    /// How many there were.
    pub pictures: usize,
    /// How many were called incorrect.
    pub incorrect: usize,
    /// The misreadings named, and how often.
    pub named: BTreeMap<&'static str, usize>,
}

/// What each simulated picture does wrong: the ways to a misreading one after another, seed by
/// seed.
pub fn misread(id: &str, seed: u64) -> Option<Hypothesis> {
    let ways: Vec<Hypothesis> =
        misreadings().into_iter().filter(|hypothesis| hypothesis.id == id).collect();
    if id == "no-offset" {
        // From facet to facet, as rounding would have it.
        let mut random = photon_random(seed, 0);
        let places = Places::new(&photon_mapping::assignment8::create_scene());
        let mut self_hits = [0.0; FACETS];
        for (facet, part) in places.facets.iter().zip(&mut self_hits) {
            let is_straight = facet.normal.abs().max_element() > 0.99;
            *part = if is_straight { 0.15 + 0.1 * random() } else { 0.45 + 0.1 * random() };
        }
        return Some(no_offset(self_hits));
    }
    let count = ways.len().max(1);
    ways.into_iter().nth(seed as usize % count)
}

/// The misreadings that a picture can show.
pub fn ids() -> Vec<&'static str> {
    let mut ids: Vec<&str> = misreadings().iter().map(|hypothesis| hypothesis.id).collect();
    ids.push("no-offset");
    ids.sort_unstable();
    ids.dedup();
    ids.retain(|id| *id != "bounce-off-by-one");
    ids
}

/// Judges pictures of `emitted` photons with the misreading `id`, one for each of `seeds`: with the
/// number known, and without.
pub fn detect(
    id: &str,
    seeds: std::ops::Range<u64>,
    emitted: u64,
    expectations: &PictureExpectations,
) -> [Row; 2] {
    let judge = |seed: u64| {
        let hypothesis = misread(id, seed).expect("it is one of the ids");
        let view = &expectations.view;
        let red =
            simulate_dots(hypothesis.variation, seed, emitted, 0.0, &expectations.places, view);
        [Some(emitted as f64), None].map(|known| judge_dots(&red, view, known, expectations))
    };
    let judged: Vec<_> = seeds.into_par_iter().map(judge).collect();
    [0, 1].map(|which| {
        let mut row = Row::default();
        for judgement in judged.iter().map(|pair| &pair[which]) {
            row.pictures += 1;
            row.incorrect += usize::from(judgement.is_incorrect());
            if let Some(explanation) = &judgement.explanation {
                *row.named.entry(explanation.hypothesis.id).or_default() += 1;
            }
        }
        row
    })
}

/// What became of pictures that are correct.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FalseAlarms {
    /// How many there were; each is judged with the number of photons known, and without.
    pub pictures: usize,
    /// How many were called incorrect, either way.
    pub incorrect: usize,
    /// How many have no dots, since positions are too far off.
    pub no_dots: usize,
    /// The smallest p-value, corrected for the number of tests.
    pub smallest: f64,
    /// The seed of the picture that has it.
    pub of_seed: u64,
    /// How many p-values there were, and how many below 0.1, 0.01 and 0.001.
    pub below: [usize; 4],
}

/// Judges correct pictures of `emitted` photons, one for each of `seeds`, of all fair readings in
/// turn; where `is_off`, with positions up to 4e-3 off. Farther off, no dot is left.
pub fn false_alarms(
    seeds: std::ops::Range<u64>,
    emitted: u64,
    is_off: bool,
    expectations: &PictureExpectations,
) -> FalseAlarms {
    let fair = fair_readings();
    let judge = |seed: u64| {
        let variation = fair[seed as usize % fair.len()].variation;
        let standoff = if is_off { 4e-3 * photon_random(seed, 1)() } else { 0.0 };
        let view = &expectations.view;
        let red = simulate_dots(variation, seed, emitted, standoff, &expectations.places, view);
        [Some(emitted as f64), None].map(|known| judge_dots(&red, view, known, expectations))
    };
    let first = seeds.start;
    let judged: Vec<_> = seeds.into_par_iter().map(judge).collect();
    let mut alarms = FalseAlarms { smallest: 1.0, ..FalseAlarms::default() };
    for (seed, judgements) in (first..).zip(judged) {
        alarms.pictures += 1;
        alarms.incorrect += usize::from(judgements.iter().any(PictureJudgement::is_incorrect));
        alarms.no_dots += usize::from(!judgements[0].has_dots);
        for p_value in judgements.iter().filter_map(|judgement| judgement.p_value) {
            if p_value < alarms.smallest {
                (alarms.smallest, alarms.of_seed) = (p_value, seed);
            }
            for (count, limit) in alarms.below.iter_mut().zip([f64::INFINITY, 0.1, 0.01, 0.001]) {
                *count += usize::from(p_value < limit);
            }
        }
    }
    alarms
}
