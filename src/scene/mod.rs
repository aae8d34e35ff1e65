//! What is there: meshes, lights, the camera, and the question what a ray meets.

pub mod camera;
pub mod frame;
pub mod intersection_state;
pub mod lights;
pub mod material;
pub mod mesh_object;
pub mod obj;
pub mod ray;
pub mod tree;
pub mod triangle;

use frame::Frame;
use glam::{DVec3, Vec3};
use intersection_state::IntersectionState;
use lights::point_light::PointLight;
use mesh_object::MeshObject;
use ray::Ray;
use tree::Tree;
use triangle::{ShearedRay, Triangle};

/// The framework's offset of a ray that leaves a surface, along the surface's normal, in scene space.
/// Without it, rounding puts every other start just below the surface and the ray meets it again.
pub const LARGE_EPSILON: f32 = 1e-5;

/// Where all triangles have an edge as long as this, rays start where the framework starts them. The
/// handout's have 0.85.
const ORDINARY_EDGE: f32 = 0.5;

/// So many times their rounding two places may lie apart and still be the same one to a ray that grazes.
const NEAR: f32 = 64.0;

/// A thin triangle rounds a point as if it were larger, but not by more than this.
const THINNEST: f32 = 16.0;

/// Mesh objects, their triangles, and the lights, z up, in the space in which they are traced. For the
/// handout's scene that is world space; see [`Frame`] for models of other sizes and places.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    mesh_objects: Vec<MeshObject>,
    triangles: Vec<Triangle>,
    lights: Vec<PointLight>,
    frame: Frame,
    /// For every triangle the length that rounds the points on it.
    sizes: Vec<f32>,
    /// The offset that is small beside every triangle.
    epsilon: f32,
    /// Only for scenes of many triangles.
    tree: Option<Tree>,
}

impl Scene {
    /// The scene of a model with `lights`, both in world space.
    pub fn from_model(model: obj::Model, lights: &[obj::ModelLight]) -> Self {
        let corners = model.triangles.iter().flat_map(|triangle| triangle.vertices);
        let frame = Frame::around(corners, lights.iter().map(|light| light.position));
        let place = |point: DVec3| frame.to_scene(point);
        let triangles = model.triangles.iter().map(|triangle| Triangle {
            vertices: triangle.vertices.map(place),
            normal: triangle.normal,
            parent_mesh_object: triangle.parent_mesh_object,
            facet: triangle.facet,
        });
        let lights = lights
            .iter()
            .map(|light| PointLight { position: place(light.position), color: light.color });
        let placed = Self::new(model.mesh_objects, triangles.collect(), lights.collect());
        Self { frame, ..placed }
    }

    /// A scene of `triangles`, each of which names its mesh object by index.
    pub fn new(
        mesh_objects: Vec<MeshObject>,
        triangles: Vec<Triangle>,
        lights: Vec<PointLight>,
    ) -> Self {
        let tree = (triangles.len() > tree::FEW).then(|| Tree::new(&triangles));
        let edges = || triangles.iter().map(Triangle::longest_edge);
        let epsilon = LARGE_EPSILON * (edges().fold(ORDINARY_EDGE, f32::min) / ORDINARY_EDGE);
        let sizes = triangles.iter().zip(edges()).map(|(triangle, edge)| {
            let thinness = edge / (2.0 * triangle.width());
            edge * thinness.min(THINNEST)
        });
        let sizes = sizes.collect();
        Self { mesh_objects, triangles, lights, frame: Frame::WORLD, sizes, epsilon, tree }
    }

    /// The mesh objects, in the model file's order.
    pub fn mesh_objects(&self) -> &[MeshObject] {
        &self.mesh_objects
    }

    /// The triangles, in the model file's order.
    pub fn triangles(&self) -> &[Triangle] {
        &self.triangles
    }

    /// The lights, in the order in which they send out their photons.
    pub fn lights(&self) -> &[PointLight] {
        &self.lights
    }

    /// Where the scene stands in the world.
    pub fn frame(&self) -> &Frame {
        &self.frame
    }

