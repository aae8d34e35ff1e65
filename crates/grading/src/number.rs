//! What to make of an intensity that speaks of another number of photons than the list has.
//!
//! A wrong intensity costs nothing, but half of all photons missing does; of a list that says how
//! many were emitted by its intensity alone, nobody can tell the one from the other. Only where the
//! intensity is off by a constant that students are known to multiply by, it is believed to be the
//! intensity.

use std::f64::consts::PI;

use super::evidence::Evidence as _;
use super::limits::{LEAST_LIKELY_SLIP, MOST_STORED, SIGNIFICANCE};
use super::list::OfList;
use super::naming::Explanation;
use super::text::rounded;
use super::trial::{Trial, best_trial};
use super::verdict::{Finding, Weight};
use variants::section::Section;

/// A constant by which an intensity may be off.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Slip {
    name: &'static str,
    factor: f64,
    /// The power of the number of photons that the intensity has, by which it is divided.
    power: f64,
}

/// Those that belong to powers, fluxes and responses of light, and a light that was made brighter
/// by hand. No other factor is below 1: it would excuse as many photons missing.
const SLIPS: [Slip; 9] = [
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

impl Slip {
    /// How many photons were emitted, where the intensity has this factor and says `number`.
    fn emitted(&self, number: f64) -> f64 {
        (self.factor * number.powf(1.0 / self.power)).round()
    }

    /// The remark that the intensity, which says `number`, is off by this.
    fn finding(&self, number: f64, p_value: f64) -> Finding {
        let without = rounded(self.emitted(number));
        let found = format!(
            "the intensity says {}; without a factor of {} it would say {without}, which the \
             photons fit",
            rounded(number),
            self.name
        );
        remark(found, p_value)
    }
}

/// What to make of a list whose photons do not fit the number that its intensity says.
pub(super) struct OtherNumber {
    pub(super) finding: Finding,
    /// Whether the intensity is wrong, and the number says nothing.
    pub(super) is_remark: bool,
    /// The tests, with the number that is believed.
    pub(super) trial: Trial,
    pub(super) explained: Option<Explanation>,
}

/// What to make of `list`, whose intensity says `number`, where its photons are as rare as
/// `p_value`; nothing where no other number fits either.
pub(super) fn other_number(list: &OfList, number: f64, p_value: f64) -> Option<OtherNumber> {
    let of = |emitted| OfList { emitted, ..*list };
    let new = |finding: Finding, trial, explained| {
        let is_remark = finding.weight == Weight::Remark;
        Some(OtherNumber { finding, is_remark, trial, explained })
    };
    for slip in SLIPS {
        let trial = best_trial(&of(Some(slip.emitted(number))));
        let of_number = trial.p_value_of(OfList::WORDS.number[0]);
        if trial.p_value >= SIGNIFICANCE && of_number >= LEAST_LIKELY_SLIP {
            return new(slip.finding(number, p_value), trial, None);
        }
    }
    let by_shape = best_trial(&of(None));
    if by_shape.p_value >= SIGNIFICANCE {
        let [says, fitted] = [number, by_shape.emitted].map(rounded);
        let cannot_be = list.observation.records as f64 > MOST_STORED * number;
        let finding = if cannot_be {
            let found = format!(
                "the intensity says {says} emitted, which cannot be: the photons fit {fitted}"
            );
            remark(found, p_value)
        } else {
            contradiction(format!("the intensity says {says}, the photons fit {fitted}"), p_value)
        };
        return new(finding, by_shape, None);
    }
    // With nine numbers to choose from, some misreading or other fits few photons: the name must
    // hold without a number, too.
    let of_shape = of(None).explain()?;
    SLIPS.into_iter().find_map(|slip| {
        let list = of(Some(slip.emitted(number)));
        let explained = list.explain().filter(|it| it.is_same_misreading(&of_shape))?;
        new(slip.finding(number, p_value), best_trial(&list), Some(explained))
    })
}

/// The remark that the intensity is wrong.
fn remark(found: String, p_value: f64) -> Finding {
    let advice = "Set 'intensity' to lightIntensity as it is.";
    Finding { advice: advice.into(), ..contradiction(found, p_value).weighing(Weight::Remark) }
}

/// The fault that the intensity says another number than the photons do.
fn contradiction(found: String, p_value: f64) -> Finding {
    let finding = Finding::new(
        "number by intensity",
        "photons for as many emitted as the intensity says",
        found,
        "Photons are lost or stored too often, all over the scene, or the intensity is wrong, \
         which is to be lightIntensity as it is. The list cannot tell which: grade with --emitted, \
         and the intensity costs nothing.",
    );
    let finding = finding.of(Section::PhotonStorage).weighing(Weight::Fault);
    Finding { p_value: Some(p_value), ..finding }
}
