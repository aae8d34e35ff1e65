//! What the records of two lists differ in, counted.

use serde::Serialize;

use super::alignment::Pairing;
use super::position_index::is_near;
use photon_list::reader::PhotonList;
use photon_mapping::photon_list::PhotonRecord;

/// How far apart two intensities may be, relative to the reference's.
const INTENSITY_TOLERANCE: f32 = 1e-4;
/// How far apart the ends of two unit vectors may be, about their angle in radians. A direction
/// depends on the distance between two hits, which can be as small as the tolerance of positions.
const DIRECTION_TOLERANCE: f32 = 1e-3;

/// In what a record of the submission differs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Difference {
    /// It has no counterpart, or lies elsewhere.
    Place,
    /// It lies where it should, with another intensity.
    Intensity,
    /// It lies where it should, with another direction to the light.
    ToLight,
}

/// Counts of differences. Every record of the reference is matched, moved or missing; every one of
/// the submission matched, moved or extra.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Differences {
    /// Records that both lists have, in the same place.
    pub matched: u64,
    /// Records that only the reference has.
    pub missing: u64,
    /// Records that only the submission has.
    pub extra: u64,
    /// Records that both lists have, in different places.
    pub moved: u64,
    /// The largest distance between two such places, in world units.
    pub moved_largest: Option<f32>,
    /// The median of these distances.
    pub moved_median: Option<f32>,
    /// Records of the submission whose position is not a finite number.
    pub not_finite: u64,
    /// Matched records whose intensity differs.
    pub wrong_intensity: u64,
    /// Matched records whose direction to the light differs.
    pub wrong_to_light: u64,
}

impl Differences {
    /// Whether the lists agree within the tolerances.
    pub fn is_none(&self) -> bool {
        let Self { missing, extra, moved, wrong_intensity, wrong_to_light, .. } = *self;
        missing + extra + moved + wrong_intensity + wrong_to_light == 0
    }
}

/// Counts the differences between the records paired by `pairings`; positions are the same within
/// `tolerance` world units. Columns that a list does not have are not compared. Also gives the
/// pairings that differ, in order.
pub fn count(
    reference: &PhotonList,
    submission: &PhotonList,
    pairings: &[Pairing],
    tolerance: f32,
) -> (Differences, Vec<(Pairing, Difference)>) {
    let mut counts = Differences::default();
    let mut differing = Vec::new();
    let mut distances = Vec::new();
    let has_intensity = reference.columns.intensity && submission.columns.intensity;
    let has_to_light = reference.columns.to_light && submission.columns.to_light;
    for pairing in pairings {
        match *pairing {
            Pairing::Missing(_) => {
                counts.missing += 1;
                differing.push((*pairing, Difference::Place));
            }
            Pairing::Extra(_) => {
                counts.extra += 1;
                differing.push((*pairing, Difference::Place));
            }
            Pairing::Both(i, j) => {
                let (a, b) = (&reference.records[i], &submission.records[j]);
                if !is_near(a.position, b.position, tolerance) {
                    counts.moved += 1;
                    distances.push(a.position.distance(b.position));
                    differing.push((*pairing, Difference::Place));
                    continue;
                }
                counts.matched += 1;
                if has_intensity && !same_intensity(a, b) {
                    counts.wrong_intensity += 1;
                    differing.push((*pairing, Difference::Intensity));
                }
                if has_to_light && !same_to_light(a, b) {
                    counts.wrong_to_light += 1;
                    differing.push((*pairing, Difference::ToLight));
                }
            }
        }
    }
    counts.not_finite =
        submission.records.iter().filter(|record| !record.position.is_finite()).count() as u64;
    distances.retain(|distance| distance.is_finite());
    distances.sort_by(f32::total_cmp);
    counts.moved_largest = distances.last().copied();
    counts.moved_median = distances.get(distances.len() / 2).copied();
    (counts, differing)
}

fn same_intensity(a: &PhotonRecord, b: &PhotonRecord) -> bool {
    let allowed = INTENSITY_TOLERANCE * a.intensity.abs().max_element();
    (a.intensity - b.intensity).abs().cmple(glam::Vec3::splat(allowed)).all()
        || (a.intensity.is_nan() && b.intensity.is_nan())
}

/// Whether two records have the same direction to the light.
pub fn same_to_light(a: &PhotonRecord, b: &PhotonRecord) -> bool {
    a.to_light.distance(b.to_light) <= DIRECTION_TOLERANCE
        || (a.to_light.is_nan() && b.to_light.is_nan())
}
