//! The loop of `trace_photon` turned inside out: not one photon through all of its bounces, but
//! every step for many photons at once.
//!
//! Photons wait before a step until the lanes are full, whatever number of bounces lies behind
//! them. So they come out in no order, and the records are put in order at the end.

use std::ops::Range;

use glam::Vec3;

use super::cells::cell_of;
use super::chacha::number;
use super::closest_hit::{self, Closest, Hits, NONE, Rays};
use super::draws::{self, Draws};
use super::emission::{self, DRAWN_IN_VAIN, Emit, EmitAgain, LaneEmission, emit_one};
use super::first_hit::{self, EmittedPhoton, FirstHits, Meet, Queue};
use super::outlook::{NOWHERE, Outlook, UNKNOWN};
use super::scattering::Scatter;
use super::{LaneTracer, Stage};
use photon_mapping::photon_list::PhotonRecord;
use photon_mapping::scene::point_light::PointLight;
use photon_mapping::scene::ray::Ray;

/// How many photons on surfaces wait for their next numbers, so that the few that need two blocks
/// fill the lanes too.
const ENOUGH_LANDED: usize = 128;

/// A photon on a surface.
#[derive(Clone, Copy, Debug)]
struct Arrival {
    point: Vec3,
    /// How far it flew.
    t: f32,
    triangle: u32,
    /// How often it has bounced.
    bounce: u16,
}

/// Photons that leave their surfaces.
struct Leaving {
    count: usize,
    words: [[u32; closest_hit::GROUP]; 2],
    point: [[f32; closest_hit::GROUP]; 3],
    frame: [[f32; closest_hit::GROUP]; 9],
    needed: [f32; closest_hit::GROUP],
    /// Number, numbers drawn, and bounces with this one.
    photon: [(u32, u32, u16); closest_hit::GROUP],
    rays: Rays,
    hits: Hits,
}

/// The photons of one light on their way.
pub(super) struct Wave<'a, D> {
    tracer: &'a LaneTracer<'a>,
    outlook: &'a Outlook,
    light: Vec3,
    intensity: Vec3,
    max_bounces: u16,
    /// Those that wait for what they meet first, by the lists of the outlook. The last ones wait
    /// for more numbers.
    queues: Vec<Queue>,
    /// How many are in each queue.
    waiting: Vec<u8>,
    first_hits: FirstHits,
    leaving: Leaving,
    landed: Vec<Arrival>,
    numbers: Vec<Draws>,
    records: Vec<PhotonRecord>,
    /// Is told of every part that is done and for how many photons.
    done: D,
}

