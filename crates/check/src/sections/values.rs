//! What stored photons hold: position, intensity and the direction to the light.

use glam::Vec3;

use super::SectionVerdict;
use crate::events::{Call, Trace};
use crate::plan::{INTENSITY, PlanStep};

/// A position this far off the surface still shows the same dots.
pub(super) const OFF_SURFACE: f32 = 7.1e-3;

/// What the stored photons hold, at a wall that absorbs everything.
pub(super) fn judge_values<'a>(
    calls: &impl Fn(PlanStep) -> &'a [Call],
    verdict: &mut SectionVerdict,
) {
    let mut total = 0;
    let mut elsewhere = Vec::new();
    let (mut off, mut intensity, mut reversed, mut unset, mut not_unit) = (0, 0, 0, 0, 0);
    for call in [2, 3].into_iter().flat_map(|path| calls(PlanStep::StoreLater(path))) {
        let Some(hit) = call.hits().next() else { continue };
        for stored in &call.stored {
            total += 1;
            let distance = (stored.position - hit.hit()).length();
            if distance.is_nan() || distance > OFF_SURFACE {
                elsewhere.push((stored.position, *hit));
            } else if distance > 1e-4 {
                off += 1;
            }
            if !(stored.intensity - INTENSITY).abs().cmple(Vec3::splat(1e-6)).all() {
                intensity += 1;
            }
            let back = -hit.direction.normalize();
            let direction = stored.to_light;
            if !direction.is_finite() || direction.abs_diff_eq(-Vec3::Z, 1e-6) {
                unset += 1;
            } else if direction.normalize_or_zero().abs_diff_eq(-back, 1e-3) {
                reversed += 1;
            } else if !direction.normalize_or_zero().abs_diff_eq(back, 1e-3) {
                unset += 1;
            } else if (direction.length() - 1.0).abs() > 1e-3 {
                not_unit += 1;
            }
        }
    }
    if let Some((stored, hit)) = elsewhere.first() {
        let found = format!(
            "a photon is stored at {}, and its ray met the wall at {}{}",
            place(*stored),
            place(hit.hit()),
            where_instead(&elsewhere)
        );
        let advice = "The position is state.intersectionRay.GetRayPosition(state.intersectionT).";
        verdict.fault(Some("wrong-position"), found, advice);
    }
    let mut remark = |count: usize, text: &str| {
        if count > 0 {
            verdict.remarks.push(format!("{text} ({count} of {total} photons). It costs nothing."));
        }
    };
    remark(off, "positions are slightly off the surface");
    remark(intensity, "intensity is not lightIntensity");
    remark(reversed, "toLightRay points along the photon's way, not against it");
    remark(unset, "toLightRay is not set to the opposite of the photon's ray");
    remark(not_unit, "toLightRay's direction is not a unit vector");
}

/// What is known about the places of photons that are not where their rays met the wall, which has
/// the normal (0, 0, 1).
fn where_instead(elsewhere: &[(Vec3, Trace)]) -> String {
    let offset = |(stored, hit): &(Vec3, Trace)| *stored - hit.hit();
    let first = offset(&elsewhere[0]);
    if elsewhere.iter().all(|(stored, hit)| stored.abs_diff_eq(hit.from, 1e-4)) {
        ": that is the start of its ray".to_owned()
    } else if first.truncate().length() < 1e-4
        && elsewhere.iter().all(|one| offset(one).abs_diff_eq(first, 1e-3))
    {
        format!(": it is moved by {:.3} along the normal", first.z)
    } else {
        String::new()
    }
}

fn place(v: Vec3) -> String {
    format!("({:.3}, {:.3}, {:.3})", v.x, v.y, v.z)
}
