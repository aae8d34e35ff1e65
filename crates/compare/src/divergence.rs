//! The first difference, explained from the reference's own path.

use std::collections::BTreeMap;

use serde::Serialize;

use super::alignment::Pairing;
use super::deeds::{place, reference_does, submission_does};
use super::differences::Difference;
use super::numbers::thousands;
use super::position_index::is_near;
use super::verdict::{Cause, Parting, judge};
use crate::explain::{Story, vector};
use crate::known::KnownRun;
use photon_list::reader::PhotonList;
use photon_mapping::photon_list::PhotonRecord;
use variants::section::Section;

/// So many differing photons are asked when the first one does not tell the section by itself.
const WITNESSES: usize = 1000;
/// So many emitted photons between two records are asked whether a record is theirs; about one in
/// thirty stores any.
const MOST_NEIGHBORS: u64 = 500;

/// Where two lists part first.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Divergence {
    /// The emitted photon, if a list tells it.
    pub photon: Option<u64>,
    /// The bounce of the record that differs, if a list tells it.
    pub bounce: Option<usize>,
    /// The section of the handout in which the submission does something else; none when the
    /// reference's run is not known.
    pub section: Option<Section>,
    /// What the reference does.
    pub reference: String,
    /// What the submission does.
    pub submission: String,
    /// What speaks for the section.
    pub reason: Option<String>,
    /// Whether there is no other plausible explanation.
    pub certain: bool,
}

/// What is compared.
#[derive(Clone, Copy, Debug)]
pub struct Lists<'lists> {
    /// The reference.
    pub reference: &'lists PhotonList,
    /// The submission.
    pub submission: &'lists PhotonList,
    /// How the records of both belong together.
    pub pairings: &'lists [Pairing],
    /// How far apart two positions may be that count as one, in world units.
    pub tolerance: f32,
    /// Whether the submission's directions to the light are what they should be where it stores
    /// what the reference stores.
    pub has_true_to_light: bool,
}

