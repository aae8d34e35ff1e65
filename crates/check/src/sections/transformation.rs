//! Hemisphere Ray Transformation: directions over walls, and where the scattered ray starts.

use glam::{Mat3, Vec3};

use super::SectionVerdict;
use super::directions::{Directions, FEWEST, FrameForm, Scattered};
use crate::plan::{PlanStep, wall_normals};
use crate::run::Observed;
use variants::section::Section;

/// A shorter offset is hardly one: some photons meet the surface they left.
const SHORTEST: f32 = 5e-7;
/// A longer offset moves photons so far that some are lost.
const LONGEST: f32 = 2e-3;
/// A ray that starts farther than this from the hit starts somewhere else.
const ELSEWHERE: f32 = 5e-2;
/// So many of the scattered photons may meet their surface again before it is a fault.
const FEW: f64 = 1e-3;

const COLUMNS: &str =
    "The columns of the matrix are t, b and n, in this order; glm::mat3(t, b, n) takes columns.";
const WALL: &str = "The wall's normal is (-1, 0, 0), so its dot product with (1, 0, 0) is -1: \
                    compare the absolute value with your threshold.";

pub(super) fn judge(
    observed: &Observed,
    directions: &Directions,
    told: &mut Vec<String>,
) -> SectionVerdict {
    let mut verdict = SectionVerdict::new(Section::HemisphereRayTransformation);
    let steps: Vec<_> = wall_normals().into_iter().map(PlanStep::Wall).collect();
    let seen = directions.walls.iter().filter(|(_, rays)| rays.len() >= FEWEST).count();
    if seen == 0 {
        if steps.iter().all(|step| observed.death(*step).is_none()) {
            verdict.not_reached("no photon scatters from a wall with P_r = 0.5");
        }
        return verdict.finish(observed, "TracePhoton", &steps, told);
    }
    if directions.are_old {
        let found = "TracePhoton is called with the ray that came in, unchanged".to_owned();
        let advice = "Hand the new ray to TracePhoton, or change photonRay before: its position \
                      and its direction.";
        verdict.fault(Some("start-not-moved"), found, advice);
    } else {
        judge_frames(directions, &mut verdict);
        judge_start(directions, &mut verdict);
    }
    verdict.finish(observed, "TracePhoton", &steps, told)
}

