//! The comparison of two lists, put together.

use glam::Vec3;
use serde::Serialize;

use super::alignment::{Pairing, align, with_bounces};
use super::differences::{Difference, Differences, count};
use super::divergence::{Divergence, Lists};
use super::position_index::is_near;
use super::readings::{Sample, best_reading};
use super::whole::judge_whole;
use crate::explain::explain;
use photon_list::reader::PhotonList;
use photon_mapping::photon_list::ListHash;
use photon_mapping::scene::Scene;
use variants::run::Run;

/// So many of the photons that differ are traced again under every reading.
const SAMPLE: usize = 200;
/// The part of the records of a right solution that rounding may move beyond the tolerance.
/// Measured in C++ over seven seeds: 3 records of 350,000, all in one run.
const USUAL_BY_ROUNDING: f64 = 1e-4;
/// So many records of the reference are traced again, to see whether its run is the one named.
const PROBES: usize = 32;

/// How two lists compare.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Outcome {
    /// The same bits.
    Identical,
    /// The same records within the tolerance, but for as many as are allowed to differ.
    WithinTolerance,
    /// Not the same.
    Different,
}

/// The comparison of two lists.
#[derive(Clone, Debug, Serialize)]
pub struct Report {
    /// How they compare.
    pub outcome: Outcome,
    /// How many records the reference has.
    pub reference_records: u64,
    /// How many records the submission has.
    pub submission_records: u64,
    /// The hash of both lists if they are identical and have all columns.
    pub sha256: Option<String>,
    /// How far apart two positions may be that count as one, in world units.
    pub tolerance: f32,
    /// In what the lists differ.
    #[serde(flatten)]
    pub differences: Differences,
    /// Where they part first.
    pub first_divergence: Option<Divergence>,
    /// The reading of the handout under which most of the photons that differ match, if it is more
    /// than half of them.
    pub reading: Option<String>,
    /// How many of the photons tried match under it.
    pub reading_matched: Option<usize>,
    /// How many photons were tried.
    pub reading_tried: Option<usize>,
    /// Why something could not be told.
    pub note: Option<String>,
}

/// The longest edge of the scene's bounding box, in scene units.
pub fn scene_size(scene: &Scene) -> f32 {
    let vertices = || scene.triangles().iter().flat_map(|triangle| triangle.vertices);
    let low = vertices().fold(Vec3::INFINITY, Vec3::min);
    let high = vertices().fold(Vec3::NEG_INFINITY, Vec3::max);
    (high - low).max_element()
}