    /// How far along the normal a ray starts that leaves `triangle` at `point`, which a ray met at the
    /// distance `t`: [`LARGE_EPSILON`] everywhere in the handout's scene.
    ///
    /// In a scene with much smaller triangles that would be a leap. There the offset shrinks in proportion
    /// to the smallest, but never below what rounding may have done to the point: a few units in the last
    /// place of the lengths it was computed from.
    pub fn offset(&self, triangle: usize, point: Vec3, t: f32) -> f32 {
        self.epsilon.max(self.rounding(triangle, point, t))
    }

    fn rounding(&self, triangle: usize, point: Vec3, t: f32) -> f32 {
        let lengths = point.abs().max_element() + 2.0 * t + self.sizes[triangle];
        2.0 * f32::EPSILON * lengths
    }

    /// Whether `ray` meets anything before its `max_t`: C++ `Scene::Trace`.
    ///
    /// With a `state`, it is filled with the closest hit; of two at the same distance, the one of
    /// the triangle that comes first. Without one, any hit will do.
    ///
    /// A back yields to the front beside it, if there is one: rounding alone put the back first.
    pub fn trace(&self, ray: &Ray, state: Option<&mut IntersectionState>) -> bool {
        let Some(state) = state else {
            return match &self.tree {
                Some(tree) => tree.any(ray, &self.triangles),
                None => self.hits(ray).next().is_some(),
            };
        };
        let closest = self.closest_and_side(ray).map(|(hit, is_front)| {
            let front = if is_front { None } else { self.front_beside(ray, hit) };
            front.unwrap_or(hit)
        });
        if let Some((index, t)) = closest {
            *state = IntersectionState {
                intersection_ray: *ray,
                intersection_t: t,
                intersected_primitive: index,
            };
        }
        closest.is_some()
    }

    /// The front that `ray` met in truth where rounding gives it a back, at the distance `t` on the triangle
    /// `index`; `None` where it met the back.
    ///
    /// Where a ray touches the edge of a solid, it enters and leaves at once, and the back may seem to be before
    /// the front: then there is the front of a neighbour at the same place, which shares a corner or its plane.
    /// Where it grazes a surface below which it started, the [`Ray::start_error`] was too short: then that front is
    /// within the error of the start.
    fn front_beside(&self, ray: &Ray, (index, t): (usize, f32)) -> Option<(usize, f32)> {
        let (back, direction) = (&self.triangles[index], ray.ray_direction());
        let rounding = self.rounding(index, ray.ray_position(t), t);
        let mut near = *ray;
        near.max_t = ray.max_t.min(t + NEAR * rounding);
        near.start_error = NEAR * ray.start_error;
        self.closest(&near, |triangle, t| {
            let depth_of_start = t * direction.dot(triangle.normal);
            triangle.faces(direction)
                && if t > 0.0 {
                    back.touches(triangle, 0.25 * rounding)
                } else {
                    depth_of_start <= ray.start_error
                }
        })
    }

    /// The closest hit of `ray` before its `max_t`, and whether it is of a front.
    fn closest_and_side(&self, ray: &Ray) -> Option<((usize, f32), bool)> {
        if let Some(tree) = &self.tree {
            return tree.closest_and_side(ray, &self.triangles);
        }
        let hit = self.closest(ray, |_, _| true)?;
        Some((hit, self.triangles[hit.0].faces(ray.ray_direction())))
    }

    /// The closest of the hits `of` of `ray` before its `max_t`: a triangle and its distance.
    fn closest(&self, ray: &Ray, of: impl Fn(&Triangle, f32) -> bool) -> Option<(usize, f32)> {
        match &self.tree {
            Some(tree) => tree.closest(ray, &self.triangles, of),
            None => self
                .hits(ray)
                .filter(|(index, t)| of(&self.triangles[*index], *t))
                .reduce(|best, hit| if hit.1 < best.1 { hit } else { best }),
        }
    }

    /// Every triangle that `ray` meets before its `max_t`, with its distance.
    fn hits(&self, ray: &Ray) -> impl Iterator<Item = (usize, f32)> {
        let sheared_ray = ShearedRay::new(ray);
        let max_t = ray.max_t;
        self.triangles.iter().enumerate().filter_map(move |(index, triangle)| {
            triangle.intersect(&sheared_ray).filter(|t| *t < max_t).map(|t| (index, t))
        })
    }
}
