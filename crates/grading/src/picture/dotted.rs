//! A picture as evidence: its red pixels, counted by place.

use std::ops::Deref;

use super::expectations::PictureExpectations;
use super::expected::{expect, means};
use super::signature::PictureSignature;
use super::view::View;
use crate::evidence::{Evidence, Words};
use crate::expected::{Expected, Groups};
use crate::kept::{Known, SignatureTable};
use crate::limits::{LEAST_LIKELY_IN_PICTURES, LEEWAY_OF_COVERAGE, LEEWAY_OF_SELF_HITS};
use variants::hypotheses::Hypothesis;

/// The red pixels of a picture, of `emitted` photons if that is known.
pub(super) struct OfPicture<'a> {
    /// By cell in sight.
    pub(super) counts: &'a [f64],
    pub(super) emitted: Option<f64>,
    pub(super) view: &'a View,
    pub(super) expectations: &'a PictureExpectations,
    pub(super) coverage: Vec<f64>,
    /// How many red pixels show no place of a cell.
    pub(super) elsewhere: f64,
}

impl Evidence for OfPicture<'_> {
    type Signature = PictureSignature;
    const WORDS: Words = Words {
        unit: "red pixels",
        number: ["number of dots", "as many dots as the photons emitted leave in sight"],
        facets: ["dots by facet", "on every facet in sight as many dots as the scene leaves there"],
        density: ["density of dots", "the scene's density of dots over every facet in sight"],
        unexplained: "None of the known misreadings explains it. Hand in the photon list: it tells \
                      more than a picture.",
    };
    const LEAST_LIKELY: f64 = LEAST_LIKELY_IN_PICTURES;

    fn table(&self) -> &SignatureTable<PictureSignature> {
        &self.expectations.signatures
    }

    fn emitted(&self) -> Option<f64> {
        self.emitted
    }

    fn of_facets(&self) -> Vec<f64> {
        self.by_facet().sums(self.counts)
    }

    fn of_cells(&self) -> &[f64] {
        self.counts
    }

    fn strays(&self) -> f64 {
        self.elsewhere
    }

    fn sizes(&self) -> Vec<f64> {
        let mut pixels = vec![0.0; self.counts.len()];
        let patches = self.view.patches.iter();
        patches.for_each(|patch| pixels[patch.cell] += f64::from(patch.pixels));
        pixels
    }

    fn facets_of_cells(&self) -> &[usize] {
        &self.view.facet_of_cell
    }

    fn facet_name(&self, facet: usize) -> String {
        self.expectations.places.name(self.view.facets[facet])
    }

    fn cell_name(&self, cell: usize) -> String {
        self.expectations.places.cell_name(self.view.cells[cell])
    }

    fn means(&self, known: &Known<PictureSignature>, emitted: f64) -> Vec<f64> {
        means(self.view, &known.signature, emitted, &self.coverage)
    }

    fn expect_cells(&self, known: &Known<PictureSignature>, emitted: f64) -> Expected {
        let Self { view, coverage, expectations, .. } = self;
        let leeway = &expectations.leeway;
        let mut expected = expect(view, &known.signature, emitted, coverage, leeway);
        for (facet, part) in coverage.iter().enumerate() {
            let by_standoff = if *part < 1.0 { LEEWAY_OF_COVERAGE / part.max(0.01) } else { 0.0 };
            let is_self_hits = known.hypothesis.id == "no-offset";
            let by_self_hits = if is_self_hits { LEEWAY_OF_SELF_HITS } else { 0.0 };
            for part in [by_standoff, by_self_hits].into_iter().filter(|part| *part > 0.0) {
                let is_on = |cell: usize| view.facet_of_cell[cell] == facet;
                let slopes = expected.slope.iter().enumerate();
                let way = slopes.map(|(cell, slope)| if is_on(cell) { part * slope } else { 0.0 });
                expected.loosen(&way.collect::<Vec<_>>());
            }
        }
        expected
    }

    fn expect_facets(
        &self,
        _: &Known<PictureSignature>,
        _: f64,
        cells: &impl Deref<Target = Expected>,
    ) -> Expected {
        cells.grouped(&self.by_facet())
    }

    fn may_be(&self, _: &Hypothesis) -> bool {
        true
    }
}

impl<'a> OfPicture<'a> {
    /// Of photons that lie on their surfaces.
    pub(super) fn new(
        counts: &'a [f64],
        emitted: Option<f64>,
        view: &'a View,
        expectations: &'a PictureExpectations,
    ) -> Self {
        Self {
            counts,
            emitted,
            view,
            expectations,
            coverage: vec![1.0; view.facets.len()],
            elsewhere: 0.0,
        }
    }

    fn by_facet(&self) -> Groups {
        Groups { of: self.view.facet_of_cell.clone(), count: self.view.facets.len() }
    }
}
