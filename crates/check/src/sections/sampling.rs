//! Hemisphere Sampling: the directions over a floor, where the frame changes nothing.

use super::directions::{Directions, FEWEST, FrameForm, Scattered};
use super::{SectionVerdict, around, turns};
use crate::plan::PlanStep;
use crate::run::Observed;
use crate::statistics::{are_alike, is_uniform, mean};
use variants::section::Section;

/// A law of the angle to the normal: u1 gives the square of its sine.
#[derive(Debug)]
pub struct AngleLaw {
    name: &'static str,
    what: &'static str,
    advice: &'static str,
    squared_sine: fn(f64) -> f64,
}

impl AngleLaw {
    /// A sample of the squared sine to the normal, as even as can be.
    pub fn squared_sines(&self) -> Vec<f64> {
        let u = (0..20_000).map(|i| (f64::from(i) + 0.5) / 20_000.0);
        u.map(self.squared_sine).collect()
    }
}

const HEIGHT: &str = "Equation (6) has z = sqrt(1 - u1).";

/// The laws of known misreadings.
pub static LAWS: [AngleLaw; 12] = [
    AngleLaw {
        name: "uniform-hemisphere",
        what: "directions are uniform over the hemisphere, not in proportion to the cosine",
        advice: "Take r = sqrt(u1) and z = sqrt(1 - u1), equations (2) and (6): that is a point of \
                 the disk, lifted to the hemisphere.",
        squared_sine: |u| 1.0 - u * u,
    },
    AngleLaw {
        name: "no-square-root",
        what: "r is u1, not its square root",
        advice: "Equation (2) has r = sqrt(u1).",
        squared_sine: |u| u * u / (u * u + 1.0 - u),
    },
    AngleLaw {
        name: "no-square-root",
        what: "r is u1, not its square root, and z the root of 1 - r^2",
        advice: "Equation (2) has r = sqrt(u1).",
        squared_sine: |u| u * u,
    },
    AngleLaw {
        name: "no-square-root-of-height",
        what: "z is 1 - u1, not its square root",
        advice: HEIGHT,
        squared_sine: |u| u / (u + (1.0 - u) * (1.0 - u)),
    },
    AngleLaw {
        name: "other-height",
        what: "z is the root of 1 - r, where r is the root of u1",
        advice: HEIGHT,
        squared_sine: |u| u / (u + 1.0 - u.sqrt()),
    },
    AngleLaw {
        name: "other-height",
        what: "z is the root of 1 - u1^2",
        advice: HEIGHT,
        squared_sine: |u| u / (u + 1.0 - u * u),
    },
    AngleLaw {
        name: "other-height",
        what: "z is 1 - r, where r is the root of u1",
        advice: HEIGHT,
        squared_sine: |u| u / (u + (1.0 - u.sqrt()).powi(2)),
    },
    AngleLaw {
        name: "other-height",
        what: "z is always 1",
        advice: HEIGHT,
        squared_sine: |u| u / (u + 1.0),
    },
    AngleLaw {
        name: "no-roots",
        what: "r is u1 and z is 1 - u1, without the square roots",
        advice: "Equations (2) and (6) have r = sqrt(u1) and z = sqrt(1 - u1).",
        squared_sine: |u| u * u / (u * u + (1.0 - u) * (1.0 - u)),
    },
    AngleLaw {
        name: "linear-angle",
        what: "the angle to the normal is even, as in theta = pi / 2 u1",
        advice: "Take r = sqrt(u1) and z = sqrt(1 - u1), equations (2) and (6).",
        squared_sine: |u| libm::sin(std::f64::consts::FRAC_PI_2 * u).powi(2),
    },
    AngleLaw {
        name: "normal-and-ball",
        what: "directions crowd around the normal, as those of n plus a point of the ball do",
        advice: "Take r = sqrt(u1) and z = sqrt(1 - u1), equations (2) and (6).",
        squared_sine: |u| 1.0 - u.sqrt(),
    },
    AngleLaw {
        name: "roulette-number-again",
        what: "u1 is always below P_r = 0.5: it is the roulette's number, used again",
        advice: "Draw new random numbers for u1 and u2 after the roulette.",
        squared_sine: |u| 0.5 * u,
    },
];

