//! What to make of an intensity that speaks of another number of photons than the list has.
//!
//! A wrong intensity costs nothing, but half of all photons missing does; of a list that says how
//! many were emitted by its intensity alone, nobody can tell the one from the other. Only where the
//! intensity is off by a constant that students are known to multiply by, it is believed to be the
//! intensity.

use std::f64::consts::PI;

use super::text::rounded;
use super::verdict::{Finding, Weight};
use variants::section::Section;

/// A constant by which an intensity may be off.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slip {
    name: &'static str,
    factor: f64,
    /// The power of the number of photons that the intensity has, by which it is divided.
    power: f64,
}

/// Those that belong to powers, fluxes and responses of light, and a light that was made brighter
/// by hand. No other factor is below 1: it would excuse as many photons missing.
pub const SLIPS: [Slip; 9] = [
    Slip { name: "4 pi", factor: 4.0 * PI, power: 1.0 },
    Slip { name: "2 pi", factor: 2.0 * PI, power: 1.0 },
    Slip { name: "10", factor: 10.0, power: 1.0 },
    Slip { name: "100", factor: 100.0, power: 1.0 },
    Slip { name: "1000", factor: 1000.0, power: 1.0 },
    Slip { name: "pi", factor: PI, power: 1.0 },
    Slip { name: "1/pi", factor: 1.0 / PI, power: 1.0 },
    Slip { name: "1/(4 pi)", factor: 0.25 / PI, power: 1.0 },
    Slip { name: "1/N", factor: 1.0, power: 2.0 },
];

/// No mistake stores more than this part of the photons emitted, unless it stores some twice: with
/// those straight from the light, it is 0.29.
const MOST_STORED: f64 = 1.0 / 3.0;

impl Slip {
    /// How many photons were emitted, where the intensity has this factor and says `number`.
    pub fn emitted(&self, number: f64) -> f64 {
        (self.factor * number.powf(1.0 / self.power)).round()
    }
}

/// The remark that the intensity, which says `number`, is off by `slip`.
pub fn slip_finding(slip: Slip, number: f64, p_value: f64) -> Finding {
    Finding {
        found: format!(
            "the intensity says {}; without a factor of {} it would say {}, which the photons fit",
            rounded(number),
            slip.name,
            rounded(slip.emitted(number))
        ),
        weight: Weight::Remark,
        advice: "Set 'intensity' to lightIntensity as it is.".into(),
        ..contradiction(number, slip.emitted(number), p_value)
    }
}

/// Whether an intensity that says `number` cannot be right where `stored` photons were stored.
pub fn cannot_be(number: f64, stored: f64) -> bool {
    stored > MOST_STORED * number
}

/// The remark that the intensity says `number`, which cannot be.
pub fn impossible(number: f64, fitted: f64, p_value: f64) -> Finding {
    Finding {
        found: format!(
            "the intensity says {} emitted, which cannot be: the photons fit {}",
            rounded(number),
            rounded(fitted)
        ),
        weight: Weight::Remark,
        advice: "Set 'intensity' to lightIntensity as it is.".into(),
        ..contradiction(number, fitted, p_value)
    }
}

/// The fault that the intensity says `number`, and the photons fit `fitted` emitted.
pub fn contradiction(number: f64, fitted: f64, p_value: f64) -> Finding {
    Finding {
        check: "number by intensity",
        section: Some(Section::PhotonStorage.title()),
        expected: "photons for as many emitted as the intensity says".to_owned(),
        found: format!(
            "the intensity says {}, the photons fit {}",
            rounded(number),
            rounded(fitted)
        ),
        p_value: Some(p_value),
        passed: false,
        weight: Weight::Fault,
        advice: "Photons are lost or stored too often, all over the scene, or the intensity is \
                 wrong, which is to be lightIntensity as it is. The list cannot tell which: grade \
                 with --emitted, and the intensity costs nothing."
            .into(),
    }
}
