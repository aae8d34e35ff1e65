//! The picture: the photon map's one question, and the pixels.

use std::path::Path;

use crate::common::handout;
use glam::Vec3;
use photon_mapping::assignment8;
use photon_mapping::rendering::image_writer::take_picture;
use photon_mapping::rendering::photon_map::PhotonMap;
use photon_mapping::rendering::photon_mapping_renderer::PHOTON_DOT_RADIUS;
use proptest::prelude::*;

#[test]
fn picture_of_the_handout() {
    let mut renderer = handout(148, 1_000_000);
    renderer.initialize_renderer(|_, _, _| ());
    let (width, height) = (assignment8::WIDTH, assignment8::HEIGHT);
    let camera = assignment8::create_camera(width, height);
    let picture = take_picture(&renderer, &camera, width, height);
    let golden = Path::new(env!("CARGO_MANIFEST_DIR")).join("golden/assignment8.png");
    if std::env::var("INSTA_UPDATE").is_ok_and(|mode| mode == "always") {
        picture.save(&golden).unwrap();
    }
    let golden = image::open(golden).expect("the golden picture is there").into_rgb8();
    let differing = picture.pixels().zip(golden.pixels()).filter(|(a, b)| a != b).count();
    assert_eq!((picture.dimensions(), differing), (golden.dimensions(), 0));
}

/// Coordinates that crowd together, on both sides of zero and of cell borders.
fn coordinate() -> impl Strategy<Value = f32> {
    prop_oneof![Just(0.0), -0.02_f32..0.02, (-3_i32..=3).prop_map(|k| k as f32 * 0.003)]
}

fn point() -> impl Strategy<Value = Vec3> {
    (coordinate(), coordinate(), coordinate()).prop_map(|(x, y, z)| Vec3::new(x, y, z))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn cube_query_matches_a_plain_search(
        photons in prop::collection::vec(point(), 0..60),
        points in prop::collection::vec(point(), 50),
    ) {
        let map = PhotonMap::new(photons.clone());
        for point in points {
            let plain = photons
                .iter()
                .any(|photon| (*photon - point).abs().max_element() <= PHOTON_DOT_RADIUS);
            prop_assert_eq!(map.any_within_cube(point, PHOTON_DOT_RADIUS), plain);
        }
    }
}

#[test]
fn faces_of_the_cube_belong_to_it() {
    let map = PhotonMap::new([Vec3::ZERO]);
    let corner = Vec3::splat(PHOTON_DOT_RADIUS);
    assert!(map.any_within_cube(corner, PHOTON_DOT_RADIUS), "a cube, not a sphere");
    assert!(!map.any_within_cube(corner * 1.0001, PHOTON_DOT_RADIUS));
}

#[test]
fn photons_far_away_are_no_trouble() {
    let map = PhotonMap::new([Vec3::splat(3e38), Vec3::splat(-3e38), Vec3::X]);
    assert!(map.any_within_cube(Vec3::X, PHOTON_DOT_RADIUS));
    assert!(!map.any_within_cube(Vec3::Y, PHOTON_DOT_RADIUS));
}

#[test]
fn photon_that_is_not_a_number_is_near_everything() {
    let map = PhotonMap::new([Vec3::new(0.0, f32::NAN, 0.0)]);
    assert!(map.any_within_cube(Vec3::ONE, PHOTON_DOT_RADIUS));
    assert!(!PhotonMap::new([]).any_within_cube(Vec3::ONE, PHOTON_DOT_RADIUS));
}
