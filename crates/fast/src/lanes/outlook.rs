//! What a point light can hit in which direction, found out once for all of its photons.
//!
//! All photons of a point light start at one point, and three in four of the handout's leave the
//! scene at once. So each of the [`super::cells`] keeps the triangles that a ray through it *may*
//! meet: often none, mostly one.
//!
//! A photon straight from the light is not stored, so one that is absorbed at its first hit needs
//! no tracing. [`Outlook::may_go_on`] plays its roulette against the largest reflection in its
//! cell. [`super::first_hit`] tests those that remain.

use std::collections::HashMap;
use std::ops::Range;

use glam::Vec3;

use super::cells::{CELLS, OF_FACE};
use super::occlusion::{find_candidates, seen_from};
use photon_mapping::scene::Scene;

/// The cell of a photon whose direction is not known yet.
pub const UNKNOWN: u32 = CELLS as u32;
/// The cell of a photon that is not there.
pub const NOWHERE: u32 = UNKNOWN + 1;
/// [`CELLS`], [`UNKNOWN`] and [`NOWHERE`], with room up to the next power of two.
const ROUGH_CELLS: usize = (CELLS + 2).next_power_of_two();

/// The triangles of a scene as one light sees them.
#[derive(Clone, Debug)]
pub struct Outlook {
    /// The corners seen from the light, once for each axis that a ray runs along.
    seen: [Vec<[Vec3; 3]>; 3],
    /// The place of each cell's list, in `lists`. The last one is of [`UNKNOWN`].
    list_of_cell: Box<[u16; ROUGH_CELLS]>,
    lists: Vec<CandidateList>,
    triangles: Vec<u32>,
    /// The greatest probability of reflection that a photon through the cell may meet, in 128ths,
    /// rounded up: a byte a cell leaves room in the first-level cache.
    reflection: Box<[u8; ROUGH_CELLS]>,
}

/// What the rays of some cells may meet.
#[derive(Clone, Debug)]
struct CandidateList {
    /// The axis along which these rays run.
    axis: usize,
    /// Where in [`Outlook::triangles`] the triangles are, in ascending order.
    triangles: Range<usize>,
}

impl Outlook {
    /// The triangles of `scene` as seen from `origin`; `reflection` is each one's probability of
    /// reflection.
    pub fn new(scene: &Scene, origin: Vec3, reflection: &[f32]) -> Self {
        let seen = seen_from(scene, origin);
        // Of the cells in which there is nothing.
        let mut lists = vec![CandidateList { axis: 0, triangles: 0..0 }];
        let mut triangles = Vec::new();
        let mut list_of_cell = Box::new([0_u16; ROUGH_CELLS]);
        let mut places = HashMap::new();
        find_candidates(&seen, &mut |cell, of_cell| {
            let axis = cell / OF_FACE / 2;
            list_of_cell[cell] = *places.entry((axis, of_cell.to_vec())).or_insert_with(|| {
                let start = triangles.len();
                triangles.extend_from_slice(of_cell);
                lists.push(CandidateList { axis, triangles: start..triangles.len() });
                (lists.len() - 1) as u16
            });
        });
        // Of the cells that nothing is known of.
        list_of_cell[CELLS..].fill(lists.len() as u16);
        let greatest = |places: &mut dyn Iterator<Item = f32>| places.fold(0.0, f32::max);
        let of_scene = greatest(&mut reflection.iter().copied());
        let of_cell = |cell: usize| {
            if cell == UNKNOWN as usize {
                return of_scene;
            }
            if cell > CELLS {
                return 0.0;
            }
            let of_cell = &triangles[lists[usize::from(list_of_cell[cell])].triangles.clone()];
            greatest(&mut of_cell.iter().map(|triangle| reflection[*triangle as usize]))
        };
        let reflection = Box::new(std::array::from_fn(|cell| {
            (of_cell(cell) * 128.0).ceil().clamp(0.0, 128.0) as u8
        }));
        Self { seen, list_of_cell, lists, triangles, reflection }
    }

    /// Whether a photon through `cell` may meet something and be reflected there when its
    /// roulette's number is that of `word`.
    #[inline(always)]
    pub fn may_go_on(&self, cell: u32, word: u32) -> bool {
        // The number is at least this many 128ths.
        word >> 25 < u32::from(self.reflection[cell as usize % ROUGH_CELLS])
    }

    /// How many lists of triangles there are.
    pub fn lists(&self) -> usize {
        self.lists.len()
    }

    /// The place of the list of `cell`: [`Self::lists`] for [`UNKNOWN`].
    #[inline(always)]
    pub fn list(&self, cell: u32) -> usize {
        self.list_of_cell[cell as usize % ROUGH_CELLS].into()
    }

    /// The axis along which the rays of `list` run, and the triangles that they may meet, in
    /// ascending order.
    pub fn candidates(&self, list: usize) -> (usize, &[u32]) {
        let CandidateList { axis, triangles } = &self.lists[list];
        (*axis, &self.triangles[triangles.clone()])
    }

    /// The corners of `triangle` as rays along `axis` see them from the light, not yet sheared.
    pub fn seen(&self, axis: usize, triangle: u32) -> &[Vec3; 3] {
        &self.seen[axis][triangle as usize]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lanes::cells::cell_of;
    use crate::lanes::emission::{RADIUS, coordinate, is_in_sphere};
    use photon_mapping::assignment8;
    use photon_mapping::random::photon_random;

    #[test]
    fn nobody_is_sorted_out_who_may_meet_something() {
        let scene = assignment8::create_scene();
        let reflection = vec![0.3; scene.triangles().len()];
        let outlook = Outlook::new(&scene, scene.lights()[0].position, &reflection);
        let mut random = photon_random(5, 0);
        let mut kept = 0;
        for number in 0..400_000 {
            let mut words = [0, 1, 2].map(|_| ((random() * 16_777_216.0) as u32) << 8);
            match number % 4 {
                // Along the edges of the cube of directions, to the last place, on both sides.
                0 => words[1] = words[0].wrapping_add(0x100),
                1 => words[2] = !words[0] & !0xff,
                // Along the border of a cell.
                2 => {
                    let [x, _, z] = words.map(coordinate);
                    let border = z * (x * 16.0 / RADIUS).round() / 16.0;
                    words[0] = (((border / RADIUS + 1.0) * 8_388_608.0) as u32) << 8;
                }
                _ => {}
            }
            let point = Vec3::from_array(words.map(coordinate));
            if !is_in_sphere(point) {
                continue;
            }
            let normalized = cell_of(point.normalize());
            let rough = cell_of(point);
            let (axis, candidates) = outlook.candidates(outlook.list(normalized));
            if !candidates.is_empty() {
                kept += 1;
                let (rough_axis, rough_candidates) = outlook.candidates(outlook.list(rough));
                assert_eq!(rough_axis, axis, "{point:?}");
                assert!(!rough_candidates.is_empty(), "{point:?}");
                assert!(outlook.may_go_on(rough, 0), "{point:?}");
                // 0.3 lies between 38 and 39 of 128.
                assert!(outlook.may_go_on(rough, 38 << 25), "{point:?}");
                assert!(!outlook.may_go_on(rough, 39 << 25), "{point:?}");
            }
        }
        assert!(kept > 30_000, "{kept}");
    }
}
