//! Light that reaches a surface straight from the lights: C++ `BackwardRenderer.cpp`.

use glam::Vec3;

use crate::scene::Scene;
use crate::scene::intersection_state::IntersectionState;
use crate::scene::lights::point_light::PointLight;
use crate::scene::ray::Ray;

/// Computes direct light with shadow rays.
#[derive(Clone, Copy, Debug)]
pub struct BackwardRenderer<'scene> {
    stored_scene: &'scene Scene,
}

impl<'scene> BackwardRenderer<'scene> {
    /// A renderer of `stored_scene`.
    pub fn new(stored_scene: &'scene Scene) -> Self {
        Self { stored_scene }
    }

    /// The colour at the point of `state`: the diffuse response times the light's colour times the
    /// cosine, over all lights in sight. As in the framework, light does not fade with distance.
    pub fn compute_sample_color(&self, state: &IntersectionState) -> Vec3 {
        let mut color = Vec3::ZERO;
        for light in self.stored_scene.lights() {
            let (shadow_ray, light_color) = self.light_towards(light, state);
            if let Some(light_color) = light_color
                && !self.stored_scene.trace(&shadow_ray, None)
            {
                color += light_color;
            }
        }
        color
    }

    /// The ray from the point of `state` to `light`, and the colour that comes along it unless
    /// something is in between; none comes to a surface that is turned away.
    pub fn light_towards(
        &self,
        light: &PointLight,
        state: &IntersectionState,
    ) -> (Ray, Option<Vec3>) {
        let scene = self.stored_scene;
        let mesh_object = &scene.mesh_objects()[state.primitive(scene).parent_mesh_object];
        let diffuse_response = mesh_object.material.base_diffuse_reflection();
        let normal = state.compute_normal(scene);
        let point = state.intersection_point();
        let offset = scene.offset(state.intersected_primitive, point, state.intersection_t);
        let point = point + offset * normal;
        let to_light = light.position - point;
        let distance = to_light.length();
        let mut shadow_ray = Ray::new(point, to_light / distance);
        shadow_ray.max_t = distance;
        let cosine = normal.dot(shadow_ray.ray_direction()).max(0.0);
        let color = (cosine > 0.0).then(|| diffuse_response * light.color * cosine);
        (shadow_ray, color)
    }
}
