//! How long each part takes: `cargo bench --bench speed`. Compare within one run, not across.

use std::io::Cursor;

use divan::counter::ItemsCount;
use divan::{Bencher, black_box};
use fast::lanes::closest_hit::{Closest, Hits, NONE, SharedCorners};
use fast::lanes::rays::{GROUP, Rays};
use fast::lanes::width::Width;
use fast::lanes::{LaneTracer, picture};
use fast::trace::{trace_list, trace_with_port};
use fast::tree::Tree;
use glam::Vec3;
use photon_list::reader;
use photon_list::writer::{Format, ListWriter};
use photon_mapping::assignment8;
use photon_mapping::photon_list::{ListHash, PhotonRecord, ROW_BYTES};
use photon_mapping::random::photon_random;
use photon_mapping::rendering::image_writer;
use photon_mapping::rendering::photon_map::PhotonMap;
use photon_mapping::rendering::photon_mapping_renderer::{
    PHOTON_DOT_RADIUS, PhotonMappingRenderer,
};
use photon_mapping::scene::Acceleration;
use photon_mapping::scene::Material;
use photon_mapping::scene::MeshObject;
use photon_mapping::scene::Scene;
use photon_mapping::scene::ray::IntersectionState;
use photon_mapping::scene::ray::Ray;
use photon_mapping::scene::triangle::Triangle;

fn main() {
    divan::main();
}

fn renderer() -> PhotonMappingRenderer {
    assignment8::create_renderer(assignment8::create_scene())
}

fn records() -> Vec<PhotonRecord> {
    let renderer = renderer();
    let lanes = LaneTracer::new(&renderer, Width::widest()).expect("the scene is small");
    lanes.trace_piece(0..assignment8::PHOTON_COUNT)
}

#[divan::bench(args = [1, 2, 4], sample_count = 10)]
fn trace_by_threads(bencher: Bencher, threads: usize) {
    let renderer = renderer();
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
    let photons = renderer.emitted();
    bencher
        .counter(ItemsCount::new(photons))
        .bench(|| pool.install(|| trace_list(&renderer, 0..photons, |_, _| Ok::<(), ()>(()))));
}

#[divan::bench(args = Width::available(), sample_count = 20)]
fn trace_by_width(bencher: Bencher, width: Width) {
    let renderer = renderer();
    let lanes = LaneTracer::new(&renderer, width).expect("the scene is small");
    bencher.counter(ItemsCount::new(100_000_u64)).bench(|| lanes.trace_piece(0..100_000));
}

#[divan::bench(sample_count = 20)]
fn trace_by_specification(bencher: Bencher) {
    let renderer = renderer();
    bencher.counter(ItemsCount::new(20_000_u64)).bench(|| trace_with_port(&renderer, 0..20_000));
}

#[divan::bench]
fn set_up_lanes(bencher: Bencher) {
    let renderer = renderer();
    bencher.bench(|| LaneTracer::new(&renderer, Width::widest()));
}

#[divan::bench]
fn set_up_a_stream_and_draw_three() -> [f32; 3] {
    let mut random = photon_random(148, black_box(7));
    [random(), random(), random()]
}

#[divan::bench]
fn closest_of_all_triangles(bencher: Bencher) {
    let scene = assignment8::create_scene();
    let ray = Ray::new(scene.lights()[0].position, Vec3::new(0.6, 0.0, -0.8));
    bencher.bench(|| scene.trace(black_box(&ray), Some(&mut IntersectionState::new())));
}