impl<'a, D: FnMut(Stage, usize)> Wave<'a, D> {
    pub(super) fn new(
        tracer: &'a LaneTracer<'a>,
        (light, outlook): (&PointLight, &'a Outlook),
        intensity: Vec3,
        done: D,
    ) -> Self {
        let most = tracer.renderer.max_photon_bounces.max(0);
        Self {
            tracer,
            outlook,
            light: light.position,
            intensity,
            max_bounces: u16::try_from(most).expect("a photon bounces at most 1000 times"),
            queues: vec![Queue::default(); outlook.lists() + 1],
            waiting: vec![0; outlook.lists() + 1],
            first_hits: FirstHits::default(),
            leaving: Leaving {
                count: 0,
                words: [[0; closest_hit::GROUP]; 2],
                point: [[0.0; closest_hit::GROUP]; 3],
                frame: [[0.0; closest_hit::GROUP]; 9],
                needed: [0.0; closest_hit::GROUP],
                photon: [(0, 0, 0); closest_hit::GROUP],
                rays: Rays::default(),
                hits: Hits::default(),
            },
            landed: Vec::new(),
            numbers: Vec::new(),
            records: Vec::new(),
            done,
        }
    }

    /// Traces the photons `photons` and gives the records of what they store.
    pub(super) fn trace(mut self, photons: Range<u64>) -> Vec<PhotonRecord> {
        if self.max_bounces == 0 {
            return Vec::new();
        }
        // Of the handout's photons, one in twenty is stored.
        self.records.reserve((photons.end - photons.start) as usize / 16);
        let mut emission = LaneEmission::default();
        for first in photons.clone().step_by(emission::GROUP) {
            let count = (photons.end - first).min(emission::GROUP as u64) as usize;
            self.emit(first as u32, count, &mut emission);
            if self.landed.len() >= ENOUGH_LANDED {
                self.play_roulette();
            }
        }
        // First those that wait for numbers, since they go on to other queues.
        for list in (0..self.queues.len()).rev() {
            self.forward(list);
        }
        while !self.landed.is_empty() || self.leaving.count > 0 {
            self.play_roulette();
            self.scatter();
        }
        let records = in_order(&self.records);
        (self.done)(Stage::Records, 0);
        records
    }

    /// Emits the `count` photons from number `first` on.
    fn emit(&mut self, first: u32, count: usize, emission: &mut LaneEmission<{ emission::GROUP }>) {
        let seed = self.tracer.renderer.seed;
        self.tracer.width.run(Emit { seed, first, emission });
        emission.cell[count..].fill(NOWHERE);
        self.sort_out(emission, |lane| first.wrapping_add(lane as u32));
    }

    /// Goes on with the rejection loops of the first `count` photons of `queue`.
    fn emit_again(&mut self, queue: &Queue, count: usize) {
        let mut emission = LaneEmission::default();
        let (seed, photons) = (self.tracer.renderer.seed, &queue.map(|photon| photon.draws.photon));
        self.tracer.width.run(EmitAgain { seed, photons, emission: &mut emission });
        for lane in 0..count {
            if emission.drawn[lane] == 0 {
                // Of 2000 photons, one.
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
    fn forward(&mut self, list: usize) {
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

    /// Draws for the photons on surfaces, and plays their roulette.
    fn play_roulette(&mut self) {
        let landed = std::mem::replace(&mut self.landed, Vec::with_capacity(2 * ENOUGH_LANDED));
        let mut numbers =
            std::mem::replace(&mut self.numbers, Vec::with_capacity(2 * ENOUGH_LANDED));
        draws::fill(self.tracer.width, self.tracer.renderer.seed, &mut numbers);
        (self.done)(Stage::Numbers, numbers.len());
        for (arrival, draws) in landed.iter().zip(&numbers) {
            let surface = &self.tracer.surfaces[arrival.triangle as usize];
            if number(draws.words[0]) < surface.probability_of_reflection
                && arrival.bounce < self.max_bounces
            {
                self.leave(arrival, draws);
            }
        }
        (self.done)(Stage::Scattering, 0);
    }

    /// Adds a photon that survived the roulette with the first of the words of `draws`.
    #[inline(always)]
    fn leave(&mut self, arrival: &Arrival, draws: &Draws) {
        let Arrival { point, t, triangle, bounce } = *arrival;
        let leaving = &mut self.leaving;
        let lane = leaving.count % closest_hit::GROUP;
        [leaving.words[0][lane], leaving.words[1][lane]] = [draws.words[1], draws.words[2]];
        for (column, coordinate) in leaving.point.iter_mut().zip(point.to_array()) {
            column[lane] = coordinate;
        }
        let frame = &self.tracer.surfaces[triangle as usize].frame;
        for (column, coordinate) in leaving.frame.iter_mut().zip(frame) {
            column[lane] = *coordinate;
        }
        let scene = &self.tracer.renderer.stored_scene;
        leaving.needed[lane] = scene.offset(triangle as usize, point, t);
        leaving.photon[lane] = (draws.photon, draws.drawn + 3, bounce + 1);
        leaving.count = lane + 1;
        if leaving.count == closest_hit::GROUP {
            self.scatter();
        }
    }

    /// Scatters the photons that leave, and stores them where they hit something.
    fn scatter(&mut self) {
        let tracer = self.tracer;
        let Leaving { count, words, point, frame, needed, photon, rays, hits } = &mut self.leaving;
        let count = std::mem::take(count);
        let offset = tracer.offset;
        tracer.width.run(Scatter { words, point, frame, needed, offset, rays });
        (self.done)(Stage::Scattering, count);
        tracer.width.run(Closest { scene: &tracer.corners, rays, hits });
        hits.settle(&tracer.renderer.stored_scene, rays, count);
        let mut lanes = [0; closest_hit::GROUP];
        let mut landed = 0;
        for (lane, triangle) in hits.triangle.iter().enumerate() {
            lanes[landed % closest_hit::GROUP] = lane as u8;
            landed += usize::from((*triangle != NONE) & (lane < count));
        }
        (self.done)(Stage::LaterHits, count);
        for lane in &lanes[..landed] {
            let lane = usize::from(*lane) % closest_hit::GROUP;
            let (ray, t, triangle) = (rays.ray(lane), hits.t[lane], hits.triangle[lane]);
            let (photon, drawn, bounce) = photon[lane];
            let point = ray.ray_position(t);
            self.landed.push(Arrival { point, t, triangle, bounce });
            self.numbers.push(Draws { photon, drawn, words: [0; 3] });
            self.records.push(PhotonRecord {
                position: point,
                intensity: self.intensity,
                to_light: -ray.ray_direction(),
                photon,
                bounce,
                surface: tracer.surfaces[triangle as usize].mesh_object,
            });
        }
        (self.done)(Stage::Records, landed);
    }
}

/// `records` in order of photon, then bounce. Those of a photon came in the order of its bounces.
fn in_order(records: &[PhotonRecord]) -> Vec<PhotonRecord> {
    let key =
        |(place, record): (usize, &PhotonRecord)| u64::from(record.photon) << 32 | place as u64;
    let mut keys: Vec<u64> = records.iter().enumerate().map(key).collect();
    keys.sort_unstable();
    keys.into_iter().map(|key| records[key as u32 as usize]).collect()
}
