//! How photons are spread along the two axes of every facet, over bounces and over incoming
//! directions: finer than the cells that are judged, for the eye.

use std::ops::Range;

use rayon::prelude::*;

use grading::observation::CountsByPlace;
use grading::places::{FacetCells, Place, Places};
use photon_mapping::photon_list::PhotonRecord;
use variants::variation::{Simulation, Variation};

/// Into how many parts an axis is divided.
pub const BINS: usize = 16;
/// Bounces from this one on are counted together.
pub const LAST_BOUNCE: usize = 7;
/// How many photons a thread traces at once.
const PIECE: u64 = 1 << 16;
/// Another one than that of the reference, so that the curve is not the submission itself.
const SEED: u64 = 0x9_2020;

/// The two axes of a facet, each named after the world axis that it is closest to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Axis {
    /// `x`, `y` or `z`.
    pub name: char,
    /// That coordinate at the start and at the end: ascending.
    pub ends: [f64; 2],
    /// Whether the facet's own coordinate runs the other way.
    is_reversed: bool,
}

impl Axis {
    /// The axes of `facet`.
    pub fn of(facet: &FacetCells) -> [Self; 2] {
        [1, 3].map(|corner| {
            let [from, to] = [facet.corners[0], facet.corners[corner]].map(|c| c.to_array());
            let length = |axis: usize| (to[axis] - from[axis]).abs();
            let axis =
                (0..3).fold(0, |best, axis| if length(axis) > length(best) { axis } else { best });
            let is_reversed = to[axis] < from[axis];
            let mut ends = [from[axis], to[axis]];
            ends.sort_by(f64::total_cmp);
            Self { name: ['x', 'y', 'z'][axis], ends, is_reversed }
        })
    }

    /// x before y before z, so that z is up.
    pub fn order(axes: &[Self; 2]) -> [usize; 2] {
        if axes[0].name < axes[1].name { [0, 1] } else { [1, 0] }
    }

    /// `coordinate` of the facet, from 0 to 1 in ascending order of the world's.
    pub fn ascending(&self, coordinate: f64) -> f64 {
        if self.is_reversed { 1.0 - coordinate } else { coordinate }
    }
}

/// Counts along axes, over cells and over bounces.
#[derive(Clone, Debug, PartialEq)]
pub struct Profile {
    /// By facet and axis.
    pub along: Vec<[[f64; BINS]; 2]>,
    /// By place.
    pub counts: CountsByPlace,
    /// By bounce, the first that is stored being the first.
    pub bounces: [f64; LAST_BOUNCE],
    /// By the cosine between the direction to the light and the normal, of all facets together.
    pub cosines: [f64; BINS],
}

impl Profile {
    fn new(places: &Places) -> Self {
        let facets = places.facets.len();
        Self {
            along: vec![[[0.0; BINS]; 2]; facets],
            counts: CountsByPlace::new(places),
            bounces: [0.0; LAST_BOUNCE],
            cosines: [0.0; BINS],
        }
    }

    /// That of `records`, whose first bounce is `first_bounce`.
    pub fn of(records: &[PhotonRecord], places: &Places, first_bounce: u16) -> Self {
        let axes: Vec<[Axis; 2]> = places.facets.iter().map(Axis::of).collect();
        let mut profile = Self::new(places);
        for record in records {
            let position = record.position.as_dvec3();
            let place = places.place(position);
            profile.counts.add(place);
            let bounce = usize::from(record.bounce.saturating_sub(first_bounce));
            profile.bounces[bounce.min(LAST_BOUNCE - 1)] += 1.0;
            let Place::Cell { facet, .. } = place else { continue };
            if let Some(direction) = record.to_light.as_dvec3().try_normalize() {
                let cosine = direction.dot(places.facets[facet].normal).max(0.0);
                profile.cosines[((cosine * BINS as f64) as usize).min(BINS - 1)] += 1.0;
            }
            let coordinates = places.facets[facet].coordinates(position);
            for axis in 0..2 {
                let along = axes[facet][axis].ascending(coordinates[axis]);
                let bin = (along.clamp(0.0, 1.0) * BINS as f64) as usize;
                profile.along[facet][axis][bin.min(BINS - 1)] += 1.0;
            }
        }
        profile
    }

    /// What is expected of `emitted` photons under `variation`, measured with `photons`.
    pub fn expected(
        variation: Variation,
        max_bounces: i32,
        places: &Places,
        photons: u64,
        emitted: f64,
    ) -> Self {
        let simulation = Simulation::new(variation, SEED, photons, max_bounces);
        let first = variation.storage.first();
        let piece = |start: u64| {
            let range: Range<u64> = start..photons.min(start + PIECE);
            Self::of(&simulation.trace(range), places, first)
        };
        let starts: Vec<u64> = (0..photons).step_by(PIECE as usize).collect();
        let pieces: Vec<Self> = starts.par_iter().map(|start| piece(*start)).collect();
        let mut sum = Self::new(places);
        pieces.iter().for_each(|piece| sum.add(piece));
        sum.scaled(emitted / photons as f64)
    }

    fn numbers(&mut self) -> impl Iterator<Item = &mut f64> {
        let CountsByPlace { cells, corner, footprint, off_surface, not_finite } = &mut self.counts;
        cells
            .iter_mut()
            .chain([corner, footprint, off_surface, not_finite])
            .chain(self.along.iter_mut().flatten().flatten())
            .chain(&mut self.bounces)
            .chain(&mut self.cosines)
    }

    fn add(&mut self, other: &Self) {
        let mut other = other.clone();
        self.numbers().zip(other.numbers()).for_each(|(sum, number)| *sum += *number);
    }

    /// All counts times `factor`.
    pub fn scaled(mut self, factor: f64) -> Self {
        self.numbers().for_each(|number| *number *= factor);
        self
    }
}
