//! Traces the reference run in lanes of every width and holds the hashes against the golden one.
//! Exits with 1 when one differs.

use std::process::ExitCode;

use fast::lanes::LaneTracer;
use fast::lanes::width::Width;
use photon_mapping::assignment8;
use photon_mapping::photon_list::ListHash;

fn main() -> ExitCode {
    let renderer = assignment8::create_renderer(assignment8::create_scene());
    let snapshot = include_str!("../../../golden/handout-1000000-sha256.snap");
    let golden = snapshot.lines().last().expect("the snapshot has a line for the hash");
    println!("{}: golden {golden}", std::env::consts::ARCH);
    let mut is_golden = true;
    for width in Width::available() {
        let lanes = LaneTracer::new(&renderer, width).expect("the scene is small");
        let mut hash = ListHash::default();
        hash.update(&lanes.trace_piece(0..renderer.emitted()));
        println!("  lanes, {width:?}: {}", hash.hex());
        is_golden &= hash.hex() == golden;
    }
    if is_golden { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}
