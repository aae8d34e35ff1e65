//! Another list as the page draws and counts it, over the run's.

use std::collections::BTreeSet;

use compare::alignment::Pairing;
use compare::position_index::is_near;
use photon_list::reader::PhotonList;

use super::comparison::ListComparison;
use super::pack::PackedColumns;

/// A page shows at most so many records that only the other list has, evenly thinned.
const MOST_EXTRA: usize = 500_000;

impl ListComparison {
    /// Adds what the page reads of the overlay; `places` has the place of each record of the
    /// reference among the stored photons of the page.
    pub(crate) fn add_columns(&self, columns: &mut PackedColumns, places: &[Option<u32>]) {
        // For each stored photon of the page: 0 matched, 1 missing, 2 moved.
        let mut kinds = vec![0; places.iter().flatten().count()];
        // For each record that moved: the stored photon that it should be, and where it is.
        let (mut moved_index, mut moved) = (Vec::new(), Vec::new());
        let mut extra = Vec::new();
        for pairing in &self.pairings {
            match *pairing {
                Pairing::Missing(i) => {
                    if let Some(place) = places[i] {
                        kinds[place as usize] = 1;
                    }
                }
                Pairing::Both(i, j) => {
                    let (a, b) = (&self.reference.records[i], &self.submission.records[j]);
                    let Some(place) = places[i] else { continue };
                    if !is_near(a.position, b.position, self.tolerance) {
                        kinds[place as usize] = 2;
                        if b.position.is_finite() {
                            moved_index.push(place);
                            moved.push(b.position.to_array());
                        }
                    }
                }
                Pairing::Extra(j) => extra.push(&self.submission.records[j]),
            }
        }
        let every = extra.len() / MOST_EXTRA + 1;
        let extra = extra.into_iter().step_by(every).filter(|record| record.position.is_finite());
        let extra: Vec<_> = extra.collect();
        columns.bytes("kind", &kinds);
        columns.words("movedIndex", &moved_index);
        columns.vectors("moved", &moved);
        let of_extra = extra.iter();
        let positions: Vec<_> = of_extra.clone().map(|it| it.position.to_array()).collect();
        columns.vectors("extra", &positions);
        // What a list does not tell is the largest number.
        let photons: Vec<_> = of_extra.clone().map(|it| it.photon).collect();
        columns.words("extraPhoton", &photons);
        columns.shorts("extraBounce", &of_extra.clone().map(|it| it.bounce).collect::<Vec<_>>());
        columns.shorts("extraSurface", &of_extra.map(|it| it.surface).collect::<Vec<_>>());
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
