//! What photons straight from a light meet: the test of [`photon_mapping::scene::triangle`] with
//! photons in the lanes that all may meet the same triangle.
//!
//! Photons wait in a queue of the triangle until the lanes are full. So a triangle's corners are
//! loaded once for many photons, and nothing depends on which of two triangles a photon meets,
//! which no processor could predict.

use glam::Vec3;
use pulp::NullaryFnOnce;

use super::closest_hit::{NONE, greatest, least, mask};
use super::outlook::Outlook;
use super::width::Width;
use photon_mapping::scene::Scene;
use photon_mapping::scene::ray::IntersectionState;
use photon_mapping::scene::ray::Ray;
use photon_mapping::scene::triangle::meet;

/// How many photons wait before they are tested.
const LANES: usize = 16;

/// The shears of a photon's direction, and the bits of its place among the photons of the search:
/// all that waits of it, in one line of the cache.
pub type Aimed = [f32; 4];

/// A photon's closest hit so far.
#[derive(Clone, Copy, Debug)]
pub struct FirstHit {
    /// The distance.
    pub t: f32,
    /// The triangle, or [`NONE`].
    pub triangle: u32,
}

/// Photons that wait to be tested with the same triangle.
#[derive(Clone, Debug)]
struct Queue {
    photons: [Aimed; LANES],
    waiting: usize,
}

/// The search for what photons of one light meet.
#[derive(Clone, Debug)]
pub struct FirstHits<'a> {
    outlook: &'a Outlook,
    width: Width,
    /// By axis, then triangle.
    queues: Vec<Queue>,
    triangles: usize,
    /// What each photon met, were there no edges where a back seems closer than a front.
    hits: Vec<FirstHit>,
}

impl<'a> FirstHits<'a> {
    /// A search for `photons` photons that see `outlook`, in a scene of `triangles` triangles.
    pub fn new(outlook: &'a Outlook, width: Width, triangles: usize, photons: usize) -> Self {
        let empty = Queue { photons: [[1.0; 4]; LANES], waiting: 0 };
        Self {
            outlook,
            width,
            queues: vec![empty; 3 * triangles],
            triangles,
            hits: vec![FirstHit { t: f32::INFINITY, triangle: NONE }; photons],
        }
    }

    /// Looks for what `photon` meets, whose direction is in `cell`.
    #[inline(always)]
    pub fn add(&mut self, cell: u32, photon: Aimed) {
        let axis = Outlook::axis(cell);
        for &triangle in self.outlook.candidates(cell) {
            let queue = &mut self.queues[axis * self.triangles + triangle as usize];
            let lane = queue.waiting % LANES;
            queue.photons[lane] = photon;
            queue.waiting = lane + 1;
            if queue.waiting == LANES {
                self.test(axis, triangle);
            }
        }
    }

    /// Tests those that still wait.
    pub fn finish(&mut self) {
        for axis in 0..3 {
            for triangle in 0..self.triangles {
                self.test(axis, triangle as u32);
            }
        }
    }

    /// What the photon at `place` met, whose ray is `ray`.
    #[inline(always)]
    pub fn hit(&self, place: usize, scene: &Scene, ray: &Ray) -> Option<FirstHit> {
        let hit = self.hits[place];
        let triangle = scene.triangles().get(hit.triangle as usize)?;
        if triangle.faces(ray.ray_direction()) {
            return Some(hit);
        }
        let mut state = IntersectionState::new();
        scene.trace(ray, Some(&mut state)).then_some(FirstHit {
            t: state.intersection_t,
            triangle: state.intersected_primitive as u32,
        })
    }

    fn test(&mut self, axis: usize, triangle: u32) {
        let queue = &mut self.queues[axis * self.triangles + triangle as usize];
        if queue.waiting == 0 {
            return;
        }
        let corners = self.outlook.seen(axis, triangle);
        let (mut t, mut is_doubtful) = ([0.0; LANES], [0; LANES]);
        self.width.run(Meet {
            corners,
            photons: &queue.photons,
            t: &mut t,
            is_doubtful: &mut is_doubtful,
        });
        for lane in 0..queue.waiting {
            if is_doubtful[lane] != 0 {
                let shear = Vec3::from_slice(&queue.photons[lane]);
                let sheared =
                    |c: Vec3| Vec3::new(c.x - shear.x * c.z, c.y - shear.y * c.z, shear.z * c.z);
                t[lane] = meet(corners.map(sheared)).filter(|t| *t > 0.0).unwrap_or(f32::INFINITY);
            }
            let hit = &mut self.hits[queue.photons[lane][3].to_bits() as usize];
            let is_tie = (t[lane] == hit.t) & (triangle < hit.triangle);
            let is_closer = mask((t[lane] < hit.t) | (is_tie & (hit.triangle != NONE)));
            let kept = hit.t.to_bits() & !is_closer;
            hit.t = f32::from_bits((t[lane].to_bits() & is_closer) | kept);
            hit.triangle = (triangle & is_closer) | (hit.triangle & !is_closer);
        }
        queue.waiting = 0;
    }
}

