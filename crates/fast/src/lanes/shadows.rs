//! Shadow rays, made in lanes.

use glam::Vec3;
use pulp::NullaryFnOnce;

use super::cells::{CELLS, cell_of};
use super::closest_hit::{Hits, NONE};
use super::rays::{GROUP, Rays};
use photon_mapping::scene::point_light::PointLight;

/// What a group of camera rays sees, by coordinate and channel. Lanes that see nothing reflect
/// nothing.
#[derive(Default)]
pub struct SeenPoints {
    /// The points.
    pub points: [[f32; GROUP]; 3],
    /// The unit normals there.
    pub normals: [[f32; GROUP]; 3],
    /// The diffuse responses there.
    pub responses: [[f32; GROUP]; 3],
    /// [`photon_mapping::scene::Scene::offset`] there.
    pub needed: [f32; GROUP],
}

/// Shadow rays from what is seen to one light.
#[derive(Default)]
pub struct ShadowRays {
    /// The rays. Those that carry no color meet nothing.
    pub rays: Rays,
    /// What they meet.
    pub obstacles: Hits,
    /// The colors that arrive along them unless something is in between.
    pub colors: [[f32; GROUP]; 3],
    /// The cells in which they lie seen from the light; [`CELLS`] for those that carry no color.
    pub cells: [u32; GROUP],
}

/// Finds the points that rays meet.
pub struct MetPoints<'a> {
    /// The rays.
    pub rays: &'a Rays,
    /// What they meet.
    pub hits: &'a Hits,
    /// Where the points go.
    pub points: &'a mut [[f32; GROUP]; 3],
}

impl NullaryFnOnce for MetPoints<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let Rays { origin, direction, .. } = self.rays;
        for ((points, origin), direction) in self.points.iter_mut().zip(origin).zip(direction) {
            for lane in 0..GROUP {
                points[lane] = origin[lane] + self.hits.t[lane] * direction[lane];
            }
        }
    }
}

/// Makes the shadow rays of [`photon_mapping::rendering::backward_renderer::light_towards`].
pub struct Towards<'a> {
    /// Where they start.
    pub seen: &'a SeenPoints,
    /// Where they end.
    pub light: &'a PointLight,
    /// Where they go.
    pub shadows: &'a mut ShadowRays,
}

impl NullaryFnOnce for Towards<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let SeenPoints { points, normals, responses, needed } = self.seen;
        let ShadowRays { rays, colors, cells, .. } = self.shadows;
        for lane in 0..GROUP {
            let of_lane = |of: &[[f32; GROUP]; 3]| Vec3::new(of[0][lane], of[1][lane], of[2][lane]);
            let (point, normal) = (of_lane(points), of_lane(normals));
            let start = point + needed[lane] * normal;
            let to_light = self.light.position - start;
            let distance = to_light.length();
            let direction = to_light / distance;
            let cosine = normal.dot(direction).max(0.0);
            let color = of_lane(responses) * self.light.color * cosine;
            let is_lit = (color.x != 0.0) | (color.y != 0.0) | (color.z != 0.0);
            let cell = cell_of(-to_light);
            cells[lane] = if is_lit { cell } else { CELLS as u32 };
            (rays.origin[0][lane], colors[0][lane]) = (start.x, color.x);
            (rays.origin[1][lane], colors[1][lane]) = (start.y, color.y);
            (rays.origin[2][lane], colors[2][lane]) = (start.z, color.z);
            rays.direction[0][lane] = if is_lit { direction.x } else { f32::NAN };
            rays.direction[1][lane] = direction.y;
            rays.direction[2][lane] = direction.z;
            rays.max_t[lane] = distance;
        }
    }
}

/// Adds the colors that arrive.
pub struct Arrive<'a> {
    /// What they arrive along.
    pub shadows: &'a ShadowRays,
    /// Where they go.
    pub colors: &'a mut [[f32; GROUP]; 3],
}

impl NullaryFnOnce for Arrive<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let ShadowRays { rays, obstacles, colors: arriving, .. } = self.shadows;
        for (colors, arriving) in self.colors.iter_mut().zip(arriving) {
            for lane in 0..GROUP {
                // Any obstacle before the light hides it, so the closest one does.
                let is_clear =
                    (obstacles.triangle[lane] == NONE) | (obstacles.t[lane] >= rays.max_t[lane]);
                colors[lane] += if is_clear { arriving[lane] } else { 0.0 };
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lanes::views::Sightlines;
    use crate::lanes::width::Width;
    use photon_mapping::random::photon_random;
    use photon_mapping::scene::Scene;
    use photon_mapping::scene::triangle::{ShearedRay, Triangle};

    /// Rays from a grid to lights on it, exactly past corners and edges, which others seldom do.
    #[test]
    fn no_triangle_before_a_light_is_left_out() {
        let (mut met, mut left_out) = (0, 0);
        for number in 0..300 {
            let mut random = photon_random(14, number);
            let scale = [1.0, 1e-3, 0.3][number as usize % 3];
            let mut point =
                || Vec3::from_array([0; 3].map(|_| scale * ((random() * 7.0).floor() - 3.0)));
            let triangles: Vec<Triangle> = (0..12)
                .map(|_| Triangle {
                    vertices: [point(), point(), point()],
                    normal: Vec3::Z,
                    parent_mesh_object: 0,
                    facet: 0,
                })
                .collect();
            let light = &PointLight { position: point(), color: Vec3::ONE };
            let mut seen = SeenPoints::default();
            for lane in 0..GROUP {
                let Triangle { vertices: [a, b, c], .. } = triangles[lane % triangles.len()];
                let start = [a, 0.5 * (b + c), (a + b + c) / 3.0, point()][lane % 4];
                let normal = (light.position - start).normalize_or(Vec3::Z);
                for axis in 0..3 {
                    seen.points[axis][lane] = start[axis];
                    seen.normals[axis][lane] = normal[axis];
                    seen.responses[axis][lane] = 1.0;
                }
                seen.needed[lane] = [0.0, 1e-5, 1e-6][lane % 3] * scale;
            }
            let scene = Scene::new(Vec::new(), triangles, Vec::new());
            let view = Sightlines::new(&scene, light.position);
            for width in Width::available() {
                let mut shadows = ShadowRays::default();
                width.run(Towards { seen: &seen, light, shadows: &mut shadows });
                for (lane, cell) in shadows.cells.into_iter().enumerate() {
                    let (ray, bits) = (shadows.rays.ray(lane), view.bits(&[cell]));
                    left_out += 12 - bits.count_ones();
                    let sheared = ShearedRay::new(&ray);
                    for (index, triangle) in scene.triangles().iter().enumerate() {
                        if triangle.intersect(&sheared).is_some_and(|t| t < ray.max_t) {
                            met += 1;
                            assert!(bits >> index & 1 == 1, "{triangle:?} {ray:?}");
                        }
                    }
                }
            }
        }
        assert!(met > 10_000 && left_out > 100_000, "{met} {left_out}");
    }
}
