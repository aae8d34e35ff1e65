//! The fast path gives the bits of the specification: any scene, any width.

use fast::lanes::offset::Offset;
use fast::lanes::width::Width;
use fast::lanes::{LaneTracer, MOST_TRIANGLES, picture};
use fast::trace::trace_with_port;
use glam::Vec3;
use model::placement::Placement;
use photon_mapping::assignment8;
use photon_mapping::photon_list::ListHash;
use photon_mapping::photon_list::PhotonRecord;
use photon_mapping::rendering::image_writer;
use photon_mapping::scene::Material;
use photon_mapping::scene::MeshObject;
use photon_mapping::scene::Scene;
use photon_mapping::scene::camera::PerspectiveCamera;
use photon_mapping::scene::point_light::PointLight;
use photon_mapping::scene::triangle::Triangle;
use proptest::prelude::*;
use variants::reading::Reading;
use variants::run::Run;
use variants::sampler::Sampler;
use variants::tracer;

fn rows(records: &[PhotonRecord]) -> Vec<[u8; 44]> {
    records.iter().map(PhotonRecord::to_row).collect()
}

/// Coordinates that often coincide, so that rays meet corners, edges and planes exactly, beside
/// some that are tiny or huge.
fn coordinate() -> impl Strategy<Value = f32> {
    prop_oneof![
        6 => (-4_i8..=4).prop_map(f32::from),
        6 => -3.0_f32..3.0,
        1 => prop_oneof![Just(1e-30_f32), Just(-1e-12), Just(3e4), Just(-0.0)],
    ]
}

fn point() -> impl Strategy<Value = Vec3> {
    (coordinate(), coordinate(), coordinate()).prop_map(|(x, y, z)| Vec3::new(x, y, z))
}

/// Corners of triangles of which one in thirteen is as small as a detail of a wide scene.
fn corners() -> impl Strategy<Value = [Vec3; 3]> {
    let tiny = (point(), [point(), point(), point()], 1..20_i32)
        .prop_map(|(place, around, smaller)| around.map(|p| place + p / (1 << smaller) as f32));
    prop_oneof![12 => [point(), point(), point()], 1 => tiny]
}

fn triangle() -> impl Strategy<Value = Triangle> {
    let normal = prop_oneof![Just(Vec3::X), Just(-Vec3::X), Just(Vec3::Y), Just(Vec3::Z)];
    (corners(), 0..3_usize, normal, any::<bool>()).prop_map(
        |(vertices, parent_mesh_object, axis, is_true)| {
            let [a, b, c] = vertices;
            let of_plane = (b - a).cross(c - a).try_normalize();
            let normal = of_plane.filter(|_| is_true).unwrap_or(axis);
            Triangle { vertices, normal, parent_mesh_object, facet: 0 }
        },
    )
}

fn run() -> impl Strategy<Value = Run> {
    let mesh_objects = || {
        [0.2, 0.9, 1.0]
            .map(|d| MeshObject { name: String::new(), material: Material::new(Vec3::splat(d)) })
    };
    let light = (point(), 0.0_f32..1.0, 0.1_f32..1.0)
        .prop_map(|(position, r, g)| PointLight { position, color: Vec3::new(r, g, 0.5) });
    let reading = prop_oneof![
        3 => Just(Reading::REFERENCE),
        1 => Just(Reading::LETTER_OF_THE_HANDOUT),
        1 => Just(Reading { offset: Offset::None, ..Reading::REFERENCE }),
        1 => Just(Reading { offset: Offset::AlongDirection(1e-3), ..Reading::REFERENCE }),
    ];
    (
        prop_oneof![
            9 => prop::collection::vec(triangle(), 0..30),
            1 => prop::collection::vec(triangle(), 60..=MOST_TRIANGLES),
        ],
        prop::collection::vec(light, 1..4),
        1..4000_u64,
        -1..12,
        any::<u64>(),
        reading,
    )
        .prop_map(move |(triangles, lights, photon_count, bounces, seed, reading)| {
            let scene = Scene::new(mesh_objects().to_vec(), triangles, lights);
            let mut run = Run::of_scene(scene, Placement::WORLD, seed, photon_count);
            run.renderer.max_photon_bounces = bounces;
            run.reading = reading;
            run
        })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, ..ProptestConfig::default() })]

    #[test]
    fn lanes_have_the_bits_of_trace_photon(
        run in run(),
        ends in (0.0_f64..1.0, 0.0_f64..1.0),
    ) {
        let emitted = run.renderer.emitted();
        let start = (ends.0 * 0.5 * emitted as f64) as u64;
        let photons = start..emitted - (ends.1 * (emitted - start) as f64 * 0.5) as u64;
        let expected = rows(&run.trace_piece(photons.clone()));
        for width in Width::available() {
            let frame = |normal| run.reading.tangent_frame(normal);
            let lanes = LaneTracer::with_frames(&run.renderer, width, frame, run.reading.offset);
            let lanes = lanes.expect("the scene is small");
            prop_assert_eq!(&rows(&lanes.trace_piece(photons.clone())), &expected, "{:?}", width);
        }
    }
}

