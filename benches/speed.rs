//! How long each part takes: `cargo bench --bench speed`. Compare within one run, not across.

use std::io::Cursor;

use divan::counter::ItemsCount;
use divan::{Bencher, black_box};
use glam::Vec3;
use photon_mapping::assignment8;
use photon_mapping::lanes::width::Width;
use photon_mapping::lanes::{LaneTracer, picture};
use photon_mapping::photon_list::record::PhotonRecord;
use photon_mapping::photon_list::trace::{trace_list, trace_piece};
use photon_mapping::photon_list::writer::{Format, ListHash, ListWriter};
use photon_mapping::photon_list::{reader, record};
use photon_mapping::random::photon_random;
use photon_mapping::rendering::image_writer;
use photon_mapping::rendering::photon_map::PhotonMap;
use photon_mapping::rendering::photon_mapping_renderer::{
    PHOTON_DOT_RADIUS, PhotonMappingRenderer,
};
use photon_mapping::scene::intersection_state::IntersectionState;
use photon_mapping::scene::ray::Ray;
use photon_mapping::scene::tree::Tree;

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
    bencher.counter(ItemsCount::new(20_000_u64)).bench(|| trace_piece(&renderer, 0..20_000));
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

/// The same rays with and without a tree: below how many triangles it does not pay.
#[divan::bench]
fn closest_in_a_tree_of_as_many(bencher: Bencher) {
    let scene = assignment8::create_scene();
    let tree = Tree::new(scene.triangles());
    let ray = Ray::new(scene.lights()[0].position, Vec3::new(0.6, 0.0, -0.8));
    bencher.bench(|| tree.closest(black_box(&ray)));
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
    bencher.bench(|| image_writer::take_picture(&renderer, &camera, 640, 480, || ()));
}

#[divan::bench(sample_count = 20)]
fn hash_a_list(bencher: Bencher) {
    let records = records();
    bencher.counter(ItemsCount::new(records.len())).bench(|| {
        let mut hash = ListHash::default();
        hash.update_all(&records);
        hash.hex()
    });
}

fn write(records: &[PhotonRecord], format: Format) -> Vec<u8> {
    let bytes = Cursor::new(Vec::with_capacity(4 * record::ROW_BYTES * records.len()));
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
