//! Dots of positions that are off their surfaces, as far as leaves the dots that there are.

use super::coverage::{STANDOFFS, coverage};
use super::dotted::OfPicture;
use super::expected::means;
use crate::evidence::Evidence;
use crate::expected::bisect;
use crate::limits::expected::SIZES;
use crate::limits::{FEW_EMITTED, FEW_RED, FEWEST_GROUPS, FEWEST_RED, SIGNIFICANCE};
use crate::trial::{Trial, attempt_above};
use photon_mapping::rendering::photon_mapping_renderer::PHOTON_DOT_RADIUS;

impl OfPicture<'_> {
    /// The fair reading, of positions that are off their surfaces, and of enough photons, under
    /// which the picture is least strange; with how far off they are.
    ///
    /// Where only boxes have dots, positions are so far off that a few micrometers decide how many
    /// are left: then the number of photons tells nothing.
    pub(super) fn best_trial_off_surface(&self) -> Option<(Trial, f64)> {
        if self.emitted.is_some() && self.is_bare() {
            let coverage = self.coverage.clone();
            return Self { emitted: None, coverage, ..*self }.best_trial_off_surface();
        }
        let is_enough = |trial: &Trial| self.emitted.is_some() || trial.emitted >= FEW_EMITTED;
        let is_short = self.counts.iter().sum::<f64>() < FEW_RED;
        let can_fail = |trial: &Trial| is_short || trial.groups >= FEWEST_GROUPS;
        let mut best: Option<(Trial, f64)> = None;
        for reading in (0..self.table().fair.len()).rev() {
            for standoff in self.standoffs(reading).into_iter().rev() {
                let coverage = coverage(self.view, &self.expectations.places, standoff);
                let off = Self { coverage, ..*self };
                let least = best.as_ref().map_or(SIGNIFICANCE.next_down(), |(it, _)| it.p_value);
                let trial = attempt_above(&off, &off.joined(), reading, least);
                let trial = trial.filter(|trial| is_enough(trial) && can_fail(trial));
                best = trial.map(|trial| (trial, standoff)).or(best);
            }
        }
        best
    }

    /// The numbers of red pixels on facets that are askew to all axes, and on others.
    fn askew_and_straight(&self, of_cells: &[f64]) -> [f64; 2] {
        let mut sums = [0.0; 2];
        for (cell, count) in of_cells.iter().enumerate() {
            let is_askew = self.expectations.is_askew[self.view.facet_of_cell[cell]];
            sums[usize::from(!is_askew)] += count;
        }
        sums
    }

    /// Whether facets that are straight have no dots.
    fn is_bare(&self) -> bool {
        let [_, straight] = self.askew_and_straight(self.counts);
        straight < FEWEST_RED
    }

    /// Whether the askew facets have fewer dots than the others, beside what `trial` leads to
    /// expect: they are the first to lose some where positions are off.
    pub(super) fn may_be_off_surface(&self, trial: &Trial) -> bool {
        let means = self.means(&self.table().fair[trial.reading], trial.emitted);
        let [askew, straight] = self.askew_and_straight(self.counts);
        let [askew_mean, straight_mean] = self.askew_and_straight(&means);
        askew * straight_mean < straight * askew_mean || straight < 0.01 * straight_mean
    }

    /// How far off positions may be: as far as leaves the dots that there are on the askew facets,
    /// for as many photons as the others show. Where these show none, nothing but the number itself
    /// tells.
    fn standoffs(&self, reading: usize) -> Vec<f64> {
        let signature = &self.table().fair[reading].signature;
        let expect = |size: f64, standoff: f64| {
            let coverage = coverage(self.view, &self.expectations.places, standoff);
            self.askew_and_straight(&means(self.view, signature, size, &coverage))
        };
        let [askew, straight] = self.askew_and_straight(self.counts);
        let radius = f64::from(PHOTON_DOT_RADIUS);
        let size = match self.emitted {
            Some(emitted) => emitted,
            None if self.is_bare() => {
                let bare = STANDOFFS.into_iter().filter(|standoff| *standoff > radius);
                return bare.step_by(3).collect();
            }
            None => bisect(SIZES, |size| expect(size, 0.0)[1] < straight),
        };
        vec![bisect([STANDOFFS[0], radius], |standoff| expect(size, standoff)[0] > askew)]
    }
}
