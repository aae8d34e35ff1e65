//! Hemisphere Ray Transformation: directions over walls.

use glam::{Mat3, Vec3};

use super::SectionVerdict;
use super::directions::{Directions, FEWEST, FrameForm, Scattered};
use super::start::judge_start;
use crate::plan::{PlanStep, wall_normals};
use crate::run::Observed;
use variants::section::Section;

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

pub(super) fn short(v: Vec3) -> String {
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
