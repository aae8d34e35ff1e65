//! How likely each hypothesis turns which pixels red, measured by tracing it.

use serde::{Deserialize, Serialize};

use super::view::View;
use crate::kept::{Effort, Hypotheses, Kept, Sums, Table, add, add_matrix, sum};
use crate::places::Places;
use crate::statistics::Matrix;
use photon_mapping::assignment8::MAX_PHOTON_BOUNCES;
use photon_mapping::photon_list::PhotonRecord;
use variants::hypotheses::{Hypothesis, fair_readings, misreadings, no_offset};
use variants::pairs::{PAIR, can_be_of_two, pairs};
use variants::variation::{FACETS, Variation};

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
pub type PictureSignatures = Table<PictureSignature>;

fn hypotheses(places: &Places) -> Hypotheses {
    [fair_readings(), known_misreadings(places), known_pairs(places)]
}

impl Kept<PictureSignature> {
    /// Those of pictures of the assignment as it stands: a test measures some of them again.
    pub fn of_pictures() -> Self {
        serde_json::from_str(include_str!("../../golden/signatures-of-pictures.json"))
            .expect("the signatures that are part of the program are well formed")
    }

    /// Measures what is missing, for photons that may bounce `max_bounces` times.
    pub fn complete_pictures(
        &mut self,
        places: &Places,
        view: &View,
        max_bounces: i32,
        effort: Effort,
    ) {
        let measure = |it: &Hypothesis, photons| measure(it, view, photons, max_bounces);
        self.measure_missing(&hypotheses(places), effort, measure);
    }
}

impl PictureSignatures {
    /// Those of the assignment as it stands, measured beforehand.
    pub fn of_assignment8(places: &Places) -> Self {
        Kept::of_pictures().table(MAX_PHOTON_BOUNCES, hypotheses(places))
    }

    /// Measures all signatures for photons that may bounce `max_bounces` times.
    pub fn measure(places: &Places, view: &View, max_bounces: i32, effort: Effort) -> Self {
        let mut kept = Kept::default();
        kept.complete_pictures(places, view, max_bounces, effort);
        kept.table(max_bounces, hypotheses(places))
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
struct OfPixels<'a> {
    view: &'a View,
    red: Vec<f64>,
    pairs: Matrix,
}

impl Sums for OfPixels<'_> {
    fn add_path(&mut self, path: &[PhotonRecord]) {
        let view = self.view;
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
        add(&mut self.red, &other.red);
        add_matrix(&mut self.pairs, &other.pairs);
    }
}

/// Measures the signature of `hypothesis` with `emitted` photons.
pub fn measure(
    hypothesis: &Hypothesis,
    view: &View,
    emitted: u64,
    max_bounces: i32,
) -> PictureSignature {
    let facets = view.facets.len();
    let none = || OfPixels {
        view,
        red: vec![0.0; view.patches.len()],
        pairs: vec![vec![0.0; facets]; facets],
    };
    let OfPixels { red, pairs, .. } = sum(hypothesis, emitted, max_bounces, none);
    let emitted = emitted as f64;
    let pairs = pairs.iter().map(|row| row.iter().map(|sum| sum / emitted).collect()).collect();
    PictureSignature { emitted, red, pairs }
}
