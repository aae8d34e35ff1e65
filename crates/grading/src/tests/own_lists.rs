//! Whose list it is: known where it is ours, in part and moved.

use glam::Vec3;
use photon_mapping::photon_list::PhotonRecord;

use crate::own::seed_of;

fn list(seed: u64, photons: u64) -> Vec<PhotonRecord> {
    fixtures::list(&fixtures::handout(seed, photons))
}

#[test]
fn own_lists_are_known_in_part_and_moved() {
    for (seed, photons) in [(148, 1_000_000), (3, 200_000), (255, 20_000), (77_777, 200_000)] {
        let mut all = list(seed, photons);
        assert_eq!(seed_of(&all, 77_777), Some(seed));
        for (at, record) in all.iter_mut().enumerate() {
            let by = Vec3::new((at % 3) as f32 - 1.0, (at % 5) as f32 / 2.0 - 1.0, 0.5);
            record.position += 1e-3 * by;
        }
        assert_eq!(seed_of(&all, 77_777), Some(seed));
        let half: Vec<_> = all.iter().copied().skip(1).step_by(2).collect();
        assert_eq!(seed_of(&half, 77_777), Some(seed));
        let tenth: Vec<_> = all.iter().copied().skip(1).step_by(10).collect();
        assert_eq!(seed_of(&tenth, 77_777), Some(seed), "{photons}");
        let mixed = [half, list(1_000, photons / 2)].concat();
        assert_eq!(seed_of(&mixed, 77_777), Some(seed), "{photons}");
    }
}

#[test]
fn lists_of_others_are_not_taken_for_own_ones() {
    let other = |seed: u64, photons: u64| seed_of(&list(seed, photons), 148);
    for (photons, runs) in [(2_000, 50), (60_000, 50), (200_000, 50), (1_000_000, 20)] {
        assert!((1_000..1_000 + runs).all(|seed| other(seed, photons).is_none()), "{photons}");
    }
    assert_eq!(other(1_002, 5_000_000), None);
    assert_eq!(seed_of(&[], 148), None);
}
