//! The loop of `trace_photon` turned inside out: not one photon through all of its bounces, but one
//! bounce for all photons of a wave.

use std::ops::Range;

use glam::Vec3;

use super::chacha::{self, number};
use super::closest_hit::{self, Closest, Hits, NONE, Rays};
use super::draws::{self, Draws};
use super::emission::{self, Aim, Aims, Emit, LaneEmission, coordinate, is_in_sphere};
use super::first_hit::{FirstHit, FirstHits};
use super::outlook::Outlook;
use super::scattering::Scatter;
use super::{LaneSurface, LaneTracer, Stage};
use photon_mapping::photon_list::PhotonRecord;
use photon_mapping::scene::point_light::PointLight;
use photon_mapping::scene::ray::Ray;

/// A photon on its way from the light.
#[derive(Clone, Copy, Debug)]
struct EmittedPhoton {
    direction: Vec3,
    /// The numbers with which it goes on.
    draws: Draws,
}

/// A photon on a surface.
#[derive(Clone, Copy, Debug)]
struct Arrival {
    point: Vec3,
    /// Where it came from: the unit vector along which it flew.
    direction: Vec3,
    /// How far.
    t: f32,
    triangle: u32,
}

/// The photons that are on a surface after the same number of bounces, in order.
#[derive(Clone, Debug)]
struct Arrivals {
    places: Vec<Arrival>,
    /// The numbers with which each goes on.
    draws: Vec<Draws>,
}

impl Arrivals {
    fn with_capacity(count: usize) -> Self {
        Self { places: Vec::with_capacity(count), draws: Vec::with_capacity(count) }
    }
}

