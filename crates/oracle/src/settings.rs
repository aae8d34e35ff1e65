//! How exactly each bounce is calculated.

use super::Accuracy;

pub(crate) struct SolveSettings {
    /// Sum over facets of the error of the second hits.
    pub(crate) second_tolerance: f64,
    pub(crate) second_evaluations: usize,
    pub(crate) third_tolerance: Option<f64>,
    pub(crate) third_evaluations: usize,
    /// Cells of the two meshes, at most if the facets allow.
    pub(crate) cells: [usize; 2],
    /// Widths of the strips along touching edges, over the longest edge of a cell.
    pub(crate) strips: &'static [f64],
    /// Error of the finer mesh over what the difference to the coarser one lets expect, at most.
    pub(crate) safety: f64,
    pub(crate) gather_order: usize,
    pub(crate) gather_ratio: f64,
}

impl SolveSettings {
    pub(crate) fn of(accuracy: Accuracy) -> Self {
        match accuracy {
            Accuracy::Quick => Self {
                second_tolerance: 2e-5,
                second_evaluations: 40_000,
                third_tolerance: None,
                third_evaluations: 0,
                cells: [300, 1000],
                strips: &[0.4, 0.1],
                // Coarse meshes err as they like: as usual where only two are compared (Roache
                // 1994).
                safety: 3.0,
                gather_order: 3,
                gather_ratio: 1.0,
            },
            Accuracy::Full => Self {
                second_tolerance: 3e-10,
                second_evaluations: 4_000_000,
                third_tolerance: Some(3e-8),
                third_evaluations: 300_000,
                cells: [3000, 9000],
                strips: &[0.5, 0.15, 0.04],
                // As usual where the order is known. A third as many cells of both err by less than
                // nine tenths of this, held against these.
                safety: 1.25,
                gather_order: 5,
                gather_ratio: 1.0,
            },
        }
    }
}
