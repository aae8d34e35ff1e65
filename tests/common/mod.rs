//! Scenes, scripted random numbers and strategies that several tests use.

use std::any::Any;
use std::cell::Cell;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind, set_hook, take_hook};
use std::sync::LazyLock;

use glam::Vec3;
use photon_mapping::assignment8;
use photon_mapping::photon_list::{ListHash, PhotonRecord, records};
use photon_mapping::rendering::photon_mapping_renderer::{
    PathVertex, Photon, PhotonMappingRenderer,
};
use photon_mapping::scene::point_light::PointLight;
use photon_mapping::scene::ray::{IntersectionState, Ray};
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

/// The handout's light. Tests ask for it very often, and a scene takes long to make.
pub fn light() -> PointLight {
    static LIGHT: LazyLock<PointLight> = LazyLock::new(|| assignment8::create_scene().lights()[0]);
    *LIGHT
}

/// A renderer of a closed cube from -1 to 1 whose walls all reflect `albedo`, with a light in its
/// center.
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

/// The handout's sections, in its order.
pub const SECTIONS: [&str; 5] = [
    "Photon Emission",
    "Photon Storage",
    "Photon Scattering/Absorption",
    "Hemisphere Sampling",
    "Hemisphere Ray Transformation",
];

/// A path of a photon that has hit one surface.
pub fn path_of_one_hit() -> Vec<PathVertex> {
    vec![PathVertex::Light, PathVertex::Surface(IntersectionState::new())]
}

/// What a photon did.
pub struct Traced {
    /// What it stored.
    pub stored: Vec<Photon>,
    /// How many of the numbers it drew.
    pub drawn: usize,
    /// Whether it came to a section that is not written yet.
    pub met_blank: bool,
}

thread_local! {
    /// The section that is tested: a blank after it is no fault, and nothing is printed of it.
    static AFTER: Cell<Option<&'static str>> = const { Cell::new(None) };
}

static QUIET: LazyLock<()> = LazyLock::new(|| {
    let print = take_hook();
    set_hook(Box::new(move |panic| {
        if !AFTER.get().is_some_and(|section| is_blank_after(section, panic.payload())) {
            print(panic);
        }
    }));
});

/// Lets `trace_photon` trace a photon on `ray` that has passed `path` and then draws `numbers`. It
/// ends when they run out, and at a section after `section` that is not written yet. So a section
/// can be tested before the next is begun, and whatever mistakes the next has.
pub fn trace_scripted(
    section: &'static str,
    renderer: &PhotonMappingRenderer,
    ray: &Ray,
    path: &mut Vec<PathVertex>,
    remaining_bounces: i32,
    numbers: &[f32],
) -> Traced {
    struct NumbersRanOut;
    let mut stored = Vec::new();
    let mut drawn = 0;
    let mut rand = || {
        let number = numbers.get(drawn).unwrap_or_else(|| resume_unwind(Box::new(NumbersRanOut)));
        drawn += 1;
        *number
    };
    let intensity = Vec3::new(0.25, 0.5, 1.0);
    *QUIET;
    AFTER.set(Some(section));
    let traced = catch_unwind(AssertUnwindSafe(|| {
        renderer.trace_photon(&mut stored, ray, intensity, path, remaining_bounces, &mut rand);
    }));
    AFTER.set(None);
    let met_blank = match traced {
        Ok(()) => false,
        Err(panic) if panic.is::<NumbersRanOut>() => false,
        Err(panic) if is_blank_after(section, &*panic) => true,
        Err(panic) => resume_unwind(panic),
    };
    Traced { stored, drawn, met_blank }
}

/// Whether `panic` is the `todo!` of a section after `section`.
fn is_blank_after(section: &str, panic: &dyn Any) -> bool {
    let message = panic.downcast_ref::<String>().map(String::as_str);
    let message = message.or(panic.downcast_ref::<&str>().copied()).unwrap_or_default();
    let Some(blank) = message.strip_prefix("not yet implemented: ") else { return false };
    let later = SECTIONS.iter().skip_while(|known| **known != section).skip(1);
    later.into_iter().any(|later| blank.starts_with(later))
}

/// Numbers for a photon, one after another, as if drawn.
pub fn draws(numbers: &[f32]) -> impl FnMut() -> f32 {
    let mut numbers = numbers.iter();
    move || *numbers.next().expect("expected a result from the numbers given, found a further draw")
}

/// Whether `vector` has length 1.
pub fn is_unit(vector: Vec3) -> bool {
    (vector.as_dvec3().length() - 1.0).abs() < 3e-7
}

/// Unit vectors anywhere, and, half of them, next to the x axis.
pub fn unit_normal() -> impl Strategy<Value = Vec3> {
    let coordinate = || -1.0_f32..1.0;
    let anywhere = (coordinate(), coordinate(), coordinate())
        .prop_map(|(x, y, z)| Vec3::new(x, y, z))
        .prop_filter_map("too short", Vec3::try_normalize);
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

/// Checks that the mean of `values`, which are those of `what`, differs from `expected` by chance.
pub fn assert_mean(values: impl Iterator<Item = f64>, expected: f64, what: &str) {
    let (mut count, mut sum, mut squares) = (0.0, 0.0, 0.0);
    for value in values {
        count += 1.0;
        sum += value;
        squares += value * value;
    }
    let mean = sum / count;
    let error = ((squares / count - mean * mean) / count).sqrt();
    let errors = (mean - expected) / error;
    assert!(
        errors.abs() < 4.0,
        "mean of {what}: expected {expected:.4}, found {mean:.4}, {errors:.1} standard errors off"
    );
}

/// By how many standard deviations `count` of `emitted` photons differs from `probability`.
pub fn deviations(count: u64, emitted: u64, probability: f64) -> f64 {
    let emitted = emitted as f64;
    let deviation = (emitted * probability * (1.0 - probability)).sqrt();
    (count as f64 - emitted * probability) / deviation
}