fn judge_frames(directions: &Directions, verdict: &mut SectionVerdict) {
    let sampling_is_finite = directions.floor.iter().all(|ray| ray.direction.is_finite());
    let sampling_spreads = directions.sines.iter().any(|sine| *sine > 1e-6);
    let mut frames: Vec<(Vec3, Option<FrameForm>)> = Vec::new();
    for (normal, rays) in directions.walls.iter().filter(|(_, rays)| rays.len() >= FEWEST) {
        let total = rays.len();
        let is_along_x = normal.x.abs() > 0.999;
        let not_finite = rays.iter().filter(|ray| !ray.direction.is_finite()).count();
        if not_finite > 0 {
            if sampling_is_finite {
                let found = format!(
                    "{not_finite} of {total} directions are not finite numbers where the normal \
                     is {}",
                    short(*normal)
                );
                let (name, advice) = if is_along_x {
                    (Some("nan-frame"), NAN_WALL)
                } else {
                    (None, "Look for a vector of length 0 that is normalized.")
                };
                verdict.fault(name, found, advice);
                return;
            }
            continue;
        }
        let along = rays
            .iter()
            .filter(|ray| ray.direction.normalize_or_zero().dot(*normal).abs() > 0.999_999)
            .count();
        let all_but_few = along as f64 > 0.95 * total as f64;
        if sampling_spreads && all_but_few {
            let found = format!(
                "{along} of {total} photons leave along the normal where it is {}: t and b have no \
                 length",
                short(*normal)
            );
            let name = is_along_x.then_some("no-absolute-value");
            let advice = if normal.x < -0.999 { WALL } else { PARALLEL };
            verdict.fault(name, found, advice);
            return;
        }
        if sampling_spreads {
            frames.push((*normal, directions.frame_of(*normal, rays)));
        }
    }
    let unfair: Vec<_> = frames
        .iter()
        .filter(|(_, frame)| !frame.is_some_and(FrameForm::is_fair))
        .copied()
        .collect();
    if unfair.is_empty() {
        judge_fair(&frames, verdict);
        return;
    }
    let most = [
        FrameForm::Flipped,
        FrameForm::Transposed,
        FrameForm::None,
        FrameForm::OtherOrder,
        FrameForm::HalfAsWritten,
    ]
    .into_iter()
    .max_by_key(|frame| unfair.iter().filter(|(_, other)| *other == Some(*frame)).count());
    // A permuted frame may be the identity over some walls, but not over all.
    let is_unfair = |normal: &Vec3| unfair.iter().any(|(other, _)| other == normal);
    let mut of_unfair = directions.walls.iter().filter(|(normal, _)| is_unfair(normal));
    let is_identity = of_unfair.all(|(_, rays)| directions.fits(rays, Mat3::IDENTITY));
    let most = if is_identity { Some(FrameForm::None) } else { most };
    let most = most.filter(|frame| {
        let those = unfair.iter().filter(|(_, other)| *other == Some(*frame)).count();
        is_identity || 2 * those > unfair.len()
    });
    let (normal, rays) = directions
        .walls
        .iter()
        .find(|(normal, _)| *normal == unfair[0].0)
        .expect("it is one of the walls");
    let seen = seen(*normal, rays);
    let (name, what, advice) = match most {
        Some(FrameForm::Flipped) => (
            Some("flipped-normal"),
            "photons leave below the surface they hit",
            "Use the normal of state.ComputeNormal() as it is, in the matrix's third column; z in \
             equation (6) is never negative.",
        ),
        Some(FrameForm::Transposed) => (
            Some("transposed-frame"),
            "t, b and n are the rows of the matrix, not its columns",
            COLUMNS,
        ),
        Some(FrameForm::None) => (
            Some("not-transformed"),
            "directions are those of tangent space, whatever the normal",
            "Multiply the matrix of t, b and n by the sampled direction before you trace the ray.",
        ),
        Some(FrameForm::HalfAsWritten) => (
            Some("half-normalised"),
            "b is normalized, and t is not",
            "Normalize both t and b, or neither: one of them alone squeezes directions to one \
             side.",
        ),
        Some(FrameForm::OtherOrder) => {
            (Some("permuted-frame"), "the normal is not the third column of the matrix", COLUMNS)
        }
        _ => (None, "directions are not those of the hemisphere around the normal", FRAME),
    };
    verdict.fault(name, format!("{what}: {seen}"), advice);
}

const NAN_WALL: &str = "The wall's normal is (-1, 0, 0), so its dot product with (1, 0, 0) is -1, \
                        t is (0, 0, 0), and normalizing it gives NaN: compare the absolute value \
                        with your threshold.";
const PARALLEL: &str = "Where the normal is close to parallel with (1, 0, 0), take another vector, \
                        such as (0, 1, 0), in equation (7).";
const FRAME: &str = "t = n x (1, 0, 0) and b = n x t, equations (7) and (8); the matrix with the \
                     columns t, b and n turns the sample into world space.";

/// The mean direction over a wall, and how many go below it.
fn seen(normal: Vec3, rays: &[Scattered]) -> String {
    let finite = || rays.iter().map(|ray| ray.direction.normalize_or_zero());
    let mean = finite().sum::<Vec3>() / rays.len() as f32;
    let below = finite().filter(|direction| direction.dot(normal) < 0.0).count();
    let due = normal * (2.0 / 3.0);
    format!(
        "where the normal is {}, the mean direction is {}; expected about {}; {below} of {} go \
         below the surface",
        short(normal),
        short(mean),
        short(due),
        rays.len()
    )
}

fn short(v: Vec3) -> String {
    format!("({:.2}, {:.2}, {:.2})", v.x, v.y, v.z)
}

fn judge_fair(frames: &[(Vec3, Option<FrameForm>)], verdict: &mut SectionVerdict) {
    let has = |frame: FrameForm| frames.iter().any(|(_, other)| *other == Some(frame));
    if has(FrameForm::AsWritten) {
        verdict
            .readings
            .push("t and b as equations (7) and (8) have them, not normalized".to_owned());
    }
}

/// Where scattered rays start, and whether they meet the surface they leave.
fn judge_start(directions: &Directions, verdict: &mut SectionVerdict) {
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