struct Meet<'a> {
    corners: &'a [Vec3; 3],
    photons: &'a [Aimed; LANES],
    /// Where the distances go; infinite where the triangle is not met.
    t: &'a mut [f32; LANES],
    /// Not 0 where an edge function that decides was rounded to zero: there `meet` looks again.
    is_doubtful: &'a mut [u32; LANES],
}

impl NullaryFnOnce for Meet<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let Self { corners: [a, b, c], photons, t, is_doubtful } = self;
        for lane in 0..LANES {
            let [sx, sy, sz, _] = photons[lane];
            let (ax, ay, az) = (a.x - sx * a.z, a.y - sy * a.z, sz * a.z);
            let (bx, by, bz) = (b.x - sx * b.z, b.y - sy * b.z, sz * b.z);
            let (cx, cy, cz) = (c.x - sx * c.z, c.y - sy * c.z, sz * c.z);
            let u = cx * by - cy * bx;
            let v = ax * cy - ay * cx;
            let w = bx * ay - by * ax;
            let (least, greatest) = (least(u, v, w), greatest(u, v, w));
            let distance = (u * az + v * bz + w * cz) / (u + v + w);
            let is_met = !(mask(least < 0.0) & mask(greatest > 0.0)) & mask(distance > 0.0);
            t[lane] =
                f32::from_bits((distance.to_bits() & is_met) | (f32::INFINITY.to_bits() & !is_met));
            is_doubtful[lane] = mask(least == 0.0) | mask(greatest == 0.0);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::outlook::aim;
    use super::*;
    use photon_mapping::random::photon_random;
    use photon_mapping::scene::triangle::Triangle;

    /// Photons fly exactly at corners and edges here, which drawn ones seldom do.
    #[test]
    fn first_hits_are_those_of_the_scene() {
        let mut met = 0;
        for number in 0..300 {
            let mut random = photon_random(11, number);
            let mut point = || Vec3::from_array([0; 3].map(|_| (random() * 7.0).floor() - 3.0));
            // Every other one is the back of the one before.
            let triangle =
                |vertices| Triangle { vertices, normal: Vec3::Z, parent_mesh_object: 0, facet: 0 };
            let triangles: Vec<Triangle> = (0..6)
                .map(|_| triangle([point(), point(), point()]))
                .flat_map(|front| [front, Triangle { normal: Vec3::NEG_Z, ..front }])
                .collect();
            let light = point();
            let mut targets: Vec<Vec3> = (0..20).map(|_| point()).collect();
            for Triangle { vertices: [a, b, c], .. } in &triangles {
                targets.extend([*a, 0.5 * (*b + *c), (*a + *b + *c) / 3.0]);
            }
            let directions = targets.iter().filter_map(|target| (*target - light).try_normalize());
            let directions: Vec<Vec3> = directions.collect();
            let scene = Scene::new(Vec::new(), triangles, Vec::new());
            let outlook = Outlook::new(&scene, light, &[1.0; 12]);
            for width in Width::available() {
                let mut found = FirstHits::new(&outlook, width, 12, directions.len());
                for (place, direction) in directions.iter().enumerate() {
                    let (cell, shear) = aim(*direction);
                    let place = f32::from_bits(place as u32);
                    found.add(cell, [shear.x, shear.y, shear.z, place]);
                }
                found.finish();
                for (place, direction) in directions.iter().enumerate() {
                    let mut state = IntersectionState::new();
                    let ray = Ray::new(light, *direction);
                    let is_met = scene.trace(&ray, Some(&mut state));
                    let hit = found.hit(place, &scene, &ray);
                    assert_eq!(is_met, hit.is_some());
                    if let Some(hit) = hit {
                        assert_eq!(state.intersected_primitive as u32, hit.triangle);
                        assert_eq!(state.intersection_t.to_bits(), hit.t.to_bits());
                        met += 1;
                    }
                }
            }
        }
        assert!(met > 1000, "{met}");
    }
}
