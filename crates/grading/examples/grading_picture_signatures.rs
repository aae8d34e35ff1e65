//! Measures what the grader expects of hypotheses in pictures, and writes it to
//! `crates/grading/golden/signatures-of-pictures.json`: of those that are not in it yet, or of all.
//!
//! `cargo run --release -p photon-mapping-grading --example grading_picture_signatures -- [all]`

#[path = "common/shorten.rs"]
mod shorten;

use grading::picture::signature::PictureSignature;
use grading::picture::view::View;
use grading::places::Places;
use grading::signature::{Effort, Kept};
use photon_mapping::assignment8::{MAX_PHOTON_BOUNCES, create_scene};
use shorten::write_short;

/// With these, a signature is known better than the leeway that a density has.
const EFFORT: Effort = Effort { main: 60_000_000, fair: 12_000_000, ..Effort::FULL };

fn main() {
    let of_all = std::env::args().nth(1).is_some();
    let mut kept: Kept<PictureSignature> =
        if of_all { Kept::default() } else { Kept::of_pictures() };
    let places = Places::new(&create_scene());
    kept.complete_pictures(&places, &View::new(&places), MAX_PHOTON_BOUNCES, EFFORT);
    write_short("crates/grading/golden/signatures-of-pictures.json", &kept);
}
