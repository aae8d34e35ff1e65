//! The scene: mesh objects with their materials, lights, and the question what a ray meets.

use std::fmt::Debug;
use std::sync::Arc;

use glam::Vec3;

mod bounds;
pub mod camera;
pub mod cornell_box;
pub mod numerics;
pub mod point_light;
pub mod ray;
pub mod triangle;

use bounds::Bounds;
use numerics::Rounding;
use point_light::PointLight;
use ray::{IntersectionState, Ray};
use triangle::Triangle;

/// A purely diffuse material.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Material {
    diffuse: Vec3,
}

impl Material {
    /// A material that reflects the fraction `diffuse`, each channel in [0, 1].
    pub fn new(diffuse: Vec3) -> Self {
        Self { diffuse }
    }

    /// The diffuse response d, before any light: C++ `Material::GetBaseDiffuseReflection()`.
    pub fn base_diffuse_reflection(&self) -> Vec3 {
        self.diffuse
    }
}

/// A named object of the model. Its triangles stand in [`Scene::triangles`].
#[derive(Clone, Debug, PartialEq)]
pub struct MeshObject {
    /// The object's name in the model.
    pub name: String,
    /// What all of its triangles are made of: C++ `MeshObject::GetMaterial()`.
    pub material: Material,
}

/// Mesh objects, their triangles, and the lights. World space, z up.
#[derive(Clone, Debug)]
pub struct Scene {
    mesh_objects: Vec<MeshObject>,
    triangles: Vec<Triangle>,
    lights: Vec<PointLight>,
    bounds: Vec<Bounds>,
    rounding: Rounding,
    acceleration: Option<Arc<dyn Acceleration>>,
}

impl Scene {
    /// A scene of `triangles`, each of which names its mesh object by index.
    pub fn new(
        mesh_objects: Vec<MeshObject>,
        triangles: Vec<Triangle>,
        lights: Vec<PointLight>,
    ) -> Self {
        let bounds = Bounds::of_mesh_objects(&triangles);
        let rounding = Rounding::new(&triangles);
        Self { mesh_objects, triangles, lights, bounds, rounding, acceleration: None }
    }

    /// The mesh objects, in the model's order.
    pub fn mesh_objects(&self) -> &[MeshObject] {
        &self.mesh_objects
    }

    /// The triangles, in the model's order.
    pub fn triangles(&self) -> &[Triangle] {
        &self.triangles
    }

    /// The lights, in the order in which they emit their photons.
    pub fn lights(&self) -> &[PointLight] {
        &self.lights
    }

    /// Whether `ray` meets anything before its `max_t`: C++ `Scene::Trace`.
    ///
    /// With a `state`, fills it with the closest hit. Of two triangles at the same distance, the
    /// first counts, but a back yields to a front beside it. Without a `state`, any hit will do.
    pub fn trace(&self, ray: &Ray, state: Option<&mut IntersectionState>) -> bool {
        let Some(state) = state else { return self.any_hit(ray) };
        let Some((triangle, t)) = self.closest_hit(ray) else { return false };
        *state = IntersectionState {
            intersection_ray: *ray,
            intersection_t: t,
            intersected_primitive: triangle,
        };
        true
    }

    /// Looks for hits with `acceleration` from now on, instead of testing every triangle.
    pub fn set_acceleration(&mut self, acceleration: Arc<dyn Acceleration>) {
        self.acceleration = Some(acceleration);
    }
}

/// A faster way to the same hits in a scene of many triangles. The handout's 24 need none.
///
/// Every method is given the scene's triangles, and must answer exactly as a test of each of them
/// would.
pub trait Acceleration: Debug + Send + Sync {
    /// The closest hit of `ray` before its `max_t`: a triangle, the distance, and whether the
    /// triangle [faces](Triangle::faces) the ray.
    fn closest(&self, ray: &Ray, triangles: &[Triangle]) -> Option<(usize, f32, bool)>;

    /// The closest hit among those that `accepts` takes.
    fn closest_of(
        &self,
        ray: &Ray,
        triangles: &[Triangle],
        accepts: &dyn Fn(&Triangle, f32) -> bool,
    ) -> Option<(usize, f32)>;

    /// Whether `ray` meets anything before its `max_t`.
    fn any(&self, ray: &Ray, triangles: &[Triangle]) -> bool;
}
