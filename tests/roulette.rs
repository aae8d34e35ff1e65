//! Photon Scattering/Absorption: the roulette of `trace_photon`.

mod common;

use common::{LARGEST_BELOW_ONE, closed_cube, deviations, trace_scripted};
use glam::Vec3;
use photon_mapping::rendering::photon_mapping_renderer::{PathVertex, PhotonMappingRenderer};
use photon_mapping::scene::ray::Ray;
use photon_mapping::scene::{Material, MeshObject, Scene};

/// How many surfaces a photon hits that draws `numbers` in `renderer`'s closed cube.
fn hits(renderer: &PhotonMappingRenderer, max_bounces: i32, numbers: &[f32]) -> usize {
    let mut path = vec![PathVertex::Light];
    let ray = Ray::new(Vec3::ZERO, Vec3::X);
    trace_scripted(renderer, &ray, &mut path, max_bounces, numbers);
    path.len() - 1
}

/// A closed cube whose walls reflect `diffuse`.
fn cube_of(diffuse: Vec3) -> PhotonMappingRenderer {
    let cube = closed_cube(0.0, 148, 1);
    let material = Material::new(diffuse);
    let mesh_objects = cube.stored_scene.mesh_objects().iter();
    let mesh_objects = mesh_objects.map(|mesh| MeshObject { name: mesh.name.clone(), material });
    let stored_scene = Scene::new(
        mesh_objects.collect(),
        cube.stored_scene.triangles().to_vec(),
        cube.stored_scene.lights().to_vec(),
    );
    PhotonMappingRenderer { stored_scene, ..cube }
}

const JUST_BELOW_HALF: f32 = 0.5 - 1.0 / 16_777_216.0;

#[test]
fn a_photon_scatters_only_below_p_r() {
    let cube = closed_cube(0.5, 148, 1);
    assert_eq!(hits(&cube, 1000, &[0.5]), 1, "0.5 is not less than 0.5");
    assert_eq!(hits(&cube, 1, &[JUST_BELOW_HALF, 0.3, 0.4, 0.9]), 2);
}

#[test]
fn p_r_is_the_largest_of_red_green_and_blue() {
    for diffuse in [Vec3::new(0.5, 0.1, 0.2), Vec3::new(0.1, 0.5, 0.2), Vec3::new(0.2, 0.1, 0.5)] {
        let cube = cube_of(diffuse);
        assert_eq!(hits(&cube, 1, &[JUST_BELOW_HALF, 0.3, 0.4, 0.9]), 2, "{diffuse}");
        assert_eq!(hits(&cube, 1, &[0.5]), 1, "{diffuse}");
    }
}

#[test]
fn p_r_of_zero_absorbs_every_photon() {
    assert_eq!(hits(&closed_cube(0.0, 148, 1), 1000, &[0.0]), 1);
}

#[test]
fn p_r_of_one_scatters_every_photon() {
    let numbers = [LARGEST_BELOW_ONE, 0.3, 0.4].repeat(1001);
    assert_eq!(hits(&closed_cube(1.0, 148, 1), 1000, &numbers), 1001);
}

#[test]
fn hits_in_a_closed_cube_form_a_geometric_series() {
    let (albedo, emitted) = (0.75_f64, 400_000);
    let cube = closed_cube(albedo as f32, 5, emitted);
    let mut hits = [[0_u64; 12]; 6];
    cube.generic_photon_map_generation(&mut Vec::new(), 0..emitted, |_, path, _| {
        for (bounce, vertex) in path[1..].iter().take(12).enumerate() {
            let PathVertex::Surface(state) = vertex else { unreachable!() };
            hits[state.primitive(&cube.stored_scene).parent_mesh_object][bounce] += 1;
        }
    });
    for bounce in 0..12 {
        let total: u64 = hits.iter().map(|surface| surface[bounce]).sum();
        let probability = albedo.powi(bounce as i32);
        if bounce == 0 {
            assert_eq!(total, emitted, "nothing leaves a closed cube");
        } else {
            let z = deviations(total, emitted, probability);
            assert!(z.abs() < 4.0, "bounce {bounce}: {z:.1} deviations");
        }
        // The light is in the middle, so each of the six faces gets a sixth.
        for surface in hits {
            let z = deviations(surface[bounce], emitted, probability / 6.0);
            assert!(z.abs() < 4.0, "bounce {bounce}: {z:.1} deviations");
        }
    }
}
