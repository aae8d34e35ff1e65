//! Does a fair way to do the assignment explain the differences?

use std::collections::{BTreeMap, HashMap};

use super::alignment::{Pairing, align};
use super::differences::Difference;
use super::divergence::Lists;
use super::fair::Fair;
use super::fair_search::{LONGEST_OFFSET, Search, Window};
use super::known::KnownRun;
use super::position_index::is_near;
use super::tries::other_emissions;
use photon_list::reader::PhotonList;
use photon_mapping::photon_list::PhotonRecord;
use variants::hypotheses::Hypothesis;
use variants::misreadings::misreadings;
use variants::section::Section;
use variants::variation::Simulation;

/// So many of the photons that differ are traced again under every reading.
const SAMPLE: usize = 150;
/// So many, where a frame is to be measured around every normal.
const MANY: usize = 20_000;
/// So many records before and after a place in a list may belong to the same photon.
const AROUND: usize = 4;
/// Where a smaller part of the submission's photons scatter at their first hit, the draws may come
/// in another order. Of photons with draws of their own, one in twelve does; with a wrong emission,
/// half.
const SAME_DRAWS: f32 = 0.9;
/// Where a smaller part of them hit anything, the draws differ.
const SAME_EMISSION: f32 = 0.5;
/// So many photons are emitted again under every misreading of the emission.
const FIRST_PHOTONS: u64 = 20_000;

/// The fair way that explains differences.
#[derive(Clone, Debug)]
pub struct FairExplanation<'run> {
    /// The reference's run, read in this way.
    pub known: KnownRun<'run>,
    /// What is done in another way than in the run, each with its section of the handout.
    pub changes: Vec<(Section, String)>,
    /// How many of the photons tried match in full.
    pub matched: usize,
    /// How many photons were tried.
    pub tried: usize,
    /// The list of the run, read in this way.
    pub reference: PhotonList,
}

impl FairExplanation<'_> {
    /// What is done in another way, in one line.
    pub fn name(&self) -> String {
        let changes: Vec<_> = self.changes.iter().map(|(_, change)| change.as_str()).collect();
        changes.join(", ")
    }
}

/// Looks for a fair way that explains differences between `lists`; nothing if none explains clearly
/// more than the run's own does.
pub fn explain_fairly<'run>(
    known: &KnownRun<'run>,
    lists: &Lists,
    differing: &[(Pairing, Difference)],
) -> Option<FairExplanation<'run>> {
    let run = known.run;
    let base = Fair::of(run)?;
    let size = run.size();
    let search = Search { run, tolerance: lists.tolerance, size };
    let base = match photons_of(lists) {
        Some(photons) if search.scattered_part(&base, &photons) < SAME_DRAWS => {
            search.draws(&base, &photons).unwrap_or(base)
        }
        _ => base,
    };
    let all_windows = |most| windows(lists, differing, size, most);
    let windows = all_windows(SAMPLE);
    let other_draws = (Fair::of(run) != Some(base)).then_some(base);
    let by_place = || {
        let photons: Vec<_> = windows.iter().map(|window| window.photon).collect();
        let records = lists.submission.records.iter();
        let positions: Vec<_> = records.map(|record| record.position).collect();
        let is_told = lists.submission.columns.photon;
        (!is_told).then(|| search.best_by_place(&base, &photons, &positions))?
    };
    let measured = || {
        let is_told = lists.submission.columns.photon;
        is_told.then(|| search.best_measured(&base, &all_windows(MANY), &windows))?
    };
    let fair = search.best(&base, &windows).or_else(by_place).or_else(measured).or(other_draws)?;
    let changes = fair.changes(run);
    if changes.is_empty() {
        return None;
    }
    let reference = known.list(&fair);
    let matched = search.explained(&fair, &windows);
    let known = KnownRun { run, fair: Some(fair) };
    Some(FairExplanation { known, changes, matched, tried: windows.len(), reference })
}

/// Some of the photons that the submission stores, if it tells them.
fn photons_of(lists: &Lists) -> Option<Vec<u64>> {
    let records = &lists.submission.records;
    let step = records.len() / SAMPLE + 1;
    let photons = records.iter().step_by(step).map(|record| u64::from(record.photon));
    lists.submission.columns.photon.then(|| photons.collect())
}

/// Whether the submission's random numbers are others than the run's, as far as the lists tell.
pub fn has_other_draws(known: &KnownRun, lists: &Lists) -> bool {
    if lists.submission.records.is_empty() {
        return false;
    }
    let matched = lists.pairings.iter().filter(|pairing| lists.is_matched(**pairing)).count();
    if 100 * matched >= lists.reference.records.len() {
        return false;
    }
    let Some(fair) = known.fair() else { return false };
    if come_from_the_light(known, lists) {
        return false;
    }
    if let Some(photons) = photons_of(lists) {
        let search = Search { run: known.run, tolerance: lists.tolerance, size: 1.0 };
        let others = other_emissions(fair.tries);
        let mut others = others.into_iter().map(|(tries, _)| Fair { tries, ..fair });
        return search.hitting_part(&fair, &photons) < SAME_EMISSION
            && others.all(|other| search.scattered_part(&other, &photons) < 0.9)
            && !is_emitted_by_a_misreading(known, lists);
    }
    true
}

