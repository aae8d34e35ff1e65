//! Measures what the grader expects of every hypothesis in a picture and prints it:
//! `src/grading/picture/signatures.json`.

use serde_json::Value;

use photon_mapping::assignment8::{MAX_PHOTON_BOUNCES, create_scene};
use photon_mapping::grading::picture::signature::PictureSignatures;
use photon_mapping::grading::picture::view::View;
use photon_mapping::grading::places::Places;
use photon_mapping::grading::signature::Effort;

/// With these, a signature is known better than the leeway that a density has.
const EFFORT: Effort = Effort {
    main: 60_000_000,
    fair: 12_000_000,
    misreading: 4_000_000,
    slow_misreading: 4_000_000,
};

fn main() {
    let places = Places::new(&create_scene());
    let view = View::new(&places);
    let signatures = PictureSignatures::measure(&places, &view, MAX_PHOTON_BOUNCES, EFFORT);
    let mut json = serde_json::to_value(&signatures).expect("signatures are numbers");
    shorten(&mut json);
    println!("{json}");
}

/// Writes whole numbers as such, and rounds all others to the five digits that are known at best.
fn shorten(json: &mut Value) {
    match json {
        Value::Array(values) => values.iter_mut().for_each(shorten),
        Value::Object(fields) => fields.values_mut().for_each(shorten),
        Value::Number(number) if number.is_f64() => {
            let value = number.as_f64().expect("it is an f64");
            *json = if value.fract() == 0.0 && value.abs() < 1e15 {
                (value as i64).into()
            } else {
                let short = format!("{value:.4e}");
                short.parse::<f64>().expect("it was a number").into()
            };
        }
        _ => {}
    }
}
