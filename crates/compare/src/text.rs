//! The report on two lists as text.

use std::fmt::Write as _;

use super::differences::Differences;
use super::divergence::Divergence;
use super::numbers::{short, thousands};
use super::report::{Outcome, RandomNumbers, Report};

impl RandomNumbers {
    /// What this means for a comparison, and what to do; nothing where it needs no words.
    pub fn told(self) -> Option<[&'static str; 2]> {
        let meaning = match self {
            Self::Same => return None,
            Self::Other => {
                "The two lists draw different random numbers, so they cannot be compared photon \
                 by photon.\nThe seed, the generator, the order of draws or the emission is \
                 another."
            }
            Self::PerhapsOther => {
                "Hardly a record is in both lists, as if they drew different random numbers: \
                 of another seed or\ngenerator, or in another order. Such lists cannot be compared \
                 photon by photon."
            }
        };
        Some([
            meaning,
            "Run photon-mapping grade on the submission: it judges a list by its statistics.\nTo \
             compare photon by photon, draw the reference's numbers with \
             interop/cpp/reference_rand.hpp.",
        ])
    }
}

impl Report {
    /// The report as text.
    pub fn text(&self) -> String {
        let records = |count: u64| if count == 1 { "record" } else { "records" };
        let differences = &self.differences;
        let matched = thousands(differences.matched);
        match self.outcome {
            Outcome::Identical => {
                let mut text = format!("identical: {matched} {}", records(differences.matched));
                if let Some(sha256) = &self.sha256 {
                    text += &format!(", SHA-256 {sha256}");
                }
                return text + "\n" + &self.notes();
            }
            Outcome::WithinTolerance if differences.is_none() => {
                let word = records(differences.matched);
                let tolerance = short(self.tolerance);
                return format!("the same within {tolerance}: {matched} {word}\n") + &self.notes();
            }
            Outcome::SameUnderAnotherReading => return self.other_reading(),
            Outcome::WithinTolerance | Outcome::Different => {}
        }
        let word = match self.outcome {
            Outcome::Different if self.random_numbers == RandomNumbers::Other => {
                "other random numbers"
            }
            Outcome::Different => "different",
            _ => "the same but for the few that may differ",
        };
        let mut text = format!(
            "{word}: the reference has {} {}, the submission {}\n",
            thousands(self.reference_records),
            records(self.reference_records),
            thousands(self.submission_records),
        );
        // Which photons of other numbers come to lie upon each other is chance.
        if self.random_numbers != RandomNumbers::Other {
            text += &counts(differences, self.tolerance);
        }
        if let Some([meaning, advice]) = self.random_numbers.told() {
            text += &format!("\n{meaning}\n{advice}\n");
        }
        if let Some(divergence) = &self.first_divergence {
            text += &divergence.text();
        }
        if let (Some(reading), Some(left)) = (&self.reading, self.reading_left) {
            text += &format!(
                "\nbesides, another fair reading of the handout: {reading}\n  this is no mistake; \
                 the divergence above is one of {} records that differ even so\n",
                thousands(left)
            );
        }
        text + &self.notes()
    }

    fn other_reading(&self) -> String {
        let reading = self.reading.as_deref().unwrap_or_default();
        let left = self.reading_left.unwrap_or_default();
        let mut text = format!("the same under another fair reading: {reading}\n");
        text += &format!(
            "  the reference has {} records, the submission {}\n",
            thousands(self.reference_records),
            thousands(self.submission_records),
        );
        text += &counts(&self.differences, self.tolerance);
        if let (Some(matched), Some(tried)) = (self.reading_matched, self.reading_tried) {
            text += &format!("the reading explains {matched} of {tried} photons tried");
            text += &match left {
                0 => ", and under it no record differs\n".to_owned(),
                left => format!("; {} records still differ, near edges\n", thousands(left)),
            };
        }
        text + &self.notes()
    }

    fn notes(&self) -> String {
        let notes = self.note.iter().flat_map(|note| note.lines());
        notes.map(|note| format!("\nnote: {note}\n")).collect()
    }
}

fn counts(differences: &Differences, tolerance: f32) -> String {
    let mut text = String::new();
    let mut line = |name: &str, count: u64, rest: &str| {
        if count > 0 || name == "matched" {
            let count = thousands(count);
            writeln!(text, "  {name:<16}{count:>10}{rest}").expect("a string takes everything");
        }
    };
    line("matched", differences.matched, &format!("  within {}", short(tolerance)));
    line("missing", differences.missing, "");
    line("extra", differences.extra, "");
    let moved = differences.moved_largest.zip(differences.moved_median);
    let distances = moved.map(|(largest, median)| {
        format!("  by {} (median), {} at most", short(median), short(largest))
    });
    line("moved", differences.moved, &distances.unwrap_or_default());
    line("not finite", differences.not_finite, "  positions of the submission");
    line("wrong intensity", differences.wrong_intensity, "");
    line("wrong to_light", differences.wrong_to_light, "");
    text
}

impl Divergence {
    fn text(&self) -> String {
        let mut text = String::from("\nfirst divergence");
        if let Some(photon) = self.photon {
            text += &format!(": photon {}", thousands(photon));
        }
        if let Some(bounce) = self.bounce {
            text += &format!(", bounce {bounce}");
        }
        text += "\n";
        text += &format!("  the reference   {}\n", self.reference);
        text += &format!("  the submission  {}\n", self.submission);
        if let Some(section) = self.section {
            let doubt = if self.certain { "" } else { " (perhaps)" };
            text += &format!("  section         {}{doubt}\n", section.title());
        }
        if let Some(reason) = &self.reason {
            text += &format!("  reason          {reason}\n");
        }
        text
    }
}
