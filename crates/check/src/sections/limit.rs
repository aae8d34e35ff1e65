//! Photon Storage: when the path ends.

use super::SectionVerdict;
use super::storage::IN_EVERY_CALL;
use crate::events::Call;
use crate::plan::PlanStep;

pub(super) fn judge_limit<'a>(
    calls: &impl Fn(PlanStep) -> &'a [Call],
    far: &[Call],
    verdict: &mut SectionVerdict,
) {
    let stored = |calls: &[Call]| calls.iter().map(|call| call.stored.len()).sum::<usize>();
    let below = stored(calls(PlanStep::Remaining(-1)));
    if below > 0 {
        let found = format!("{below} photons are stored with remainingBounces = -1");
        let advice = "End TracePhoton first of all where remainingBounces is less than 0.";
        verdict.fault(Some("no-limit"), found, advice);
    }
    let advice = "TracePhoton ends when remainingBounces is LESS THAN 0, not when it is 0.";
    let at_zero = calls(PlanStep::Remaining(0));
    let hits = |calls: &[Call]| calls.iter().map(|call| call.hits().count()).sum::<usize>();
    let hits_at_zero = hits(at_zero);
    if !at_zero.is_empty() && hits(calls(PlanStep::Remaining(1))) > 0 && hits_at_zero == 0 {
        let found = "with remainingBounces = 0, no ray is traced; expected one".to_owned();
        verdict.fault(Some("bounce-off-by-one"), found, advice);
        return;
    }
    let stores = stored(calls(PlanStep::StoreLater(2))) > 0;
    if hits_at_zero > 0 && stored(at_zero) == 0 && stores {
        let found = "with remainingBounces = 0, a hit is not stored".to_owned();
        verdict.fault(Some("bounce-off-by-one"), found, advice);
        return;
    }
    if hits_at_zero > at_zero.len() && verdict.faults.is_empty() {
        let found = format!(
            "with remainingBounces = 0, a path has {} hits; expected 1",
            hits_at_zero.div_ceil(at_zero.len())
        );
        let advice = "Hand remainingBounces - 1 to the next call, and end where it is less than 0.";
        verdict.fault(Some("no-limit"), found, advice);
        return;
    }
    let counts: Vec<_> = far.iter().map(|call| call.hits().count()).collect();
    let missed =
        far.iter().any(|call| call.traces.iter().any(|trace| trace.has_state && !trace.met));
    let Some(count) = counts.first().copied() else { return };
    let all_same = counts.iter().all(|other| *other == count);
    // One hit alone is a path that never scatters, which is another section's.
    let is_told = verdict.faults.iter().any(|fault| fault.name == Some("first-bounce-only"));
    if all_same && !missed && !is_told && (2..1001).contains(&count) {
        let found = format!(
            "all paths end after {count} hits in closed white cubes where remainingBounces starts \
             with 1000; expected 1001"
        );
        let (name, advice) = match count {
            2 => ("first-bounce-only", IN_EVERY_CALL),
            1000 => ("bounce-off-by-one", advice),
            _ => ("fewer-bounces", "Let remainingBounces alone decide when a path ends."),
        };
        verdict.fault(Some(name), found, advice);
    } else if all_same && count > 1001 {
        let found = format!("paths have {count} hits; expected 1001");
        verdict.fault(Some("no-limit"), found, "Hand remainingBounces - 1 to the next call.");
    }
}