/// Compares two lists; positions are the same within `tolerance` world units, and the part
/// `allowed` of all records, from 0 to 1, may differ before the lists do. `run` is the run of
/// which `reference` is said to be the list; where they part is explained from it if it is.
pub fn compare(
    reference: &PhotonList,
    submission: &PhotonList,
    run: Option<&Run>,
    tolerance: f32,
    allowed: f32,
) -> Report {
    let mut report = Report {
        outcome: Outcome::Identical,
        reference_records: reference.records.len() as u64,
        submission_records: submission.records.len() as u64,
        sha256: None,
        tolerance,
        differences: Differences::default(),
        first_divergence: None,
        reading: None,
        reading_matched: None,
        reading_tried: None,
        note: None,
    };
    if has_same_bits(reference, submission) {
        report.differences.matched = report.reference_records;
        report.sha256 = reference.columns.all().then(|| hash(reference));
        return report;
    }
    let (reference, submission) = (&*with_bounces(reference), &*with_bounces(submission));
    let pairings = align(reference, submission, tolerance);
    let (differences, differing) = count(reference, submission, &pairings, tolerance);
    let records = report.reference_records.max(report.submission_records);
    let few = |part: f64| differing.len() as f64 <= part * records as f64;
    let agree = few(f64::from(allowed));
    report.outcome = if agree { Outcome::WithinTolerance } else { Outcome::Different };
    report.differences = differences;
    if !(reference.columns.photon && submission.columns.photon) && is_reordered(&pairings) {
        report.add_note(if differing.is_empty() {
            "the same photons in another order"
        } else {
            "the photons are in another order, and were matched by their places"
        });
    }
    if differing.is_empty() {
        return report;
    }
    let lists = Lists { reference, submission, pairings: &pairings, tolerance };
    let known = run.filter(|run| is_run_of(reference, run, tolerance));
    if known.is_none() {
        report.add_note(
            "the run of the reference is not known; --seed and --photons (and --max-bounces, \
             --scene, --light) name it, so that the divergence can be explained",
        );
    }
    let mut divergence = lists.first_divergence(&differing, known);
    let whole = known.and_then(|run| judge_whole(&lists, &differing, run));
    let is_explained = whole.is_some();
    if let Some(whole) = whole {
        divergence.section = Some(whole.section);
        divergence.reason = Some(whole.reason);
        divergence.certain = whole.is_certain;
    }
    let hardly_any = 100 * report.differences.matched < report.reference_records;
    if hardly_any && report.submission_records > 0 {
        divergence.certain = false;
        report.add_note(
            "hardly any record matches: a list with another generator, seed or order of draws can \
             be compared only by its statistics",
        );
    }
    report.first_divergence = Some(divergence);
    if few(USUAL_BY_ROUNDING) && !agree {
        report.add_note(
            "so few may differ by rounding alone, where light grazes a surface or an edge; \
             --allow 0.0001 lets them pass",
        );
    }
    let sample = sample(&lists, &differing);
    if let Some(run) = known.filter(|_| !sample.is_empty() && !is_explained) {
        let positions: Vec<_> = submission.records.iter().map(|record| record.position).collect();
        let best = best_reading(run, &sample, &positions, tolerance);
        if let Some(best) = best {
            report.reading = Some(best.name);
            report.reading_matched = Some(best.matched);
            report.reading_tried = Some(best.tried);
        }
    }
    report
}

fn has_same_bits(a: &PhotonList, b: &PhotonList) -> bool {
    a.columns == b.columns
        && a.records.len() == b.records.len()
        && a.records.iter().zip(&b.records).all(|(a, b)| a.to_row() == b.to_row())
}

fn hash(list: &PhotonList) -> String {
    let mut hash = ListHash::default();
    hash.update(&list.records);
    hash.hex()
}

/// Whether `run` stores the records of `list`: some of them are looked at.
fn is_run_of(list: &PhotonList, run: &Run, tolerance: f32) -> bool {
    if !(list.columns.photon && list.columns.bounce) {
        return false;
    }
    let step = list.records.len() / PROBES + 1;
    list.records.iter().step_by(step).all(|record| {
        let story = explain(run, u64::from(record.photon));
        let hit = story.and_then(|story| story.hits.into_iter().nth(record.bounce.into()));
        hit.is_some_and(|hit| is_near(hit.point(), record.position, tolerance))
    })
}

/// Photons that differ, spread over the run, and what the submission stored of them.
fn sample(lists: &Lists, differing: &[(Pairing, Difference)]) -> Sample {
    let in_place = differing.iter().filter(|(_, difference)| *difference == Difference::Place);
    let mut photons: Vec<_> =
        in_place.filter_map(|(pairing, _)| lists.identity(*pairing).0).collect();
    photons.sort_unstable();
    photons.dedup();
    let step = photons.len() / SAMPLE + 1;
    let has_photons = lists.submission.columns.photon;
    let mut sample: Sample = photons
        .into_iter()
        .step_by(step)
        .map(|photon| (photon, has_photons.then(Vec::new)))
        .collect();
    if has_photons {
        let mut records: Vec<_> = lists.submission.records.iter().collect();
        records.sort_by_key(|record| (record.photon, record.bounce));
        for record in records {
            if let Some(Some(stored)) = sample.get_mut(&u64::from(record.photon)) {
                stored.push(record.position);
            }
        }
    }
    sample
}

impl Report {
    /// Adds `note` to what is noted already.
    pub fn add_note(&mut self, note: &str) {
        self.note = Some(match self.note.take() {
            Some(before) => format!("{before}\n{note}"),
            None => note.to_owned(),
        });
    }
}

fn is_reordered(pairings: &[Pairing]) -> bool {
    let places = pairings.iter().filter_map(|pairing| match *pairing {
        Pairing::Both(_, j) => Some(j),
        _ => None,
    });
    !places.is_sorted()
}
