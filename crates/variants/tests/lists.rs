//! Whole lists on the fast path: the letter of the handout, and any number of threads.

use std::fmt::Write as _;

use fixtures::{handout, hash, list};
use photon_mapping::photon_list::{PhotonRecord, trace};
use variants::reading::Reading;
use variants::run::Run;

/// Every float as its bits and in decimal.
fn exact(list: &[PhotonRecord]) -> String {
    let mut text = String::new();
    for record in list {
        let PhotonRecord { photon, bounce, surface, .. } = record;
        writeln!(text, "photon {photon} bounce {bounce} surface {surface}").unwrap();
        let vectors = [record.position, record.intensity, record.to_light];
        for (name, vector) in ["position", "intensity", "to_light"].into_iter().zip(vectors) {
            let [x, y, z] = vector.to_array();
            let bits = vector.to_array().map(|float| format!("{:08x}", float.to_bits())).join(" ");
            writeln!(text, "  {name:9} {bits}  {x:?} {y:?} {z:?}").unwrap();
        }
    }
    text
}

#[test]
fn list_of_the_letter_of_the_handout() {
    let letter = Run { reading: Reading::LETTER_OF_THE_HANDOUT, ..handout(148, 2000) };
    let mut settings = insta::Settings::clone_current();
    settings.set_snapshot_path("../../../golden");
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    let content = exact(&list(&letter));
    settings.bind(|| insta::assert_snapshot!("letter-of-the-handout", content));
    assert_eq!(letter.trace_piece(0..2000), list(&letter), "lanes and tracer differ");
}

#[test]
fn hash_on_one_two_and_seven_threads() {
    let run = handout(148, 100_000);
    let of_port = hash(&trace(148, 100_000));
    for threads in [1, 2, 7] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        assert_eq!(pool.install(|| hash(&list(&run))), of_port, "{threads} threads");
    }
}
