//! Signatures where photons may bounce a few times only.
//!
//! A photon that may bounce `n` times does what one that may bounce more often does, until its
//! `n`th bounce. So photons are counted by bounce, once, and every limit takes what it allows. How
//! photons of one path go together is counted for the reference alone: of others, as much of it is
//! left as of the reference's.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::kept::{Effort, Known, SignatureTable, Sums, add_matrix, sum};
use super::observation::BOUNCES;
use super::places::Places;
use super::signature::{Signature, Signatures, hypotheses};
use super::statistics::Matrix;
use photon_mapping::photon_list::PhotonRecord;
use variants::hypotheses::BOUNCE_OFF_BY_ONE;
use variants::variation::Variation;

/// With more bounces allowed, hardly a path ends by the limit, and the signatures without one are
/// right.
pub const MANY_BOUNCES: i32 = 20;
/// Bounces 0 to 19.
const COUNTED: usize = MANY_BOUNCES as usize;

/// With how many photons they are counted.
const EFFORT: Effort = Effort {
    main: 40_000_000,
    fair: 10_000_000,
    fast: 10_000_000,
    weak: 4_000_000,
    other: 1_000_000,
};

/// What one hypothesis leaves, bounce by bounce.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ByBounce {
    emitted: f64,
    /// Photons by cell, then in corners and in footprints.
    counts: Matrix,
}

/// What is kept of paths with few bounces.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ShortPaths {
    /// Of the reference, by the later bounce of the two: pairs of photons of one path, by class.
    pairs: Vec<Matrix>,
    of: BTreeMap<String, ByBounce>,
}

struct ShortCounts<'a> {
    places: &'a Places,
    counts: Matrix,
    pairs: Vec<Matrix>,
}

impl Sums for ShortCounts<'_> {
    fn add_path(&mut self, path: &[PhotonRecord]) {
        let place = |record: &PhotonRecord| {
            let place = self.places.place(record.position.as_dvec3());
            let bounce = usize::from(record.bounce);
            Some((self.places.class_and_cell(place)?, bounce)).filter(|_| bounce < COUNTED)
        };
        let located: Vec<_> = path.iter().filter_map(place).collect();
        let beyond_cells = self.places.cells - self.places.facets.len();
        for (at, ((class, cell), bounce)) in located.iter().enumerate() {
            self.counts[*bounce][cell.unwrap_or(class + beyond_cells)] += 1.0;
            for ((other, _), earlier) in &located[..at] {
                let pairs = &mut self.pairs[*bounce.max(earlier)];
                pairs[*class][*other] += 1.0;
                pairs[*other][*class] += 1.0;
            }
        }
    }

    fn add(&mut self, other: &Self) {
        add_matrix(&mut self.counts, &other.counts);
        self.pairs.iter_mut().zip(&other.pairs).for_each(|(a, b)| add_matrix(a, b));
    }
}

impl ShortPaths {
    /// Those of the assignment as it stands: a test measures some of them again.
    pub fn of_assignment8() -> Self {
        serde_json::from_str(include_str!("../golden/short-paths.json"))
            .expect("the counts that are part of the program are well formed")
    }

    /// Counts what is missing.
    pub fn complete(&mut self, places: &Places) {
        let [fair, misreadings, _] = hypotheses();
        for hypothesis in fair.iter().chain(&misreadings) {
            let (key, emitted) = (hypothesis.key(), EFFORT.photons(hypothesis));
            let is_counted = |kept: &ByBounce| kept.emitted >= emitted as f64;
            if hypothesis.id == BOUNCE_OFF_BY_ONE || self.of.get(&key).is_some_and(is_counted) {
                continue;
            }
            let classes = places.facets.len() + 2;
            let counted = || ShortCounts {
                places,
                counts: vec![vec![0.0; places.cells + 2]; COUNTED],
                pairs: vec![vec![vec![0.0; classes]; classes]; COUNTED],
            };
            let ShortCounts { counts, pairs, .. } =
                sum(hypothesis, emitted, MANY_BOUNCES - 1, counted);
            if hypothesis == &fair[0] {
                self.pairs = pairs;
            }
            self.of.insert(key, ByBounce { emitted: emitted as f64, counts });
        }
    }

    /// By class, which part of the reference's pairs is left where `max_bounces` are allowed.
    fn part_of_pairs(&self, max_bounces: usize) -> Matrix {
        let sum = |bounces: usize, a: usize, b: usize| {
            self.pairs[..bounces].iter().map(|pairs| pairs[a][b]).sum::<f64>()
        };
        let classes = 0..self.pairs[0].len();
        let part = |a, b| sum(max_bounces + 1, a, b) / sum(COUNTED, a, b).max(1.0);
        classes.clone().map(|a| classes.clone().map(|b| part(a, b)).collect()).collect()
    }

