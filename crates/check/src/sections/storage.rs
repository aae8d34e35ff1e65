//! Photon Storage: which hits are stored, what is stored, and when the path ends.

use glam::Vec3;

use super::limit::judge_limit;
use super::values::{OFF_SURFACE, judge_values};
use super::{Fault, SectionVerdict};
use crate::events::{Call, StepLog, Trace};
use crate::plan::{PlanStep, STORAGE};
use crate::run::Observed;
use variants::section::Section;

pub(super) const IN_EVERY_CALL: &str =
    "Call TracePhoton for the scattered ray in every call, not only in the first.";
const ONLY_LATER: &str = "Store a photon only where path.size() is larger than 1, and let 'path' \
                          grow with every call of TracePhoton.";

/// What the whole run can refute: which hits are stored, and how often.
const WHICH_HITS: [&str; 6] = [
    "direct-stored",
    "third-hit-on",
    "absorbed-not-stored",
    "not-stored",
    "stored-twice",
    "path-does-not-grow",
];

pub(super) fn judge(observed: &Observed, told: &mut Vec<String>) -> SectionVerdict {
    let mut verdict = SectionVerdict::new(Section::PhotonStorage);
    let calls =
        |step: PlanStep| -> &[Call] { observed.step(step).map_or(&[], |log| log.calls.as_slice()) };
    let ended =
        |step: PlanStep| -> &[Call] { observed.step(step).map_or(&[], StepLog::ended_calls) };
    let is_seen = STORAGE.iter().any(|step| !calls(*step).is_empty());
    let asks = STORAGE.iter().any(|step| calls(*step).iter().any(|call| call.rays() > 0));
    if !is_seen {
        if STORAGE.iter().all(|step| observed.death(*step).is_none()) {
            verdict.not_reached("TracePhoton was not called");
        }
    } else if !asks && STORAGE.iter().all(|step| observed.death(*step).is_none()) {
        let found = "TracePhoton never calls storedScene->Trace with a state".to_owned();
        let advice =
            "Call storedScene->Trace(photonRay, &state) below the line that sets currentIOR.";
        verdict.fault(None, found, advice);
    } else {
        judge_first(ended(PlanStep::StoreFirst), &mut verdict);
        judge_later(&ended, &mut verdict);
        judge_values(&ended, &mut verdict);
        if observed.death(PlanStep::GrowPath).is_none() {
            judge_growth(ended(PlanStep::GrowPath), &mut verdict);
        }
        judge_limit(&calls, ended(PlanStep::Remaining(1000)), &mut verdict);
        let missed =
            calls(PlanStep::StoreMiss).iter().filter(|call| !call.stored.is_empty()).count();
        if missed > 0 {
            let found = "a photon is stored though its ray meets nothing".to_owned();
            verdict.fault(None, found, "End TracePhoton where Trace returns false.");
        }
    }
    // TracePhoton alone may lack what is done before it in a run.
    let is_right_in_run = observed.log.whole.stores_right_hits();
    if is_right_in_run {
        let is_refuted = |fault: &Fault| fault.name.is_some_and(|name| WHICH_HITS.contains(&name));
        verdict.faults.retain(|fault| !is_refuted(fault));
    }
    if STORAGE.iter().any(|step| observed.step(*step).is_some_and(|log| log.other_signature)) {
        verdict.remarks.push(
            "TracePhoton takes other arguments than the framework's, so paths that start with two \
             elements were not tried"
                .to_owned(),
        );
    }
    // What stores the photon first and dies then, dies in what comes after: the roulette.
    let stores_before_dying = observed.death(PlanStep::Black).is_some()
        && observed.death(PlanStep::StoreLater(2)).is_some()
        && calls(PlanStep::StoreLater(2)).iter().all(|call| call.stored.len() == 1);
    // What dies only where photons scatter, dies in what other sections ask for.
    let dies_scattering = observed.death(PlanStep::White).is_some()
        && [PlanStep::Black, PlanStep::StoreMiss]
            .into_iter()
            .all(|step| observed.death(step).is_none());
    let dies_alone = observed.death(PlanStep::StoreLater(2)).is_some()
        && STORAGE.iter().all(|step| !starts_at_light(*step) || observed.death(*step).is_none());
    let own: Vec<_> = STORAGE
        .into_iter()
        .filter(|step| !is_right_in_run || starts_at_light(*step) || !dies_alone)
        .filter(|step| match is_on_black_wall(*step) {
            true => !stores_before_dying,
            false => !dies_scattering || *step == PlanStep::StoreMiss,
        })
        .collect();
    if dies_scattering && verdict.faults.is_empty() {
        verdict.not_reached(
            "TracePhoton does not end well where photons scatter, so whether 'path' grows was not \
             seen",
        );
    }
    verdict.finish(observed, "TracePhoton", &own, told)
}

/// Whether a run could begin like that.
fn starts_at_light(step: PlanStep) -> bool {
    matches!(step, PlanStep::StoreFirst | PlanStep::GrowPath)
}

fn is_on_black_wall(step: PlanStep) -> bool {
    matches!(step, PlanStep::StoreFirst | PlanStep::StoreLater(_))
}

fn judge_first(calls: &[Call], verdict: &mut SectionVerdict) {
    let stored: usize = calls.iter().map(|call| call.stored.len()).sum();
    if stored > 0 {
        let found = format!(
            "{stored} photons are stored in {} calls where the path has a size of 1: they come \
             directly from the light",
            calls.len()
        );
        verdict.fault(Some("direct-stored"), found, ONLY_LATER);
    }
}

