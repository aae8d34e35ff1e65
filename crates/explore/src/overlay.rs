//! Another list as the page draws and counts it, over the run's.

use std::collections::BTreeSet;

use compare::alignment::Pairing;
use compare::position_index::is_near;
use photon_list::reader::PhotonList;
use photon_mapping::photon_list::PhotonRecord;

use super::comparison::ListComparison;

/// A page shows at most so many records that only the other list has, evenly thinned.
const MOST_EXTRA: usize = 500_000;

/// What a page draws of another list.
#[derive(Debug, Default)]
pub(crate) struct Overlay<'a> {
    /// For each dot: 0 matched, 1 missing, 2 moved, 3 extra. After the stored photons of the page
    /// come those that moved, then the extra ones.
    pub(crate) kinds: Vec<u8>,
    /// The positions of the dots after the stored photons.
    pub(crate) positions: Vec<[f32; 3]>,
    /// For each dot that moved, the stored photon that it should be.
    pub(crate) moved_index: Vec<u32>,
    pub(crate) extra: Vec<&'a PhotonRecord>,
}

impl ListComparison {
    /// What the page draws; `places` has the place of each record of the reference among its
    /// `stored` photons.
    pub(crate) fn overlay(&self, places: &[Option<u32>], stored: usize) -> Overlay<'_> {
        let mut overlay = Overlay { kinds: vec![0; stored], ..Overlay::default() };
        for pairing in &self.pairings {
            match *pairing {
                Pairing::Missing(i) => {
                    if let Some(place) = places[i] {
                        overlay.kinds[place as usize] = 1;
                    }
                }
                Pairing::Both(i, j) => {
                    let (a, b) = (&self.reference.records[i], &self.submission.records[j]);
                    let Some(place) = places[i] else { continue };
                    if !is_near(a.position, b.position, self.tolerance) {
                        overlay.kinds[place as usize] = 2;
                        if b.position.is_finite() {
                            overlay.moved_index.push(place);
                            overlay.positions.push(b.position.to_array());
                        }
                    }
                }
                Pairing::Extra(j) => overlay.extra.push(&self.submission.records[j]),
            }
        }
        let every = overlay.extra.len() / MOST_EXTRA + 1;
        let kept = overlay.extra.into_iter().step_by(every);
        overlay.extra = kept.filter(|record| record.position.is_finite()).collect();
        overlay.positions.extend(overlay.extra.iter().map(|record| record.position.to_array()));
        overlay.kinds.resize(stored + overlay.moved_index.len(), 2);
        overlay.kinds.resize(stored + overlay.positions.len(), 3);
        overlay
    }

    /// How many photons the other list stores, surface by surface and last in total: at the bounces
    /// 1, 2, 3, above, and at all. Nothing where the list does not tell it.
    pub(crate) fn table(&self, surfaces: usize) -> Vec<[Option<u64>; 5]> {
        let PhotonList { columns, records } = &self.submission;
        let mut table = vec![[columns.surface.then_some(0); 5]; surfaces];
        table.push([Some(0); 5]);
        if !columns.bounce {
            table.iter_mut().for_each(|row| row[..4].fill(None));
        }
        for record in records {
            // Of a surface or a bounce that the reference does not have, only the sums tell.
            let of_bounce = usize::from(record.bounce).checked_sub(1).map(|at| at.min(3));
            let of_surface = usize::from(record.surface).min(surfaces);
            for row in BTreeSet::from([of_surface, surfaces]) {
                for column in of_bounce.into_iter().chain([4]) {
                    table[row][column] = table[row][column].map(|count| count + 1);
                }
            }
        }
        table
    }
}
