//! Few photons, whose numbers on each facet are tested exactly: paths are independent of each
//! other, and how many photons they store on a facet, and beside it, is counted once.

use std::collections::BTreeMap;

use super::limits::few::{EMITTED, SEED};
use super::limits::{FEW_PHOTONS, WORTH};
use super::places::Places;
use super::statistics::corrected;
use variants::hypotheses::Hypothesis;
use variants::variation::Simulation;

/// Photons that one path stores on a class, and in all.
type PathStored = (usize, usize);

/// What the paths of one fair reading store.
#[derive(Clone, Debug)]
pub(super) struct StoredByPaths {
    /// By class, see [`Places::class_and_cell`]: each kind of path, with its share of all paths.
    of_classes: Vec<BTreeMap<PathStored, f64>>,
}

impl StoredByPaths {
    /// Those of `reading`, where photons may bounce `max_bounces` times.
    pub(super) fn new(reading: &Hypothesis, places: &Places, max_bounces: i32) -> Self {
        let simulation = Simulation::new(reading.variation, SEED, EMITTED, max_bounces);
        let mut of_classes = vec![BTreeMap::new(); places.facets.len() + 1];
        let records = simulation.trace(0..EMITTED);
        for path in records.chunk_by(|a, b| a.photon == b.photon) {
            let mut stored = vec![0; of_classes.len()];
            for record in path {
                let place = places.place(record.position.as_dvec3());
                let class = places.class_and_cell(place).map(|(class, _)| class);
                if let Some(stored) = class.and_then(|class| stored.get_mut(class)) {
                    *stored += 1;
                }
            }
            for (paths, stored) in of_classes.iter_mut().zip(stored) {
                *paths.entry((stored, path.len())).or_insert(0.0) += 1.0;
            }
        }
        for paths in &mut of_classes {
            let all: f64 = paths.values().sum();
            paths.values_mut().for_each(|share| *share /= all);
        }
        Self { of_classes }
    }

    /// The chance that one of `counts`, by class, is as far from what is usual as the farthest is,
    /// among so many photons in all; nothing where they are many.
    pub(super) fn p_value(&self, counts: &[f64]) -> Option<f64> {
        let all = counts.iter().sum::<f64>() as usize;
        if !(1..=FEW_PHOTONS).contains(&all) {
            return None;
        }
        let tails = self.of_classes.iter().zip(counts);
        let tails = tails.filter(|(paths, count)| is_far(paths, all, **count));
        let tails = tails.map(|(paths, count)| smaller_tail(paths, all, *count as usize));
        Some(corrected(tails.fold(1.0, f64::min), 2 * self.of_classes.len()))
    }
}

/// Whether `count` of `all` photons are so far from what is usual on a class that it is worth a
/// test: paths that store several photons there only spread the counts.
fn is_far(paths: &BTreeMap<PathStored, f64>, all: usize, count: f64) -> bool {
    let mean = |stored: fn(&PathStored) -> usize| {
        paths.iter().map(|(path, share)| share * stored(path) as f64).sum::<f64>()
    };
    let part = mean(|(on, _)| *on) / mean(|(_, all)| *all);
    let all = all as f64;
    (count - all * part).powi(2) > (WORTH * WORTH) * all * part * (1.0 - part)
}

/// The smaller of the chances that of `all` photons at most, or at least, `count` are on a class:
/// of paths that come one after another, until there are `all`.
fn smaller_tail(paths: &BTreeMap<PathStored, f64>, all: usize, count: usize) -> f64 {
    // By the photons stored, and those on the class: how often paths come to these.
    let mut visits = vec![vec![0.0; all + 1]; all + 1];
    visits[0][0] = 1.0;
    for stored in 1..=all {
        for ((on, of_path), share) in paths.iter().filter(|((_, of_path), _)| *of_path <= stored) {
            for before in 0..=stored - of_path {
                let visit = share * visits[stored - of_path][before];
                visits[stored][before + on] += visit;
            }
        }
    }
    let visits = &visits[all];
    let sum = |visits: &[f64]| visits.iter().sum::<f64>();
    let whole = sum(visits).max(f64::MIN_POSITIVE);
    (sum(&visits[..=count]) / whole).min(sum(&visits[count..]) / whole)
}
