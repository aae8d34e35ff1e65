//! Measures what the grader expects of every hypothesis in a picture and prints it:
//! `src/grading/picture/signatures.json`.

#[path = "common/shorten.rs"]
mod shorten;

use grading::picture::signature::PictureSignatures;
use grading::picture::view::View;
use grading::places::Places;
use grading::signature::Effort;
use photon_mapping::assignment8::{MAX_PHOTON_BOUNCES, create_scene};
use shorten::shorten;

/// With these, a signature is known better than the leeway that a density has.
const EFFORT: Effort = Effort {
    main: 60_000_000,
    fair: 12_000_000,
    misreading: 4_000_000,
    slow_misreading: 4_000_000,
    pair: 4_000_000,
};

fn main() {
    let places = Places::new(&create_scene());
    let view = View::new(&places);
    let signatures = PictureSignatures::measure(&places, &view, MAX_PHOTON_BOUNCES, EFFORT);
    let mut json = serde_json::to_value(&signatures).expect("signatures are numbers");
    shorten(&mut json);
    println!("{json}");
}
