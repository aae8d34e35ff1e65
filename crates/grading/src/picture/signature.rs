//! How likely each hypothesis turns which pixels red, measured by tracing it.

use serde::{Deserialize, Serialize};

use super::view::View;
use crate::kept::{
    Effort, Hypotheses, KeptSignatures, Known, SignatureTable, Sums, add, add_matrix, sum,
};
use crate::limits::dots_of_photons::{SAME_PLACE, SELF_HITS};
use crate::places::Places;
use crate::short::MANY_BOUNCES;
use crate::signature::Signatures;
use crate::statistics::Matrix;
use photon_mapping::assignment8::MAX_PHOTON_BOUNCES;
use photon_mapping::photon_list::PhotonRecord;
use variants::hypotheses::{Hypothesis, fair_readings, misreadings, no_offset};
use variants::pairs::{PAIR, can_be_of_two, pairs};
use variants::variation::{FACETS, Variation};

/// With how many photons: then a signature is known better than the leeway that a density has.
const EFFORT: Effort = Effort {
    main: 60_000_000,
    fair: 12_000_000,
    fast: 4_000_000,
    weak: 4_000_000,
    other: 4_000_000,
};

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
pub type PictureSignatures = SignatureTable<PictureSignature>;

fn hypotheses(places: &Places) -> Hypotheses {
    [fair_readings(), known_misreadings(places), known_pairs(places)]
}

impl KeptSignatures<PictureSignature> {
    /// Those of pictures of the assignment as it stands: a test measures some of them again.
    pub fn of_pictures() -> Self {
        serde_json::from_str(include_str!("../../golden/signatures-of-pictures.json"))
            .expect("the signatures that are part of the program are well formed")
    }

    /// Measures what is missing.
    pub fn complete_pictures(&mut self, places: &Places, view: &View) {
        let measure = |it: &Hypothesis, photons| measure(it, view, photons, MAX_PHOTON_BOUNCES);
        let emitted = |kept: &PictureSignature| kept.emitted;
        self.measure_missing(&hypotheses(places), EFFORT, emitted, measure);
    }
}

impl PictureSignatures {
    /// Those of the assignment as it stands, measured beforehand.
    pub fn of_assignment8(places: &Places) -> Self {
        KeptSignatures::of_pictures().table(MAX_PHOTON_BOUNCES, hypotheses(places))
    }

    /// Those of photons that may bounce `max_bounces` times: within a cell, a limit takes the same
    /// part of photons everywhere.
    pub fn of_limit(places: &Places, view: &View, max_bounces: i32) -> Self {
        let all = Self::of_assignment8(places);
        if max_bounces >= MANY_BOUNCES {
            return all;
        }
        let [long, short] = [MANY_BOUNCES, max_bounces].map(|it| Signatures::of_limit(places, it));
        let find = |table: &Signatures, hypothesis: &Hypothesis| {
            let mut all = table.fair.iter().chain(&table.misreadings);
            let found = all.find(|known| known.hypothesis.key() == hypothesis.key());
            // Self-hits bounce once more, about as often everywhere.
            found.unwrap_or(&table.fair[0]).signature.clone()
        };
        let shorten = |mut known: Known<PictureSignature>| {
            let [of_long, of_short] = [&long, &short].map(|table| find(table, &known.hypothesis));
            for (red, patch) in known.signature.red.iter_mut().zip(&view.patches) {
                let cell = view.cells[patch.cell];
                *red *= of_short.cells[cell] / of_long.cells[cell].max(f64::MIN_POSITIVE);
            }
            let facets = view.facets.iter().enumerate();
            for (f, a) in facets.clone() {
                for (g, b) in facets.clone() {
                    let [all, left] = [&of_long, &of_short].map(|it| it.pairs(*a, *b));
                    known.signature.pairs[f][g] *= left / all.max(f64::MIN_POSITIVE);
                }
            }
            known
        };
        let shorten = |known: Vec<Known<_>>| known.into_iter().map(shorten).collect();
        let [fair, misreadings] = [all.fair, all.misreadings].map(shorten);
        Self { max_bounces, fair, misreadings, unnamed: Vec::new(), correlation: all.correlation }
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
