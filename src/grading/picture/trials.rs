//! Simulated pictures, to see how often they are judged rightly.

use std::collections::BTreeMap;

use glam::Vec3;

use super::expectations::PictureExpectations;
use super::judge::judge_dots;
use super::view::{PIXELS, View};
use crate::grading::hypotheses::{Hypothesis, fair_readings, misreadings, no_offset};
use crate::grading::places::Places;
use crate::grading::variation::{FACETS, Simulation, Variation};
use crate::random::photon_random;

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
        Simulation::new(variation, seed, emitted, crate::assignment8::MAX_PHOTON_BOUNCES);
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

/// What each simulated picture does wrong: the ways to a misreading one after another, seed by seed.
pub fn misread(id: &str, seed: u64) -> Option<Hypothesis> {
    let ways: Vec<Hypothesis> =
        misreadings().into_iter().filter(|hypothesis| hypothesis.id == id).collect();
    if id == "no-offset" {
        // From facet to facet, as rounding would have it.
        let mut random = photon_random(seed, 0);
        let places = Places::new(&crate::assignment8::create_scene());
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
    let mut rows = [Row::default(), Row::default()];
    for seed in seeds {
        let hypothesis = misread(id, seed).expect("it is one of the ids");
        let view = &expectations.view;
        let red =
            simulate_dots(hypothesis.variation, seed, emitted, 0.0, &expectations.places, view);
        for (row, known) in rows.iter_mut().zip([Some(emitted as f64), None]) {
            let judgement = judge_dots(&red, view, known, expectations);
            row.pictures += 1;
            row.incorrect += usize::from(judgement.findings.iter().any(|f| f.is_fault()));
            if let Some(explanation) = judgement.explanation {
                *row.named.entry(explanation.hypothesis.id).or_default() += 1;
            }
        }
    }
    rows
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
    /// How many p-values were below 0.1, 0.01 and 0.001.
    pub below: [usize; 3],
}

/// Judges correct pictures of `emitted` photons, one for each of `seeds`: fair readings in turn, and one
/// in three with positions up to 7e-3 off.
pub fn false_alarms(
    seeds: std::ops::Range<u64>,
    emitted: u64,
    expectations: &PictureExpectations,
) -> FalseAlarms {
    let fair = fair_readings();
    let mut alarms = FalseAlarms { smallest: 1.0, ..FalseAlarms::default() };
    for seed in seeds {
        let variation = fair[seed as usize % fair.len()].variation;
        let standoff = if seed % 3 == 2 { 7e-3 * photon_random(seed, 1)() } else { 0.0 };
        let view = &expectations.view;
        let red = simulate_dots(variation, seed, emitted, standoff, &expectations.places, view);
        alarms.pictures += 1;
        let judgements =
            [Some(emitted as f64), None].map(|known| judge_dots(&red, view, known, expectations));
        let is_incorrect = judgements.iter().any(|judgement| {
            judgement.has_dots && judgement.findings.iter().any(|finding| finding.is_fault())
        });
        alarms.incorrect += usize::from(is_incorrect);
        alarms.no_dots += usize::from(!judgements[0].has_dots);
        for p_value in judgements.iter().filter_map(|judgement| judgement.p_value) {
            alarms.smallest = alarms.smallest.min(p_value);
            for (count, limit) in alarms.below.iter_mut().zip([0.1, 0.01, 0.001]) {
                *count += usize::from(p_value < limit);
            }
        }
    }
    alarms
}