impl Lists<'_> {
    /// Describes the first of `differing`, which must not be empty; differences of place come
    /// first, since another intensity or direction to the light is often the same for all records.
    /// With the reference's run, `known`, also names the section.
    pub fn first_divergence(
        &self,
        differing: &[(Pairing, Difference)],
        known: Option<&KnownRun>,
    ) -> Divergence {
        let in_place = differing.iter().find(|(_, difference)| *difference == Difference::Place);
        let (pairing, difference) = *in_place.unwrap_or(&differing[0]);
        if difference != Difference::Place {
            return self.wrong_value(pairing, difference);
        }
        let (mut photon, mut bounce) = self.identity(pairing);
        let found = known
            .filter(|_| photon.is_none() && self.reference.columns.photon)
            .and_then(|known| self.photon_of_extra(pairing, known));
        if let Some((found_photon, found_bounce, _)) = &found {
            (photon, bounce) = (Some(*found_photon), Some(*found_bounce));
        }
        let story = photon.zip(known).and_then(|(photon, known)| known.story(photon));
        let record = self.submission_record(pairing);
        let places = differing
            .iter()
            .filter(|(_, difference)| *difference == Difference::Place)
            .map(|(pairing, _)| *pairing);
        let Some((story, known)) = story.zip(known) else {
            let verdict = known
                .and_then(|known| self.majority(places, known).or_else(|| only_extra(differing)));
            return Divergence {
                photon,
                bounce,
                section: verdict.as_ref().map(|verdict| verdict.section),
                reference: match self.reference_record(pairing) {
                    Some(record) => format!("stores a photon at {}", place(record)),
                    None => "stores no such photon".to_owned(),
                },
                submission: submission_does(record),
                certain: verdict.as_ref().is_some_and(|verdict| verdict.is_certain),
                reason: verdict.map(|verdict| verdict.reason),
            };
        };
        let only_missing =
            differing.iter().all(|(pairing, _)| matches!(pairing, Pairing::Missing(_)));
        let first = match found {
            Some((_, _, verdict)) => Some(verdict),
            None => self.judge(pairing, &story, known),
        };
        let is_known = self.submission.columns.photon || matches!(pairing, Pairing::Extra(_));
        let verdict = match first {
            Some(first) if first.is_certain && is_known => Some(first),
            first => self.majority(places, known).or(first),
        };
        Divergence {
            photon,
            bounce,
            section: verdict.as_ref().map(|verdict| verdict.section),
            reference: reference_does(&story, bounce.unwrap_or(1)),
            submission: submission_does(record),
            // Photons that went elsewhere would have been stored elsewhere.
            certain: verdict.as_ref().is_some_and(|verdict| verdict.is_certain || only_missing),
            reason: verdict.map(|verdict| verdict.reason),
        }
    }

    fn wrong_value(&self, pairing: Pairing, difference: Difference) -> Divergence {
        let (photon, bounce) = self.identity(pairing);
        let tell = |record: Option<&PhotonRecord>| {
            let record = record.expect("both lists have a record whose values differ");
            match difference {
                Difference::Intensity => {
                    format!("has the intensity {}", vector(&record.intensity.to_array()))
                }
                _ => format!("has to_light {}", vector(&record.to_light.to_array())),
            }
        };
        let reason = match difference {
            Difference::Intensity => {
                "intensity is the light's color divided by the photons it emits"
            }
            _ => "to_light is the opposite of the photon ray's direction",
        };
        Divergence {
            photon,
            bounce,
            section: Some(Section::PhotonStorage),
            reference: tell(self.reference_record(pairing)),
            submission: tell(self.submission_record(pairing)),
            certain: true,
            reason: Some(reason.to_owned()),
        }
    }

    fn reference_record(&self, pairing: Pairing) -> Option<&PhotonRecord> {
        match pairing {
            Pairing::Both(i, _) | Pairing::Missing(i) => Some(&self.reference.records[i]),
            Pairing::Extra(_) => None,
        }
    }

    fn submission_record(&self, pairing: Pairing) -> Option<&PhotonRecord> {
        match pairing {
            Pairing::Both(_, j) | Pairing::Extra(j) => Some(&self.submission.records[j]),
            Pairing::Missing(_) => None,
        }
    }

    /// Whether both lists have a record, in the same place.
    pub fn is_matched(&self, pairing: Pairing) -> bool {
        let records = self.reference_record(pairing).zip(self.submission_record(pairing));
        records.is_some_and(|(a, b)| is_near(a.position, b.position, self.tolerance))
    }

    /// Photon and bounce of a difference, as far as the lists tell.
    pub fn identity(&self, pairing: Pairing) -> (Option<u64>, Option<usize>) {
        let of = |list: &PhotonList, record: Option<&PhotonRecord>| {
            let columns = list.columns;
            let photon = record.filter(|_| columns.photon).map(|record| u64::from(record.photon));
            let bounce = record.filter(|_| columns.bounce).map(|record| record.bounce.into());
            (photon, bounce)
        };
        let reference = of(self.reference, self.reference_record(pairing));
        let submission = of(self.submission, self.submission_record(pairing));
        (reference.0.or(submission.0), reference.1.or(submission.1))
    }

    fn judge(&self, pairing: Pairing, story: &Story, known: &KnownRun) -> Option<Cause> {
        let (_, bounce) = self.identity(pairing);
        let is_same_photon = self.submission.columns.photon;
        Some(judge(&self.observation(pairing, story, bounce?, is_same_photon, known)))
    }

    fn observation<'run>(
        &'run self,
        pairing: Pairing,
        story: &'run Story,
        bounce: usize,
        is_same_photon: bool,
        known: &'run KnownRun,
    ) -> Parting<'run> {
        Parting {
            story,
            bounce,
            submission: self.submission_record(pairing),
            is_same_photon,
            has_true_to_light: self.has_true_to_light,
            known,
            tolerance: self.tolerance,
        }
    }

    /// The photon and bounce to which an extra record belongs whose list does not tell it: that of
    /// the photons next to it whose path explains it.
    fn photon_of_extra(&self, extra: Pairing, known: &KnownRun) -> Option<(u64, usize, Cause)> {
        let at = self.pairings.iter().position(|pairing| *pairing == extra)?;
        let photon_of = |pairing: &Pairing| {
            self.reference_record(*pairing).map(|record| u64::from(record.photon))
        };
        let before = self.pairings[..at].iter().rev().find_map(photon_of).unwrap_or(0);
        let after = self.pairings[at..].iter().find_map(photon_of);
        let after = after.unwrap_or(before + MOST_NEIGHBORS).min(before + MOST_NEIGHBORS);
        (before..=after).filter_map(|photon| known.story(photon)).find_map(|story| {
            (1..=story.hits.len()).find_map(|bounce| {
                let verdict = judge(&self.observation(extra, &story, bounce, false, known));
                verdict.is_certain.then_some((story.photon, bounce, verdict))
            })
        })
    }

    /// The verdict of most of the photons that differ: of those that leave no doubt, if there are
    /// any, else of all. Of each photon, only the first difference says anything.
    fn majority(
        &self,
        differing: impl Iterator<Item = Pairing>,
        known: &KnownRun,
    ) -> Option<Cause> {
        let mut votes: BTreeMap<(bool, Section), (usize, Cause)> = BTreeMap::new();
        let mut last = None;
        for pairing in differing {
            let (Some(photon), _) = self.identity(pairing) else { continue };
            if last == Some(photon) {
                continue;
            }
            last = Some(photon);
            let verdict = known.story(photon).and_then(|story| self.judge(pairing, &story, known));
            if let Some(mut verdict) = verdict {
                if verdict.is_certain {
                    let photon = thousands(photon);
                    verdict.reason = format!("as photon {photon} shows, {}", verdict.reason);
                }
                let key = (verdict.is_certain, verdict.section);
                votes.entry(key).or_insert((0, verdict)).0 += 1;
            }
            if votes.values().map(|(count, _)| count).sum::<usize>() >= WITNESSES {
                break;
            }
        }
        let all: usize = votes.values().map(|(count, _)| count).sum();
        let is_known = self.submission.columns.photon;
        let most = votes.into_iter().max_by_key(|((is_certain, _), (count, _))| {
            // Where a list does not tell its photons, a few fit something by chance.
            (*is_certain && (is_known || 10 * count > all), *count)
        });
        most.map(|(_, (count, verdict))| {
            let is_certain = verdict.is_certain && (is_known || 10 * count > all);
            Cause { is_certain, ..verdict }
        })
    }
}

/// What remains when only records without numbers were added, and no path explains any of them.
fn only_extra(differing: &[(Pairing, Difference)]) -> Option<Cause> {
    differing.iter().all(|(pairing, _)| matches!(pairing, Pairing::Extra(_))).then(|| Cause {
        section: Section::PhotonScatteringAbsorption,
        reason: "the submission may scatter where the reference absorbs".to_owned(),
        is_certain: false,
    })
}
