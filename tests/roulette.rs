//! Photon Scattering/Absorption: the roulette of `trace_photon`.

use crate::common::{LARGEST_BELOW_ONE, Traced, closed_cube, path_of_one_hit, trace_scripted};
use glam::Vec3;
use photon_mapping::rendering::photon_mapping_renderer::{PathVertex, PhotonMappingRenderer};
use photon_mapping::scene::ray::Ray;
use photon_mapping::scene::{Material, MeshObject, Scene};

const SECTION: &str = "Photon Scattering/Absorption";

/// Traces a photon that draws `numbers` in `renderer`'s closed cube. It has passed `path`.
fn trace(
    renderer: &PhotonMappingRenderer,
    path: &mut Vec<PathVertex>,
    remaining_bounces: i32,
    numbers: &[f32],
) -> Traced {
    let ray = Ray::new(Vec3::ZERO, Vec3::Z);
    trace_scripted(SECTION, renderer, &ray, path, remaining_bounces, numbers)
}

/// Checks that a photon that draws `number` for the roulette scatters where it first hits, and so
/// draws u1 and u2 as well, or, if that is not `expected`, that it is absorbed.
fn assert_scatters(renderer: &PhotonMappingRenderer, number: f32, expected: bool) {
    let mut path = vec![PathVertex::Light];
    let drawn = trace(renderer, &mut path, 1000, &[number, 0.3, 0.4]).drawn;
    let d = renderer.stored_scene.mesh_objects()[0].material.base_diffuse_reflection();
    let (draws, end) = if expected { (3, "scatters") } else { (1, "is absorbed") };
    assert_eq!(drawn, draws, "{SECTION}: it draws {number} where d = {d}, and {end}");
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
    assert_scatters(&cube, 0.5, false);
    assert_scatters(&cube, JUST_BELOW_HALF, true);
}

#[test]
fn p_r_is_the_largest_of_red_green_and_blue() {
    for diffuse in [Vec3::new(0.5, 0.1, 0.2), Vec3::new(0.1, 0.5, 0.2), Vec3::new(0.2, 0.1, 0.5)] {
        let cube = cube_of(diffuse);
        assert_scatters(&cube, JUST_BELOW_HALF, true);
        assert_scatters(&cube, 0.5, false);
    }
}

#[test]
fn p_r_of_zero_absorbs_every_photon() {
    assert_scatters(&closed_cube(0.0, 148, 1), 0.0, false);
}

#[test]
fn p_r_of_one_scatters_every_photon() {
    assert_scatters(&closed_cube(1.0, 148, 1), LARGEST_BELOW_ONE, true);
}

/// A photon that scatters nearly along the normal goes from one wall to the opposite one, until it
/// has bounced often enough. Limits of 3 to 6 are compared with one another, and not with numbers:
/// where a path ends and what it stores are matters of Photon Storage.
#[test]
fn one_more_bounce_allowed_is_one_more_hit() {
    let cube = closed_cube(1.0, 148, 1);
    let numbers = [0.5, 1e-4, 0.0].repeat(20);
    let of_limit = |remaining_bounces, numbers: &[f32]| {
        let mut path = path_of_one_hit();
        let traced = trace(&cube, &mut path, remaining_bounces, numbers);
        (traced, path.len())
    };
    // While a later section is blank, no photon gets to a second hit.
    let paths = [3, 4, 5, 6].map(|remaining_bounces| of_limit(remaining_bounces, &numbers));
    if paths[0].0.met_blank {
        return;
    }
    let (_, after_one_hit) = of_limit(3, &[]);
    for ((shorter, length), (longer, new_length)) in paths.iter().zip(&paths[1..]) {
        let [drawn, more] = [shorter.drawn, longer.drawn];
        assert_eq!(more, drawn + 3, "{SECTION}: draws at one more hit (a ray of NaN hits nothing)");
        let of_hit = after_one_hit - path_of_one_hit().len();
        assert_eq!(*new_length, length + of_hit, "{SECTION}: all hits are in the same path");
        for (photon, next) in longer.stored.iter().zip(longer.stored.iter().skip(1)) {
            assert_ne!(photon.position, next.position, "{SECTION}: goes on along the new ray");
        }
    }
}