const AZIMUTH: &str = "Equation (3): theta = 2 pi u2 in radians, and u2 is in [0, 1).";
const NEW_NUMBERS: &str = "Draw two random numbers in [0, 1), u1 and u2, for every direction.";

pub(super) fn judge(
    observed: &Observed,
    directions: &Directions,
    told: &mut Vec<String>,
) -> SectionVerdict {
    let mut verdict = SectionVerdict::new(Section::HemisphereSampling);
    let total = directions.floor.len();
    if total < FEWEST {
        if observed.death(PlanStep::Floor).is_none() {
            verdict.not_reached(format!(
                "only {total} photons scatter from a floor with P_r = 0.5, so no direction can be \
                 judged"
            ));
        }
        return verdict.finish(observed, "TracePhoton", &[PlanStep::Floor], told);
    }
    if directions.are_old {
        verdict.not_reached("the ray with the new direction is never traced");
        return verdict;
    }
    let not_finite = directions.floor.iter().filter(|ray| !ray.direction.is_finite()).count();
    if not_finite > 0 {
        let found =
            format!("{not_finite} of {total} directions over a floor are not finite numbers");
        let advice = "sqrt of a negative number is NaN: u1 must lie in [0, 1).";
        verdict.fault(Some("not-finite"), found, advice);
    } else if directions.frame_of_floor.is_none() {
        if !judge_angles(directions, &mut verdict) {
            judge_around(observed, directions, &mut verdict);
        }
    } else {
        if let Some(law) = directions.law {
            law_fault(law, directions, &mut verdict);
        }
        let is_paired = judge_pairs(directions, &mut verdict);
        if !judge_turns(directions, &mut verdict) && !is_paired {
            judge_around(observed, directions, &mut verdict);
        }
    }
    verdict.finish(observed, "TracePhoton", &[PlanStep::Floor], told)
}

/// The angles to the normal, and around it, of directions that do not follow the cosine; whether
/// there is a fault around it, or in all.
fn judge_angles(directions: &Directions, verdict: &mut SectionVerdict) -> bool {
    let rays = &directions.floor;
    let total = rays.len();
    let below = rays.iter().filter(|ray| ray.direction.z < 0.0).count();
    let sines = &directions.sines;
    if sines.iter().all(|sine| *sine < 1e-6) {
        let found = format!("all {total} directions go along the normal");
        let advice = "x and y are always 0: look at r and u1. Dividing two integers, \
                      rand() / RAND_MAX, gives 0.";
        verdict.fault(Some("along-normal"), found, advice);
        return true;
    }
    let always = |expected: &dyn Fn(&Scattered) -> glam::Vec3| {
        rays.iter().all(|ray| ray.direction.normalize_or_zero().abs_diff_eq(expected(ray), 1e-3))
    };
    if always(&|ray| ray.incoming.reflect(glam::Vec3::Z)) {
        let found = "all photons are reflected as by a mirror".to_owned();
        verdict.fault(None, found, NEW_NUMBERS);
        return true;
    }
    if always(&|ray| ray.incoming) {
        let found = "all photons go on in the direction in which they came".to_owned();
        verdict.fault(None, found, NEW_NUMBERS);
        return true;
    }
    let first = rays[0].direction.normalize_or_zero();
    if always(&|_| first) {
        let found = format!("all {total} directions over a floor are the same");
        verdict.fault(Some("same-direction"), found, NEW_NUMBERS);
        return true;
    }
    if below > 0 && below < total {
        let found = format!("{below} of {total} directions go below the floor; expected none");
        verdict.fault(
            Some("below-surface"),
            found,
            "z = sqrt(1 - u1) is never negative, equation (6).",
        );
        return true;
    }
    let law = LAWS.iter().find(|law| are_alike(sines, &law.squared_sines()));
    let cosine = mean_cosine(directions);
    if let Some(law) = law {
        law_fault(law, directions, verdict);
    } else if sines.iter().all(|sine| (sine - sines[0]).abs() < 1e-4) {
        let found =
            format!("all directions have the same angle to the normal, of cosine {cosine:.3}");
        verdict.fault(None, found, NEW_NUMBERS);
    } else if !is_uniform(sines) {
        let found =
            format!("directions do not follow the cosine: its mean is {cosine:.3}; expected 0.667");
        let advice = "Equations (2) to (6), with u1 and u2 drawn anew: r = sqrt(u1), \
                      theta = 2 pi u2, x = r cos(theta), y = r sin(theta), z = sqrt(1 - u1).";
        verdict.fault(None, found, advice);
    }
    let has_fault_around = judge_turns(directions, verdict);
    // Where neither angle follows, one sentence is enough.
    if !has_fault_around && !directions.is_even_around && (law.is_some() || is_uniform(sines)) {
        let (x, y): (Vec<_>, Vec<_>) =
            rays.iter().map(|ray| (f64::from(ray.direction.x), f64::from(ray.direction.y))).unzip();
        let found = format!(
            "directions are not even around the normal: the means of x and y are {:.3} and {:.3}, \
             expected 0",
            mean(&x),
            mean(&y)
        );
        verdict.fault(Some("not-even-around"), found, AZIMUTH);
    }
    has_fault_around || !directions.is_even_around
}

