//! Faults that look like something else: what is said of them, and what is not.

use std::sync::LazyLock;

use grading::judge_list::{Expectations, Judgement, judge};
use grading::observation::{Observation, observe};
use grading::places::Places;
use grading::signature::Signatures;
use photon_list::reader::PhotonList;
use photon_list::record::{ABSENT, Columns};
use photon_mapping::assignment8::create_scene;
use photon_mapping::photon_list::PhotonRecord;
use variants::hypotheses::no_offset;
use variants::variation::{Simulation, Variation};

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

fn positions_of(records: &[PhotonRecord]) -> Observation {
    let bare = |record: &PhotonRecord| PhotonRecord { position: record.position, ..ABSENT };
    observed(records.iter().map(bare).collect(), Columns::default())
}

fn faults(judgement: &Judgement) -> Vec<&'static str> {
    let faults = judgement.findings.iter().filter(|finding| finding.is_fault());
    faults.map(|fault| fault.check).collect()
}

fn name(judgement: &Judgement) -> Option<&str> {
    judgement.explanation.as_ref().map(|explanation| explanation.hypothesis.id)
}

#[test]
fn hits_that_come_back_from_farther_than_rounding_are_not_called_no_offset() {
    let sides = [0.2, 0.6, 0.6, 0.6, 0.6, 0.3, 0.2, 0.6, 0.6, 0.6, 0.6, 0.15];
    let self_hits = records(no_offset(sides).variation, 60, EMITTED);
    // As from 1e-5 above the surface, in a direction below it.
    let mut below = self_hits.clone();
    for at in 1..below.len() {
        if self_hits[at].position == self_hits[at - 1].position {
            let facet = &EXPECTATIONS.places.facets[usize::from(self_hits[at].surface)];
            let along = (facet.corners[1] - facet.corners[0]).normalize();
            below[at].position = below[at - 1].position + 1.2e-5 * along.as_vec3();
        }
    }
    for emitted in [None, Some(EMITTED as f64)] {
        let judged = |list| judge(&positions_of(list), emitted, emitted.is_some(), &EXPECTATIONS);
        assert_eq!(name(&judged(&self_hits)), Some("no-offset"));
        let judgement = judged(&below);
        assert_eq!(name(&judgement), None);
        assert!(faults(&judgement).contains(&"same place"));
        let mut same_place = judgement.findings.iter().filter(|it| it.check == "same place");
        assert!(same_place.all(|it| it.advice.contains("hemisphere over the normal")));
    }
}