fn judge_later<'a>(calls: &impl Fn(PlanStep) -> &'a [Call], verdict: &mut SectionVerdict) {
    let stores_the_scattered = calls(PlanStep::GrowPath).iter().any(|call| !call.stored.is_empty());
    for path in [2, 3] {
        let of_step = calls(PlanStep::StoreLater(path));
        let with_hit: Vec<_> = of_step.iter().filter(|call| call.hits().next().is_some()).collect();
        let none = with_hit.iter().filter(|call| call.stored.is_empty()).count();
        if none > 0 {
            let found = format!(
                "nothing is stored in {none} of {} calls where the path has a size of {path} and \
                 the wall is black",
                with_hit.len()
            );
            let stores_third = path == 2
                && calls(PlanStep::StoreLater(3)).iter().all(|call| !call.stored.is_empty());
            let (name, advice) = if stores_third {
                (
                    "third-hit-on",
                    "The light is the first entry of 'path': store where its size is larger than \
                     1, not 2.",
                )
            } else if stores_the_scattered {
                (
                    "absorbed-not-stored",
                    "Store a photon before the roulette decides what becomes of it.",
                )
            } else {
                ("not-stored", "Insert a photon into photonMap where path.size() is larger than 1.")
            };
            verdict.fault(Some(name), found, advice);
            return;
        }
        let twice = with_hit.iter().filter(|call| repeats(call)).count();
        if twice > 0 {
            let found =
                format!("a photon is stored more than once in {twice} of {} calls", with_hit.len());
            verdict.fault(Some("stored-twice"), found, "Insert each photon once.");
            return;
        }
    }
}

/// Whether one hit is stored more often than it happened.
fn repeats(call: &Call) -> bool {
    let near = |hit: &Trace, position: Vec3| hit.hit().abs_diff_eq(position, OFF_SURFACE);
    call.hits().any(|hit| {
        let stored = call.stored.iter().filter(|stored| near(hit, stored.position)).count();
        let happened = call.hits().filter(|other| near(other, hit.hit())).count();
        stored > happened
    })
}

fn judge_growth(calls: &[Call], verdict: &mut SectionVerdict) {
    let ends_at_second = |call: &Call| call.hits().count() == 2 && call.rays() == 2;
    if !calls.is_empty() && calls.iter().all(ends_at_second) {
        let found = "all paths end at the second hit in closed white cubes where remainingBounces \
                     starts with 5; expected 6 hits";
        verdict.fault(Some("first-bounce-only"), found.to_owned(), IN_EVERY_CALL);
    }
    let hits: usize = calls.iter().map(|call| call.hits().count().saturating_sub(1)).sum();
    if hits == 0 {
        return;
    }
    let has_fault =
        |verdict: &SectionVerdict, name: &str| verdict.faults.iter().any(|f| f.name == Some(name));
    let stored: usize = calls.iter().map(|call| call.stored.len()).sum();
    // A wrong place tells nothing about which hit is stored.
    let is_placed = !has_fault(verdict, "wrong-position");
    let first_stored = calls.iter().filter(|call| is_placed && stores_first(call)).count();
    if first_stored > 0 && !has_fault(verdict, "direct-stored") {
        let found = format!(
            "the first hit of the path is stored in {first_stored} of {} calls: it comes directly \
             from the light",
            calls.len()
        );
        verdict.fault(Some("direct-stored"), found, ONLY_LATER);
    }
    let is_told = ["direct-stored", "not-stored", "absorbed-not-stored", "third-hit-on"];
    if is_told.iter().any(|name| has_fault(verdict, name)) {
        return;
    }
    if stored == 0 {
        let found = format!(
            "no photon is stored that bounces in closed cubes, in {hits} later hits: the path \
             does not grow"
        );
        let advice = "Add an element to 'path' before TracePhoton calls itself.";
        verdict.fault(Some("path-does-not-grow"), found, advice);
        return;
    }
    let second = calls.iter().filter(|call| call.hits().count() > 1);
    let without = second.clone().filter(|call| is_placed && lacks_second(call)).count();
    if without > 0 {
        let found = format!(
            "the second hit of the path is not stored in {without} of {} calls; the first that is \
             stored comes later",
            second.count()
        );
        verdict.fault(Some("third-hit-on"), found, ONLY_LATER);
    } else if stored < hits {
        let found = format!("{stored} photons are stored in {hits} hits that have bounced");
        verdict.fault(None, found, ONLY_LATER);
    } else if stored > hits && !has_fault(verdict, "stored-twice") {
        let found = format!("{stored} photons are stored, and only {hits} hits have bounced");
        verdict.fault(Some("stored-twice"), found, "Insert each photon once.");
    }
}

/// At the place of hit number `index`, from 0: how many photons are stored, and how many hits there
/// have bounced.
fn stored_and_due(call: &Call, index: usize) -> Option<(usize, usize)> {
    let place = call.hits().nth(index)?.hit();
    let near = |position: Vec3| place.abs_diff_eq(position, OFF_SURFACE);
    let stored = call.stored.iter().filter(|stored| near(stored.position)).count();
    // Without an offset, several hits lie in one place.
    let due = call.hits().skip(1).filter(|hit| near(hit.hit())).count();
    Some((stored, due))
}

fn stores_first(call: &Call) -> bool {
    stored_and_due(call, 0).is_some_and(|(stored, due)| stored > due)
}

fn lacks_second(call: &Call) -> bool {
    stored_and_due(call, 1).is_some_and(|(stored, due)| stored < due)
}
