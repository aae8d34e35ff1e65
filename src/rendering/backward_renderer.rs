//! Light that reaches a surface straight from the lights: C++ `BackwardRenderer.cpp`.

use glam::Vec3;

use crate::scene::Scene;
use crate::scene::point_light::PointLight;
use crate::scene::ray::{IntersectionState, Ray};

/// The color at the point of `state`: the sum, over all lights in sight, of the diffuse response
/// times the light's color times the cosine. As in the framework, light does not fade with
/// distance.
pub fn compute_sample_color(scene: &Scene, state: &IntersectionState) -> Vec3 {
    let mut color = Vec3::ZERO;
    for light in scene.lights() {
        let (shadow_ray, light_color) = light_towards(scene, state, light);
        if light_color != Vec3::ZERO && !scene.trace(&shadow_ray, None) {
            color += light_color;
        }
    }
    color
}

/// The shadow ray from the point of `state` to `light`, and the color that arrives unless
/// something is in between. No light arrives at a surface that is turned away.
pub fn light_towards(scene: &Scene, state: &IntersectionState, light: &PointLight) -> (Ray, Vec3) {
    let hit_mesh_object = &scene.mesh_objects()[state.primitive(scene).parent_mesh_object];
    let diffuse_response = hit_mesh_object.material.base_diffuse_reflection();
    // The start counts as exact: with a start error, no pixel would change.
    let (start, _) = scene.spawn_point(state);
    let to_light = light.position - start;
    let distance = to_light.length();
    let mut shadow_ray = Ray::new(start, to_light / distance);
    shadow_ray.max_t = distance;
    let cosine = state.compute_normal(scene).dot(shadow_ray.ray_direction()).max(0.0);
    (shadow_ray, diffuse_response * light.color * cosine)
}
