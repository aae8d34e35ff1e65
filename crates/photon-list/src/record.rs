//! One row of a photon list, as a file gives it.

use std::path::Path;

use glam::Vec3;
use photon_mapping::photon_list::{COLUMNS, PhotonRecord};

use super::error::{At, ListError, Reason, start};

/// The first column of [`COLUMNS`] that holds whole numbers, and which these columns hold.
const FIRST_WHOLE: usize = 9;
const WHOLE: [&str; 3] = [
    "a whole number from 0 to 4294967295",
    "a whole number from 0 to 65535",
    "a whole number from 0 to 65535",
];

/// What stands for a column that a list does not have: NaN, and the largest whole number.
pub const ABSENT: PhotonRecord = PhotonRecord {
    position: Vec3::NAN,
    intensity: Vec3::NAN,
    to_light: Vec3::NAN,
    photon: u32::MAX,
    bounce: u16::MAX,
    surface: u16::MAX,
};

/// Sets column `column` of [`COLUMNS`](photon_mapping::photon_list::COLUMNS), given as text or as
/// any number; `None` when the value does not fit the column.
fn set(record: &mut PhotonRecord, column: usize, value: Value<'_>) -> Option<()> {
    match column {
        0..=2 => record.position[column] = value.float()?,
        3..=5 => record.intensity[column - 3] = value.float()?,
        6..=8 => record.to_light[column - 6] = value.float()?,
        FIRST_WHOLE => record.photon = value.whole()?.try_into().ok()?,
        10 => record.bounce = value.whole()?.try_into().ok()?,
        _ => record.surface = value.whole()?.try_into().ok()?,
    }
    Some(())
}

/// A value as a file gives it.
#[derive(Clone, Copy, Debug)]
pub(super) enum Value<'a> {
    Text(&'a str),
    /// Text between separators: that of a float may have a decimal comma.
    Cell(&'a str),
    Float(f32),
    Double(f64),
    Whole(i64),
}

impl Value<'_> {
    pub(super) fn float(self) -> Option<f32> {
        match self {
            Self::Text(text) => text.parse().ok().or_else(|| not_finite(text)),
            Self::Cell(text) if text.contains(',') => {
                Value::Text(&text.replacen(',', ".", 1)).float()
            }
            Self::Cell(text) => Self::Text(text).float(),
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
            // A comma in a whole number is between its thousands.
            Self::Text(text) | Self::Cell(text) => {
                text.parse().ok().or_else(|| from_double(text.parse::<f64>().ok()?))
            }
            Self::Float(float) => from_double(f64::from(float)),
            Self::Double(double) => from_double(double),
            Self::Whole(whole) => Some(whole),
        }
    }
}

/// What C and C++ libraries print besides "nan" and "inf": `1.#J` is `1.#INF` with one digit.
fn not_finite(text: &str) -> Option<f32> {
    let text = text.to_ascii_lowercase();
    let unsigned = text.strip_prefix(['+', '-']).unwrap_or(&text);
    let is = |spellings: &[&str]| spellings.iter().any(|start| unsigned.starts_with(start));
    match text.starts_with('-') {
        _ if is(&["nan(", "1.#ind", "1.#qnan", "1.#snan"]) => Some(f32::NAN),
        true if is(&["1.#inf", "1.#j"]) => Some(f32::NEG_INFINITY),
        false if is(&["1.#inf", "1.#j"]) => Some(f32::INFINITY),
        _ => None,
    }
}

/// The rows of a list, as they are read.
pub(super) struct Rows<'path, OnRecord> {
    path: &'path Path,
    /// Whether an optional column that cannot be read is refused, and not left out.
    is_strict: bool,
    /// Takes each record, and says whether it wants more.
    pub on_record: OnRecord,
    /// For each column of [`COLUMNS`] that cannot be read, why.
    pub left_out: [Option<ListError>; COLUMNS.len()],
}

impl<'path, OnRecord: FnMut(PhotonRecord) -> Result<bool, ListError>> Rows<'path, OnRecord> {
    pub fn new(path: &'path Path, is_strict: bool, on_record: OnRecord) -> Self {
        Self { path, is_strict, on_record, left_out: Default::default() }
    }

    /// Sets `column` of `record` to `value`, which stands in the line or row `at`.
    pub fn set(
        &mut self,
        record: &mut PhotonRecord,
        column: usize,
        value: Value<'_>,
        at: At,
    ) -> Result<(), ListError> {
        if set(record, column, value).is_some() || self.left_out[column].is_some() {
            return Ok(());
        }
        let name = COLUMNS[column];
        let kind = if column < FIRST_WHOLE { "a number" } else { WHOLE[column - FIRST_WHOLE] };
        let found = match value {
            Value::Text(text) | Value::Cell(text) => start(text),
            Value::Float(float) => float.to_string(),
            Value::Double(double) => double.to_string(),
            Value::Whole(whole) => whole.to_string(),
        };
        let message = format!("expected {kind} for '{name}'");
        let reason = Reason { message, found: Some(found) };
        let error = ListError::at(self.path, at, reason);
        if self.is_strict || column < 3 {
            return Err(error);
        }
        self.left_out[column] = Some(error);
        Ok(())
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
    /// All of them.
    pub const ALL: Self =
        Self { intensity: true, to_light: true, photon: true, bounce: true, surface: true };

    /// What a file has whose columns are at `places` of
    /// [`COLUMNS`](photon_mapping::photon_list::COLUMNS).
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
    /// Leaves out what `place` of [`COLUMNS`] is part of, also from `records`.
    pub(super) fn forget(&mut self, place: usize, records: &mut [PhotonRecord]) {
        let (has, forget): (&mut bool, fn(&mut PhotonRecord)) = match place {
            0..=2 => return,
            3..=5 => (&mut self.intensity, |record| record.intensity = ABSENT.intensity),
            6..=8 => (&mut self.to_light, |record| record.to_light = ABSENT.to_light),
            FIRST_WHOLE => (&mut self.photon, |record| record.photon = ABSENT.photon),
            10 => (&mut self.bounce, |record| record.bounce = ABSENT.bounce),
            _ => (&mut self.surface, |record| record.surface = ABSENT.surface),
        };
        *has = false;
        records.iter_mut().for_each(forget);
    }
}
