//! What a run stores under a misreading of the table.

use std::ops::Range;

use fast::lanes::offset::Offset;
use model::facets::facets;
use photon_mapping::photon_list::PhotonRecord;
use variants::hypotheses::{self, Hypothesis};
use variants::misreadings::by_marks;
use variants::reading::Reading;
use variants::run::Run;
use variants::variation::Simulation;

use super::comparison::Other;

/// A run with so few bounces allowed shows paths that end one bounce too early. With the handout's
/// 1000, no path is that long.
pub const FEW_BOUNCES: i32 = 3;

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

/// What `run` stores of `photons`.
fn stored(run: &Run, photons: Range<u64>) -> Vec<PhotonRecord> {
    let mut records = Vec::new();
    let traced: Result<_, std::convert::Infallible> = run.trace_list(photons, |piece, _| {
        records.extend_from_slice(piece);
        Ok(())
    });
    let Ok(_) = traced;
    records
}

/// What the misreading `name` is, and the records that `run`, a run of the handout's scene, stores
/// under it; nothing if no misreading has this name. Its photons draw the numbers of the run.
pub fn trace(name: &str, run: &Run) -> Option<(Other, Vec<PhotonRecord>)> {
    let hypothesis = table().into_iter().find(|hypothesis| hypothesis.id == name)?;
    let misreading = hypothesis.misreading?;
    let other = Other::Misreading {
        id: hypothesis.id.to_owned(),
        title: hypothesis.title,
        section: misreading.section,
        advice: misreading.advice.to_owned(),
    };
    let emitted = run.renderer.emitted();
    let all = 0..emitted;
    let by_marks = match name {
        // How often a photon hits the surface it leaves depends on rounding, so it is traced as it
        // is.
        "no-offset" => {
            let reading = Reading { offset: Offset::None, ..run.reading };
            Some(stored(&Run { reading, ..run.clone() }, all.clone()))
        }
        "stored-twice" => {
            Some(stored(run, all.clone()).into_iter().flat_map(|record| [record; 2]).collect())
        }
        "repeated-paths" => {
            let of_thread = emitted.div_ceil(THREADS);
            let first = stored(run, 0..of_thread);
            let again = |thread: u64| {
                let number = (thread * of_thread) as u32;
                first
                    .iter()
                    .map(move |record| PhotonRecord { photon: record.photon + number, ..*record })
            };
            let all = (0..THREADS).flat_map(again);
            Some(all.filter(|record| u64::from(record.photon) < emitted).collect())
        }
        _ => None,
    };
    if let Some(records) = by_marks {
        return Some((other, records));
    }
    let renderer = &run.renderer;
    let simulation = Simulation::new(
        hypothesis.variation,
        renderer.seed,
        renderer.emitted(),
        renderer.max_photon_bounces,
    );
    let mut records = simulation.trace(all);
    // The simulation has a mesh object for every face.
    let surfaces: Vec<_> =
        facets(run.scene()).map(|facet| facet[0].parent_mesh_object as u16).collect();
    for record in &mut records {
        // A photon that is nowhere is on no face.
        if let Some(surface) = surfaces.get(usize::from(record.surface)) {
            record.surface = *surface;
        }
    }
    Some((other, records))
}
