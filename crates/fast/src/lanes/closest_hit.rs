//! What rays from anywhere meet: the test of [`photon_mapping::scene::triangle`] with a ray in
//! every lane.

use glam::Vec3;
use pulp::NullaryFnOnce;

use super::axes::{axis_of, turn};
use super::rays::{GROUP, GroupLanes, Rays};
use photon_mapping::scene::Scene;
use photon_mapping::scene::ray::IntersectionState;

/// No triangle.
pub const NONE: u32 = u32::MAX;

/// The triangles of a scene, with every corner named once: a ray turns and shears a corner for all
/// the triangles that share it. The same arithmetic gives the same bits however often it is done.
#[derive(Clone, Debug)]
pub struct SharedCorners {
    corners: Vec<Vec3>,
    /// The places of the corners in `corners`, and the triangle's index in the scene.
    triangles: Vec<([u32; 3], u32)>,
}

impl SharedCorners {
    /// The triangles of `scene`.
    pub fn new(scene: &Scene) -> Self {
        Self::of(scene, 0..scene.triangles().len() as u32)
    }

    /// Those `triangles` of `scene`, whose indices must ascend.
    pub fn of(scene: &Scene, triangles: impl IntoIterator<Item = u32>) -> Self {
        let mut corners: Vec<Vec3> = Vec::new();
        let mut of_bits = std::collections::HashMap::new();
        let mut place = |corner: Vec3| {
            *of_bits.entry(corner.to_array().map(f32::to_bits)).or_insert_with(|| {
                corners.push(corner);
                corners.len() as u32 - 1
            })
        };
        let triangles = triangles
            .into_iter()
            .map(|index| (scene.triangles()[index as usize].vertices.map(&mut place), index))
            .collect();
        Self { corners, triangles }
    }
}

/// What the rays meet.
#[derive(Clone, Debug)]
pub struct Hits {
    /// The distances.
    pub t: GroupLanes,
    /// The triangles, or [`NONE`].
    pub triangle: [u32; GROUP],
    /// Not 0 where an edge function that decides was rounded to zero, or where a triangle is
    /// within the error of the start: see [`Self::settle`].
    is_doubtful: [u32; GROUP],
    seen: Vec<[GroupLanes; 3]>,
}

impl Default for Hits {
    fn default() -> Self {
        Self {
            t: [f32::INFINITY; GROUP],
            triangle: [NONE; GROUP],
            is_doubtful: [0; GROUP],
            seen: Vec::new(),
        }
    }
}

/// Finds the closest triangle for every ray.
pub struct Closest<'a> {
    /// The triangles.
    pub scene: &'a SharedCorners,
    /// The rays.
    pub rays: &'a Rays,
    /// Where the answers go.
    pub hits: &'a mut Hits,
}

impl NullaryFnOnce for Closest<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let Self { scene, rays, hits } = self;
        let [origin_x, origin_y, origin_z] = &rays.origin;
        let [direction_x, direction_y, direction_z] = &rays.direction;
        let mut axis = [0; GROUP];
        let (mut shear_x, mut shear_y, mut shear_z) = ([0.0; GROUP], [0.0; GROUP], [0.0; GROUP]);
        for lane in 0..GROUP {
            let direction = Vec3::new(direction_x[lane], direction_y[lane], direction_z[lane]);
            axis[lane] = axis_of(direction);
            let Vec3 { x, y, z } = turn(axis[lane], direction);
            shear_x[lane] = x / z;
            shear_y[lane] = y / z;
            shear_z[lane] = 1.0 / z;
        }
        hits.seen.resize(scene.corners.len(), [[0.0; GROUP]; 3]);
        for (corner, [seen_x, seen_y, seen_z]) in scene.corners.iter().zip(&mut hits.seen) {
            for lane in 0..GROUP {
                let origin = Vec3::new(origin_x[lane], origin_y[lane], origin_z[lane]);
                let Vec3 { x, y, z } = turn(axis[lane], *corner - origin);
                seen_x[lane] = x - shear_x[lane] * z;
                seen_y[lane] = y - shear_y[lane] * z;
                seen_z[lane] = shear_z[lane] * z;
            }
        }
        let mut closest_t = [f32::INFINITY; GROUP];
        let mut closest = [NONE; GROUP];
        let mut doubt = [0; GROUP];
        for (triangle, index) in &scene.triangles {
            let [a, b, c] = triangle.map(|corner| &hits.seen[corner as usize]);
            for lane in 0..GROUP {
                let (ax, ay, bx) = (a[0][lane], a[1][lane], b[0][lane]);
                let (by, cx, cy) = (b[1][lane], c[0][lane], c[1][lane]);
                let u = cx * by - cy * bx;
                let v = ax * cy - ay * cx;
                let w = bx * ay - by * ax;
                let (least, greatest) = (least(u, v, w), greatest(u, v, w));
                // A determinant of zero gives a t that is infinite or not a number.
                let t = (u * a[2][lane] + v * b[2][lane] + w * c[2][lane]) / (u + v + w);
                let is_met = !(mask(least < 0.0) & mask(greatest > 0.0));
                let is_closer = is_met & mask(t > 0.0) & mask(t < closest_t[lane]);
                let kept = closest_t[lane].to_bits() & !is_closer;
                closest_t[lane] = f32::from_bits((t.to_bits() & is_closer) | kept);
                closest[lane] = (index & is_closer) | (closest[lane] & !is_closer);
                // Beside a true negative and a true positive one, a zero changes nothing.
                let is_at_start = is_met & mask(t.abs() <= rays.start_error[lane]);
                doubt[lane] |= mask(least == 0.0) | mask(greatest == 0.0) | is_at_start;
            }
        }
        (hits.t, hits.triangle, hits.is_doubtful) = (closest_t, closest, doubt);
    }
}