/// How theta follows from its random number, if that is known; whether there is a fault.
fn judge_turns(directions: &Directions, verdict: &mut SectionVerdict) -> bool {
    let calls = directions.floor.iter().map(|ray| ray.call);
    let angles: Vec<_> = calls.zip(directions.around.iter().copied()).collect();
    let Some(turns) = turns::turns(&angles) else { return false };
    if let Some((name, found)) = turns::fault(turns, "theta") {
        verdict.fault(Some(name), found, AZIMUTH);
        return true;
    }
    verdict.remarks.extend(turns::remark(turns, "theta"));
    false
}

/// What only millions of directions show.
fn judge_around(observed: &Observed, directions: &Directions, verdict: &mut SectionVerdict) {
    // In other frames, the angle around the floor's normal is not theta.
    let is_theta =
        !matches!(directions.frame_of_floor, Some(form) if form == FrameForm::OtherOrder);
    let log = observed.step(PlanStep::Around).filter(|_| is_theta);
    let Some(counts) = log.and_then(|log| log.around.last()) else { return };
    if let Some(found) = around::degrees(counts, "theta") {
        verdict.fault(Some("angle-in-degrees"), found, AZIMUTH);
    } else if let (true, Some(part)) = (verdict.faults.is_empty(), around::unevenness(counts)) {
        let total: u64 = counts.iter().copied().map(u64::from).sum();
        let found = format!(
            "{total} directions are not even around the normal: an arc of the circle has {:.2} % \
             of them more than its share",
            100.0 * part
        );
        verdict.fault(Some("not-even-around"), found, AZIMUTH);
    }
}

fn law_fault(law: &AngleLaw, directions: &Directions, verdict: &mut SectionVerdict) {
    let cosine = mean_cosine(directions);
    let found =
        format!("{}: the mean cosine to the normal is {cosine:.3}; expected 0.667", law.what);
    verdict.fault(Some(law.name), found, law.advice);
}

fn mean_cosine(directions: &Directions) -> f64 {
    let cosines: Vec<_> =
        directions.sines.iter().map(|sine| (1.0 - sine).max(0.0).sqrt()).collect();
    mean(&cosines)
}

/// Whether the angle to the normal and that around it depend on each other.
fn judge_pairs(directions: &Directions, verdict: &mut SectionVerdict) -> bool {
    let mut of_all: Vec<_> = directions.sines.iter().zip(&directions.around).collect();
    of_all.sort_unstable_by(|a, b| a.0.total_cmp(b.0));
    let (near, far) = of_all.split_at(of_all.len() / 2);
    let [near, far] =
        [near, far].map(|half| half.iter().map(|(_, angle)| **angle).collect::<Vec<_>>());
    let is_paired = !are_alike(&near, &far);
    if is_paired {
        let found = "the angle around the normal depends on the angle to it".to_owned();
        verdict.fault(Some("one-number"), found, NEW_NUMBERS);
    }
    is_paired
}
