//! Arguments that need more than parsing a number.

use std::ops::Range;

use glam::{DVec3, Vec3};

use model::obj::ModelLight;

/// The longest edge of a picture, in pixels.
const LONGEST_EDGE: u32 = 16_384;

/// `640x480` as width and height in pixels.
pub fn size(text: &str) -> Result<(u32, u32), String> {
    let edge = |text: &str| text.parse().ok().filter(|edge| (1..=LONGEST_EDGE).contains(edge));
    text.split_once('x')
        .and_then(|(width, height)| Some((edge(width)?, edge(height)?)))
        .ok_or_else(|| format!("expected WIDTHxHEIGHT, each from 1 to {LONGEST_EDGE} pixels"))
}

/// `A..B` as the photons from A up to, but not with, B.
pub fn range(text: &str) -> Result<Range<u64>, String> {
    text.split_once("..")
        .and_then(|(start, end)| Some(number(start)?..number(end)?))
        .filter(|range: &Range<u64>| range.start < range.end)
        .ok_or_else(|| "expected A..B with whole numbers A < B".to_owned())
}

/// `x,y,z` or `x,y,z,r,g,b` as a light.
pub fn light(text: &str) -> Result<ModelLight, String> {
    let numbers: Option<Vec<f64>> = text
        .split(',')
        .map(|number| number.trim().parse().ok().filter(|number: &f64| number.abs() <= 1e9))
        .collect();
    let is_color = |color: &[f64]| {
        // Darker than this, the length of the color is zero in f32.
        let shines = |channel: &f64| *channel > 1e-18;
        color.iter().all(|channel| *channel >= 0.0) && color.iter().any(shines)
    };
    match numbers.as_deref() {
        Some([x, y, z]) => Ok(ModelLight { position: DVec3::new(*x, *y, *z), color: Vec3::ONE }),
        Some([x, y, z, color @ ..]) if color.len() == 3 && is_color(color) => Ok(ModelLight {
            position: DVec3::new(*x, *y, *z),
            color: DVec3::from_slice(color).as_vec3(),
        }),
        _ => Err("expected x,y,z or x,y,z,r,g,b: finite numbers, the color not negative and not \
                  black"
            .to_owned()),
    }
}

/// A whole number from `low` to `high`, which may be written as `1e6`.
pub fn whole<T>(low: T, high: T) -> impl Fn(&str) -> Result<T, String> + Clone + Send + Sync
where
    T: std::str::FromStr + PartialOrd + std::fmt::Display + Copy + Send + Sync,
{
    move |text: &str| {
        number(text)
            .filter(|number| (low..=high).contains(number))
            .ok_or_else(|| format!("expected a whole number from {low} to {high}"))
    }
}

/// `text` as a whole number; `1e6` is one, too.
fn number<T: std::str::FromStr>(text: &str) -> Option<T> {
    /// All whole numbers up to this one are exact in f64.
    const LARGEST: f64 = 9_007_199_254_740_992.0;
    let of_float = || {
        let number: f64 = text.parse().ok()?;
        let is_whole = number.fract() == 0.0 && number.abs() <= LARGEST;
        is_whole.then(|| format!("{number:.0}").parse().ok())?
    };
    text.parse().ok().or_else(of_float)
}
