//! How many photons each hypothesis leaves where, measured by tracing it.

use serde::{Deserialize, Serialize};

use super::expected::{Expected, fit_size};
use super::kept::{Effort, Hypotheses, Sums, add, add_matrix, sum};
pub use super::kept::{KeptSignatures, Known, SignatureTable};
use super::limits::{LEEWAY, LEEWAY_OF_CORNERS};
use super::observation::{BOUNCES, CountsByPlace};
use super::places::Places;
use super::short::pairs_of;
use super::statistics::Matrix;
use photon_mapping::assignment8::MAX_PHOTON_BOUNCES;
use photon_mapping::photon_list::PhotonRecord;
use variants::hypotheses::{Hypothesis, fair_readings, misreadings};
use variants::pairs::unnamed;

/// With how many photons signatures of lists are measured.
const EFFORT: Effort = Effort {
    main: 100_000_000,
    fair: 30_000_000,
    fast: 30_000_000,
    weak: 12_000_000,
    other: 4_000_000,
};

/// Where one hypothesis leaves its photons, for each photon emitted. A class is a facet, or all of
/// [`super::places::Place::Corner`], or all of [`super::places::Place::Footprint`], in this order.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Signature {
    /// The photons emitted to measure it.
    pub emitted: f64,
    /// Photons by cell.
    pub cells: Vec<f64>,
    /// The variance of each.
    pub variance: Vec<f64>,
    /// Photons by class.
    pub classes: Vec<f64>,
    /// The covariance of these.
    pub covariance: Matrix,
    /// By bounce, from the first that is stored on, photons by class.
    pub by_bounce: Vec<Vec<f64>>,
}

/// The signatures of all hypotheses.
pub type Signatures = SignatureTable<Signature>;

pub(crate) fn hypotheses() -> Hypotheses {
    [fair_readings(), misreadings(), unnamed()]
}

impl KeptSignatures<Signature> {
    /// Those of the assignment as it stands: a test measures some of them again.
    pub fn of_assignment8() -> Self {
        serde_json::from_str(include_str!("../golden/signatures-of-lists.json"))
            .expect("the signatures that are part of the program are well formed")
    }

    /// Measures what is missing.
    pub fn complete(&mut self, places: &Places) {
        let measure = |it: &Hypothesis, photons| measure(it, places, photons, MAX_PHOTON_BOUNCES);
        let reference = &fair_readings()[0];
        if self.correlation.is_empty() {
            let (signature, of_cells) = measure(reference, EFFORT.photons(reference));
            self.correlation = correlate(&of_cells);
            self.of.insert(reference.key(), signature);
        }
        let emitted = |kept: &Signature| kept.emitted;
        self.measure_missing(&hypotheses(), EFFORT, emitted, |it, photons| measure(it, photons).0);
    }
}

impl Signatures {
    /// Those of the assignment as it stands, measured beforehand.
    pub fn of_assignment8() -> Self {
        KeptSignatures::<Signature>::of_assignment8().table(MAX_PHOTON_BOUNCES, hypotheses())
    }
}

impl Signature {
    /// What is expected of the classes of `emitted` photons.
    pub fn of_classes(&self, emitted: f64) -> Expected {
        let covariance = |a: usize, b: usize| self.covariance[a][b];
        let leeway = leeway_of_classes(self.classes.len());
        Expected::of_paths(&self.classes, covariance, self.emitted, &leeway, emitted)
    }

    /// The mean number of pairs of photons of one path on two classes.
    pub(crate) fn pairs(&self, a: usize, b: usize) -> f64 {
        pairs_of(self.covariance[a][b], self.classes[a], self.classes[b], a == b)
    }

    /// How many photons emitted fit `counts` of classes best.
    pub(crate) fn fit_size(&self, counts: &[f64]) -> f64 {
        let means = |emitted| self.classes.iter().map(|mean| emitted * mean).collect();
        fit_size(counts, means, |emitted| self.of_classes(emitted))
    }

    /// How many standard deviations `counts` of classes, of `emitted` photons or, if that is free,
    /// about as many, are on the way to `other`.
    pub(crate) fn towards(&self, other: &Self, counts: &[f64], emitted: f64, is_free: bool) -> f64 {
        let other = other.classes.iter().map(|mean| emitted * mean).collect();
        let law = self.of_classes(emitted).law(is_free);
        law.towards(counts, [other].into_iter()).map(|(deviations, _)| deviations).sum()
    }

    /// What is expected of the cells, whose photons go together as `correlation` says.
    pub fn of_cells(&self, correlation: &Matrix, leeway: &[f64], emitted: f64) -> Expected {
        let deviation: Vec<f64> = self.variance.iter().map(|variance| variance.sqrt()).collect();
        let covariance = |a: usize, b: usize| correlation[a][b] * deviation[a] * deviation[b];
        Expected::of_paths(&self.cells, covariance, self.emitted, leeway, emitted)
    }

