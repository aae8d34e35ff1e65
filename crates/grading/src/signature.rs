//! How many photons each hypothesis leaves where, measured by tracing it.

use std::collections::BTreeMap;
use std::ops::Range;

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

pub use super::kept::Effort;
use super::kept::take;
use super::observation::{BOUNCES, Counts};
use super::places::Places;
use super::statistics::{Law, Matrix};
use photon_mapping::assignment8;
use photon_mapping::photon_list::PhotonRecord;
use variants::hypotheses::{Hypothesis, fair_readings, misreadings};
use variants::pairs::unnamed;
use variants::variation::Simulation;

/// How many photons a thread traces at once.
const PIECE: u64 = 1 << 16;
/// By which part of itself the number of photons in corners may be off.
const LEEWAY_OF_CORNERS: f64 = 0.5;
/// The seed of the signatures. Submissions that follow our streams have another.
const SEED: u64 = 0x9_2019;

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
#[derive(Clone, Debug, PartialEq)]
pub struct Signatures {
    /// How often photons may bounce.
    pub max_bounces: i32,
    /// For [`fair_readings`], in their order.
    pub fair: Vec<Signature>,
    /// For [`misreadings`], in their order.
    pub misreadings: Vec<Signature>,
    /// For [`unnamed`], in their order; nothing where these are not looked for.
    pub pairs: Vec<Signature>,
    /// How the numbers of photons in two cells go together under the reference: their correlation.
    pub correlation: Matrix,
}

/// Signatures as they are kept: each under what its hypothesis is called.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Kept {
    /// See [`Signatures::correlation`].
    pub correlation: Matrix,
    /// By [`Hypothesis::key`].
    pub of: BTreeMap<String, Signature>,
}

impl Kept {
    /// Those of the assignment as it stands: a test measures some of them again.
    pub fn of_assignment8() -> Self {
        let json = include_str!("../golden/signatures-of-lists.json");
        serde_json::from_str(json)
            .expect("the signatures that are part of the program are well formed")
    }

    /// Measures what is missing, for photons that may bounce `max_bounces` times.
    pub fn complete(&mut self, places: &Places, max_bounces: i32, effort: Effort) {
        let measure = |hypothesis: &Hypothesis| {
            measure(hypothesis, places, effort.photons(hypothesis), max_bounces)
        };
        let reference = &fair_readings()[0];
        if self.correlation.is_empty() {
            let (signature, of_cells) = measure(reference);
            self.correlation = correlate(&of_cells);
            self.of.insert(reference.key(), signature);
        }
        let all = [fair_readings(), misreadings(), unnamed()].concat();
        let missing =
            all.par_iter().filter(|it| effort.photons(it) > 0 && !self.of.contains_key(&it.key()));
        let measured: Vec<_> = missing.map(|it| (it.key(), measure(it).0)).collect();
        self.of.extend(measured);
    }
}

impl Signatures {
    /// Those of the assignment as it stands, measured beforehand.
    pub fn of_assignment8() -> Self {
        Self::of_kept(MAX_BOUNCES, Kept::of_assignment8())
    }

    /// Measures all signatures for photons that may bounce `max_bounces` times.
    pub fn measure(places: &Places, max_bounces: i32, effort: Effort) -> Self {
        let mut kept = Kept::default();
        kept.complete(places, max_bounces, effort);
        Self::of_kept(max_bounces, kept)
    }

    /// Those in `kept`, which has all of them, for photons that may bounce `max_bounces` times.
    pub fn of_kept(max_bounces: i32, Kept { correlation, mut of }: Kept) -> Self {
        Self {
            max_bounces,
            fair: take(&mut of, &fair_readings()),
            misreadings: take(&mut of, &misreadings()),
            pairs: take(&mut of, &unnamed()),
            correlation,
        }
    }
}

impl Signature {
    /// The law of the classes, where the mean of a facet may be off by the part `leeway` of itself.
    pub fn law_of_classes(&self, leeway: f64) -> Law {
        Law {
            mean: self.classes.clone(),
            covariance: self.covariance.clone(),
            measured_with: self.emitted,
            leeway: leeway_of_classes(leeway, self.classes.len()),
        }
    }

    /// The law of the cells, whose photons go together as `correlation` says.
    pub fn law_of_cells(&self, correlation: &Matrix, leeway: f64) -> Law {
        let deviation: Vec<f64> = self.variance.iter().map(|variance| variance.sqrt()).collect();
        let covariance = correlation.iter().enumerate().map(|(a, row)| {
            row.iter().enumerate().map(|(b, entry)| entry * deviation[a] * deviation[b]).collect()
        });
        Law {
            mean: self.cells.clone(),
            covariance: covariance.collect(),
            measured_with: self.emitted,
            leeway: vec![leeway; self.cells.len()],
        }
    }

    /// The law of the classes after `bounce` bounces more than the first: of these, a path has at
    /// most one photon, so that they are multinomial.
    pub fn law_of_bounce(&self, bounce: usize, leeway: f64) -> Law {
        let mean = self.by_bounce[bounce].clone();
        let covariance = (0..mean.len()).map(|a| {
            let entry = |b| if a == b { mean[a] * (1.0 - mean[a]) } else { -mean[a] * mean[b] };
            (0..mean.len()).map(entry).collect()
        });
        Law {
            covariance: covariance.collect(),
            leeway: leeway_of_classes(leeway, mean.len()),
            mean,
            measured_with: self.emitted,
        }
    }
}