    /// The signature of a hypothesis where `max_bounces` are allowed, of which the one without a
    /// limit is known, and `part` of its pairs are left.
    fn signature(
        &self,
        Known { hypothesis, signature: long }: &Known<Signature>,
        fair: &[Known<Signature>],
        max_bounces: usize,
        part: &Matrix,
        places: &Places,
    ) -> Signature {
        // A bounce fewer is a fair reading without its last one.
        let with_last = Variation { fewer_bounces: 0, ..hypothesis.variation };
        let with_last = fair.iter().find(|known| known.hypothesis.variation == with_last);
        let counted = with_last.map_or(hypothesis, |known| &known.hypothesis);
        let ByBounce { emitted, counts } = &self.of[&counted.key()];
        let allowed = max_bounces.saturating_sub(hypothesis.variation.fewer_bounces as usize);
        let means = |counts: &[f64]| counts.iter().map(|count| count / emitted).collect::<Vec<_>>();
        let classes = |counts: &[f64]| {
            let mut classes = vec![0.0; places.facets.len()];
            for (facet, count) in places.facet_of_cell.iter().zip(counts) {
                classes[*facet] += count / emitted;
            }
            classes.extend(means(&counts[places.cells..]));
            classes
        };
        let mut all = vec![0.0; places.cells + 2];
        for of_bounce in &counts[..=allowed] {
            all.iter_mut().zip(of_bounce).for_each(|(sum, count)| *sum += count);
        }
        let first = usize::from(hypothesis.variation.storage.first());
        let by_bounce = (first..first + BOUNCES).map(|bounce| match counts.get(bounce) {
            Some(counts) if bounce <= allowed => classes(counts),
            _ => vec![0.0; places.facets.len() + 2],
        });
        let (cells, of_classes) = (means(&all[..places.cells]), classes(&all));
        let variance = (0..cells.len()).map(|cell| {
            let facet = places.facet_of_cell[cell];
            let pairs = pairs_of(long.variance[cell], long.cells[cell], long.cells[cell], true);
            shortened(pairs * part[facet][facet], cells[cell], cells[cell], true)
        });
        let covariance = |a: usize, b: usize| {
            shortened(long.pairs(a, b) * part[a][b], of_classes[a], of_classes[b], a == b)
        };
        Signature {
            emitted: *emitted,
            variance: variance.collect(),
            covariance: square(of_classes.len(), covariance),
            by_bounce: by_bounce.collect(),
            cells,
            classes: of_classes,
        }
    }

    /// The signatures where `max_bounces` are allowed, of which `long` are those without a limit.
    fn table(&self, long: Signatures, max_bounces: i32, places: &Places) -> Signatures {
        let allowed = max_bounces as usize;
        let part = self.part_of_pairs(allowed);
        let of = |known: &Known<Signature>| Known {
            signature: self.signature(known, &long.fair, allowed, &part, places),
            hypothesis: known.hypothesis.clone(),
        };
        let fair: Vec<_> = long.fair.iter().map(of).collect();
        let [of_long, of_short] = [&long.fair[0].signature, &fair[0].signature];
        let correlation = square(places.cells, |a, b| {
            let (means, variance) = (&of_long.cells, &of_long.variance);
            let covariance = long.correlation[a][b] * (variance[a] * variance[b]).sqrt();
            let pairs = pairs_of(covariance, means[a], means[b], a == b);
            let (means, variance) = (&of_short.cells, &of_short.variance);
            let part = part[places.facet_of_cell[a]][places.facet_of_cell[b]];
            let covariance = shortened(pairs * part, means[a], means[b], a == b);
            covariance / (variance[a] * variance[b]).sqrt().max(f64::MIN_POSITIVE)
        });
        let misreadings = long.misreadings.iter().map(of).collect();
        SignatureTable { max_bounces, fair, misreadings, unnamed: Vec::new(), correlation }
    }
}

/// The mean number of pairs of photons, of which the numbers have this `covariance`.
pub(crate) fn pairs_of(covariance: f64, a: f64, b: f64, is_same: bool) -> f64 {
    (covariance + a * b - if is_same { a } else { 0.0 }).max(0.0)
}

/// The covariance of numbers that have `pairs` pairs.
fn shortened(pairs: f64, a: f64, b: f64, is_same: bool) -> f64 {
    pairs - a * b + if is_same { a } else { 0.0 }
}

fn square(size: usize, entry: impl Fn(usize, usize) -> f64) -> Matrix {
    (0..size).map(|a| (0..size).map(|b| entry(a, b)).collect()).collect()
}

impl Signatures {
    /// Those of photons that may bounce `max_bounces` times, from what is kept.
    pub fn of_limit(places: &Places, max_bounces: i32) -> Self {
        let long = Self::of_assignment8();
        match max_bounces {
            0..MANY_BOUNCES => ShortPaths::of_assignment8().table(long, max_bounces, places),
            _ => Self { max_bounces, ..long },
        }
    }
}
