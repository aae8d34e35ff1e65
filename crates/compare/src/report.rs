//! The comparison of two lists, put together.

use serde::Serialize;

use super::alignment::{Pairing, with_bounces};
use super::compared::Compared;
use super::conventions::{other_bounces, to_reference};
use super::differences::{Difference, Differences};
use super::divergence::{Divergence, Lists};
use super::explanation::{explain_fairly, has_other_draws};
use super::known::KnownRun;
use super::numbering::{links, with_photons};
use super::numbers::thousands;
use super::position_index::is_near;
use super::same_rows::{has_same_bits, has_same_order, has_same_rows};
use super::whole::judge_whole;
use crate::explain::explain;
use photon_list::reader::PhotonList;
use photon_list::record::Columns;
use photon_mapping::photon_list::ListHash;
use variants::run::Run;

/// How far apart two positions may be that count as one, over the size of the scene, where the user
/// does not say.
pub const TOLERANCE: f32 = 1e-4;
/// The part of the records that may still differ under the fair reading that explains the others:
/// near edges, an offset that is only about known loses some.
const LEFT_BY_READING: f64 = 1e-3;
/// The part of the records of a right solution that rounding may move beyond the tolerance.
/// Measured in C++ over seven seeds: 3 records of 350,000, all in one run.
const USUAL_BY_ROUNDING: f64 = 1e-4;
/// So many records of the reference are traced again, to see whether its run is the one named.
const PROBES: usize = 32;
/// Fewer records in common tell nothing of the random numbers.
const FEW_RECORDS: u64 = 20;

const ANOTHER_ORDER: &str = "the same photons in another order";

/// How two lists compare.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Outcome {
    /// The same bits.
    Identical,
    /// The same records within the tolerance, but for as many as are allowed to differ.
    WithinTolerance,
    /// The same but for as many as rounding may change, when the handout is read in another fair
    /// way.
    SameUnderAnotherReading,
    /// Not the same.
    Different,
}

/// Whether the submission draws the reference's random numbers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum RandomNumbers {
    /// Nothing speaks against it.
    #[default]
    Same,
    /// Hardly a record matches, and the list does not tell its photons.
    PerhapsOther,
    /// It draws others. Where two photons part then tells nothing.
    Other,
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
    /// Whether the lists can be compared photon by photon.
    pub random_numbers: RandomNumbers,
    /// In what the lists differ.
    #[serde(flatten)]
    pub differences: Differences,
    /// Where they part first.
    pub first_divergence: Option<Divergence>,
    /// The fair reading of the handout that explains all or some of the differences.
    pub reading: Option<String>,
    /// How many of the photons tried match in full under it.
    pub reading_matched: Option<usize>,
    /// How many photons were tried.
    pub reading_tried: Option<usize>,
    /// How many records still differ under it.
    pub reading_left: Option<u64>,
    /// Why something could not be told.
    pub note: Option<String>,
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
        random_numbers: RandomNumbers::Same,
        differences: Differences::default(),
        first_divergence: None,
        reading: None,
        reading_matched: None,
        reading_tried: None,
        reading_left: None,
        note: None,
    };
    if has_same_bits(reference, submission) {
        report.differences.matched = report.reference_records;
        report.sha256 = (reference.columns == Columns::ALL).then(|| hash(reference));
        return report;
    }
    let tells_photons = reference.columns.photon && submission.columns.photon;
    if has_same_rows(reference, submission) {
        report.outcome = Outcome::WithinTolerance;
        report.differences.matched = report.reference_records;
        if !tells_photons && !has_same_order(reference, submission) {
            report.add_note(ANOTHER_ORDER);
        }
        return report;
    }
    let reference = &*with_bounces(reference);
    let (submission, notes) = to_reference(reference, submission, tolerance);
    notes.iter().for_each(|note| report.add_note(note));
    let submission = &*with_bounces(&submission);
    let records = report.reference_records.max(report.submission_records);
    let compared = Compared::new(reference, submission, tolerance);
    let agree = compared.few(f64::from(allowed), records);
    report.outcome = if agree { Outcome::WithinTolerance } else { Outcome::Different };
    report.differences = compared.differences.clone();
    if !tells_photons && is_reordered(&compared.pairings) {
        report.add_note(if compared.differing.is_empty() {
            ANOTHER_ORDER
        } else {
            "the photons are in another order, and were matched by their places"
        });
    }
    if let Some(note) = other_bounces(reference, submission, &compared.pairings) {
        report.add_note(&note);
    }
    if compared.differing.is_empty() {
        return report;
    }
    let Some(run) = run.filter(|run| is_run_of(reference, run, tolerance)) else {
        report.add_note(
            "the run of the reference is not known; --seed and --photons (and --max-bounces, \
             --scene, --light) name it, so that the divergence can be explained",
        );
        report.add_divergence(&compared.lists(reference, submission), &compared.differing, None);
        if report.shares_hardly_a_photon() {
            report.has_other_numbers(false);
        }
        return report;
    };
    if !agree {
        let allowed = LEFT_BY_READING.max(f64::from(allowed));
        let few = |left: &Compared| left.few(allowed, records);
        report.explain(run, reference, submission, compared, few);
    } else {
        let lists = compared.lists(reference, submission);
        report.add_divergence(&lists, &compared.differing, Some(&KnownRun { run, fair: None }));
    }
    if report.differences_are_few(USUAL_BY_ROUNDING, records) && !agree {
        report.add_note(
            "so few may differ by rounding alone, where light grazes a surface or an edge; \
             --allow 0.0001 lets them pass",
        );
    }
    report
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

