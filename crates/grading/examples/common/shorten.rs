//! Numbers as short as they are known.

use serde::Serialize;
use serde_json::Value;

/// Writes `signatures` to `path`, a row for each.
pub fn write_short(path: &str, signatures: &impl Serialize) {
    let mut json = serde_json::to_value(signatures).expect("signatures are numbers");
    shorten(&mut json);
    let rows = json.to_string().replace("},\"", "},\n\"");
    std::fs::write(path, rows + "\n").expect("the file can be written");
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
