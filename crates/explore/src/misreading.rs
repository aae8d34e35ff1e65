//! What a run stores under a misreading of the table.

use fast::lanes::offset::Offset;
use model::facets::facets;
use photon_mapping::photon_list::PhotonRecord;
use variants::hypotheses::{self, Hypothesis};
use variants::reading::Reading;
use variants::run::Run;
use variants::variation::{FACETS, Simulation};

use super::comparison::Other;

/// A run with so few bounces allowed shows paths that end one bounce too early. With the handout's
/// 1000, no path is that long.
pub const FEW_BOUNCES: i32 = 3;

/// All misreadings, each once, in the table's order.
fn table() -> Vec<Hypothesis> {
    let mut table = vec![hypotheses::no_offset([0.0; FACETS])];
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
pub fn trace(name: &str, run: &Run) -> Option<(Other, Vec<PhotonRecord>)> {
    let hypothesis = table().into_iter().find(|hypothesis| hypothesis.id == name)?;
    let misreading = hypothesis.misreading?;
    let other = Other::Misreading {
        id: hypothesis.id.to_owned(),
        title: hypothesis.title,
        section: misreading.section,
        advice: misreading.advice.to_owned(),
    };
    let all = 0..run.renderer.emitted();
    if name == "no-offset" {
        // How often a photon hits the surface it leaves depends on rounding, so it is traced as it
        // is.
        let reading = Reading { offset: Offset::None, ..run.reading };
        let mut records = Vec::new();
        let traced: Result<_, std::convert::Infallible> = Run { reading, ..run.clone() }
            .trace_list(all, |piece, _| {
                records.extend_from_slice(piece);
                Ok(())
            });
        let Ok(_) = traced;
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
