//! What all differences together say, where each by itself would mislead.

use std::collections::HashSet;

use super::alignment::Pairing;
use super::differences::Difference;
use super::divergence::Lists;
use super::known::KnownRun;
use super::numbers::thousands;
use super::verdict::{Cause, has_parallel_normal, judge_not_finite};
use photon_list::reader::PhotonList;
use photon_mapping::photon_list::PhotonRecord;
use variants::section::Section;

/// So many records beyond a bounce must be missing before it is called a limit without doubt.
const ENOUGH_BEYOND: usize = 5;

/// So many records that differ are asked for the cause of positions that are no numbers.
const WITNESSES: usize = 1000;
/// The part of them that a cause must explain. Some are paired with others by their order.
const EXPLAINED: f64 = 0.95;

/// The verdict on the lists as a whole, if `differing` fits one, for the run `known`.
pub fn judge_whole(
    lists: &Lists,
    differing: &[(Pairing, Difference)],
    known: &KnownRun,
) -> Option<Cause> {
    let run = known.run;
    stored_twice(lists, differing)
        .or_else(|| not_finite(lists, differing, known))
        .or_else(|| other_count(lists, differing, run.renderer.emitted()))
        .or_else(|| smaller_limit(lists, differing, run.renderer.max_photon_bounces))
}

fn places(differing: &[(Pairing, Difference)]) -> impl Iterator<Item = Pairing> {
    let in_place = differing.iter().filter(|(_, difference)| *difference == Difference::Place);
    in_place.map(|(pairing, _)| *pairing)
}

fn stored_twice(lists: &Lists, differing: &[(Pairing, Difference)]) -> Option<Cause> {
    let Pairing::Extra(first) = places(differing).next()? else { return None };
    if !lists.submission.records[first].position.is_finite() {
        return None;
    }
    let rows: HashSet<_> = lists
        .pairings
        .iter()
        .filter_map(|pairing| match *pairing {
            Pairing::Both(_, j) => Some(lists.submission.records[j].to_row()),
            _ => None,
        })
        .collect();
    rows.contains(&lists.submission.records[first].to_row()).then(|| Cause {
        section: Section::PhotonStorage,
        reason: "the photon is stored twice".to_owned(),
        is_certain: true,
    })
}

/// Most of what differs is no number, in a list that does not tell its photons. The axis that
/// builds t explains it if all that differs comes after a hit where it is parallel to the normal.
fn not_finite(
    lists: &Lists,
    differing: &[(Pairing, Difference)],
    known: &KnownRun,
) -> Option<Cause> {
    let PhotonList { columns, records } = lists.submission;
    let of_submission = places(differing).filter_map(|pairing| match pairing {
        Pairing::Both(_, j) | Pairing::Extra(j) => Some(records[j].position.is_finite()),
        Pairing::Missing(_) => None,
    });
    let (finite, others): (Vec<_>, Vec<_>) = of_submission.partition(|is_finite| *is_finite);
    if columns.photon || others.is_empty() || finite.len() > others.len() {
        return None;
    }
    let of_reference = places(differing).filter_map(|pairing| match pairing {
        Pairing::Both(i, _) | Pairing::Missing(i) => Some(&lists.reference.records[i]),
        Pairing::Extra(_) => None,
    });
    let parallel_before = |record: &PhotonRecord| {
        let story = known.story(u64::from(record.photon))?;
        story.hits.into_iter().take(record.bounce.into()).find(has_parallel_normal)
    };
    let hits: Vec<_> = of_reference.take(WITNESSES).map(parallel_before).collect();
    let explained = hits.iter().flatten().count();
    let is_explained = explained as f64 > EXPLAINED * hits.len() as f64;
    Some(judge_not_finite(hits.iter().flatten().next().filter(|_| is_explained)))
}

fn smaller_limit(
    lists: &Lists,
    differing: &[(Pairing, Difference)],
    max_bounces: i32,
) -> Option<Cause> {
    let bounce = |place: usize| lists.reference.records[place].bounce;
    let missing: Option<Vec<_>> = places(differing)
        .map(|pairing| match pairing {
            Pairing::Missing(i) => Some(bounce(i)),
            _ => None,
        })
        .collect();
    let missing = missing?;
    let both = lists.pairings.iter().filter_map(|pairing| match *pairing {
        Pairing::Both(i, _) => Some(bounce(i)),
        _ => None,
    });
    let last = both.max()?;
    // At the last bounce allowed it is not another limit, but another way to count down to it.
    if *missing.iter().min()? <= last || i32::from(last) + 1 >= max_bounces {
        return None;
    }
    Some(Cause {
        section: Section::PhotonStorage,
        reason: format!(
            "the submission ends paths after {last} bounces: all that is missing lies beyond"
        ),
        is_certain: missing.len() >= ENOUGH_BEYOND,
    })
}

fn other_count(lists: &Lists, differing: &[(Pairing, Difference)], emitted: u64) -> Option<Cause> {
    if !(lists.reference.columns.intensity && lists.submission.columns.intensity) {
        return None;
    }
    let ratios = lists.pairings.iter().filter_map(|pairing| match *pairing {
        Pairing::Both(i, j) => {
            let [a, b] = [&lists.reference.records[i], &lists.submission.records[j]];
            Some(a.intensity.max_element() / b.intensity.max_element())
        }
        _ => None,
    });
    let ratios: Vec<_> = ratios.collect();
    let ratio = *ratios.first()?;
    let is_constant = ratios.iter().all(|other| (other / ratio - 1.0).abs() < 1e-3);
    let count = (f64::from(ratio) * emitted as f64).round();
    if !is_constant || (ratio - 1.0).abs() < 1e-3 || !(1.0..1e15).contains(&count) {
        return None;
    }
    let photon_limit = count * (1.0 + 1e-3);
    let (mut beyond, mut any) = (true, false);
    for pairing in places(differing) {
        any = true;
        beyond &= match pairing {
            Pairing::Missing(i) => {
                f64::from(lists.reference.records[i].photon) >= count * (1.0 - 1e-3)
            }
            Pairing::Extra(j) => {
                let photon = lists.submission.records[j].photon;
                !lists.submission.columns.photon
                    || (u64::from(photon) >= emitted && f64::from(photon) < photon_limit)
            }
            Pairing::Both(..) => false,
        };
    }
    (beyond && any).then(|| Cause {
        section: Section::PhotonEmission,
        reason: format!(
            "the submission emits about {} photons, the reference {}: intensities and photons \
             both say so",
            thousands(count as u64),
            thousands(emitted)
        ),
        is_certain: true,
    })
}
