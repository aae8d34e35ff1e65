//! Scenes, scripted random numbers and strategies that several tests use.
#![allow(dead_code, reason = "no test uses all of them")]

use glam::Vec3;
use photon_mapping::assignment8;
use photon_mapping::photon_list::{ListHash, PhotonRecord, records};
use photon_mapping::random::photon_random;
use photon_mapping::rendering::photon_mapping_renderer::{
    PathVertex, Photon, PhotonMappingRenderer,
};
use photon_mapping::scene::point_light::PointLight;
use photon_mapping::scene::ray::Ray;
use photon_mapping::scene::triangle::Triangle;
use photon_mapping::scene::{Material, MeshObject, Scene};
use proptest::prelude::*;

/// The largest number that a photon can draw.
pub const LARGEST_BELOW_ONE: f32 = 1.0 - 1.0 / 16_777_216.0;

/// The reference's renderer with another seed and number of photons.
pub fn handout(seed: u64, photon_count: u64) -> PhotonMappingRenderer {
    let renderer = assignment8::create_renderer(assignment8::create_scene());
    PhotonMappingRenderer { seed, photon_count, ..renderer }
}

/// The handout's light.
pub fn light() -> PointLight {
    assignment8::create_scene().lights()[0]
}

/// A renderer of a closed cube from -1 to 1 whose walls all reflect `albedo`, with a light in its
/// centre.
pub fn closed_cube(albedo: f32, seed: u64, photon_count: u64) -> PhotonMappingRenderer {
    // Corners 0 to 7 of a model with y up, and its faces with their normals.
    let corner = |k: usize| {
        let high = |bit: bool| if bit { 1.0 } else { -1.0 };
        let (x, y, z) = (high(k % 4 == 1 || k % 4 == 2), high(k % 4 >= 2), high(k >= 4));
        Vec3::new(x, 0.0 - z, y)
    };
    let faces: [(&str, [usize; 4], Vec3); 6] = [
        ("low_x", [0, 3, 7, 4], Vec3::X),
        ("high_x", [1, 5, 6, 2], Vec3::NEG_X),
        ("low_y", [0, 4, 5, 1], Vec3::Z),
        ("high_y", [3, 2, 6, 7], Vec3::NEG_Z),
        ("low_z", [0, 1, 2, 3], Vec3::NEG_Y),
        ("high_z", [4, 7, 6, 5], Vec3::Y),
    ];
    let material = Material::new(Vec3::new(albedo, 0.0, 0.0));
    let mut mesh_objects = Vec::new();
    let mut triangles = Vec::new();
    for (name, corners, normal) in faces {
        let [a, b, c, d] = corners.map(corner);
        triangles.extend([[a, b, c], [a, c, d]].map(|vertices| Triangle {
            vertices,
            normal,
            parent_mesh_object: mesh_objects.len(),
            facet: 0,
        }));
        mesh_objects.push(MeshObject { name: name.to_owned(), material });
    }
    let light = PointLight { position: Vec3::ZERO, color: Vec3::ONE };
    let scene = Scene::new(mesh_objects, triangles, vec![light]);
    PhotonMappingRenderer { seed, photon_count, ..assignment8::create_renderer(scene) }
}

/// A square from -1 to 1 at the height `z` that faces up.
pub fn square(z: f32) -> [Triangle; 2] {
    let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
    let [a, b, c, d] = corners.map(|(x, y)| Vec3::new(x, y, z));
    [[a, b, c], [a, c, d]].map(|vertices| Triangle {
        vertices,
        normal: Vec3::Z,
        parent_mesh_object: 0,
        facet: 0,
    })
}

/// A scene of `triangles` alone.
pub fn scene_of(triangles: &[Triangle]) -> Scene {
    Scene::new(Vec::new(), triangles.to_vec(), Vec::new())
}

/// The list of a run, by `trace_photon`.
pub fn list(renderer: &PhotonMappingRenderer) -> Vec<PhotonRecord> {
    let mut list = Vec::new();
    let all = 0..renderer.emitted();
    renderer.generic_photon_map_generation(&mut Vec::new(), all, |photon, path, stored| {
        list.extend(records(&renderer.stored_scene, photon, path, stored));
    });
    list
}

/// The hash that names a list.
pub fn hash(list: &[PhotonRecord]) -> String {
    let mut hash = ListHash::default();
    hash.update(list);
    hash.hex()
}

/// What `trace_photon` stores of a photon on `ray` that has passed `path` and then draws `numbers`.
/// The photon may draw no more numbers than these.
pub fn trace_scripted(
    renderer: &PhotonMappingRenderer,
    ray: &Ray,
    path: &mut Vec<PathVertex>,
    remaining_bounces: i32,
    numbers: &[f32],
) -> Vec<Photon> {
    let mut photon_map = Vec::new();
    let mut rand = draws(numbers);
    let intensity = Vec3::new(0.25, 0.5, 1.0);
    renderer.trace_photon(&mut photon_map, ray, intensity, path, remaining_bounces, &mut rand);
    photon_map
}

/// Numbers for a photon, one after another, as if drawn.
pub fn draws(numbers: &[f32]) -> impl FnMut() -> f32 {
    let mut numbers = numbers.iter();
    move || *numbers.next().expect("the photon draws no more numbers than the test gives")
}

/// Whether `vector` has length 1.
pub fn is_unit(vector: Vec3) -> bool {
    (vector.as_dvec3().length() - 1.0).abs() < 3e-7
}

/// Unit vectors anywhere, and, half of them, next to the x axis.
pub fn unit_normal() -> impl Strategy<Value = Vec3> {
    let anywhere = (any::<u64>()).prop_map(|seed| {
        let ray = light().generate_random_photon_ray(&mut photon_random(seed, 0));
        ray.ray_direction().normalize()
    });
    let near_x = (any::<bool>(), 0_i32..30, 0_i32..30, any::<bool>(), any::<bool>()).prop_map(
        |(negative, y, z, y_negative, z_negative)| {
            let sign = |negative| if negative { -1.0_f32 } else { 1.0 };
            let tiny =
                |exponent: i32| if exponent == 0 { 0.0 } else { 0.5 / (1 << exponent) as f32 };
            let y = sign(y_negative) * tiny(y);
            Vec3::new(sign(negative), y, sign(z_negative) * tiny(z)).normalize()
        },
    );
    prop_oneof![anywhere, near_x]
}

/// The numbers a photon can draw.
pub fn uniform() -> impl Strategy<Value = f32> {
    (0_u32..1 << 24).prop_map(|k| k as f32 / 16_777_216.0)
}

/// The mean of `values`, and by how many standard errors it differs from `expected`.
pub fn standard_errors(values: impl Iterator<Item = f64>, expected: f64) -> f64 {
    let (mut count, mut sum, mut squares) = (0.0, 0.0, 0.0);
    for value in values {
        count += 1.0;
        sum += value;
        squares += value * value;
    }
    let mean = sum / count;
    let error = ((squares / count - mean * mean) / count).sqrt();
    (mean - expected) / error
}

/// By how many standard deviations `count` of `emitted` photons differs from `probability`.
pub fn deviations(count: u64, emitted: u64, probability: f64) -> f64 {
    let emitted = emitted as f64;
    let deviation = (emitted * probability * (1.0 - probability)).sqrt();
    (count as f64 - emitted * probability) / deviation
}
