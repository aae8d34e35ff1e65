//! Traces the reference run and holds its hash against the golden one: the check that another
//! processor gives the same bits. Exits with 1 when it does not.

use photon_mapping::assignment8;
use photon_mapping::photon_list::trace::trace_piece;
use photon_mapping::photon_list::writer::ListHash;

fn main() {
    let renderer = assignment8::create_renderer(assignment8::create_scene());
    let mut hash = ListHash::default();
    trace_piece(&renderer, 0..renderer.emitted()).iter().for_each(|record| hash.update(record));
    let snapshot = include_str!("../golden/handout-1000000-sha256.snap");
    let golden = snapshot.lines().last().expect("the snapshot has a line for the hash");
    let (found, processor) = (hash.hex(), std::env::consts::ARCH);
    println!("{processor}: found {found}, golden {golden}");
    std::process::exit(i32::from(found != golden));
}
