//! Hemisphere Ray Transformation: where the scattered ray starts.

use glam::Vec3;

use super::SectionVerdict;
use super::directions::Directions;
use super::transformation::short;

/// A shorter offset is hardly one: some photons meet the surface they left.
const SHORTEST: f32 = 5e-7;
/// A longer offset moves photons so far that some are lost.
const LONGEST: f32 = 2e-3;
/// A ray that starts farther than this from the hit starts somewhere else.
const ELSEWHERE: f32 = 5e-2;
/// So many of the scattered photons may meet their surface again before it is a fault.
const FEW: f64 = 1e-3;

/// Where scattered rays start, and whether they meet the surface they leave.
pub(super) fn judge_start(directions: &Directions, verdict: &mut SectionVerdict) {
    let walls = directions.walls.iter().map(|(normal, rays)| (*normal, rays));
    let all = walls.chain([(Vec3::Z, &directions.floor)]);
    let mut offsets = Vec::new();
    let mut distances: Vec<f32> = Vec::new();
    let (mut again, mut above) = (0_usize, 0_usize);
    let mut elsewhere: Option<(Vec3, Vec3)> = None;
    let all = all.flat_map(|(normal, rays)| rays.iter().map(move |ray| (normal, ray)));
    // A start along a direction that is not a number is none either; that has been said.
    for (normal, ray) in all.filter(|(_, ray)| ray.direction.is_finite()) {
        let offset = ray.from - ray.hit;
        let direction = ray.direction.normalize_or_zero();
        if offset.length() > ELSEWHERE || !offset.is_finite() {
            elsewhere.get_or_insert((ray.from, ray.hit));
            distances.push(offset.length());
            continue;
        }
        offsets.push((offset, normal, direction, ray.incoming));
        // A ray that goes down meets the surface, wherever it starts.
        if direction.dot(normal) > 1e-3 {
            above += 1;
            again += usize::from(ray.met_again);
        }
    }
    if let Some((from, hit)) = elsewhere {
        let found = format!(
            "a scattered ray starts at {}, and the photon hit the wall at {}: it is {:.2} away",
            short(from),
            short(hit),
            from.distance(hit)
        );
        let is_constant = distances.iter().all(|other| (other / distances[0] - 1.0).abs() < 0.01);
        let (name, advice) = if is_constant {
            (None, "Start the new ray at the point that was hit, and only 1e-5 above it.")
        } else {
            (Some("start-not-moved"), "Start the new ray at the point that was hit.")
        };
        verdict.fault(name, found, advice);
        return;
    }
    let lengths = offsets.iter().map(|(offset, ..)| offset.length());
    let mut lengths: Vec<_> = lengths.collect();
    lengths.sort_unstable_by(f32::total_cmp);
    let Some(length) = lengths.get(lengths.len() / 2).copied() else { return };
    let below = offsets.iter().filter(|(offset, normal, ..)| offset.dot(*normal) < -SHORTEST);
    let below = below.count();
    if again as f64 > FEW * above as f64 && 2 * below > offsets.len() {
        let found = format!(
            "{below} of {} scattered photons start below the surface they leave, {length:.0e} from \
             the hit, and {again} met it from behind",
            offsets.len()
        );
        let advice = "Turn the sign of the offset round: the hit point plus 1e-5 times the normal.";
        verdict.fault(Some("offset-below"), found, advice);
        return;
    }
    if again as f64 > FEW * above as f64 {
        let found = format!(
            "{again} of {above} scattered photons met the very wall they left: the offset is {}",
            if length < SHORTEST {
                "missing or too short".to_owned()
            } else {
                format!("{length:.0e}")
            }
        );
        let advice = "Start the scattered ray a little above the surface: the hit point plus 1e-5 \
                      times the normal, as the framework does for shadow rays.";
        verdict.fault(Some("no-offset"), found, advice);
        return;
    }
    if length < SHORTEST {
        verdict.remarks.push(
            "the scattered ray starts at the point that was hit, and still does not meet the \
             surface it leaves"
                .to_owned(),
        );
        return;
    }
    let aside = |axis: &dyn Fn(Vec3, Vec3, Vec3) -> Vec3| {
        offsets.iter().all(|(offset, normal, direction, incoming)| {
            let axis = axis(*normal, *direction, *incoming);
            (*offset - offset.dot(axis) * axis).length() < 0.05 * length + 3e-7
        })
    };
    let rounded = rounded(length);
    let along = if aside(&|normal, _, _| normal) {
        if (rounded - 1e-5).abs() < 1e-6 {
            return;
        }
        "along the normal"
    } else if aside(&|_, direction, _| direction) {
        "along the new direction"
    } else if aside(&|_, _, incoming| incoming) {
        "back along the ray"
    } else {
        "off the point that was hit"
    };
    verdict.readings.push(format!("offset {rounded:e} {along}"));
    if length > LONGEST {
        verdict.remarks.push(format!(
            "the offset of {rounded:e} is large: near edges, photons start behind another surface; \
             1e-5 is enough"
        ));
    }
}

/// One digit is what a student wrote; the rest is rounding.
fn rounded(length: f32) -> f32 {
    format!("{length:.0e}").parse().unwrap_or(length)
}
