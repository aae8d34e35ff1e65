//! Photon Scattering/Absorption: the roulette of `trace_photon`.

use crate::common::{LARGEST_BELOW_ONE, Traced, closed_cube, trace_scripted};
use glam::Vec3;
use photon_mapping::rendering::photon_mapping_renderer::{PathVertex, PhotonMappingRenderer};
use photon_mapping::scene::ray::Ray;
use photon_mapping::scene::{Material, MeshObject, Scene};

const SECTION: &str = "Photon Scattering/Absorption";

/// Traces a photon that draws `numbers` in `renderer`'s closed cube.
fn trace(renderer: &PhotonMappingRenderer, remaining_bounces: i32, numbers: &[f32]) -> Traced {
    let mut path = vec![PathVertex::Light];
    let ray = Ray::new(Vec3::ZERO, Vec3::Z);
    trace_scripted(SECTION, renderer, &ray, &mut path, remaining_bounces, numbers)
}

/// Whether a photon that draws `number` for the roulette scatters where it first hits. If so, it
/// draws u1 and u2 as well.
fn scatters(renderer: &PhotonMappingRenderer, number: f32) -> bool {
    match trace(renderer, 1000, &[number, 0.3, 0.4]).drawn {
        1 => false,
        3 => true,
        drawn => panic!("{SECTION}: expected 1 number drawn, or 3 to scatter; found {drawn}"),
    }
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
    assert!(!scatters(&cube, 0.5), "0.5 is not less than 0.5");
    assert!(scatters(&cube, JUST_BELOW_HALF));
}

#[test]
fn p_r_is_the_largest_of_red_green_and_blue() {
    for diffuse in [Vec3::new(0.5, 0.1, 0.2), Vec3::new(0.1, 0.5, 0.2), Vec3::new(0.2, 0.1, 0.5)] {
        let cube = cube_of(diffuse);
        assert!(scatters(&cube, JUST_BELOW_HALF), "{diffuse}");
        assert!(!scatters(&cube, 0.5), "{diffuse}");
    }
}

#[test]
fn p_r_of_zero_absorbs_every_photon() {
    assert!(!scatters(&closed_cube(0.0, 148, 1), 0.0));
}

#[test]
fn p_r_of_one_scatters_every_photon() {
    assert!(scatters(&closed_cube(1.0, 148, 1), LARGEST_BELOW_ONE));
}

#[test]
fn one_more_bounce_allowed_is_one_more_hit() {
    let cube = closed_cube(1.0, 148, 1);
    // It scatters nearly along the normal, from one wall to the opposite one.
    let numbers = [0.5, 1e-4, 0.0].repeat(20);
    let [three, four] = [3, 4].map(|remaining| trace(&cube, remaining, &numbers));
    if !three.met_blank {
        assert_eq!(
            four.drawn,
            three.drawn + 3,
            "{SECTION}: one more hit draws three more numbers; none if the new direction is NaN"
        );
    }
}
