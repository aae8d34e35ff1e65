//! One row of a photon list, as a file gives it.

use glam::Vec3;
use photon_mapping::photon_list::PhotonRecord;

/// What stands for a column that a list does not have: NaN, and the largest whole number.
pub const ABSENT: PhotonRecord = PhotonRecord {
    position: Vec3::NAN,
    intensity: Vec3::NAN,
    to_light: Vec3::NAN,
    photon: u32::MAX,
    bounce: u16::MAX,
    surface: u16::MAX,
};

/// Sets column `column` of [`COLUMNS`](photon_mapping::photon_list::COLUMNS), given as text or as any
/// number; `None` when the value does not fit the column.
pub(crate) fn set(record: &mut PhotonRecord, column: usize, value: Value<'_>) -> Option<()> {
    match column {
        0..=2 => record.position[column] = value.float()?,
        3..=5 => record.intensity[column - 3] = value.float()?,
        6..=8 => record.to_light[column - 6] = value.float()?,
        9 => record.photon = value.whole()?.try_into().ok()?,
        10 => record.bounce = value.whole()?.try_into().ok()?,
        _ => record.surface = value.whole()?.try_into().ok()?,
    }
    Some(())
}

/// A value as a file gives it.
#[derive(Clone, Copy, Debug)]
pub(super) enum Value<'a> {
    Text(&'a str),
    Float(f32),
    Double(f64),
    Whole(i64),
}

impl Value<'_> {
    pub(super) fn float(self) -> Option<f32> {
        match self {
            Self::Text(text) => text.parse().ok().or_else(|| {
                // What C and C++ libraries print besides "nan".
                let text = text.to_ascii_lowercase();
                let unsigned = text.trim_start_matches(['+', '-']);
                let spellings = ["nan(", "1.#ind", "1.#qnan", "1.#snan"];
                let is_nan = spellings.iter().any(|spelling| unsigned.starts_with(spelling));
                is_nan.then_some(f32::NAN)
            }),
            Self::Float(float) => Some(float),
            Self::Double(double) => Some(double as f32),
            Self::Whole(whole) => Some(whole as f32),
        }
    }

    fn whole(self) -> Option<i64> {
        let from_double = |double: f64| {
            let whole = double as i64;
            (whole as f64 == double).then_some(whole)
        };
        match self {
            Self::Text(text) => {
                text.parse().ok().or_else(|| from_double(text.parse::<f64>().ok()?))
            }
            Self::Float(float) => from_double(f64::from(float)),
            Self::Double(double) => from_double(double),
            Self::Whole(whole) => Some(whole),
        }
    }
}

/// Which columns besides the position a list has.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Columns {
    /// `intensity_r`, `intensity_g` and `intensity_b`.
    pub intensity: bool,
    /// `to_light_x`, `to_light_y` and `to_light_z`.
    pub to_light: bool,
    /// `photon`.
    pub photon: bool,
    /// `bounce`.
    pub bounce: bool,
    /// `surface`.
    pub surface: bool,
}

impl Columns {
    /// Whether no column is missing.
    pub fn all(&self) -> bool {
        self.intensity && self.to_light && self.photon && self.bounce && self.surface
    }

    /// What a file has whose columns are at `places` of [`COLUMNS`](photon_mapping::photon_list::COLUMNS).
    pub(super) fn at(places: &[Option<usize>]) -> Self {
        let has = |place: usize| places.contains(&Some(place));
        Self {
            intensity: has(3) && has(4) && has(5),
            to_light: has(6) && has(7) && has(8),
            photon: has(9),
            bounce: has(10),
            surface: has(11),
        }
    }
}
