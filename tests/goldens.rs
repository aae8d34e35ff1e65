//! The exact photon lists and the picture.
//!
//! `INSTA_UPDATE=always cargo test --test goldens` refreshes everything in `golden/`; nothing else
//! writes there. See the value-stability policy in `CHANGELOG.md` before doing so.


use std::fmt::Write as _;
use std::path::Path;

use fixtures::{closed_cube, handout, hash, list};
use glam::Vec3;
use photon_mapping::assignment8;
use photon_list::PhotonRecord;
use photon_mapping::rendering::image_writer::take_picture;
use photon_mapping::rendering::photon_mapping_renderer::PhotonMappingRenderer;
use variants::reading::Reading;

fn snapshot(name: &str, content: &str) {
    let mut settings = insta::Settings::clone_current();
    settings.set_snapshot_path("../golden");
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    settings.bind(|| insta::assert_snapshot!(name, content));
}

/// Every float as its bits and in decimal.
fn exact(list: &[PhotonRecord]) -> String {
    let mut text = String::new();
    for record in list {
        let PhotonRecord { photon, bounce, surface, .. } = record;
        writeln!(text, "photon {photon} bounce {bounce} surface {surface}").unwrap();
        let vectors = [record.position, record.intensity, record.to_light];
        for (name, vector) in ["position", "intensity", "to_light"].into_iter().zip(vectors) {
            let Vec3 { x, y, z } = vector;
            let bits = vector.to_array().map(|float| format!("{:08x}", float.to_bits())).join(" ");
            writeln!(text, "  {name:9} {bits}  {x:?} {y:?} {z:?}").unwrap();
        }
    }
    text
}

#[test]
fn list_of_the_handout_at_seed_148() {
    snapshot("handout-seed-148", &exact(&list(&handout(148, 2000))));
}

#[test]
fn list_of_the_handout_at_seed_0() {
    snapshot("handout-seed-0", &exact(&list(&handout(0, 2000))));
}

#[test]
fn list_of_the_handout_at_the_largest_seed() {
    snapshot("handout-seed-largest", &exact(&list(&handout(u64::MAX, 2000))));
}

#[test]
fn list_of_the_letter_of_the_handout() {
    let reading = Reading::LETTER_OF_THE_HANDOUT;
    let letter = PhotonMappingRenderer { reading, ..handout(148, 2000) };
    snapshot("letter-of-the-handout", &exact(&list(&letter)));
}

#[test]
fn list_of_a_closed_cube() {
    snapshot("closed-cube", &exact(&list(&closed_cube(0.75, 148, 40))));
}

#[test]
fn hash_of_the_full_list() {
    snapshot("handout-1000000-sha256", &hash(&list(&handout(148, 1_000_000))));
}

#[test]
fn hash_on_one_two_and_seven_threads() {
    let renderer = handout(148, 100_000);
    let on = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| hash(&list(&renderer)))
    };
    assert_eq!([on(1), on(2), on(7)].map(|hash| hash == on(3)), [true; 3]);
}

#[test]
fn picture_of_the_handout() {
    let mut renderer = handout(148, 1_000_000);
    renderer.initialize_renderer();
    let (width, height) = (assignment8::WIDTH, assignment8::HEIGHT);
    let camera = assignment8::create_camera(width, height);
    let picture = take_picture(&renderer, &camera, width, height, || ());
    let golden = Path::new(env!("CARGO_MANIFEST_DIR")).join("golden/assignment8.png");
    if std::env::var("INSTA_UPDATE").is_ok_and(|mode| mode == "always") {
        picture.save(&golden).unwrap();
    }
    let golden = image::open(golden).expect("the golden picture is there").into_rgb8();
    let differing = picture.pixels().zip(golden.pixels()).filter(|(a, b)| a != b).count();
    assert_eq!((picture.dimensions(), differing), (golden.dimensions(), 0));
}
