//! Two pictures, compared pixel by pixel and dot by dot.

use image::{Rgb, RgbImage};
use serde::Serialize;

use super::numbers::thousands;
use super::report::Outcome;

/// A dot adds all red there is to a pixel, which no surface of the box comes near by direct light.
const RED_OF_DOT: u8 = 255;
/// Dots that both have: lighter than any surface, and darker than what differs.
const MATCHING: Rgb<u8> = Rgb([120; 3]);

/// The comparison of two pictures. Within the tolerance means here that every pixel, but for as
/// many as may differ, has or lacks its dot as it should, and that no channel is further off than
/// one step.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct PictureReport {
    /// How they compare.
    pub outcome: Outcome,
    /// Width and height of the reference in pixels.
    pub reference_size: (u32, u32),
    /// Width and height of the submission in pixels.
    pub submission_size: (u32, u32),
    /// Pixels of which any channel differs; none when the sizes do, as for what follows.
    pub differing_pixels: Option<u64>,
    /// By how many of 255 steps a channel differs at most.
    pub largest_difference: Option<u8>,
    /// Pixels with a dot only in the reference.
    pub dots_missing: Option<u64>,
    /// Pixels with a dot only in the submission.
    pub dots_extra: Option<u64>,
}

/// Compares two pictures, of which `allowed` pixels may have or lack a dot that the other has not.
/// The difference picture shows the reference in gray, dots that both have a little lighter,
/// missing dots in blue, extra dots in red, and other differences in yellow. There is none when the
/// pictures have different sizes.
pub fn compare_pictures(
    reference: &RgbImage,
    submission: &RgbImage,
    allowed: u64,
) -> (PictureReport, Option<RgbImage>) {
    let mut report = PictureReport {
        outcome: Outcome::Different,
        reference_size: reference.dimensions(),
        submission_size: submission.dimensions(),
        differing_pixels: None,
        largest_difference: None,
        dots_missing: None,
        dots_extra: None,
    };
    if report.reference_size != report.submission_size {
        return (report, None);
    }
    let (mut differing, mut missing, mut extra, mut largest) = (0, 0, 0, 0);
    let mut largest_besides_dots = 0;
    let mut difference = RgbImage::new(reference.width(), reference.height());
    for ((a, b), shown) in reference.pixels().zip(submission.pixels()).zip(difference.pixels_mut())
    {
        let steps = a.0.iter().zip(b.0).map(|(a, b)| a.abs_diff(b)).max().unwrap_or(0);
        differing += u64::from(steps > 0);
        largest = largest.max(steps);
        if (a[0] == RED_OF_DOT) == (b[0] == RED_OF_DOT) {
            largest_besides_dots = largest_besides_dots.max(steps);
        }
        let gray = ((u16::from(a[1]) + u16::from(a[2])) / 5) as u8;
        *shown = match (a[0] == RED_OF_DOT, b[0] == RED_OF_DOT) {
            (true, false) => {
                missing += 1;
                Rgb([64, 96, 255])
            }
            (false, true) => {
                extra += 1;
                Rgb([255, 0, 0])
            }
            _ if steps > 1 => Rgb([255, 255, 0]),
            (true, true) => MATCHING,
            (false, false) => Rgb([gray; 3]),
        };
    }
    report.outcome = match largest {
        0 => Outcome::Identical,
        _ if largest_besides_dots <= 1 && missing + extra <= allowed => Outcome::WithinTolerance,
        _ => Outcome::Different,
    };
    report.differing_pixels = Some(differing);
    report.largest_difference = Some(largest);
    report.dots_missing = Some(missing);
    report.dots_extra = Some(extra);
    (report, Some(difference))
}

impl PictureReport {
    /// The report as text.
    pub fn text(&self) -> String {
        let ((width, height), (other_width, other_height)) =
            (self.reference_size, self.submission_size);
        let word = match self.outcome {
            Outcome::Identical => return format!("identical: {width} x {height} pixels\n"),
            Outcome::WithinTolerance
                if self.dots_missing != Some(0) || self.dots_extra != Some(0) =>
            {
                "the same but for the few dots that may differ"
            }
            Outcome::WithinTolerance => "the same within one step of 255",
            _ => "different",
        };
        let numbers = self.differing_pixels.zip(self.largest_difference);
        let dots = self.dots_missing.zip(self.dots_extra);
        let Some(((differing, largest), (missing, extra))) = numbers.zip(dots) else {
            return format!(
                "{word}: the reference has {width} x {height} pixels, the submission \
                 {other_width} x {other_height}\n"
            );
        };
        format!(
            "{word}: {} of {} pixels differ, by {largest} of 255 at most\n  pixels whose dot is \
             missing  {}\n  pixels whose dot is extra    {}\n",
            thousands(differing),
            thousands(u64::from(width) * u64::from(height)),
            thousands(missing),
            thousands(extra)
        )
    }
}