/// Whether most photons of the submission, which tells them, are stored first where a misreading of
/// the emission stores them with the run's random numbers.
fn is_emitted_by_a_misreading(known: &KnownRun, lists: &Lists) -> bool {
    let renderer = &known.run.renderer;
    let [emitted, seed] = [renderer.emitted(), renderer.seed];
    let mut first = HashMap::new();
    for record in &lists.submission.records {
        first.entry(record.photon).or_insert(record.position);
    }
    let is_of_emission = |hypothesis: &Hypothesis| {
        hypothesis.misreading.is_some_and(|it| it.section == Section::PhotonEmission)
    };
    misreadings().into_iter().filter(is_of_emission).any(|Hypothesis { variation, .. }| {
        let simulation = Simulation::new(variation, seed, emitted, renderer.max_photon_bounces);
        let traced = simulation.trace(0..emitted.min(FIRST_PHOTONS));
        let paths: Vec<_> = traced.chunk_by(|a, b| a.photon == b.photon).collect();
        let is_same = |path: &&&[PhotonRecord]| {
            let found = first.get(&path[0].photon);
            found.is_some_and(|place| is_near(*place, path[0].position, lists.tolerance))
        };
        2 * paths.iter().filter(is_same).count() > paths.len()
    })
}

/// Whether the directions of most records lead back to a light: rays start there again.
fn come_from_the_light(known: &KnownRun, lists: &Lists) -> bool {
    if !lists.submission.columns.to_light {
        return false;
    }
    let run = known.run;
    let reach = LONGEST_OFFSET * run.size();
    let lights = run.scene().lights().iter().map(|light| run.placement.to_world(light.position));
    let lights: Vec<_> = lights.collect();
    let records = &lists.submission.records;
    let lead_back = records.iter().filter(|record| {
        let back = record.to_light.normalize_or_zero();
        lights.iter().any(|light| (*light - record.position).cross(back).length() < reach)
    });
    2 * lead_back.count() > records.len()
}

/// What the submission may have stored of about `most` of the photons that differ, spread over the
/// run.
fn windows(
    lists: &Lists,
    differing: &[(Pairing, Difference)],
    size: f32,
    most: usize,
) -> Vec<Window> {
    let in_place = differing.iter().filter(|(_, difference)| *difference == Difference::Place);
    let places: Vec<_> = in_place.map(|(pairing, _)| *pairing).collect();
    let mut photons: Vec<_> =
        places.iter().filter_map(|pairing| lists.identity(*pairing).0).collect();
    photons.sort_unstable();
    photons.dedup();
    let step = photons.len() / most + 1;
    let photons: Vec<_> = photons.into_iter().step_by(step).collect();
    if lists.submission.columns.photon {
        return exact_windows(lists, &photons);
    }
    if 2 * places.len() < lists.pairings.len() {
        return windows_around(lists, lists.pairings, &photons);
    }
    // Stored a little elsewhere, no record matches: those that are near show which belong together.
    let wide = align(lists.reference, lists.submission, LONGEST_OFFSET * size);
    windows_around(lists, &wide, &photons)
}

fn exact_windows(lists: &Lists, photons: &[u64]) -> Vec<Window> {
    let mut stored: BTreeMap<u64, Vec<_>> =
        photons.iter().map(|photon| (*photon, Vec::new())).collect();
    let mut records: Vec<_> = lists.submission.records.iter().collect();
    records.sort_by_key(|record| (record.photon, record.bounce));
    for record in records {
        if let Some(of_photon) = stored.get_mut(&u64::from(record.photon)) {
            of_photon.push(record.position);
        }
    }
    let windows = stored.into_iter();
    windows.map(|(photon, positions)| Window { photon, positions, is_exact: true }).collect()
}

/// The records of the submission that lie in the list about where those of the photons should.
fn windows_around(lists: &Lists, pairings: &[Pairing], photons: &[u64]) -> Vec<Window> {
    let mut windows = Vec::new();
    let mut last = None;
    for (at, pairing) in pairings.iter().enumerate() {
        let (Pairing::Both(i, _) | Pairing::Missing(i)) = *pairing else { continue };
        let photon = u64::from(lists.reference.records[i].photon);
        if last == Some(photon) || photons.binary_search(&photon).is_err() {
            continue;
        }
        last = Some(photon);
        let around = &pairings[at.saturating_sub(AROUND)..(at + 2 * AROUND).min(pairings.len())];
        let mut places: Vec<_> = around
            .iter()
            .filter_map(|pairing| match *pairing {
                Pairing::Both(_, j) | Pairing::Extra(j) => Some(j),
                Pairing::Missing(_) => None,
            })
            .collect();
        places.sort_unstable();
        let positions = places.into_iter().map(|j| lists.submission.records[j].position).collect();
        windows.push(Window { photon, positions, is_exact: false });
    }
    windows
}
