//! Measures what the grader expects of every hypothesis and prints it: `src/grading/signatures.json`.

use serde_json::Value;

use photon_mapping::assignment8::{MAX_PHOTON_BOUNCES, create_scene};
use photon_mapping::grading::places::Places;
use photon_mapping::grading::signature::{Effort, Signatures};

fn main() {
    let places = Places::new(&create_scene());
    let signatures = Signatures::measure(&places, MAX_PHOTON_BOUNCES, Effort::FULL);
    let mut json = serde_json::to_value(&signatures).expect("signatures are numbers");
    shorten(&mut json);
    println!("{json}");
}

/// Rounds every number to the seven digits that are known of it at best.
fn shorten(json: &mut Value) {
    match json {
        Value::Array(values) => values.iter_mut().for_each(shorten),
        Value::Object(fields) => fields.values_mut().for_each(shorten),
        Value::Number(number) if number.is_f64() => {
            let short = format!("{:.6e}", number.as_f64().expect("it is an f64"));
            *json = short.parse::<f64>().expect("it was a number").into();
        }
        _ => {}
    }
}
