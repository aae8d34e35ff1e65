//! Measures what the grader expects of hypotheses in lists, and writes it to
//! `crates/grading/golden/signatures-of-lists.json`: of those that are not in it yet, or of all.
//!
//! `cargo run --release -p photon-mapping-grading --example grading_signatures -- [all]`

#[path = "common/shorten.rs"]
mod shorten;

use grading::places::Places;
use grading::signature::{Effort, Kept, Signature};
use photon_mapping::assignment8::{MAX_PHOTON_BOUNCES, create_scene};
use shorten::write_short;

fn main() {
    let of_all = std::env::args().nth(1).is_some();
    let mut kept: Kept<Signature> = if of_all { Kept::default() } else { Kept::of_assignment8() };
    kept.complete(&Places::new(&create_scene()), MAX_PHOTON_BOUNCES, Effort::FULL);
    write_short("crates/grading/golden/signatures-of-lists.json", &kept);
}