impl Report {
    /// Says why `submission`, which differs, does: by a fair reading under which only a `few`
    /// records differ, or by the first divergence that no fair reading explains.
    fn explain(
        &mut self,
        run: &Run,
        reference: &PhotonList,
        submission: &PhotonList,
        compared: Compared,
        few: impl Fn(&Compared) -> bool,
    ) {
        let known = KnownRun { run, fair: None };
        let explain = |list: &PhotonList, compared: &Compared| {
            let lists = compared.lists(reference, list);
            let explanation = explain_fairly(&known, &lists, &compared.differing)?;
            let left = Compared::new(&explanation.reference, submission, compared.tolerance);
            Some((explanation, left))
        };
        let mut explanation = explain(submission, &compared);
        let mut told = None;
        let is_explained = explanation.as_ref().is_some_and(|(_, left)| few(left));
        let links = if is_explained { Vec::new() } else { links(run, submission) };
        for link in links {
            let Some(list) = with_photons(run, submission, &link) else { continue };
            let again = Compared::new(reference, &list, compared.tolerance);
            let found = explain(&list, &again);
            let is_explained = found.as_ref().is_some_and(|(_, left)| few(left));
            // If photons may be mistaken, only what turns out to explain all is to be trusted.
            if is_explained || link.is_measured {
                explanation = found;
                told = Some((list, again));
                break;
            }
        }
        if let Some((explanation, left)) = &explanation {
            self.reading = Some(explanation.name());
            self.reading_matched = Some(explanation.matched);
            self.reading_tried = Some(explanation.tried);
            self.reading_left = Some(left.differing.len() as u64);
            if few(left) {
                self.outcome = Outcome::SameUnderAnotherReading;
                let lists = compared.lists(reference, submission);
                self.first_divergence = Some(Divergence {
                    section: explanation.changes.first().map(|(section, _)| *section),
                    reason: Some(format!("another fair reading: {}", explanation.name())),
                    certain: true,
                    ..lists.first_divergence(&compared.differing, Some(&known))
                });
                return;
            }
        }
        if let Some((list, _)) = &told {
            self.add_note(&format!(
                "the submission does not tell its photons; they were found for {} of its records \
                 by the directions to the light",
                thousands(list.records.len() as u64)
            ));
        }
        let (list, compared) = told.as_ref().map_or((submission, &compared), |(l, c)| (l, c));
        if let Some((explanation, _)) = &explanation {
            let left = Compared::new(&explanation.reference, list, compared.tolerance);
            let lists = left.lists(&explanation.reference, list);
            return self.add_divergence(&lists, &left.differing, Some(&explanation.known));
        }
        let lists = compared.lists(reference, list);
        self.add_divergence(&lists, &compared.differing, Some(&known));
        if has_other_draws(&known, &lists) {
            self.has_other_numbers(list.columns.photon);
        }
    }

    /// Whether the two lists have neither records nor numbers of photons in common, but for what
    /// chance gives. Wrong positions of the same photons would be moved.
    fn shares_hardly_a_photon(&self) -> bool {
        let Differences { matched, moved, .. } = self.differences;
        let records = self.reference_records.min(self.submission_records);
        records >= FEW_RECORDS && 100 * matched < records && 10 * moved < records
    }

    fn differences_are_few(&self, part: f64, records: u64) -> bool {
        let Differences { missing, extra, moved, wrong_intensity, wrong_to_light, .. } =
            self.differences;
        let differing = missing + extra + moved + wrong_intensity + wrong_to_light;
        differing as f64 <= part * records as f64
    }

    fn add_divergence(
        &mut self,
        lists: &Lists,
        differing: &[(Pairing, Difference)],
        known: Option<&KnownRun>,
    ) {
        let mut divergence = lists.first_divergence(differing, known);
        if let Some(whole) = known.and_then(|known| judge_whole(lists, differing, known)) {
            divergence.section = Some(whole.section);
            divergence.reason = Some(whole.reason);
            divergence.certain = whole.is_certain;
        }
        self.first_divergence = Some(divergence);
    }

    /// Takes back what was said of the first divergence. If photons are not told, what is sure of
    /// one of them may be true.
    fn has_other_numbers(&mut self, tells_photons: bool) {
        self.random_numbers =
            if tells_photons { RandomNumbers::Other } else { RandomNumbers::PerhapsOther };
        let divergence = self.first_divergence.take();
        let kept = divergence.filter(|divergence| divergence.certain && !tells_photons);
        self.first_divergence = kept.map(|kept| Divergence { certain: false, ..kept });
    }

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
