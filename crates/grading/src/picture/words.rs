//! What is said of a picture.

use crate::facts::ENOUGH_PHOTONS;
use crate::limits::{FEW_EMITTED, FEWEST_DOTS, NUMBER_LEEWAY};
use crate::text::rounded;
use crate::verdict::{Finding, Weight};
use compare::numbers::thousands;
use photon_mapping::assignment8::PHOTON_COUNT;
use variants::section::Section;

fn storage(
    check: &'static str,
    expected: &str,
    found: String,
    passed: bool,
    weight: Weight,
    advice: &'static str,
) -> Finding {
    let finding = Finding::new(check, expected, found, advice);
    finding.of(Section::PhotonStorage).weighing(weight).passed_if(passed)
}

/// There are no dots on the surfaces.
pub(super) fn no_dots(found: f64, elsewhere: f64) -> Finding {
    let by_edges = elsewhere > found + 10.0;
    storage(
        "dots",
        "a red dot for every photon stored that is in sight",
        if by_edges {
            format!(
                "{} red pixels on the surfaces, and {} along their edges",
                rounded(found),
                rounded(elsewhere)
            )
        } else {
            format!("{} red pixels on the surfaces", rounded(found))
        },
        false,
        Weight::Fault,
        if by_edges {
            "A photon shows within 0.003 of its position: store the point hit, not a point above \
             it."
        } else {
            "Insert a photon where the size of 'path' is larger than 1, and check that TracePhoton \
             calls itself."
        },
    )
}

/// So many photons that all of a right picture would be red, too.
pub(super) fn saturated(emitted: f64) -> Finding {
    storage(
        "dots",
        "pixels without a dot, to tell where dots are",
        format!("with {} photons emitted nearly all is red, right or wrong", rounded(emitted)),
        false,
        Weight::Remark,
        "A picture with 1,000,000 photons emitted tells more.",
    )
}

/// Every pixel of the scene is red.
pub(super) fn all_red() -> Finding {
    Finding {
        section: Some(Section::HemisphereRayTransformation.title()),
        ..storage(
            "dots",
            "dots, and surfaces between them",
            "every pixel of the scene is red, as when the position of a photon is not a number"
                .to_owned(),
            false,
            Weight::Grave,
            "A photon whose position is not a number is near every point. Look for a vector of \
             length 0 that is normalized: t where the normal is (-1, 0, 0), for which the absolute \
             value of the dot product is to be compared. If all is well there, PHOTON_DOT_RADIUS \
             may be far larger than 0.003.",
        )
    }
}

/// Whether the dots are enough to be what the handout asks for. Only where they are fair, it is
/// told how many photons fit them.
pub(super) fn enough(found: f64, fitted: f64, are_fair: bool) -> Finding {
    storage(
        ENOUGH_PHOTONS,
        &format!("the dots of at least {} photons emitted", rounded(FEW_EMITTED)),
        if are_fair {
            format!("{} red pixels, of about {} photons emitted", rounded(found), rounded(fitted))
        } else {
            format!("{} red pixels", rounded(found))
        },
        fitted >= FEW_EMITTED && found >= FEWEST_DOTS,
        Weight::Fault,
        "The framework emits 1,000,000 photons. If yours did, look at where paths end; if it \
         emitted fewer, grade with --emitted.",
    )
}

/// With how many photons emitted a misreading explains the dots: the number is all that tells it
/// from the same misreading with another one that changes little else.
pub(super) fn number_under(id: &str, emitted: f64) -> Finding {
    let close = (emitted / PHOTON_COUNT as f64 - 1.0).abs() < NUMBER_LEEWAY;
    storage(
        "photons emitted",
        &format!("{}, as the framework emits", thousands(PHOTON_COUNT)),
        format!(
            "'{id}' explains the dots of about {} photons",
            rounded((emitted / 1e3).round() * 1e3)
        ),
        close,
        Weight::Remark,
        "If yours emitted another number than this, there is another mistake, too: grade with \
         --emitted.",
    )
}

/// What a picture cannot tell when photons hit the triangle they leave.
pub(super) fn self_hits() -> Finding {
    storage(
        "self-hits",
        "none",
        "how many there are depends on rounding, so another mistake may hide behind them"
            .to_owned(),
        false,
        Weight::Remark,
        "Mend the offset, and hand in again: the photon list tells more than a picture.",
    )
}

/// Positions are off their surface, which is fair.
pub(super) fn off_surface(standoff: f64) -> Finding {
    storage(
        "off the surfaces",
        "photons at the points hit",
        format!("dots as of photons about {standoff:.4} above their surfaces"),
        false,
        Weight::Remark,
        "Store the point hit: a dot shows only within 0.003 of it.",
    )
}
