//! What photons straight from a light meet: the test of [`photon_mapping::scene::triangle`] with
//! photons in the lanes that all may meet the same triangles.
//!
//! Photons wait in a queue of their [`Outlook`]'s list of triangles until the lanes are full. So
//! nothing depends on which list it is, which no processor could predict.

use glam::Vec3;
use pulp::NullaryFnOnce;

use super::LaneSurface;
use super::closest_hit::{NONE, greatest, least, mask};
use super::draws::Draws;
use super::outlook::Outlook;
use photon_mapping::scene::Scene;
use photon_mapping::scene::ray::{IntersectionState, Ray};

/// How many photons wait before they are tested.
pub const LANES: usize = 16;

/// A photon on its way from the light: all that waits of it, in one line of the cache.
#[derive(Clone, Copy, Debug, Default)]
#[repr(align(32))]
pub struct EmittedPhoton {
    /// The point in the sphere that it drew.
    pub point: [f32; 3],
    /// The numbers with which it goes on.
    pub draws: Draws,
}

/// Photons of the same list.
pub type Queue = [EmittedPhoton; LANES];

/// What the photons of a queue meet.
#[derive(Clone, Debug)]
pub struct FirstHits {
    /// Along which unit vectors they fly, by coordinate.
    pub direction: [[f32; LANES]; 3],
    /// How far.
    pub t: [f32; LANES],
    /// The triangles, or [`NONE`].
    pub triangle: [u32; LANES],
    /// The probabilities of reflection there; 0 where nothing is met.
    pub reflection: [f32; LANES],
    /// Not 0 where an edge function that decides was rounded to zero, or where a photon came from
    /// behind: see [`Self::settle`].
    is_doubtful: [u32; LANES],
}

impl Default for FirstHits {
    fn default() -> Self {
        Self {
            direction: [[0.0; LANES]; 3],
            t: [0.0; LANES],
            triangle: [NONE; LANES],
            reflection: [0.0; LANES],
            is_doubtful: [0; LANES],
        }
    }
}

impl FirstHits {
    /// Asks [`Scene::trace`] for those of the first `count` photons that are in doubt.
    pub fn settle(&mut self, scene: &Scene, surfaces: &[LaneSurface], light: Vec3, count: usize) {
        for lane in 0..count {
            if self.is_doubtful[lane] != 0 {
                let mut state = IntersectionState::new();
                let is_met = scene.trace(&Ray::new(light, self.direction(lane)), Some(&mut state));
                let met = state.intersected_primitive;
                self.t[lane] = state.intersection_t;
                self.triangle[lane] = if is_met { met as u32 } else { NONE };
                self.reflection[lane] =
                    if is_met { surfaces[met].probability_of_reflection } else { 0.0 };
            }
        }
    }

    /// The unit vector in `lane`.
    #[inline(always)]
    pub fn direction(&self, lane: usize) -> Vec3 {
        Vec3::from_array([0, 1, 2].map(|c| self.direction[c][lane]))
    }
}

/// Finds what the photons of a queue meet.
pub struct Meet<'a> {
    /// What their light sees.
    pub outlook: &'a Outlook,
    /// Their list.
    pub list: usize,
    /// The triangles of the scene.
    pub surfaces: &'a [LaneSurface],
    /// The photons.
    pub queue: &'a Queue,
    /// Where the answers go.
    pub hits: &'a mut FirstHits,
}

