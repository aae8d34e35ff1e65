//! The loop of `trace_photon` turned inside out: not one photon through all of its bounces, but
//! every step for many photons at once.
//!
//! Photons wait before a step until the lanes are full, whatever number of bounces lies behind
//! them. So they come out in no order, and the records are put in order at the end.

mod bounces;
mod departure;

use std::ops::Range;

use glam::Vec3;

use super::closest_hit::Hits;
use super::draws::Draws;
use super::emission::{self, LaneEmission};
use super::first_hit::{FirstHits, Queue};
use super::outlook::Outlook;
use super::rays::{self, Rays};
use super::{LaneTracer, Stage};
use photon_mapping::photon_list::PhotonRecord;
use photon_mapping::scene::point_light::PointLight;

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
    words: [[u32; rays::GROUP]; 2],
    point: [[f32; rays::GROUP]; 3],
    frame: [[f32; rays::GROUP]; 9],
    needed: [f32; rays::GROUP],
    /// Number, numbers drawn, and bounces with this one.
    photon: [(u32, u32, u16); rays::GROUP],
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
                words: [[0; rays::GROUP]; 2],
                point: [[0.0; rays::GROUP]; 3],
                frame: [[0.0; rays::GROUP]; 9],
                needed: [0.0; rays::GROUP],
                photon: [(0, 0, 0); rays::GROUP],
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
}

/// `records` in order of photon, then bounce. Those of a photon came in the order of its bounces.
fn in_order(records: &[PhotonRecord]) -> Vec<PhotonRecord> {
    let key =
        |(place, record): (usize, &PhotonRecord)| u64::from(record.photon) << 32 | place as u64;
    let mut keys: Vec<u64> = records.iter().enumerate().map(key).collect();
    keys.sort_unstable();
    keys.into_iter().map(|key| records[key as u32 as usize]).collect()
}