/// How many photons are close to a corner depends on how far off the surface they are stored, if
/// that is along the photon's ray.
fn leeway_of_classes(leeway: f64, classes: usize) -> Vec<f64> {
    let mut of_classes = vec![leeway; classes];
    of_classes[classes - 2] = LEEWAY_OF_CORNERS;
    of_classes
}

/// The classes of `counts`.
pub fn classes(counts: &Counts, places: &Places) -> Vec<f64> {
    let facets = places.facets.iter().map(|facet| {
        let cells = facet.first_cell..facet.first_cell + facet.divisions * facet.divisions;
        counts.cells[cells].iter().sum()
    });
    facets.chain([counts.corner, counts.footprint]).collect()
}

/// Sums over photons, and over pairs of photons of one path.
struct Sums {
    cells: Vec<f64>,
    of_cells: Matrix,
    classes: Vec<f64>,
    of_classes: Matrix,
    by_bounce: Vec<Vec<f64>>,
    /// The first bounce that is stored.
    first: usize,
}

impl Sums {
    fn new(cells: usize, classes: usize, first: u16) -> Self {
        Self {
            first: usize::from(first),
            cells: vec![0.0; cells],
            of_cells: vec![vec![0.0; cells]; cells],
            classes: vec![0.0; classes],
            of_classes: vec![vec![0.0; classes]; classes],
            by_bounce: vec![vec![0.0; classes]; BOUNCES],
        }
    }

    /// Adds what one path stores.
    fn add_path(&mut self, path: &[PhotonRecord], places: &Places) {
        let located: Vec<_> = path
            .iter()
            .map(|record| (places.place(record.position.as_dvec3()), record.bounce))
            .filter_map(|(place, bounce)| Some((places.class_and_cell(place)?, bounce)))
            .collect();
        for ((class, cell), bounce) in &located {
            self.classes[*class] += 1.0;
            if let Some(counts) =
                self.by_bounce.get_mut(usize::from(*bounce).wrapping_sub(self.first))
            {
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
        let add = |sums: &mut Vec<f64>, others: &Vec<f64>| {
            sums.iter_mut().zip(others).for_each(|(sum, other)| *sum += other);
        };
        add(&mut self.cells, &other.cells);
        add(&mut self.classes, &other.classes);
        self.of_cells.iter_mut().zip(&other.of_cells).for_each(|(a, b)| add(a, b));
        self.of_classes.iter_mut().zip(&other.of_classes).for_each(|(a, b)| add(a, b));
        self.by_bounce.iter_mut().zip(&other.by_bounce).for_each(|(a, b)| add(a, b));
    }
}

/// Measures the signature of `hypothesis` with `emitted` photons, and the covariance of its cells.
pub fn measure(
    hypothesis: &Hypothesis,
    places: &Places,
    emitted: u64,
    max_bounces: i32,
) -> (Signature, Matrix) {
    let simulation = Simulation::new(hypothesis.variation, SEED, emitted, max_bounces);
    let classes = places.facets.len() + 2;
    let first = hypothesis.variation.storage.first();
    let piece = |photons: Range<u64>| {
        let mut sums = Sums::new(places.cells, classes, first);
        let records = simulation.trace(photons);
        records.chunk_by(|a, b| a.photon == b.photon).for_each(|path| sums.add_path(path, places));
        sums
    };
    let starts: Vec<u64> = (0..emitted).step_by(PIECE as usize).collect();
    let mut sums = Sums::new(places.cells, classes, first);
    // In waves, added in order: the sums are whole numbers, but memory is not to grow with them.
    for wave in starts.chunks(256) {
        let pieces: Vec<Sums> =
            wave.par_iter().map(|start| piece(*start..emitted.min(start + PIECE))).collect();
        pieces.iter().for_each(|of_piece| sums.add(of_piece));
    }
    let count = emitted as f64;
    let mean = |sums: &[f64]| sums.iter().map(|sum| sum / count).collect::<Vec<f64>>();
    let covariance = |pairs: &Matrix, mean: &[f64]| -> Matrix {
        let row = |(a, row): (usize, &Vec<f64>)| {
            row.iter().enumerate().map(|(b, sum)| sum / count - mean[a] * mean[b]).collect()
        };
        pairs.iter().enumerate().map(row).collect()
    };
    let (cells, in_classes) = (mean(&sums.cells), mean(&sums.classes));
    let of_cells = covariance(&sums.of_cells, &cells);
    let signature = Signature {
        emitted: count,
        variance: (0..cells.len()).map(|cell| of_cells[cell][cell]).collect(),
        covariance: covariance(&sums.of_classes, &in_classes),
        by_bounce: sums.by_bounce.iter().map(|sums| mean(sums)).collect(),
        cells,
        classes: in_classes,
    };
    (signature, of_cells)
}

fn correlate(covariance: &Matrix) -> Matrix {
    let entry =
        |a: usize, b: usize| covariance[a][b] / (covariance[a][a] * covariance[b][b]).sqrt();
    (0..covariance.len()).map(|a| (0..covariance.len()).map(|b| entry(a, b)).collect()).collect()
}

/// The bounces of the assignment as it stands.
pub const MAX_BOUNCES: i32 = assignment8::MAX_PHOTON_BOUNCES;
