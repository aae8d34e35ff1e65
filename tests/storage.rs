//! Photon Storage: what `trace_photon` stores, where, and when it ends.

use crate::common::{Traced, closed_cube, handout, path_of_one_hit, trace_scripted};
use glam::Vec3;
use photon_mapping::rendering::photon_mapping_renderer::{PathVertex, PhotonMappingRenderer};
use photon_mapping::scene::ray::Ray;

/// What a photon on `ray` that has passed `path` does if it is absorbed where it hits.
fn trace(
    renderer: &PhotonMappingRenderer,
    ray: &Ray,
    path: &mut Vec<PathVertex>,
    remaining_bounces: i32,
) -> Traced {
    trace_scripted("Photon Storage", renderer, ray, path, remaining_bounces, &[0.9])
}

#[test]
fn a_photon_straight_from_the_light_is_not_stored() {
    let cube = closed_cube(0.5, 148, 1);
    let ray = Ray::new(Vec3::ZERO, Vec3::X);
    let mut path = vec![PathVertex::Light];
    let traced = trace(&cube, &ray, &mut path, 1000);
    assert!(traced.stored.is_empty(), "stored: {:?}", traced.stored);
    assert_eq!(path.len(), 2, "the path grows all the same");
    assert!(traced.drawn > 0 || traced.met_blank, "the photon comes to the roulette all the same");
}

#[test]
fn a_photon_that_has_bounced_is_stored_where_it_hits() {
    let cube = closed_cube(0.5, 148, 1);
    let direction = Vec3::new(0.6, 0.0, 0.8);
    let ray = Ray::new(Vec3::new(0.1, 0.2, 0.0), direction);
    let stored = trace(&cube, &ray, &mut path_of_one_hit(), 1000).stored;
    let [photon] = stored[..] else { panic!("expected one photon, found {stored:?}") };
    // Exactly the point hit, not the point 1e-5 above it from which a photon goes on.
    assert_eq!(photon.position, ray.ray_position(1.25));
    assert_eq!(photon.position.z, 1.0);
    assert_eq!(photon.intensity, Vec3::new(0.25, 0.5, 1.0), "the photon's intensity");
    let to_light = photon.to_light_ray;
    assert_eq!(to_light.position(), photon.position, "`to_light_ray` starts at the point hit");
    assert_eq!(to_light.ray_direction(), -direction, "`to_light_ray` goes back");
}

#[test]
fn a_path_ends_when_remaining_bounces_is_less_than_zero() {
    let cube = closed_cube(0.5, 148, 1);
    let ray = Ray::new(Vec3::ZERO, Vec3::X);
    for (remaining_bounces, photons) in [(-1, 0), (0, 1), (1, 1)] {
        let mut path = path_of_one_hit();
        let stored = trace(&cube, &ray, &mut path, remaining_bounces).stored;
        assert_eq!(stored.len(), photons, "remaining_bounces = {remaining_bounces}");
        assert_eq!(path.len(), 2 + photons, "remaining_bounces = {remaining_bounces}");
    }
}

#[test]
fn a_photon_that_meets_nothing_is_not_stored() {
    let handout = handout(148, 1);
    let up = Ray::new(Vec3::new(0.0, 0.0, 3.0), Vec3::Z);
    let mut path = path_of_one_hit();
    assert!(trace(&handout, &up, &mut path, 1000).stored.is_empty());
    assert_eq!(path.len(), 2, "the path does not grow where nothing is met");
}