impl NullaryFnOnce for Meet<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let Self { outlook, list, surfaces, queue, hits } = self;
        let (axis, candidates) = outlook.candidates(list);
        let (mut x, mut y, mut z) = ([0.0; LANES], [0.0; LANES], [0.0; LANES]);
        for (lane, photon) in queue.iter().enumerate() {
            [x[lane], y[lane], z[lane]] = photon.point;
        }
        let [dx, dy, dz] = &mut hits.direction;
        for lane in 0..LANES {
            let direction = Vec3::new(x[lane], y[lane], z[lane]).normalize();
            (dx[lane], dy[lane], dz[lane]) = (direction.x, direction.y, direction.z);
        }
        let [dx, dy, dz] = &hits.direction;
        let [along_x, along_y, along_z] = match axis {
            0 => [dy, dz, dx],
            1 => [dz, dx, dy],
            _ => [dx, dy, dz],
        };
        let (mut shear_x, mut shear_y, mut shear_z) = ([0.0; LANES], [0.0; LANES], [0.0; LANES]);
        for lane in 0..LANES {
            shear_x[lane] = along_x[lane] / along_z[lane];
            shear_y[lane] = along_y[lane] / along_z[lane];
            shear_z[lane] = 1.0 / along_z[lane];
        }
        let (mut closest_t, mut closest) = ([f32::INFINITY; LANES], [NONE; LANES]);
        let (mut reflection, mut doubt, mut behind) = ([0.0; LANES], [0; LANES], [0; LANES]);
        for &triangle in candidates {
            let [a, b, c] = outlook.seen(axis, triangle);
            let LaneSurface { probability_of_reflection, frame, .. } = &surfaces[triangle as usize];
            for lane in 0..LANES {
                let (sx, sy, sz) = (shear_x[lane], shear_y[lane], shear_z[lane]);
                let (ax, ay, az) = (a.x - sx * a.z, a.y - sy * a.z, sz * a.z);
                let (bx, by, bz) = (b.x - sx * b.z, b.y - sy * b.z, sz * b.z);
                let (cx, cy, cz) = (c.x - sx * c.z, c.y - sy * c.z, sz * c.z);
                let u = cx * by - cy * bx;
                let v = ax * cy - ay * cx;
                let w = bx * ay - by * ax;
                let (least, greatest) = (least(u, v, w), greatest(u, v, w));
                let t = (u * az + v * bz + w * cz) / (u + v + w);
                let is_met = !(mask(least < 0.0) & mask(greatest > 0.0));
                let is_closer = is_met & mask(t > 0.0) & mask(t < closest_t[lane]);
                let of_floats = |new: f32, old: f32| {
                    f32::from_bits((new.to_bits() & is_closer) | (old.to_bits() & !is_closer))
                };
                closest_t[lane] = of_floats(t, closest_t[lane]);
                reflection[lane] = of_floats(*probability_of_reflection, reflection[lane]);
                closest[lane] = (triangle & is_closer) | (closest[lane] & !is_closer);
                // As `Triangle::faces`.
                let cosine = dx[lane] * frame[6] + dy[lane] * frame[7] + dz[lane] * frame[8];
                behind[lane] = (mask(cosine > 0.0) & is_closer) | (behind[lane] & !is_closer);
                // Beside a true negative and a true positive one, a zero changes nothing.
                doubt[lane] |= mask(least == 0.0) | mask(greatest == 0.0);
            }
        }
        for lane in 0..LANES {
            doubt[lane] |= behind[lane];
        }
        (hits.t, hits.triangle) = (closest_t, closest);
        (hits.reflection, hits.is_doubtful) = (reflection, doubt);
    }
}

#[cfg(test)]
mod tests {
    use super::super::cells::cell_of;
    use super::*;
    use crate::lanes::width::Width;
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
            let surfaces: Vec<LaneSurface> = (0_u8..)
                .zip(&triangles)
                .map(|(number, triangle)| LaneSurface {
                    mesh_object: 0,
                    probability_of_reflection: 0.01 * f32::from(number + 1),
                    frame: [[0.0; 3], [0.0; 3], triangle.normal.to_array()]
                        .as_flattened()
                        .try_into()
                        .expect("nine numbers"),
                })
                .collect();
            let scene = Scene::new(Vec::new(), triangles, Vec::new());
            let outlook = Outlook::new(&scene, light, &[1.0; 12]);
            let mut hits = FirstHits::default();
            for target in targets {
                let aside = target - light;
                if aside == Vec3::ZERO {
                    continue;
                }
                let list = outlook.list(cell_of(aside));
                let point = aside.to_array();
                let queue = [EmittedPhoton { point, draws: Draws::default() }; LANES];
                let direction = aside.normalize();
                let mut state = IntersectionState::new();
                let is_met = scene.trace(&Ray::new(light, direction), Some(&mut state));
                for width in Width::available() {
                    let (outlook, surfaces, queue) = (&outlook, &surfaces[..], &queue);
                    width.run(Meet { outlook, list, surfaces, queue, hits: &mut hits });
                    hits.settle(&scene, surfaces, light, LANES);
                    for lane in 0..LANES {
                        assert_eq!(hits.direction(lane), direction);
                        assert_eq!(is_met, hits.triangle[lane] != NONE);
                        let expected = if is_met {
                            assert_eq!(state.intersected_primitive as u32, hits.triangle[lane]);
                            assert_eq!(state.intersection_t.to_bits(), hits.t[lane].to_bits());
                            met += 1;
                            surfaces[state.intersected_primitive].probability_of_reflection
                        } else {
                            0.0
                        };
                        assert_eq!(expected, hits.reflection[lane]);
                    }
                }
            }
        }
        assert!(met > 10_000, "{met}");
    }
}
