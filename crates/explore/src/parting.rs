//! The step of a photon at which two lists part.

use compare::alignment::Pairing;
use compare::explain::{Hit, explain, vector};
use glam::Vec3;
use photon_mapping::photon_list::PhotonRecord;
use variants::run::Run;
use variants::section::Section;

use super::comparison::ListComparison;
use super::html::escape;

/// A record closer than this to the hit before it, in world units, tells no direction.
const NEAREST: f32 = 0.01;

/// A step at which two lists part.
#[derive(Debug)]
pub(crate) struct PartingStep {
    pub(crate) photon: u64,
    pub(crate) bounce: usize,
    pub(crate) name: &'static str,
    /// Label, the reference's value, the other list's.
    pub(crate) sides: Vec<[String; 3]>,
    /// Where the other list has its record, if it has one.
    pub(crate) other: Option<[f32; 3]>,
}

impl ListComparison {
    /// The step at which the lists part first.
    pub(crate) fn find_step(&self, run: &Run) -> Option<PartingStep> {
        let divergence = self.report.first_divergence.as_ref()?;
        let photon = divergence.photon?;
        let story = explain(run, photon)?;
        let recorded = divergence.bounce.unwrap_or(1).min(story.hits.len());
        // What went wrong happened at the hit before the record.
        let before = recorded.saturating_sub(1);
        let starts_elsewhere =
            divergence.reason.as_ref().is_some_and(|reason| reason.contains("start"));
        let (bounce, name) = match self.section()? {
            Section::PhotonEmission => (0, "emission"),
            Section::PhotonStorage => (recorded.min(story.hits.len().saturating_sub(1)), "stored"),
            Section::PhotonScatteringAbsorption => (before, "roulette"),
            Section::HemisphereSampling => (before, "hemisphere"),
            Section::HemisphereRayTransformation if starts_elsewhere => (before, "ray"),
            Section::HemisphereRayTransformation => (before, "frame"),
        };
        let told = [&divergence.reference, &divergence.submission];
        let (reference, submission) = self.records_of(photon, recorded);
        // Before the photon has scattered, its records tell no direction.
        let has_scattered = !["emission", "stored"].contains(&name);
        let before = story.hits.get(before).filter(|_| recorded > 0 && has_scattered);
        let [ours, theirs] = told.map(String::clone);
        let mut sides = vec![[format!("bounce {recorded}"), ours, theirs]];
        // What was told already is not told again.
        let is_new = |row: &[String; 3]| row[1..].iter().zip(told).any(|(a, b)| !b.contains(a));
        sides.extend(values(before, reference, submission).into_iter().filter(is_new));
        let other = submission.map(|record| record.position).filter(|place| place.is_finite());
        Some(PartingStep {
            photon,
            bounce,
            name,
            sides,
            other: other.map(|place| place.to_array()),
        })
    }

    /// Both lists' values at the step where they part, as a table.
    pub(crate) fn sides(&self) -> String {
        let Some(step) = &self.step else { return String::new() };
        let row = |cells: [&str; 3], tag: &str| {
            let cells = cells.map(|words| format!("<{tag}>{}</{tag}>", escape(words)));
            format!("<tr>{}</tr>", cells.concat())
        };
        let head = row(["", "reference", self.kind()], "th");
        let rows = step.sides.iter().map(|cells| row(cells.each_ref().map(String::as_str), "td"));
        format!("<caption>Here the lists part</caption>{head}{}", rows.collect::<String>())
    }

    /// The records of bounce `bounce` of `photon` in both lists.
    fn records_of(
        &self,
        photon: u64,
        bounce: usize,
    ) -> (Option<&PhotonRecord>, Option<&PhotonRecord>) {
        let is_it = |record: &PhotonRecord| {
            u64::from(record.photon) == photon && usize::from(record.bounce) == bounce
        };
        let (reference, submission) = (&self.reference.records, &self.submission.records);
        let pairing = self.pairings.iter().find(|pairing| match **pairing {
            Pairing::Both(i, _) | Pairing::Missing(i) => is_it(&reference[i]),
            Pairing::Extra(j) => self.submission.columns.photon && is_it(&submission[j]),
        });
        match pairing.copied() {
            Some(Pairing::Both(i, j)) => (Some(&reference[i]), Some(&submission[j])),
            Some(Pairing::Missing(i)) => (Some(&reference[i]), None),
            Some(Pairing::Extra(j)) => (None, Some(&submission[j])),
            None => (None, None),
        }
    }
}

/// Both lists' values of a record, with labels. `before` is the hit from which its photon came.
fn values(
    before: Option<&Hit>,
    reference: Option<&PhotonRecord>,
    submission: Option<&PhotonRecord>,
) -> Vec<[String; 3]> {
    let none = || "none".to_owned();
    let tell = |value: Option<Vec3>| value.map_or_else(none, |value| vector(&value.to_array()));
    let mut rows = Vec::new();
    // Where only one list has a record, what happens at this bounce tells its place.
    if let Some((a, b)) = reference.zip(submission) {
        let [a, b] = [a, b].map(|record| tell(Some(record.position)));
        rows.push(["position".to_owned(), a, b]);
    }
    // From a point as close as rounding, the way tells no direction.
    let way = before.zip(submission).map(|(before, other)| other.position - before.point());
    if let (Some(before), Some(way)) = (before, way.filter(|way| way.length() > NEAREST)) {
        let way = way.normalize();
        let normal = Vec3::from_array(before.normal);
        let angle = |way: Vec3| format!("{:.1}°", way.angle_between(normal).to_degrees());
        let expected = before.direction.map(Vec3::from_array);
        rows.push(["direction".to_owned(), tell(expected), tell(Some(way))]);
        rows.push(["angle to n".to_owned(), expected.map_or_else(none, angle), angle(way)]);
    }
    rows
}
