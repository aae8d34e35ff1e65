//! What a run stores under a misreading of the table.

use std::collections::BTreeMap;

use compare::position_index::is_near;
use compare::report::TOLERANCE;
use fast::lanes::offset::Offset;
use glam::Vec3;
use model::facets::facets;
use photon_list::reader::PhotonList;
use photon_mapping::photon_list::PhotonRecord;
use rayon::prelude::*;
use variants::hypotheses::{self, Hypothesis};
use variants::misreadings::by_marks;
use variants::reading::Reading;
use variants::run::Run;
use variants::section::Section;
use variants::variation::Simulation;

/// A run with so few bounces allowed shows paths that end one bounce too early. With the handout's
/// 1000, no path is that long.
pub const FEW_BOUNCES: i32 = 3;

/// So many photons are traced under every misreading to find the one that a list shows.
const PHOTONS_TRIED: u64 = 20_000;
/// A list that differs from the reference in fewer records than this shows no misreading.
const FEWEST_WRONG: usize = 20;
/// A misreading explains a list if it leaves at most this part of the wrong records wrong.
const LEFT_WRONG: f64 = 0.02;

/// A misreading of the table.
#[derive(Clone, Debug)]
pub struct ShownMisreading {
    /// Its name.
    pub id: &'static str,
    /// What it does.
    pub title: String,
    /// The section of the handout that it misreads.
    pub section: Section,
    /// What to look at in the code.
    pub advice: &'static str,
}

/// Paths that come again are shown as of so many threads with one seed.
const THREADS: u64 = 8;

/// All misreadings, each once, in the table's order.
fn table() -> Vec<Hypothesis> {
    let mut table = by_marks().to_vec();
    for hypothesis in hypotheses::misreadings() {
        if table.iter().all(|other| other.id != hypothesis.id) {
            table.push(hypothesis);
        }
    }
    table
}

/// The names of all misreadings.
pub fn names() -> Vec<&'static str> {
    table().into_iter().map(|hypothesis| hypothesis.id).collect()
}

/// Whether the misreading `name` shows only where few bounces are allowed.
pub fn needs_few_bounces(name: &str) -> bool {
    name == hypotheses::BOUNCE_OFF_BY_ONE
}

/// What the misreading `name` is, and the records that `run`, a run of the handout's scene, stores
/// under it; nothing if no misreading has this name. Its photons draw the numbers of the run.
pub fn trace(name: &str, run: &Run) -> Option<(ShownMisreading, Vec<PhotonRecord>)> {
    let hypothesis = table().into_iter().find(|hypothesis| hypothesis.id == name)?;
    let records = records(&hypothesis, run, run.renderer.emitted());
    Some((shown(hypothesis)?, records))
}

fn shown(Hypothesis { id, title, misreading, .. }: Hypothesis) -> Option<ShownMisreading> {
    let advised = misreading?;
    Some(ShownMisreading { id, title, section: advised.section, advice: advised.advice })
}

/// What the first `photons` photons of `run` store under `hypothesis`.
fn records(hypothesis: &Hypothesis, run: &Run, photons: u64) -> Vec<PhotonRecord> {
    match hypothesis.id {
        // How often a photon hits the surface it leaves depends on rounding, so it is traced as it
        // is.
        "no-offset" => {
            let reading = Reading { offset: Offset::None, ..run.reading };
            (Run { reading, ..run.clone() }).records(0..photons)
        }
        "stored-twice" => {
            run.records(0..photons).into_iter().flat_map(|record| [record; 2]).collect()
        }
        "repeated-paths" => {
            let of_thread = run.renderer.emitted().div_ceil(THREADS);
            let first = run.records(0..of_thread.min(photons));
            let again = |thread: u64| {
                let number = (thread * of_thread) as u32;
                first
                    .iter()
                    .map(move |record| PhotonRecord { photon: record.photon + number, ..*record })
            };
            let all = (0..THREADS).flat_map(again);
            all.filter(|record| u64::from(record.photon) < photons).collect()
        }
        _ => {
            let renderer = &run.renderer;
            let simulation = Simulation::new(
                hypothesis.variation,
                renderer.seed,
                renderer.emitted(),
                renderer.max_photon_bounces,
            );
            let mut records = simulation.trace(0..photons);
            // The simulation has a mesh object for every face.
            let surfaces: Vec<_> =
                facets(run.scene()).map(|facet| facet[0].parent_mesh_object as u16).collect();
            for record in &mut records {
                // A photon that is nowhere is on no face.
                if let Some(surface) = surfaces.get(usize::from(record.surface)) {
                    record.surface = *surface;
                }
            }
            records
        }
    }
}

/// The misreading under which `run`, a run of the handout's scene, stores what `list` has of its
/// first photons. A list with other random numbers shows none.
pub fn recognize(list: &PhotonList, run: &Run) -> Option<ShownMisreading> {
    let mut few = run.clone();
    few.renderer.photon_count = few.renderer.photon_count.min(PHOTONS_TRIED);
    let emitted = few.renderer.emitted();
    let wrong = |traced: &[PhotonRecord], photons: u64| {
        wrong_records(list, traced, photons, TOLERANCE * run.size())
    };
    let without_any = wrong(&few.records(0..emitted), emitted);
    let most = (without_any as f64 * LEFT_WRONG) as usize;
    let tried = table().into_par_iter().filter_map(|hypothesis| {
        let left = |photons| wrong(&records(&hypothesis, &few, photons), photons);
        // More photons are never less wrong, and most misreadings fail by the first few.
        let is_worth = left(emitted / 8) <= most;
        let left = is_worth.then(|| left(emitted)).filter(|left| *left <= most)?;
        Some((left, shown(hypothesis)?))
    });
    let best = || tried.min_by_key(|(left, _)| *left).map(|(_, misreading)| misreading);
    (without_any >= FEWEST_WRONG).then(best).flatten()
}

/// How many records of the first `emitted` photons differ between `list` and `traced`, or are in
/// only one of the two. A list that does not tell its photons is read in order.
fn wrong_records(
    list: &PhotonList,
    traced: &[PhotonRecord],
    emitted: u64,
    tolerance: f32,
) -> usize {
    let tells_photons = list.columns.photon;
    let mut paths: BTreeMap<u32, [Vec<Vec3>; 2]> = BTreeMap::new();
    let mut add = |side: usize, record: &PhotonRecord| {
        let path = if tells_photons { record.photon } else { 0 };
        paths.entry(path).or_default()[side].push(record.position);
    };
    traced.iter().for_each(|record| add(0, record));
    let most = if tells_photons { list.records.len() } else { traced.len() };
    let of_list = list.records.iter().take(most);
    let is_tried = |record: &&PhotonRecord| !tells_photons || u64::from(record.photon) < emitted;
    of_list.filter(is_tried).for_each(|record| add(1, record));
    let wrong = |[a, b]: &[Vec<Vec3>; 2]| {
        let same = a.iter().zip(b).filter(|(a, b)| is_near(**a, **b, tolerance)).count();
        a.len().max(b.len()) - same
    };
    paths.values().map(wrong).sum()
}