#[test]
fn the_default_run_is_the_same_at_every_width() {
    let golden = include_str!("../../../golden/handout-1000000-sha256.snap");
    let golden = golden.lines().last().expect("the snapshot has a line for the hash");
    let renderer = assignment8::create_renderer(assignment8::create_scene());
    for width in Width::available() {
        let lanes = LaneTracer::new(&renderer, width).expect("the scene is small");
        let mut hash = ListHash::default();
        for start in (0..assignment8::PHOTON_COUNT).step_by(100_000) {
            hash.update(&lanes.trace_piece(start..start + 100_000));
        }
        assert_eq!(hash.hex(), golden, "{width:?}");
    }
}

#[test]
fn the_last_photons_of_the_largest_run_are_the_same() {
    let mut renderer = assignment8::create_renderer(assignment8::create_scene());
    renderer.photon_count = u64::from(u32::MAX);
    let emitted = renderer.emitted();
    let photons = emitted - 3000..emitted;
    let lanes = LaneTracer::new(&renderer, Width::widest()).expect("the scene is small");
    assert_eq!(
        rows(&lanes.trace_piece(photons.clone())),
        rows(&trace_with_port(&renderer, photons))
    );
}

#[test]
fn the_picture_is_the_same_at_every_width() {
    let mut renderer = assignment8::create_renderer(assignment8::create_scene());
    renderer.photon_count = 200_000;
    renderer.initialize_renderer(|_, _, _| ());
    // Not a multiple of the lanes.
    let (width, height) = (203, 150);
    let camera = assignment8::create_camera(width, height);
    let expected = image_writer::take_picture(&renderer, &camera, width, height);
    for lanes in Width::available() {
        let picture = picture::take_picture(&renderer, lanes, &camera, width, height, || ());
        assert_eq!(picture.difference, None, "{lanes:?}");
        assert!(picture.picture == expected, "{lanes:?}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 200, ..ProptestConfig::default() })]

    #[test]
    fn pictures_of_other_scenes_are_the_same(
        run in run(),
        position in point(),
        target in point(),
        field_of_view in 5.0_f32..120.0,
    ) {
        let mut renderer = run.renderer;
        renderer.photon_count = renderer.photon_count.min(300);
        renderer.initialize_renderer(|_, _, _| ());
        let (width, height) = (37, 23);
        let forward = (target - position).try_normalize().unwrap_or(Vec3::Y);
        let up = forward.any_orthonormal_vector();
        let ratio = width as f32 / height as f32;
        let camera = PerspectiveCamera::new(position, forward, up, field_of_view, ratio);
        let expected = image_writer::take_picture(&renderer, &camera, width, height);
        for lanes in Width::available() {
            let picture = picture::take_picture(&renderer, lanes, &camera, width, height, || ());
            prop_assert_eq!(picture.difference, None, "{:?}", lanes);
            prop_assert!(picture.picture == expected, "{:?}", lanes);
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, ..ProptestConfig::default() })]

    #[test]
    fn the_tracer_with_neutral_knobs_has_the_bits_of_trace_photon(run in run()) {
        let photons = 0..run.renderer.emitted();
        let mut port = Vec::new();
        run.renderer.generic_photon_map_generation(&mut port, photons.clone(), |_, _, _| ());
        let mut tracer = Vec::new();
        tracer::generic_photon_map_generation(
            &run.renderer,
            &Reading::REFERENCE,
            Sampler::ChaCha,
            &mut tracer,
            photons,
            |_, _, _| (),
        );
        // Debug output tells bits apart, also where floats are equal or not numbers.
        prop_assert_eq!(format!("{port:?}"), format!("{tracer:?}"));
    }
}
