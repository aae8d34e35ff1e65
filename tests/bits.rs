//! The exact photon lists, traced by `trace_photon`, and the random numbers under them.
//!
//! `INSTA_UPDATE=always cargo test --workspace` refreshes everything in `golden/`; nothing else
//! writes there. See the value-stability policy in `CHANGELOG.md` before doing so.

use std::fmt::Write as _;

use crate::common::{closed_cube, handout, hash, list};
use glam::Vec3;
use photon_mapping::photon_list::{PhotonRecord, records, trace};
use photon_mapping::random::photon_random;
use proptest::prelude::*;

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
    snapshot("handout-seed-148", &exact(&trace(148, 2000)));
}

#[test]
fn list_of_the_handout_at_seed_0() {
    snapshot("handout-seed-0", &exact(&trace(0, 2000)));
}

#[test]
fn list_of_the_handout_at_the_largest_seed() {
    snapshot("handout-seed-largest", &exact(&trace(u64::MAX, 2000)));
}

#[test]
fn list_of_a_closed_cube() {
    snapshot("closed-cube", &exact(&list(&closed_cube(0.75, 148, 40))));
}

#[test]
fn hash_of_the_full_list() {
    snapshot("handout-1000000-sha256", &hash(&trace(148, 1_000_000)));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn adjoining_ranges_make_the_whole(
        seed: u64, mut cuts in prop::collection::vec(0_u64..3000, 0..5)
    ) {
        let renderer = handout(seed, 3000);
        cuts.extend([0, 3000]);
        cuts.sort_unstable();
        let mut pieces = Vec::new();
        for cut in cuts.windows(2) {
            let range = cut[0]..cut[1];
            renderer.generic_photon_map_generation(&mut Vec::new(), range, |photon, path, stored| {
                pieces.extend(records(&renderer.stored_scene, photon, path, stored));
            });
        }
        prop_assert_eq!(pieces, list(&renderer));
    }

    #[test]
    fn numbers_are_multiples_of_2_to_the_minus_24_below_one(seed: u64, photon: u64) {
        let mut rand = photon_random(seed, photon);
        for _ in 0..40 {
            let number = rand();
            prop_assert!((0.0..1.0).contains(&number));
            prop_assert_eq!((number * 16_777_216.0).fract(), 0.0);
        }
    }
}
