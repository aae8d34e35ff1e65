//! Scenes and lists that several tests use.
#![allow(dead_code, reason = "no test uses all of them")]

pub mod judge;

use glam::{DVec3, Vec3};
use photon_mapping::assignment8;
use photon_mapping::photon_list::record::PhotonRecord;
use photon_mapping::photon_list::trace::trace_list;
use photon_mapping::photon_list::writer::ListHash;
use photon_mapping::rendering::photon_mapping_renderer::PhotonMappingRenderer;
use photon_mapping::scene::Scene;
use photon_mapping::scene::lights::point_light::PointLight;
use photon_mapping::scene::obj::{self, ModelLight};

/// A renderer of the handout's scene.
pub fn handout(seed: u64, photon_count: u64) -> PhotonMappingRenderer {
    let renderer = assignment8::create_renderer(assignment8::create_scene());
    PhotonMappingRenderer { seed, photon_count, ..renderer }
}

/// The handout's scene, every coordinate times `scale` and then moved by `shift` (world space), read
/// from the text of a model file as a user's scene is.
pub fn moved_handout(scale: f64, shift: DVec3, seed: u64, count: u64) -> PhotonMappingRenderer {
    load(&handout_text(scale, shift), scale, shift, seed, count)
}

/// The handout's scene, moved by `shift`, over the middle of a square from -`extent` to `extent` that
/// absorbs all photons.
pub fn handout_over_a_square(
    extent: f64,
    shift: DVec3,
    seed: u64,
    count: u64,
) -> PhotonMappingRenderer {
    let text = handout_text(1.0, shift) + &square("square", extent, -1.0);
    load(&text, 1.0, shift, seed, count)
}

/// The handout's scene, moved by `shift`, with a floor that reaches from -`extent` to `extent`.
pub fn handout_on_a_plain(
    extent: f64,
    shift: DVec3,
    seed: u64,
    count: u64,
) -> PhotonMappingRenderer {
    let text = handout_text(1.0, shift);
    let (boxes_and_wall, _) = text.split_once("o floor").unwrap();
    let text = boxes_and_wall.to_owned() + &square("floor", extent, 0.0);
    load(&text, 1.0, shift, seed, count)
}

/// The handout's model with y up: world (x, y, z) is (x, z, -y) there.
fn handout_text(scale: f64, shift: DVec3) -> String {
    let shift = [shift.x, shift.z, -shift.y];
    let mut text = String::new();
    for line in include_str!("../../src/assignment8/cornell_box.obj").lines() {
        if let Some(figures) = line.strip_prefix("v ") {
            let figures: Vec<f64> = figures.split(' ').map(|word| word.parse().unwrap()).collect();
            let [x, y, z] = std::array::from_fn(|axis| figures[axis] * scale + shift[axis]);
            text += &format!("v {x} {y} {z}\n");
        } else {
            text += line;
            text += "\n";
        }
    }
    text
}

/// A square of the model that faces up.
fn square(name: &str, extent: f64, height: f64) -> String {
    let (e, h) = (extent, height);
    format!(
        "o {name}\nusemtl {name}\nv -{e} {h} {e}\nv {e} {h} {e}\nv {e} {h} -{e}\nv -{e} {h} -{e}\n\
         f -4 -3 -2 -1\n"
    )
}

fn load(
    text: &str,
    scale: f64,
    shift: DVec3,
    seed: u64,
    photon_count: u64,
) -> PhotonMappingRenderer {
    let materials = include_str!("../../src/assignment8/cornell_box.mtl");
    let materials = format!("{materials}\nnewmtl square\nKd 0 0 0\n");
    let model = obj::parse(text, |_| Ok(materials.clone())).unwrap();
    let light = assignment8::create_light();
    let light = ModelLight { position: light.position * scale + shift, ..light };
    let renderer = assignment8::create_renderer(Scene::from_model(model, &[light]));
    PhotonMappingRenderer { seed, photon_count, ..renderer }
}

/// A renderer of a closed cube from -1 to 1 whose walls all reflect `albedo`, with a light in its
/// centre; the walls are named after the axis they cross.
pub fn closed_cube(albedo: f32, seed: u64, photon_count: u64) -> PhotonMappingRenderer {
    let model = obj::parse(CLOSED_CUBE, |_| Ok(format!("newmtl wall\nKd {albedo} 0 0\n")))
        .expect("the cube is well formed");
    let light = ModelLight { position: DVec3::ZERO, color: Vec3::ONE };
    let scene = Scene::from_model(model, &[light]);
    let renderer = assignment8::create_renderer(scene);
    PhotonMappingRenderer { seed, photon_count, ..renderer }
}

const CLOSED_CUBE: &str = "
mtllib cube.mtl
v -1 -1 -1
v  1 -1 -1
v  1  1 -1
v -1  1 -1
v -1 -1  1
v  1 -1  1
v  1  1  1
v -1  1  1
vn 1 0 0
vn -1 0 0
vn 0 1 0
vn 0 -1 0
vn 0 0 1
vn 0 0 -1
usemtl wall
o low_x
f 1//1 4//1 8//1 5//1
o high_x
f 2//2 6//2 7//2 3//2
o low_y
f 1//3 5//3 6//3 2//3
o high_y
f 4//4 3//4 7//4 8//4
o low_z
f 1//5 2//5 3//5 4//5
o high_z
f 5//6 8//6 7//6 6//6
";

/// The handout's light.
pub fn light() -> PointLight {
    handout(148, 1).stored_scene.lights()[0]
}

/// The whole list of a run.
pub fn list(renderer: &PhotonMappingRenderer) -> Vec<PhotonRecord> {
    let mut list = Vec::new();
    trace_list(renderer, 0..renderer.emitted(), |records, _| {
        list.extend_from_slice(records);
        Ok::<_, std::convert::Infallible>(())
    })
    .unwrap();
    list
}

/// The hash that names a list.
pub fn hash(list: &[PhotonRecord]) -> String {
    let mut hash = ListHash::default();
    list.iter().for_each(|record| hash.update(record));
    hash.hex()
}

/// Numbers for a photon, one after another, as if drawn.
pub fn draws<'a>(numbers: &'a [f32]) -> impl FnMut() -> f32 + 'a {
    let mut numbers = numbers.iter();
    move || *numbers.next().expect("the photon draws no more numbers than the test gives")
}