    /// What is expected of the classes after `bounce` bounces more than the first: of these, a path
    /// has at most one photon, so that they are multinomial.
    pub fn of_bounce(&self, bounce: usize, emitted: f64) -> Expected {
        let mean = &self.by_bounce[bounce];
        let covariance =
            |a: usize, b: usize| if a == b { mean[a] } else { 0.0 } - mean[a] * mean[b];
        let leeway = leeway_of_classes(mean.len());
        Expected::of_paths(mean, covariance, self.emitted, &leeway, emitted)
    }
}

/// How many photons are close to a corner depends on how far off the surface they are stored, if
/// that is along the photon's ray.
fn leeway_of_classes(classes: usize) -> Vec<f64> {
    let mut of_classes = vec![LEEWAY; classes];
    of_classes[classes - 2] = LEEWAY_OF_CORNERS;
    of_classes
}

/// The classes of `counts`.
pub fn classes(counts: &CountsByPlace, places: &Places) -> Vec<f64> {
    let facets = places.facets.iter().map(|facet| {
        let cells = facet.first_cell..facet.first_cell + facet.divisions * facet.divisions;
        counts.cells[cells].iter().sum()
    });
    facets.chain([counts.corner, counts.footprint]).collect()
}

/// Sums over photons, and over pairs of photons of one path.
struct OfPlaces<'a> {
    places: &'a Places,
    cells: Vec<f64>,
    of_cells: Matrix,
    classes: Vec<f64>,
    of_classes: Matrix,
    by_bounce: Vec<Vec<f64>>,
    /// The first bounce that is stored.
    first: usize,
}

impl<'a> OfPlaces<'a> {
    fn new(places: &'a Places, first: u16) -> Self {
        let (cells, classes) = (places.cells, places.facets.len() + 2);
        Self {
            places,
            first: usize::from(first),
            cells: vec![0.0; cells],
            of_cells: vec![vec![0.0; cells]; cells],
            classes: vec![0.0; classes],
            of_classes: vec![vec![0.0; classes]; classes],
            by_bounce: vec![vec![0.0; classes]; BOUNCES],
        }
    }
}

impl Sums for OfPlaces<'_> {
    fn add_path(&mut self, path: &[PhotonRecord]) {
        let place = |record: &PhotonRecord| {
            let place = self.places.place(record.position.as_dvec3());
            Some((self.places.class_and_cell(place)?, usize::from(record.bounce)))
        };
        let located: Vec<_> = path.iter().filter_map(place).collect();
        for ((class, cell), bounce) in &located {
            self.classes[*class] += 1.0;
            if let Some(counts) = self.by_bounce.get_mut(bounce.wrapping_sub(self.first)) {
                counts[*class] += 1.0;
            }
            for ((other, _), _) in &located {
                self.of_classes[*class][*other] += 1.0;
            }
            let Some(cell) = cell else { continue };
            self.cells[*cell] += 1.0;
            for ((_, other), _) in &located {
                if let Some(other) = other {
                    self.of_cells[*cell][*other] += 1.0;
                }
            }
        }
    }

    fn add(&mut self, other: &Self) {
        add(&mut self.cells, &other.cells);
        add(&mut self.classes, &other.classes);
        add_matrix(&mut self.of_cells, &other.of_cells);
        add_matrix(&mut self.of_classes, &other.of_classes);
        add_matrix(&mut self.by_bounce, &other.by_bounce);
    }
}

/// Measures the signature of `hypothesis` with `emitted` photons, and the covariance of its cells.
pub fn measure(
    hypothesis: &Hypothesis,
    places: &Places,
    emitted: u64,
    max_bounces: i32,
) -> (Signature, Matrix) {
    let first = hypothesis.variation.storage.first();
    let sums = sum(hypothesis, emitted, max_bounces, || OfPlaces::new(places, first));
    let count = emitted as f64;
    let mean = |sums: &[f64]| sums.iter().map(|sum| sum / count).collect::<Vec<f64>>();
    let covariance = |pairs: &Matrix, mean: &[f64]| -> Matrix {
        let row = |(a, row): (usize, &Vec<f64>)| {
            row.iter().enumerate().map(|(b, sum)| sum / count - mean[a] * mean[b]).collect()
        };
        pairs.iter().enumerate().map(row).collect()
    };
    let (cells, classes) = (mean(&sums.cells), mean(&sums.classes));
    let of_cells = covariance(&sums.of_cells, &cells);
    let signature = Signature {
        emitted: count,
        variance: (0..cells.len()).map(|cell| of_cells[cell][cell]).collect(),
        covariance: covariance(&sums.of_classes, &classes),
        by_bounce: sums.by_bounce.iter().map(|sums| mean(sums)).collect(),
        cells,
        classes,
    };
    (signature, of_cells)
}

fn correlate(covariance: &Matrix) -> Matrix {
    let entry =
        |a: usize, b: usize| covariance[a][b] / (covariance[a][a] * covariance[b][b]).sqrt();
    (0..covariance.len()).map(|a| (0..covariance.len()).map(|b| entry(a, b)).collect()).collect()
}
