//! Measures what the grader expects of hypotheses, and writes it to `crates/grading/golden`: of
//! those that are not in it yet, or of all.
//!
//! `cargo run --release -p photon-mapping-grading --example grading_signatures -- [all]`

#[path = "common/shorten.rs"]
mod shorten;

use grading::picture::signature::PictureSignature;
use grading::picture::view::View;
use grading::places::Places;
use grading::short::ShortPaths;
use grading::signature::{KeptSignatures, Signature};
use photon_mapping::assignment8::create_scene;
use shorten::write_short;

fn main() {
    let of_all = std::env::args().nth(1).is_some();
    let places = Places::new(&create_scene());
    let golden = |name: &str| format!("crates/grading/golden/{name}.json");

    let mut short = if of_all { ShortPaths::default() } else { ShortPaths::of_assignment8() };
    short.complete(&places);
    write_short(&golden("short-paths"), &short);

    let mut lists: KeptSignatures<Signature> =
        if of_all { KeptSignatures::default() } else { KeptSignatures::of_assignment8() };
    lists.complete(&places);
    write_short(&golden("signatures-of-lists"), &lists);

    let mut pictures: KeptSignatures<PictureSignature> =
        if of_all { KeptSignatures::default() } else { KeptSignatures::of_pictures() };
    pictures.complete_pictures(&places, &View::new(&places));
    write_short(&golden("signatures-of-pictures"), &pictures);
}
