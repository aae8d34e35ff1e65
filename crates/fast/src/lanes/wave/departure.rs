//! From the light to the first surface.

use glam::Vec3;

use super::{Arrival, Wave};
use crate::lanes::Stage;
use crate::lanes::cells::cell_of;
use crate::lanes::chacha::number;
use crate::lanes::draws::Draws;
use crate::lanes::emission::{self, DRAWN_IN_VAIN, Emit, EmitAgain, LaneEmission, emit_one};
use crate::lanes::first_hit::{self, EmittedPhoton, Meet, Queue};
use crate::lanes::outlook::{NOWHERE, UNKNOWN};
use photon_mapping::scene::ray::Ray;

impl<D: FnMut(Stage, usize)> Wave<'_, D> {
    /// Emits the `count` photons from number `first` on.
    pub(super) fn emit(
        &mut self,
        first: u32,
        count: usize,
        emission: &mut LaneEmission<{ emission::GROUP }>,
    ) {
        let seed = self.tracer.seed;
        self.tracer.width.run(Emit { seed, first, emission });
        emission.cell[count..].fill(NOWHERE);
        self.sort_out(emission, |lane| first.wrapping_add(lane as u32));
    }

    /// Goes on with the rejection loops of the first `count` photons of `queue`.
    fn emit_again(&mut self, queue: &Queue, count: usize) {
        let mut emission = LaneEmission::default();
        let (seed, photons) = (self.tracer.seed, &queue.map(|photon| photon.draws.photon));
        self.tracer.width.run(EmitAgain { seed, photons, emission: &mut emission });
        for lane in 0..count {
            if emission.drawn[lane] == 0 {
                // Very few photons get here.
                let EmittedPhoton { point, draws } = emit_one(seed, photons[lane]);
                for (column, coordinate) in emission.point.iter_mut().zip(point) {
                    column[lane] = coordinate;
                }
                for (column, word) in emission.next.iter_mut().zip(draws.words) {
                    column[lane] = word;
                }
                emission.drawn[lane] = draws.drawn;
                emission.cell[lane] = cell_of(Vec3::from_array(point));
            }
        }
        emission.cell[count..].fill(NOWHERE);
        self.sort_out(&emission, |lane| photons[lane % emission::AGAIN]);
    }

    /// Lets those photons of `emission` go on that may hit something and be reflected there.
    #[inline(always)]
    fn sort_out<const LANES: usize>(
        &mut self,
        emission: &LaneEmission<LANES>,
        photon: impl Fn(usize) -> u32,
    ) {
        let outlook = self.outlook;
        // Without a branch, since which photons these are cannot be predicted.
        let mut lanes = [0; LANES];
        let mut departing = 0;
        for (lane, (cell, roulette)) in emission.cell.iter().zip(&emission.next[0]).enumerate() {
            lanes[departing % LANES] = lane as u8;
            departing += usize::from(outlook.may_go_on(*cell, *roulette));
        }
        (self.done)(Stage::Emission, LANES);
        for lane in &lanes[..departing] {
            let lane = usize::from(*lane) % LANES;
            let drawn = emission.drawn[lane];
            let cell = if drawn == DRAWN_IN_VAIN && LANES == emission::GROUP {
                UNKNOWN
            } else {
                emission.cell[lane]
            };
            let list = outlook.list(cell);
            let point = [0, 1, 2].map(|c| emission.point[c][lane]);
            let words = [0, 1, 2].map(|n| emission.next[n][lane]);
            let draws = Draws { photon: photon(lane), drawn, words };
            self.wait(list, EmittedPhoton { point, draws });
        }
        (self.done)(Stage::FirstHit, departing);
    }

    /// Lets `photon` wait for others of `list`.
    #[inline(always)]
    fn wait(&mut self, list: usize, photon: EmittedPhoton) {
        let waiting = &mut self.waiting[list];
        let lane = usize::from(*waiting) % first_hit::LANES;
        *waiting = lane as u8 + 1;
        self.queues[list][lane] = photon;
        if lane + 1 == first_hit::LANES {
            self.forward(list);
        }
    }

    /// Finds what the waiting photons of `list` hit first, and plays their roulette.
    pub(super) fn forward(&mut self, list: usize) {
        let Self { tracer, outlook, .. } = *self;
        let waiting = usize::from(std::mem::take(&mut self.waiting[list]));
        if waiting == 0 {
            return;
        }
        if list == outlook.lists() {
            let queue = self.queues[list];
            return self.emit_again(&queue, waiting);
        }
        let (queue, hits) = (&self.queues[list], &mut self.first_hits);
        let surfaces = &tracer.surfaces;
        tracer.width.run(Meet { outlook, list, surfaces, queue, hits });
        hits.settle(&tracer.renderer.stored_scene, surfaces, self.light, waiting);
        let mut lanes = [0; first_hit::LANES];
        let mut reflected = 0;
        for (lane, (photon, reflection)) in queue.iter().zip(&hits.reflection).enumerate() {
            lanes[reflected % first_hit::LANES] = lane as u8;
            let is_reflected = number(photon.draws.words[0]) < *reflection;
            reflected += usize::from(is_reflected & (lane < waiting));
        }
        (self.done)(Stage::FirstHit, 0);
        for lane in &lanes[..reflected] {
            let lane = usize::from(*lane) % first_hit::LANES;
            let (queue, hits) = (&self.queues[list], &self.first_hits);
            let (t, triangle) = (hits.t[lane], hits.triangle[lane]);
            let point = Ray::new(self.light, hits.direction(lane)).ray_position(t);
            let draws = queue[lane].draws;
            self.leave(&Arrival { point, t, triangle, bounce: 0 }, &draws);
        }
        (self.done)(Stage::Scattering, 0);
    }
}
