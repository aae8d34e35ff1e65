//! Another list as the page draws and counts it, over the run's.

use std::collections::BTreeSet;

use compare::alignment::Pairing;
use compare::position_index::is_near;
use photon_list::reader::PhotonList;

use super::comparison::ListComparison;
use super::pack::PackedColumns;

/// A page shows at most so many records that only the other list has, evenly thinned.
const MOST_EXTRA: usize = 500_000;

/// The overlay as the page's columns.
#[derive(Debug, Default)]
pub(crate) struct Overlay {
    /// For each stored photon of the page: 0 matched, 1 missing, 2 moved.
    pub kinds: Vec<u8>,
    /// For each record that moved: the stored photon that it should be, and where it is.
    pub moved_index: Vec<u32>,
    pub moved: Vec<[f32; 3]>,
    /// The records that only the other list has, with the largest number for what it does not
    /// tell.
    pub extra: Vec<[f32; 3]>,
    pub extra_photon: Vec<u32>,
    pub extra_bounce: Vec<u16>,
    pub extra_surface: Vec<u16>,
}

impl ListComparison {
    /// Adds what the page reads of the overlay; `places` has the place of each record of the
    /// reference among the stored photons of the page.
    pub(crate) fn add_columns(&self, columns: &mut PackedColumns, places: &[Option<u32>]) {
        let overlay = self.overlay(places);
        columns.bytes("kind", &overlay.kinds);
        columns.words("movedIndex", &overlay.moved_index);
        columns.vectors("moved", &overlay.moved);
        columns.vectors("extra", &overlay.extra);
        columns.words("extraPhoton", &overlay.extra_photon);
        columns.shorts("extraBounce", &overlay.extra_bounce);
        columns.shorts("extraSurface", &overlay.extra_surface);
    }

    /// The overlay; `places` has the place of each record of the reference among the page's
    /// photons.
    fn overlay(&self, places: &[Option<u32>]) -> Overlay {
        let shown = places.iter().flatten().count();
        let mut overlay = Overlay { kinds: vec![0; shown], ..Overlay::default() };
        let extra = || self.pairings.iter().filter(|pairing| matches!(pairing, Pairing::Extra(_)));
        let every = extra().count() / MOST_EXTRA + 1;
        let mut number_of_extra = 0;
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
                            overlay.moved.push(b.position.to_array());
                        }
                    }
                }
                Pairing::Extra(j) => {
                    number_of_extra += 1;
                    let record = &self.submission.records[j];
                    if number_of_extra % every == 0 && record.position.is_finite() {
                        overlay.extra.push(record.position.to_array());
                        overlay.extra_photon.push(record.photon);
                        overlay.extra_bounce.push(record.bounce);
                        overlay.extra_surface.push(record.surface);
                    }
                }
            }
        }
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
