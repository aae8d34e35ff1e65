//! One photon in f32 and in f64, by the same code: what is compared is the arithmetic alone.
//!
//! Step for step the reference's `trace_photon`, written once for both types; a test holds its f32
//! half against the reference, bit for bit. The scene is the one that the reference traces: its f32
//! figures, widened for f64. The random numbers are the same too; f64 holds them exactly.

use glam::{DVec3, Vec3};

/// Where one path hit, and how its emission was decided.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Path {
    /// How many points were drawn until one lay in the ball.
    pub tries: u32,
    /// The triangle and the point of every hit, in scene units; f32 points are widened.
    pub hits: Vec<(usize, DVec3)>,
}

macro_rules! tracer {
    ($(#[$doc:meta])* $module:ident, $scalar:ty, $vector:ty, $sin:path, $cos:path) => {
        $(#[$doc])*
        pub mod $module {
            use super::*;
            use photon_mapping::scene::Scene;

            struct PreparedFace {
                vertices: [$vector; 3],
                normal: $vector,
                probability_of_reflection: $scalar,
            }

            /// A scene in this precision, with its first light.
            pub struct PrecisionTracer {
                faces: Vec<PreparedFace>,
                light: $vector,
                offset: $scalar,
            }

            fn widen(vector: Vec3) -> $vector {
                <$vector>::new(vector.x.into(), vector.y.into(), vector.z.into())
            }

            impl PrecisionTracer {
                /// The scene and its first light; scattered rays start `offset` along the normal.
                pub fn new(scene: &Scene, offset: f64) -> Self {
                    let face = |triangle: &photon_mapping::scene::triangle::Triangle| {
                        let mesh_object = &scene.mesh_objects()[triangle.parent_mesh_object];
                        let diffuse = mesh_object.material.base_diffuse_reflection();
                        PreparedFace {
                            vertices: triangle.vertices.map(widen),
                            normal: widen(triangle.normal),
                            probability_of_reflection: diffuse.max_element().into(),
                        }
                    };
                    let light = widen(scene.lights()[0].position);
                    let faces = scene.triangles().iter().map(face).collect();
                    Self { faces, light, offset: offset as $scalar }
                }

                /// Follows one photon for up to 1001 hits; `path` is overwritten.
                pub fn trace(&self, rand: &mut impl FnMut() -> f32, path: &mut Path) {
                    let mut rand = || <$scalar>::from(rand());
                    path.hits.clear();
                    path.tries = 0;
                    let mut direction = loop {
                        path.tries += 1;
                        let x = 2.0 * rand() - 1.0;
                        let y = 2.0 * rand() - 1.0;
                        let z = 2.0 * rand() - 1.0;
                        let length_squared = x * x + y * y + z * z;
                        if length_squared <= 1.0 && length_squared > 0.0 {
                            break <$vector>::new(x, y, z).normalize();
                        }
                    };
                    let mut origin = self.light;
                    for _ in 0..=1000 {
                        let Some((face, t)) = self.closest(origin, direction) else { return };
                        let point = origin + t * direction;
                        let [x, y, z] = point.to_array().map(f64::from);
                        path.hits.push((face, DVec3::new(x, y, z)));
                        let face = &self.faces[face];
                        if rand() >= face.probability_of_reflection {
                            return;
                        }
                        let (u1, u2) = (rand(), rand());
                        direction = scatter(face.normal, u1, u2);
                        origin = point + self.offset * face.normal;
                    }
                }

                fn closest(&self, origin: $vector, direction: $vector) -> Option<(usize, $scalar)> {
                    let size = direction.abs();
                    let z = if size.x >= size.y && size.x >= size.z {
                        0
                    } else if size.y >= size.z {
                        1
                    } else {
                        2
                    };
                    let (x, y) = ((z + 1) % 3, (z + 2) % 3);
                    let shear = [
                        direction[x] / direction[z],
                        direction[y] / direction[z],
                        1.0 / direction[z],
                    ];
                    let mut closest: Option<(usize, $scalar)> = None;
                    for (index, face) in self.faces.iter().enumerate() {
                        let [a, b, c] = face.vertices.map(|vertex| {
                            let from_origin = vertex - origin;
                            let depth = from_origin[z];
                            <$vector>::new(
                                from_origin[x] - shear[0] * depth,
                                from_origin[y] - shear[1] * depth,
                                shear[2] * depth,
                            )
                        });
                        let mut u = c.x * b.y - c.y * b.x;
                        let mut v = a.x * c.y - a.y * c.x;
                        let mut w = b.x * a.y - b.y * a.x;
                        if u == 0.0 || v == 0.0 || w == 0.0 {
                            u = edge(c, b);
                            v = edge(a, c);
                            w = edge(b, a);
                        }
                        if (u < 0.0 || v < 0.0 || w < 0.0) && (u > 0.0 || v > 0.0 || w > 0.0) {
                            continue;
                        }
                        let determinant = u + v + w;
                        if determinant == 0.0 {
                            continue;
                        }
                        let t = (u * a.z + v * b.z + w * c.z) / determinant;
                        if t > 0.0 && closest.is_none_or(|(_, best)| t < best) {
                            closest = Some((index, t));
                        }
                    }
                    closest
                }
            }

            fn edge(p: $vector, q: $vector) -> $scalar {
                let [px, py, qx, qy] = [p.x, p.y, q.x, q.y].map(f64::from);
                (px * qy - py * qx) as $scalar
            }

            fn scatter(normal: $vector, u1: $scalar, u2: $scalar) -> $vector {
                let r = u1.sqrt();
                // The same rounded pi for both: the numbers are compared, not their meaning.
                let theta = 2.0 * <$scalar>::from(std::f32::consts::PI) * u2;
                let (x, y, z) = (r * $cos(theta), r * $sin(theta), (1.0 - u1).sqrt());
                let is_parallel = normal.x.abs() > 0.99;
                let axis = if is_parallel { <$vector>::Y } else { <$vector>::X };
                let tangent = normal.cross(axis).normalize();
                let bitangent = normal.cross(tangent).normalize();
                (tangent * x + bitangent * y + normal * z).normalize()
            }
        }
    };
}

tracer!(
    /// In f32, as the reference.
    single, f32, Vec3, libm::sinf, libm::cosf
);
tracer!(
    /// In f64.
    double, f64, DVec3, libm::sin, libm::cos
);

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hits::surface_hits;
    use fixtures::handout_on_a_plain;
    use photon_mapping::assignment8;
    use photon_mapping::random::photon_random;
    use photon_mapping::rendering::photon_mapping_renderer::PathVertex;
    use photon_mapping::scene::Scene;
    use photon_mapping::scene::numerics::LARGE_EPSILON;
    use photon_mapping::scene::point_light::PointLight;
    use photon_mapping::scene::triangle::Triangle;

    #[test]
    fn single_precision_is_the_reference() {
        let renderer = assignment8::create_renderer(assignment8::create_scene());
        let tracer = single::PrecisionTracer::new(&renderer.stored_scene, LARGE_EPSILON.into());
        let mut path = Path::default();
        renderer.generic_photon_map_generation(&mut Vec::new(), 0..20_000, |photon, known, _| {
            tracer.trace(&mut photon_random(renderer.seed, photon), &mut path);
            let known: Vec<_> = surface_hits(known)
                .map(|hit| (hit.intersected_primitive, hit.intersection_point().as_dvec3()))
                .collect();
            assert_eq!(path.hits, known, "photon {photon}");
        });
    }

    /// A point on a wide facet has no more digits than its width leaves, also beside a detail that
    /// stands on it. Held against f64, photon by photon, the share of photons with another path is
    /// less than the last place of the width, in units of the handout's scene.
    #[test]
    fn small_detail_on_a_wide_plain() {
        let count = 300_000;
        for extent in [20.0, 200.0, 2e3, 2e4] {
            let run = handout_on_a_plain(extent, DVec3::ZERO, 34, count);
            let scene = run.scene();
            // In f64 the scene is traced at the size of the handout's, where the framework's offset
            // is right.
            let unit = run.placement.length_to_world(1.0);
            let triangles = scene.triangles().iter().map(|triangle| Triangle {
                vertices: triangle.vertices.map(|vertex| vertex * unit),
                ..*triangle
            });
            let lights = scene
                .lights()
                .iter()
                .map(|light| PointLight { position: light.position * unit, ..*light });
            let world =
                Scene::new(scene.mesh_objects().to_vec(), triangles.collect(), lights.collect());
            let double = double::PrecisionTracer::new(&world, LARGE_EPSILON.into());
            let mut others = 0_u32;
            let mut exact = Path::default();
            run.trace_photons(0..count, |photon, path, _| {
                double.trace(&mut photon_random(34, photon), &mut exact);
                let hits = path[1..].iter().map(|vertex| match vertex {
                    PathVertex::Surface(state) => state.intersected_primitive,
                    PathVertex::Light => unreachable!(),
                });
                others += u32::from(!hits.eq(exact.hits.iter().map(|(triangle, _)| *triangle)));
            });
            let share = f64::from(others) / count as f64;
            assert!(
                share < 1e-5 + f64::from(f32::EPSILON) * extent,
                "{extent}: {others} of {count}"
            );
        }
    }
}
