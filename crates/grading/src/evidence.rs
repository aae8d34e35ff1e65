//! What a submission shows, list or picture, as the one judge takes it: counts in cells.

use std::cell::LazyCell;
use std::ops::Deref;

use super::expected::{Expected, Groups, fit_size, size_with_total};
use super::kept::{Known, SignatureTable};
use super::limits::LEAST_DEVIATIONS;
use variants::hypotheses::Hypothesis;

/// Counts in cells, and how hypotheses are projected on these.
pub(crate) trait Evidence {
    /// What is measured of a hypothesis.
    type Signature;
    /// How the counts are spoken of.
    const WORDS: Words;
    /// A misreading with which the counts are less likely than this explains nothing.
    const LEAST_LIKELY: f64;

    /// All hypotheses.
    fn table(&self) -> &SignatureTable<Self::Signature>;
    /// How many photons were emitted, if that is known.
    fn emitted(&self) -> Option<f64>;
    /// The counts by facet, or by what else is told apart.
    fn of_facets(&self) -> Vec<f64>;
    /// The counts by cell.
    fn of_cells(&self) -> &[f64];
    /// Counts in no cell, of photons or dots that lie where hardly any do.
    fn strays(&self) -> f64;
    /// How large each cell is.
    fn sizes(&self) -> Vec<f64>;
    /// The facet of each cell.
    fn facets_of_cells(&self) -> &[usize];
    /// The name of a facet.
    fn facet_name(&self, facet: usize) -> String;
    /// The name of a cell.
    fn cell_name(&self, cell: usize) -> String;
    /// The means by cell of `emitted` photons.
    fn means(&self, known: &Known<Self::Signature>, emitted: f64) -> Vec<f64>;
    /// What is expected of the cells.
    fn expect_cells(&self, known: &Known<Self::Signature>, emitted: f64) -> Expected;
    /// What is expected of the facets, where that of the cells is `cells`, which may be made only
    /// when it is asked for.
    fn expect_facets(
        &self,
        known: &Known<Self::Signature>,
        emitted: f64,
        cells: &impl Deref<Target = Expected>,
    ) -> Expected;
    /// Whether nothing but the counts can rule `hypothesis` out.
    fn may_be(&self, hypothesis: &Hypothesis) -> bool;

    /// The chance of what the evidence has besides places; nothing where it has no more.
    fn of_bounces(&self, _: &Known<Self::Signature>, _emitted: f64) -> Option<f64> {
        None
    }

    /// The chance of the counts by facet, exactly, under a fair reading; nothing where there are
    /// too many.
    fn of_few(&self, _reading: usize) -> Option<f64> {
        None
    }

    /// The means by facet where more paths have one of each length.
    fn other_lengths(&self, _: &Known<Self::Signature>, _emitted: f64) -> Vec<Vec<f64>> {
        Vec::new()
    }

    /// The number of photons emitted with which a hypothesis has as many counts.
    fn size_by_total(&self, known: &Known<Self::Signature>) -> f64 {
        let total = |emitted| self.means(known, emitted).iter().sum();
        size_with_total(self.of_cells().iter().sum(), total)
    }

    /// The number of photons emitted with which a hypothesis fits the cells best.
    fn fit_size(&self, known: &Known<Self::Signature>) -> f64 {
        let means = |emitted| self.means(known, emitted);
        fit_size(self.of_cells(), means, |emitted| self.expect_cells(known, emitted))
    }

    /// Facets and cells, joined until the counts that are expected are as good as normal. For as
    /// many photons as there seem to be: a misreading may have left far fewer than it should.
    fn joined(&self) -> Joined {
        let reference = &self.table().fair[0];
        let emitted = self.fit_size(reference);
        let cells = LazyCell::new(|| self.expect_cells(reference, emitted));
        let facets = self.expect_facets(reference, emitted, &cells);
        let alike = vec![0; facets.mean.len()];
        Joined {
            facets: facets.joined(&alike, LEAST_DEVIATIONS),
            cells: cells.joined(self.facets_of_cells(), LEAST_DEVIATIONS),
        }
    }
}

/// Facets and cells in groups.
pub(crate) struct Joined {
    pub(crate) facets: Groups,
    pub(crate) cells: Groups,
}

/// How counts are spoken of.
pub(crate) struct Words {
    /// What is counted.
    pub(crate) unit: &'static str,
    /// The check of their number, and what it expects.
    pub(crate) number: [&'static str; 2],
    /// The same by facet.
    pub(crate) facets: [&'static str; 2],
    /// The same by cell.
    pub(crate) density: [&'static str; 2],
    /// What is to be done where no misreading explains them.
    pub(crate) unexplained: &'static str,
}
