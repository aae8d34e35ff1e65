//! What the lines of a model can be.

use glam::{DVec3, Vec3};

use super::lines::{ObjLine, numbers};

/// Numbers larger than this are refused: their products would not be finite.
const LARGEST_COORDINATE: f64 = 1e9;

/// What changes no diffuse triangle: texture coordinates, smoothing, levels of detail, and the
/// parameters of curves and surfaces, whose own lines are not among these.
pub const WITHOUT_AREA: [&str; 24] = [
    "vt",
    "vp",
    "s",
    "mg",
    "bevel",
    "c_interp",
    "d_interp",
    "lod",
    "shadow_obj",
    "trace_obj",
    "maplib",
    "usemap",
    "cstype",
    "deg",
    "bmat",
    "step",
    "parm",
    "trim",
    "hole",
    "scrv",
    "sp",
    "end",
    "con",
    "stech",
];

/// Points and lines: no photon meets them.
pub const THIN: [&str; 5] = ["l", "p", "curv", "curv2", "ctech"];

/// Surfaces that are no polygons, and lines that bring in other files.
pub const REFUSED: [&str; 8] = ["surf", "bsp", "bzp", "cdc", "cdp", "res", "call", "csh"];

/// Whether `word` starts a line.
pub fn starts(word: &str) -> bool {
    let names = ["v", "vn", "f", "fo", "o", "g", "usemtl", "mtllib"];
    [&names[..], &WITHOUT_AREA, &THIN, &REFUSED].iter().any(|words| words.contains(&word))
}

/// The position in the line `v`.
pub fn vertex(line: &ObjLine) -> Result<DVec3, String> {
    let mut words = line.words();
    let position = vector(&mut words, "v")?;
    let more: Vec<&str> = words.collect();
    if more.iter().any(|word| word.parse::<f64>().is_err()) || more.len() > 4 {
        let found = more.join(" ");
        return Err(format!("expected x, y, z, a weight and a color after 'v', found '{found}'"));
    }
    // Three numbers more are a color; the first of one or four is a weight.
    match more.as_slice() {
        [weight] | [weight, _, _, _] if weight.parse() != Ok(1.0) => {
            Err(format!("expected the weight 1 after 'v', found '{weight}'"))
        }
        _ => Ok(turn(position)),
    }
}

/// The normal in the line `vn`.
pub fn normal(line: &ObjLine) -> Result<Vec3, String> {
    let normal = turn(vector(&mut line.words(), "vn")?).as_vec3();
    normal.try_normalize().ok_or_else(|| "expected a normal longer than zero after 'vn'".to_owned())
}

fn vector<'a>(words: &mut impl Iterator<Item = &'a str>, keyword: &str) -> Result<DVec3, String> {
    numbers(words, keyword, -LARGEST_COORDINATE..=LARGEST_COORDINATE, 0.0)
}

/// From y up to z up: +90 degrees about x.
fn turn(model: DVec3) -> DVec3 {
    DVec3::new(model.x, 0.0 - model.z, model.y)
}
