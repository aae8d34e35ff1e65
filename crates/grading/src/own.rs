//! Lists and pictures that this program itself wrote: anybody can hand in its right answer.

use std::sync::OnceLock;

use glam::Vec3;
use photon_mapping::assignment8;
use photon_mapping::photon_list::PhotonRecord;
use variants::run::Run;

use super::picture::view::View;
use crate::limits::own::{ABOVE_CHANCE, EMITTED, FOUND, FOUND_IN_PICTURES, NEAR, SEEDS};

/// Photons of this program's runs, by place.
struct Own {
    seeds: Vec<u64>,
    /// Where each photon lies, and the place of its seed in `seeds`.
    photons: Vec<(Vec3, usize)>,
    /// Cells, in order, each with the place in `photons` of one that is near it.
    near: Vec<([i32; 3], usize)>,
}

/// The seed of this program's run that `records` are of, or a part of, or hardly moved.
pub fn seed_of(records: &[PhotonRecord], seed_of_course: u64) -> Option<u64> {
    first_seed(seed_of_course, |own| own.seed_of(&own.near_to(records), FOUND))
}

/// The seed of this program's run whose photons make the `red` pixels of a picture in `view`.
pub fn seed_of_picture(red: &[bool], view: &View, seed_of_course: u64) -> Option<u64> {
    first_seed(seed_of_course, |own| own.seed_of(&own.with_dots(red, view), FOUND_IN_PICTURES))
}

/// The seed that `seed_of` finds among those that are usual, or near that of the course.
fn first_seed(seed_of_course: u64, seed_of: impl Fn(&Own) -> Option<u64>) -> Option<u64> {
    static USUAL: OnceLock<Own> = OnceLock::new();
    let usual = USUAL.get_or_init(|| Own::new((0..SEEDS).chain([assignment8::SEED]).collect()));
    let is_usual = usual.seeds.contains(&seed_of_course);
    let of_course = || Own::new([seed_of_course].into_iter().chain(0..8).collect());
    seed_of(usual).or_else(|| (!is_usual).then(|| seed_of(&of_course()))?)
}

impl Own {
    fn new(mut seeds: Vec<u64>) -> Self {
        seeds.sort_unstable();
        seeds.dedup();
        let mut photons = Vec::new();
        let run = Run::handout(0, EMITTED);
        let mut lanes = run.lanes().expect("lanes trace the handout's scene");
        for (at, seed) in seeds.iter().enumerate() {
            lanes.set_seed(*seed);
            let records = lanes.trace_piece(0..EMITTED);
            photons.extend(records.iter().map(|record| (record.position, at)));
        }
        let mut near = Vec::new();
        for (at, (position, _)) in photons.iter().enumerate() {
            let (low, high) = (cell(position - NEAR), cell(position + NEAR));
            for x in low[0]..=high[0] {
                for y in low[1]..=high[1] {
                    near.extend((low[2]..=high[2]).map(|z| ([x, y, z], at)));
                }
            }
        }
        near.sort_unstable();
        Self { seeds, photons, near }
    }

    /// For each photon, whether one of `records` is near it.
    fn near_to(&self, records: &[PhotonRecord]) -> Vec<Option<bool>> {
        let mut is_found = vec![Some(false); self.photons.len()];
        for record in records.iter().filter(|record| record.position.is_finite()) {
            let cell = cell(record.position);
            let first = self.near.partition_point(|(other, _)| *other < cell);
            for (_, at) in self.near[first..].iter().take_while(|(other, _)| *other == cell) {
                let distance = (self.photons[*at].0 - record.position).abs().max_element();
                if distance <= NEAR {
                    is_found[*at] = Some(true);
                }
            }
        }
        is_found
    }

    /// For each photon, whether its pixels are `red`, if `view` shows any.
    fn with_dots(&self, red: &[bool], view: &View) -> Vec<Option<bool>> {
        let is_red = |(position, _): &(Vec3, usize)| {
            let (mut seen, mut all_red) = (false, true);
            view.for_each_pixel_of(*position, |pixel| {
                seen = true;
                all_red &= red[pixel];
            });
            seen.then_some(all_red)
        };
        self.photons.iter().map(is_red).collect()
    }

    /// The seed of which far more photons are found than of the others, and this part at `least`.
    fn seed_of(&self, is_found: &[Option<bool>], least: f64) -> Option<u64> {
        let mut found = vec![(0.0, 0.0); self.seeds.len()];
        for ((_, seed), is_found) in self.photons.iter().zip(is_found) {
            if let Some(is_found) = *is_found {
                found[*seed].0 += f64::from(u8::from(is_found));
                found[*seed].1 += 1.0;
            }
        }
        let part = |(found, all): &(f64, f64)| found / f64::max(*all, 1.0);
        let mut order: Vec<usize> = (0..found.len()).collect();
        order.sort_by(|a, b| part(&found[*a]).total_cmp(&part(&found[*b])));
        let (best, usual) = (*order.last()?, part(&found[order[order.len() / 2]]));
        let deviation = (usual * (1.0 - usual) / found[best].1).sqrt();
        let least = least.max(usual + ABOVE_CHANCE * deviation);
        (part(&found[best]) >= least).then_some(self.seeds[best])
    }
}

fn cell(position: Vec3) -> [i32; 3] {
    (position / (2.0 * NEAR)).floor().to_array().map(|cells| cells as i32)
}
