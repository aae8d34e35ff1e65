//! Traces photons of the handout's scene on one thread and does nothing else: `trace_photons Avx2
//! 100000` in lanes of a width, `trace_photons port 100000` with `trace_photon`. For programs that
//! count instructions.

use fast::lanes::LaneTracer;
use fast::lanes::width::Width;
use fast::trace::{pieces, trace_with_port};
use photon_mapping::assignment8;

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [how, photons] = &arguments[..] else { panic!("expected 'port' or a width, and a number") };
    let photons = 0..photons.parse().expect("a number of photons");
    let renderer = assignment8::create_renderer(assignment8::create_scene());
    let width = Width::available().into_iter().find(|width| format!("{width:?}") == *how);
    let lanes = width.and_then(|width| LaneTracer::new(&renderer, width));
    assert!(lanes.is_some() || how == "port", "{how}: not a width of this processor");
    let trace = |piece| match &lanes {
        Some(lanes) => lanes.trace_piece(piece),
        None => trace_with_port(&renderer, piece),
    };
    println!("{} stored", pieces(&photons).map(|piece| trace(piece).len()).sum::<usize>());
}