impl LaneTracer<'_> {
    /// Traces the photons `photons` of `light` and adds what they store to `records`. `done` is
    /// told of every part that is done and for how many photons, for those who take the time.
    pub(super) fn trace_wave(
        &self,
        light: &PointLight,
        outlook: &Outlook,
        light_intensity: Vec3,
        photons: Range<u64>,
        records: &mut Vec<PhotonRecord>,
        done: &mut impl FnMut(Stage, usize),
    ) {
        if self.renderer.max_photon_bounces < 0 {
            return;
        }
        let mut arrivals = self.emit(light, outlook, photons, done);
        let mut by_bounce: Vec<Vec<PhotonRecord>> = Vec::new();
        for bounce in 1..=self.renderer.max_photon_bounces {
            arrivals = self.scatter(&arrivals, done);
            if arrivals.places.is_empty() {
                break;
            }
            let bounce = u16::try_from(bounce).expect("a photon bounces at most 1000 times");
            let stored =
                arrivals.places.iter().zip(&arrivals.draws).map(|(arrival, draws)| PhotonRecord {
                    position: arrival.point,
                    intensity: light_intensity,
                    to_light: -arrival.direction,
                    photon: draws.photon,
                    bounce,
                    surface: self.surface(arrival).mesh_object,
                });
            by_bounce.push(stored.collect());
            done(Stage::Records, arrivals.places.len());
        }
        join(&by_bounce, records);
        done(Stage::Records, 0);
    }

    fn surface(&self, arrival: &Arrival) -> &LaneSurface {
        &self.surfaces[arrival.triangle as usize]
    }

    /// Where the photons `photons` of `light` hit first, in order, without some that are absorbed
    /// there.
    fn emit(
        &self,
        light: &PointLight,
        outlook: &Outlook,
        photons: Range<u64>,
        done: &mut impl FnMut(Stage, usize),
    ) -> Arrivals {
        let count = (photons.end - photons.start) as usize;
        let mut departures = self.depart(outlook, photons);
        done(Stage::Emission, count);
        let count = departures.len();
        let triangles = self.surfaces.len();
        let mut first_hits = FirstHits::new(outlook, self.width, triangles, departures.len());
        let mut point = [[0.0; emission::GROUP]; 3];
        let mut aims = Aims::default();
        for (group, departures) in departures.chunks_mut(emission::GROUP).enumerate() {
            for (lane, departure) in departures.iter().enumerate() {
                for (column, coordinate) in point.iter_mut().zip(departure.direction.to_array()) {
                    column[lane] = coordinate;
                }
            }
            let first = (group * emission::GROUP) as u32;
            self.width.run(Aim { point: &point, first, aims: &mut aims });
            for (lane, departure) in departures.iter_mut().enumerate() {
                departure.direction = Vec3::from_array([0, 1, 2].map(|c| aims.direction[c][lane]));
                first_hits.add(aims.cell[lane], aims.aimed[lane]);
            }
        }
        first_hits.finish();
        let mut arrivals = Arrivals::with_capacity(departures.len());
        let scene = &self.renderer.stored_scene;
        for (place, EmittedPhoton { direction, draws }) in departures.into_iter().enumerate() {
            let ray = Ray::new(light.position, direction);
            if let Some(FirstHit { t, triangle }) = first_hits.hit(place, scene, &ray) {
                let point = ray.ray_position(t);
                arrivals.places.push(Arrival { point, direction, t, triangle });
                arrivals.draws.push(draws);
            }
        }
        done(Stage::FirstHit, count);
        let count = self.complete(&mut arrivals.draws);
        done(Stage::Numbers, count);
        arrivals
    }

    /// Those of the photons `photons` that may hit something and be reflected there, in order, with
    /// directions that are not yet normalised.
    fn depart(&self, outlook: &Outlook, photons: Range<u64>) -> Vec<EmittedPhoton> {
        let mut emission = LaneEmission::default();
        // Of the handout's photons, one in five.
        let expected = (photons.end - photons.start) as usize / 4;
        let mut departures: Vec<EmittedPhoton> = Vec::with_capacity(expected);
        // The places of those for which the first block was not long enough.
        let mut again = Vec::new();
        for first in photons.clone().step_by(emission::GROUP) {
            let count = (photons.end - first).min(emission::GROUP as u64) as usize;
            let first = first as u32;
            let seed = self.renderer.seed;
            self.width.run(Emit { seed, first, emission: &mut emission });
            // Without a branch, since which photons these are cannot be predicted.
            let mut lanes = [0; emission::GROUP];
            let mut departing = 0;
            for (lane, (cell, roulette)) in emission.cell.iter().zip(&emission.next[0]).enumerate()
            {
                lanes[departing % emission::GROUP] = lane as u8;
                departing += usize::from(outlook.may_go_on(*cell, *roulette) & (lane < count));
            }
            departures.extend(lanes[..departing].iter().map(|&lane| {
                let at = usize::from(lane) % emission::GROUP;
                EmittedPhoton {
                    direction: Vec3::from_array([0, 1, 2].map(|c| emission.point[c][at])),
                    draws: Draws {
                        photon: first.wrapping_add(lane.into()),
                        drawn: emission.drawn[at],
                        words: [0, 1, 2].map(|n| emission.next[n][at]),
                    },
                }
            }));
            let places = departures.len() - departing..departures.len();
            again.extend(places.filter(|place| departures[*place].draws.drawn == 0));
        }
        self.try_again(&mut departures, again);
        departures
    }

    /// Draws again what the first block was not long enough for, and counts it.
    fn complete(&self, draws: &mut [Draws]) -> usize {
        let is_lacking = |draws: &Draws| draws.drawn + 3 > chacha::WORDS as u32;
        let lacking: Vec<usize> = (0..draws.len()).filter(|at| is_lacking(&draws[*at])).collect();
        let mut completed: Vec<Draws> = lacking.iter().map(|at| draws[*at]).collect();
        draws::fill(self.width, self.renderer.seed, &mut completed);
        let count = lacking.len();
        for (at, completed) in lacking.into_iter().zip(completed) {
            draws[at] = completed;
        }
        count
    }

    /// Goes on with the rejection loops of the departures at `places`.
    fn try_again(&self, departures: &mut [EmittedPhoton], mut places: Vec<usize>) {
        let of_place = |place: &usize| {
            let photon = departures[*place].draws.photon;
            Draws { photon, drawn: emission::DRAWN_IN_VAIN, words: [0; 3] }
        };
        let mut tries: Vec<Draws> = places.iter().map(of_place).collect();
        while !tries.is_empty() {
            draws::fill(self.width, self.renderer.seed, &mut tries);
            let mut remaining = 0;
            for at in 0..tries.len() {
                let mut draws = tries[at];
                draws.drawn += 3;
                let point = Vec3::from_array(draws.words.map(coordinate));
                let departure = &mut departures[places[at]];
                (departure.direction, departure.draws.drawn) = (point, draws.drawn);
                (tries[remaining], places[remaining]) = (draws, places[at]);
                remaining += usize::from(!is_in_sphere(point));
            }
            tries.truncate(remaining);
        }
    }

    /// Plays the roulette for all of `arrivals`, scatters those that survive, and gives what these
    /// hit next.
    fn scatter(&self, arrivals: &Arrivals, done: &mut impl FnMut(Stage, usize)) -> Arrivals {
        let mut survivors = Vec::with_capacity(arrivals.places.len());
        for (place, (arrival, draws)) in arrivals.places.iter().zip(&arrivals.draws).enumerate() {
            if number(draws.words[0]) < self.surface(arrival).probability_of_reflection {
                survivors.push(place);
            }
        }
        let mut words = [[0; closest_hit::GROUP]; 2];
        let mut point = [[0.0; closest_hit::GROUP]; 3];
        let mut frame = [[0.0; closest_hit::GROUP]; 9];
        let mut needed = [0.0; closest_hit::GROUP];
        let mut rays = Rays::default();
        let mut hits = Hits::default();
        // Of the handout's photons, one in four.
        let mut next = Arrivals::with_capacity(survivors.len() / 3);
        for group in survivors.chunks(closest_hit::GROUP) {
            for (lane, place) in group.iter().enumerate() {
                let (arrival, draws) = (&arrivals.places[*place], &arrivals.draws[*place]);
                [words[0][lane], words[1][lane]] = [draws.words[1], draws.words[2]];
                for (column, coordinate) in point.iter_mut().zip(arrival.point.to_array()) {
                    column[lane] = coordinate;
                }
                for (column, coordinate) in frame.iter_mut().zip(self.surface(arrival).frame) {
                    column[lane] = coordinate;
                }
                let Arrival { point, t, triangle, .. } = *arrival;
                needed[lane] = self.renderer.stored_scene.offset(triangle as usize, point, t);
            }
            self.width.run(Scatter {
                words: &words,
                point: &point,
                frame: &frame,
                needed: &needed,
                offset: self.offset,
                rays: &mut rays,
            });
            done(Stage::Scattering, group.len());
            self.width.run(Closest { scene: &self.corners, rays: &rays, hits: &mut hits });
            hits.settle(&self.renderer.stored_scene, &rays, group.len());
            for (lane, place) in group.iter().enumerate() {
                if hits.triangle[lane] != NONE {
                    let ray = rays.ray(lane);
                    next.places.push(Arrival {
                        point: ray.ray_position(hits.t[lane]),
                        direction: ray.ray_direction(),
                        t: hits.t[lane],
                        triangle: hits.triangle[lane],
                    });
                    let Draws { photon, drawn, .. } = arrivals.draws[*place];
                    next.draws.push(Draws { photon, drawn: drawn + 3, words: [0; 3] });
                }
            }
            done(Stage::LaterHits, group.len());
        }
        draws::fill(self.width, self.renderer.seed, &mut next.draws);
        done(Stage::Numbers, next.draws.len());
        next
    }
}

/// The records of all bounces in order of photon, then bounce. A photon stored at its k-th bounce
/// was stored at every one before, so those of one photon are the heads of the first few lists.
fn join(by_bounce: &[Vec<PhotonRecord>], records: &mut Vec<PhotonRecord>) {
    let Some((first, later)) = by_bounce.split_first() else {
        return;
    };
    records.reserve(by_bounce.iter().map(Vec::len).sum());
    let mut later: Vec<_> = later.iter().map(|records| records.iter().peekable()).collect();
    for record in first {
        records.push(*record);
        for bounce in &mut later {
            let Some(next) = bounce.next_if(|next| next.photon == record.photon) else {
                break;
            };
            records.push(*next);
        }
    }
}
