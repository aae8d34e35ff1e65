//! The checks of a picture: are its dots where photons lie?

mod coverage;
pub mod dot_size;
pub mod dots;
mod dotted;
pub mod expectations;
pub mod expected;
pub mod judge;
pub mod kinds;
mod off_surface;
pub mod reading;
pub mod signature;
pub mod view;
mod words;

use std::path::Path;

use dot_size::DotSize;
use dots::find_dots;
use expectations::PictureExpectations;
use judge::{PictureJudgment, judge_dots};

/// Judges the picture `path`, for which `emitted` photons were emitted, if that is known.
///
/// # Errors
/// The reason, in words, if its dots cannot be told.
pub fn judge_picture(
    path: &Path,
    emitted: Option<f64>,
    expectations: &PictureExpectations,
) -> Result<PictureJudgment, String> {
    let picture = reading::read_picture(path)?;
    let dots = find_dots(&picture, &expectations.view, || expectations.shifted())?;
    let view = if dots.is_shifted { expectations.shifted() } else { &expectations.view };
    if let Some(size) = DotSize::new(&dots.red, view).filter(DotSize::is_too_large) {
        return Err(size.reason());
    }
    let mut judgment = judge_dots(&dots.red, view, emitted, expectations);
    judgment.findings.extend(dots.remarks);
    Ok(judgment)
}
