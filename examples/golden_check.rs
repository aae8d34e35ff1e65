//! Traces the reference run, by `trace_photon` and in lanes, and holds both hashes against the golden
//! one: the check that another processor gives the same bits. Exits with 1 when it does not.

use photon_mapping::assignment8;
use fast::lanes::LaneTracer;
use fast::lanes::width::Width;
use variants::trace::trace_piece;
use photon_mapping::photon_list::ListHash;

fn main() {
    let renderer = assignment8::create_renderer(assignment8::create_scene());
    let photons = 0..renderer.emitted();
    let snapshot = include_str!("../golden/handout-1000000-sha256.snap");
    let golden = snapshot.lines().last().expect("the snapshot has a line for the hash");
    let mut lists = vec![("trace_photon".to_owned(), trace_piece(&renderer, photons.clone()))];
    for width in Width::available() {
        let lanes = LaneTracer::new(&renderer, width).expect("the scene is small");
        lists.push((format!("lanes, {width:?}"), lanes.trace_piece(photons.clone())));
    }
    println!("{}: golden {golden}", std::env::consts::ARCH);
    let mut is_golden = true;
    for (path, records) in lists {
        let mut hash = ListHash::default();
        hash.update_all(&records);
        println!("  {path}: {}", hash.hex());
        is_golden &= hash.hex() == golden;
    }
    std::process::exit(i32::from(!is_golden));
}
