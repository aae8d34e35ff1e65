//! From surface to surface.

use super::{Arrival, ENOUGH_LANDED, Leaving, Wave};
use crate::lanes::Stage;
use crate::lanes::chacha::number;
use crate::lanes::closest_hit::{Closest, NONE};
use crate::lanes::draws::{self, Draws};
use crate::lanes::rays;
use crate::lanes::scattering::Scatter;
use photon_mapping::photon_list::PhotonRecord;

impl<D: FnMut(Stage, usize)> Wave<'_, D> {
    /// Draws for the photons on surfaces, and plays their roulette.
    pub(super) fn play_roulette(&mut self) {
        let landed = std::mem::replace(&mut self.landed, Vec::with_capacity(2 * ENOUGH_LANDED));
        let mut numbers =
            std::mem::replace(&mut self.numbers, Vec::with_capacity(2 * ENOUGH_LANDED));
        draws::fill(self.tracer.width, self.tracer.seed, &mut numbers);
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
    pub(super) fn leave(&mut self, arrival: &Arrival, draws: &Draws) {
        let Arrival { point, t, triangle, bounce } = *arrival;
        let leaving = &mut self.leaving;
        let lane = leaving.count % rays::GROUP;
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
        if leaving.count == rays::GROUP {
            self.scatter();
        }
    }

    /// Scatters the photons that leave, and stores them where they hit something.
    pub(super) fn scatter(&mut self) {
        let tracer = self.tracer;
        let Leaving { count, words, point, frame, needed, photon, rays, hits } = &mut self.leaving;
        let count = std::mem::take(count);
        let offset = tracer.offset;
        tracer.width.run(Scatter { words, point, frame, needed, offset, rays });
        (self.done)(Stage::Scattering, count);
        tracer.width.run(Closest { scene: &tracer.corners, rays, hits });
        hits.settle(&tracer.renderer.stored_scene, rays, count);
        let mut lanes = [0; rays::GROUP];
        let mut landed = 0;
        for (lane, triangle) in hits.triangle.iter().enumerate() {
            lanes[landed % rays::GROUP] = lane as u8;
            landed += usize::from((*triangle != NONE) & (lane < count));
        }
        (self.done)(Stage::LaterHits, count);
        for lane in &lanes[..landed] {
            let lane = usize::from(*lane) % rays::GROUP;
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