/// All bits or none. Masks keep the compiler from branching where it should stay in lanes.
#[inline(always)]
pub(super) fn mask(condition: bool) -> u32 {
    u32::from(condition).wrapping_neg()
}

/// The least of three, in the form for which every processor has an instruction.
#[inline(always)]
pub(super) fn least(u: f32, v: f32, w: f32) -> f32 {
    let least = if u < v { u } else { v };
    if least < w { least } else { w }
}

/// The greatest of three.
#[inline(always)]
pub(super) fn greatest(u: f32, v: f32, w: f32) -> f32 {
    let greatest = if u > v { u } else { v };
    if greatest > w { greatest } else { w }
}

impl Hits {
    /// Asks [`Scene::trace`] for those of the first `count` rays that are in doubt or came from
    /// behind: its second looks are rarely needed and not made in lanes.
    pub fn settle(&mut self, scene: &Scene, rays: &Rays, count: usize) {
        for lane in 0..count {
            let triangle = scene.triangles().get(self.triangle[lane] as usize);
            let is_from_behind =
                triangle.is_some_and(|triangle| !triangle.faces(rays.direction(lane)));
            if self.is_doubtful[lane] != 0 || is_from_behind {
                let mut state = IntersectionState::new();
                let is_met = scene.trace(&rays.ray(lane), Some(&mut state));
                self.t[lane] = state.intersection_t;
                self.triangle[lane] =
                    if is_met { state.intersected_primitive as u32 } else { NONE };
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lanes::width::Width;
    use photon_mapping::random::photon_random;
    use photon_mapping::scene::ray::Ray;
    use photon_mapping::scene::triangle::Triangle;

    /// Rays exactly at corners and edges, which scattered ones seldom are.
    #[test]
    fn closest_hits_are_those_of_the_scene() {
        let mut met = 0;
        for number in 0..300 {
            let mut random = photon_random(12, number);
            let mut point = || Vec3::from_array([0; 3].map(|_| (random() * 7.0).floor() - 3.0));
            let triangle = |vertices: [Vec3; 3]| Triangle {
                vertices,
                normal: Vec3::Z,
                parent_mesh_object: 0,
                facet: 0,
            };
            let triangles: Vec<Triangle> =
                (0..12).map(|_| triangle([point(), point(), point()])).collect();
            let mut rays = Rays::default();
            for lane in 0..GROUP {
                let Triangle { vertices: [a, b, c], .. } = triangles[lane % triangles.len()];
                let target = [a, 0.5 * (b + c), (a + b + c) / 3.0][lane % 3];
                let start = point();
                let direction = (target - start).try_normalize().unwrap_or(Vec3::X);
                let mut ray = Ray::new(start, direction);
                ray.start_error = [0.0, 0.6, 0.01][lane % 3];
                rays.set(lane, &ray);
            }
            let scene = Scene::new(Vec::new(), triangles, Vec::new());
            let corners = SharedCorners::new(&scene);
            for width in Width::available() {
                let mut hits = Hits::default();
                width.run(Closest { scene: &corners, rays: &rays, hits: &mut hits });
                hits.settle(&scene, &rays, GROUP);
                for lane in 0..GROUP {
                    let mut state = IntersectionState::new();
                    let is_met = scene.trace(&rays.ray(lane), Some(&mut state));
                    assert_eq!(is_met, hits.triangle[lane] != NONE);
                    if is_met {
                        assert_eq!(state.intersected_primitive as u32, hits.triangle[lane]);
                        assert_eq!(state.intersection_t.to_bits(), hits.t[lane].to_bits());
                        met += 1;
                    }
                }
            }
        }
        assert!(met > 5000, "{met}");
    }
}
