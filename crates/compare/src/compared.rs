//! Two lists, paired and counted.

use super::alignment::{Pairing, align};
use super::differences::{Difference, Differences, count, same_to_light};
use super::divergence::Lists;
use super::position_index::is_near;
use photon_list::reader::PhotonList;

/// Fewer matched records say nothing about the directions to the light.
const FEWEST_MATCHED: usize = 20;

pub(crate) struct Compared {
    pub(crate) tolerance: f32,
    pub(crate) pairings: Vec<Pairing>,
    pub(crate) differences: Differences,
    pub(crate) differing: Vec<(Pairing, Difference)>,
}

impl Compared {
    pub(crate) fn new(reference: &PhotonList, submission: &PhotonList, tolerance: f32) -> Self {
        let pairings = align(reference, submission, tolerance);
        let (differences, differing) = count(reference, submission, &pairings, tolerance);
        Self { tolerance, pairings, differences, differing }
    }

    /// Whether no more than the part `part` of `records` differ.
    pub(crate) fn few(&self, part: f64, records: u64) -> bool {
        self.differing.len() as f64 <= part * records as f64
    }

    pub(crate) fn lists<'a>(
        &'a self,
        reference: &'a PhotonList,
        submission: &'a PhotonList,
    ) -> Lists<'a> {
        let Self { tolerance, pairings, .. } = self;
        let matched = pairings.iter().filter_map(|pairing| match *pairing {
            Pairing::Both(i, j) => Some((&reference.records[i], &submission.records[j])),
            _ => None,
        });
        let near = matched.filter(|(a, b)| is_near(a.position, b.position, *tolerance));
        let [all, same] = near
            .fold([0, 0], |[all, same], (a, b)| [all + 1, same + usize::from(same_to_light(a, b))]);
        let has_true_to_light =
            submission.columns.to_light && (all < FEWEST_MATCHED || 2 * same > all);
        Lists { reference, submission, pairings, tolerance: *tolerance, has_true_to_light }
    }
}
