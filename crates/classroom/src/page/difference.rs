//! The page of two pictures and their difference.

use image::RgbImage;
use maud::html;

use super::pictures::address;
use super::{POLICY, document, figure};

/// What the colors of the difference picture mean.
pub const LEGEND: [(&str, &str); 4] = [
    ("gray", "no difference, dots lighter"),
    ("blue", "missing dot"),
    ("red", "extra dot"),
    ("yellow", "another difference"),
];

/// The page of `reference`, `submission` and, if they have the same size, their `difference`, with
/// the `report` on them.
pub fn page(
    reference: &RgbImage,
    submission: &RgbImage,
    difference: Option<&RgbImage>,
    report: &str,
) -> String {
    let body = html! {
        h1 { "Two pictures compared" }
        pre { (report) }
        div.pictures {
            @if let Some(difference) = difference {
                (figure(&address(difference), "The difference"))
                ul.legend {
                    @for (color, meaning) in LEGEND {
                        li.(color) { (color) ": " (meaning) }
                    }
                }
            }
            (figure(&address(reference), "The reference"))
            (figure(&address(submission), "The submission"))
        }
    };
    document("Two pictures compared", POLICY, &body)
}
