//! The exact comparison, for lists that follow the reference's streams.

use super::submission::Settings;
use super::verdict::Finding;
use crate::limits::exact::{BY_ROUNDING, MOST_COMPARED, MOST_PHOTONS, PROBES, SAME_HIT};
use compare::report::{Outcome, Report, TOLERANCE, compare};
use photon_list::reader::PhotonList;
use photon_mapping::photon_list::PhotonRecord;
use photon_mapping::rendering::photon_mapping_renderer::{PathVertex, PhotonMappingRenderer};
use variants::run::Run;

/// What the exact comparison finds; nothing for lists with other random numbers.
pub fn exact_comparison(
    list: &PhotonList,
    settings: &Settings,
    max_bounces: i32,
    emitted: Option<u64>,
) -> Option<Finding> {
    if list.records.len() > MOST_COMPARED {
        return None;
    }
    let last = list.records.iter().map(|record| u64::from(record.photon)).max()?;
    let emitted = emitted.unwrap_or(last + 1);
    if !list.columns.photon || last >= emitted || emitted > MOST_PHOTONS {
        return None;
    }
    let mut run = Run::handout(settings.seed, emitted);
    run.renderer.max_photon_bounces = max_bounces;
    if !follows(list, &run.renderer) {
        return None;
    }
    let reference = PhotonList::of(run.records(0..run.renderer.emitted()));
    let tolerance = TOLERANCE * run.size();
    let report = compare(&reference, list, Some(&run), tolerance, BY_ROUNDING);
    Some(finding_of(&report))
}

/// Whether some of the list's photons are where the reference's photons of the same number are.
fn follows(list: &PhotonList, renderer: &PhotonMappingRenderer) -> bool {
    let step = list.records.len() / PROBES + 1;
    let probes: Vec<_> = list.records.iter().step_by(step).collect();
    let found = probes.iter().filter(|record| is_hit(renderer, record)).count();
    5 * found > probes.len()
}

/// Whether the reference's photon of the same number hits where `record` is; straight from the
/// light, too, for those who store that.
fn is_hit(renderer: &PhotonMappingRenderer, record: &PhotonRecord) -> bool {
    let photon = u64::from(record.photon);
    let mut is_hit = false;
    renderer.generic_photon_map_generation(&mut Vec::new(), photon..photon + 1, |_, path, _| {
        is_hit = path.iter().any(|vertex| match vertex {
            PathVertex::Surface(state) => {
                state.intersection_point().distance(record.position) < SAME_HIT
            }
            PathVertex::Light => false,
        });
    });
    is_hit
}

fn finding_of(report: &Report) -> Finding {
    let differing = report.reference_records.max(report.submission_records)
        - report.differences.matched.min(report.submission_records);
    let found = match (&report.outcome, &report.first_divergence) {
        (Outcome::Identical, _) => "the same list, bit for bit".to_owned(),
        (Outcome::WithinTolerance, _) => format!("the same photons; {differing} differ"),
        (_, divergence) => {
            let reason = divergence.as_ref().and_then(|divergence| divergence.reason.clone());
            let reading = report.reading.as_ref().map(|reading| format!("as with {reading}"));
            let why = reading.or(reason).unwrap_or_else(|| "the first is not explained".to_owned());
            format!("{differing} photons differ: {why}")
        }
    };
    let section = report.first_divergence.as_ref().and_then(|divergence| divergence.section);
    let finding = Finding::new(
        "exact comparison",
        "the reference's photons, whose random numbers the list follows",
        found,
        "'photon-mapping compare' tells more.",
    );
    // What it shows of positions, the other checks judge; what they let pass may be fair.
    let finding = finding.passed_if(report.outcome != Outcome::Different);
    Finding { section: section.map(|section| section.title()), ..finding }
}
