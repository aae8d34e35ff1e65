//! The grader through the library: submissions of every kind, and what is said of them.

mod columns;
mod faults;
mod laws;
mod lists;
mod names;
mod own_lists;
mod planted;
mod power;
mod recognized;
mod threads;

use std::sync::LazyLock;

use photon_list::reader::PhotonList;
use photon_list::record::{ABSENT, Columns};
use photon_mapping::assignment8::create_scene;
use photon_mapping::photon_list::PhotonRecord;
use variants::variation::{Simulation, Variation};

use crate::judge_list::{Expectations, Judgment};
use crate::observation::{Observation, observe};
use crate::places::Places;
use crate::signature::Signatures;

const EMITTED: u64 = 200_000;

static EXPECTATIONS: LazyLock<Expectations> =
    LazyLock::new(|| Expectations::new(Places::new(&create_scene()), Signatures::of_assignment8()));

fn records(variation: Variation, seed: u64, emitted: u64) -> Vec<PhotonRecord> {
    Simulation::new(variation, seed, emitted, 1000).trace(0..emitted)
}

fn observed(records: Vec<PhotonRecord>, columns: Columns) -> Observation {
    let light = create_scene().lights()[0].position.as_dvec3();
    observe(&PhotonList { columns, records }, &EXPECTATIONS.places, light)
}

/// What is seen of positions alone.
fn positions_of(records: &[PhotonRecord]) -> Observation {
    let bare = |record: &PhotonRecord| PhotonRecord { position: record.position, ..ABSENT };
    observed(records.iter().map(bare).collect(), Columns::default())
}

fn name(judgment: &Judgment) -> Option<&str> {
    judgment.explanation.as_ref().map(|explanation| explanation.hypothesis.id)
}

fn is_incorrect(judgment: &Judgment) -> bool {
    judgment.findings.iter().any(|finding| finding.is_fault())
}

/// Whether photons are said to come straight from the light.
fn says_direct(judgment: &Judgment) -> bool {
    judgment.findings.iter().any(|finding| finding.check == "indirect only" && finding.is_fault())
}