/// `triangles` triangles of boxes that stand about in a room.
fn boxes(triangles: usize) -> Scene {
    let mut random = photon_random(7, triangles as u64);
    let mut all = Vec::new();
    while all.len() < triangles {
        let center = Vec3::new(2.0 * random() - 1.0, 2.0 * random() - 1.0, 1.5 * random());
        let half = Vec3::new(0.05 + 0.2 * random(), 0.05 + 0.2 * random(), 0.1 + 0.3 * random());
        let corner = |number: usize| {
            let side = |axis: usize| if number >> axis & 1 == 1 { 1.0 } else { -1.0 };
            center + half * Vec3::new(side(0), side(1), side(2))
        };
        let faces =
            [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        for [a, b, c, d] in faces {
            for corners in [[a, b, c], [a, c, d]] {
                let vertices = corners.map(corner);
                let [a, b, c] = vertices;
                let normal = (b - a).cross(c - a).normalize();
                all.push(Triangle { vertices, normal, parent_mesh_object: 0, facet: 0 });
            }
        }
    }
    all.truncate(triangles);
    let material = Material::new(Vec3::splat(0.5));
    Scene::new(vec![MeshObject { name: String::new(), material }], all, Vec::new())
}

/// Rays that leave the triangles of `scene`, more of them upright than aslant.
fn scattered_rays(scene: &Scene) -> Vec<Ray> {
    let mut random = photon_random(9, 0);
    let triangles = scene.triangles();
    (0..RAYS)
        .map(|ray| {
            let Triangle { vertices: [a, b, c], normal, .. } = triangles[ray % triangles.len()];
            let (u, v) = (random().sqrt(), random());
            let start = a * (1.0 - u) + b * (u * (1.0 - v)) + c * (u * v);
            let aslant = Vec3::new(random() - 0.5, random() - 0.5, random() - 0.5).normalize();
            Ray::new(start + 1e-5 * normal, (aslant + 1.001 * normal).normalize())
        })
        .collect()
}

const RAYS: usize = 8192;

/// Up to how many triangles lanes are as fast as a tree: `lanes::MOST_TRIANGLES`.
#[divan::bench(args = [24, 48, 64, 96, 128, 192, 256], sample_count = 20)]
fn closest_in_lanes_by_triangles(bencher: Bencher, triangles: usize) {
    let scene = boxes(triangles);
    let (corners, all) = (SharedCorners::new(&scene), scattered_rays(&scene));
    let (mut rays, mut hits) = (Rays::default(), Hits::default());
    bencher.counter(ItemsCount::new(RAYS)).bench_local(|| {
        let mut found = 0;
        for group in all.chunks(GROUP) {
            group.iter().enumerate().for_each(|(lane, ray)| rays.set(lane, ray));
            let closest = Closest { scene: &corners, rays: &rays, hits: &mut hits };
            Width::widest().run(closest);
            hits.settle(&scene, &rays, group.len());
            found += hits.triangle.iter().filter(|triangle| **triangle != NONE).count();
        }
        found
    });
}

#[divan::bench(args = [24, 48, 64, 96, 128, 192, 256], sample_count = 20)]
fn closest_in_a_tree_by_triangles(bencher: Bencher, triangles: usize) {
    let scene = boxes(triangles);
    let (tree, all) = (Tree::new(scene.triangles()), scattered_rays(&scene));
    bencher
        .counter(ItemsCount::new(RAYS))
        .bench(|| all.iter().filter(|ray| tree.closest(ray, scene.triangles()).is_some()).count());
}

#[divan::bench(sample_count = 20)]
fn build_the_photon_map(bencher: Bencher) {
    let records = records();
    bencher
        .counter(ItemsCount::new(records.len()))
        .bench(|| PhotonMap::new(records.iter().map(|record| record.position)));
}

#[divan::bench(sample_count = 20)]
fn ask_the_photon_map(bencher: Bencher) {
    let records = records();
    let map = PhotonMap::new(records.iter().map(|record| record.position));
    let aside = Vec3::splat(0.01);
    bencher.counter(ItemsCount::new(records.len())).bench(|| {
        let is_near =
            |r: &&PhotonRecord| map.any_within_cube(r.position + aside, PHOTON_DOT_RADIUS);
        records.iter().filter(is_near).count()
    });
}

#[divan::bench(sample_count = 10)]
fn take_the_picture_in_lanes(bencher: Bencher) {
    let mut renderer = renderer();
    renderer.diffuse_map = PhotonMap::new(records().iter().map(|record| record.position));
    let camera = assignment8::create_camera(640, 480);
    let width = Width::widest();
    bencher.bench(|| picture::take_picture(&renderer, width, &camera, 640, 480, || ()));
}

#[divan::bench(sample_count = 3)]
fn take_the_picture_by_specification(bencher: Bencher) {
    let mut renderer = renderer();
    renderer.diffuse_map = PhotonMap::new(records().iter().map(|record| record.position));
    let camera = assignment8::create_camera(640, 480);
    bencher.bench(|| image_writer::take_picture(&renderer, &camera, 640, 480));
}

#[divan::bench(sample_count = 20)]
fn hash_a_list(bencher: Bencher) {
    let records = records();
    bencher.counter(ItemsCount::new(records.len())).bench(|| {
        let mut hash = ListHash::default();
        hash.update(&records);
        hash.hex()
    });
}

fn write(records: &[PhotonRecord], format: Format) -> Vec<u8> {
    let bytes = Cursor::new(Vec::with_capacity(4 * ROW_BYTES * records.len()));
    let mut writer = ListWriter::new(bytes, format, Vec::new()).expect("memory takes everything");
    writer.write(records).expect("memory takes everything");
    writer.finish().expect("memory takes everything").into_inner()
}

#[divan::bench(args = [Format::Ply, Format::Csv], sample_count = 10)]
fn write_a_list(bencher: Bencher, format: Format) {
    let records = records();
    bencher.counter(ItemsCount::new(records.len())).bench(|| write(&records, format));
}

#[divan::bench(args = [Format::Ply, Format::Csv], sample_count = 10)]
fn read_a_list(bencher: Bencher, format: Format) {
    let records = records();
    let file = tempfile::NamedTempFile::new().expect("a temporary file");
    std::fs::write(file.path(), write(&records, format)).expect("a temporary file");
    bencher
        .counter(ItemsCount::new(records.len()))
        .bench(|| reader::load(file.path()).expect("the list just written"));
}
