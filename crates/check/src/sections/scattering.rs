//! Photon Scattering/Absorption: the roulette.

use glam::Vec3;

use super::{SectionVerdict, judge_seeds};
use crate::events::Call;
use crate::plan::{COLORS, PlanStep, SCATTERING};
use crate::run::Observed;
use crate::statistics::{SIGMAS, may_happen};
use variants::section::Section;

const MAXIMUM: &str = "Equation (1): P_r = max(d_r, d_g, d_b).";
const ROULETTE: &str = "Scatter only if a new random number in [0, 1) is less than P_r, which \
                        equation (1) takes from the material that was hit; do nothing otherwise.";

/// A rule for the chance to scatter.
struct Rule {
    name: &'static str,
    what: &'static str,
    advice: &'static str,
    chance: fn(Vec3) -> f32,
}

const RULES: [Rule; 15] = [
    Rule {
        name: "no-roulette",
        what: "every photon scatters, whatever the material",
        advice: ROULETTE,
        chance: |_| 1.0,
    },
    Rule {
        name: "no-roulette",
        what: "every photon scatters, unless the material is black",
        advice: "Dividing two integers, rand() / RAND_MAX, gives 0, which is always less than P_r: \
                 make one of them a float first.",
        chance: |d| f32::from(u8::from(d.max_element() > 0.0)),
    },
    Rule {
        name: "mean-roulette",
        what: "P_r is the mean of the diffuse response, not its maximum",
        advice: MAXIMUM,
        chance: |d| d.element_sum() / 3.0,
    },
    Rule {
        name: "red-roulette",
        what: "P_r is the red of the diffuse response alone, not its maximum",
        advice: MAXIMUM,
        chance: |d| d.x,
    },
    Rule {
        name: "green-roulette",
        what: "P_r is the green of the diffuse response alone, not its maximum",
        advice: MAXIMUM,
        chance: |d| d.y,
    },
    Rule {
        name: "blue-roulette",
        what: "P_r is the blue of the diffuse response alone, not its maximum",
        advice: MAXIMUM,
        chance: |d| d.z,
    },
    Rule {
        name: "smallest-roulette",
        what: "P_r is the smallest channel of the diffuse response, not the largest",
        advice: MAXIMUM,
        chance: |d| d.min_element(),
    },
    Rule {
        name: "luminance-roulette",
        what: "P_r is the luminance of the diffuse response, not its maximum",
        advice: MAXIMUM,
        chance: |d| d.dot(Vec3::new(0.2126, 0.7152, 0.0722)),
    },
    Rule {
        name: "luminance-roulette",
        what: "P_r is the luma of the diffuse response, not its maximum",
        advice: MAXIMUM,
        chance: |d| d.dot(Vec3::new(0.299, 0.587, 0.114)),
    },
    Rule {
        name: "inverted-roulette",
        what: "photons scatter where the number is above P_r, and are absorbed below it",
        advice: "Turn the comparison around: scatter if the number is less than P_r.",
        chance: |d| 1.0 - d.max_element(),
    },
    Rule {
        name: "squared-roulette",
        what: "photons scatter with the square of P_r: two numbers must be below it, or P_r is \
               multiplied twice",
        advice: ROULETTE,
        chance: |d| d.max_element() * d.max_element(),
    },
    Rule {
        name: "sum-roulette",
        what: "P_r is the sum of the diffuse response's channels, not its maximum",
        advice: MAXIMUM,
        chance: |d| d.element_sum(),
    },
    Rule {
        name: "length-roulette",
        what: "P_r is the length of the diffuse response, not its maximum",
        advice: MAXIMUM,
        chance: |d| d.length(),
    },
    Rule {
        name: "roulette-by-channel",
        what: "every channel of the diffuse response has a random number of its own",
        advice: "Draw one number, and compare it with the largest channel.",
        chance: |d| 1.0 - (1.0 - d).element_product(),
    },
    Rule {
        name: "signed-roulette",
        what: "the number for the roulette lies in [-1, 1), not in [0, 1)",
        advice: "Do not scale the roulette's number as you do x, y and z.",
        chance: |d| 0.5 + 0.5 * d.max_element(),
    },
];

pub(super) fn judge(observed: &Observed, told: &mut Vec<String>) -> SectionVerdict {
    let mut verdict = SectionVerdict::new(Section::PhotonScatteringAbsorption);
    let calls = |step| observed.calls(step);
    // What happens at the first hit, by the wall's color.
    let walls: Vec<_> = [
        (PlanStep::Black, Vec3::ZERO),
        (PlanStep::White, Vec3::ONE),
        (PlanStep::Color(0), COLORS[0]),
        (PlanStep::Color(1), COLORS[1]),
        (PlanStep::Color(2), COLORS[2]),
        (PlanStep::Color(3), COLORS[3]),
        (PlanStep::Floor, Vec3::splat(0.5)),
    ]
    .into_iter()
    .map(|(step, color)| (color, counts(calls(step), 1)))
    .collect();
    // On a black wall, nothing is to scatter.
    let bright = walls.iter().filter(|(color, _)| *color != Vec3::ZERO);
    let tried: usize = bright.map(|(_, [total, _])| total).sum();
    let scattered: usize = walls.iter().map(|(_, [_, count])| count).sum();
    if tried == 0 {
        if SCATTERING.iter().all(|step| observed.death(*step).is_none()) {
            verdict.not_reached("no photon hit anything: TracePhoton does not call Trace");
        }
    } else if scattered == 0 {
        let found = format!("no photon scatters, of {tried} that hit walls with P_r from 0.3 to 1");
        let advice = "Draw a random number in [0, 1); if it is less than P_r, call TracePhoton \
                      with the new ray.";
        verdict.fault(Some("never-scatters"), found, advice);
    } else {
        let in_cube = calls(PlanStep::GrayCube);
        if judge_rule(&walls, &mut verdict) {
            judge_later(in_cube, &mut verdict);
        } else if is_right_in_cube(in_cube, 2) && !is_right_in_cube(in_cube, 1) {
            let found = "this is so at the first hit of a path alone: later, the roulette is right";
            verdict.remarks.push(found.to_owned());
        }
        judge_threshold(observed, &mut verdict);
    }
    judge_seeds(observed, &mut verdict);
    verdict.finish(observed, "TracePhoton", &SCATTERING, told)
}

/// Of the calls with a hit number `hit`, from 1: how many there are, and how many scatter there.
fn counts(calls: &[Call], hit: usize) -> [usize; 2] {
    let with_hit = || calls.iter().filter(|call| call.hits().count() >= hit);
    [with_hit().count(), with_hit().filter(|call| call.rays() > hit).count()]
}

/// Whether there are enough calls with a hit number `hit` in the closed cube with P_r = 0.5, and
/// the right part scatters there. So it does under a wrong rule with the same chance for this gray.
fn is_right_in_cube(calls: &[Call], hit: usize) -> bool {
    let [total, count] = counts(calls, hit);
    total >= 100 && may_happen(count, total, 0.5)
}

fn judge_rule(walls: &[(Vec3, [usize; 2])], verdict: &mut SectionVerdict) -> bool {
    let fits = |chance: &dyn Fn(Vec3) -> f32| {
        walls
            .iter()
            .all(|(color, [total, count])| may_happen(*count, *total, f64::from(chance(*color))))
    };
    if fits(&|color| color.max_element()) {
        return true;
    }
    let known = RULES.iter().find(|rule| fits(&rule.chance));
    let colored = || walls.iter().filter(|(_, [total, _])| *total > 0);
    let seen: Vec<_> = colored()
        .map(|(d, [total, count])| {
            let part = *count as f64 / *total as f64;
            format!("{part:.3} where d = ({}, {}, {})", d.x, d.y, d.z)
        })
        .collect();
    let shown = match seen.as_slice() {
        [black, white, ..] if seen.len() > 2 && known.is_none() => {
            format!("{black}, {white}, {}", seen[2..].join(", "))
        }
        _ => seen.get(2..).unwrap_or(&seen).join(", "),
    };
    let (name, what, advice) = match known {
        Some(rule) => (Some(rule.name), rule.what, rule.advice),
        None => match constant(walls) {
            true => (
                Some("no-roulette"),
                "photons scatter with the same chance on every material",
                ROULETTE,
            ),
            false => (None, "photons do not scatter with the chance P_r", ROULETTE),
        },
    };
    verdict.fault(name, format!("{what}: the part that scatters is {shown}"), advice);
    false
}

/// Whether every material has the same chance.
fn constant(walls: &[(Vec3, [usize; 2])]) -> bool {
    let total: usize = walls.iter().map(|(_, [total, _])| total).sum();
    let count: usize = walls.iter().map(|(_, [_, count])| count).sum();
    let chance = count as f64 / total as f64;
    // Where hardly any scatters, all chances look alike.
    chance > 0.05 && walls.iter().all(|(_, [total, count])| may_happen(*count, *total, chance))
}

/// The roulette of later hits, in a closed cube with P_r = 0.5.
fn judge_later(calls: &[Call], verdict: &mut SectionVerdict) {
    for hit in 1..=6 {
        let [total, count] = counts(calls, hit);
        if total < 20 || may_happen(count, total, 0.5) {
            continue;
        }
        if hit > 1 && count == 0 {
            // The path ends here, whatever the roulette says: that is a matter of Photon Storage.
            return;
        }
        let found = format!(
            "at hit number {hit} of a path, {count} of {total} photons scatter where P_r = 0.5; at \
             the first hit the part is right"
        );
        let advice = "Let the same roulette decide at every hit, with a new random number.";
        verdict.fault(Some("late-roulette"), found, advice);
        return;
    }
    // The part that scatters at the second hit, where the first direction was near the normal, and
    // elsewhere.
    let mut parts = [[0_usize; 2]; 2];
    for call in calls.iter().filter(|call| call.hits().count() >= 2) {
        let first = call.hits().next().expect("there are two");
        let Some(second) = call.traces.iter().filter(|trace| trace.has_state).nth(1) else {
            continue;
        };
        // Two triangles a side, two sides an axis, three axes a cube.
        let normal = Vec3::AXES[usize::from(first.triangle) / 4 % 3];
        let cosine = second.direction.normalize().dot(normal);
        let part = &mut parts[usize::from(cosine * cosine > 0.5)];
        part[0] += 1;
        part[1] += usize::from(call.rays() > 2);
    }
    let [far, near] =
        parts.map(|[total, count]| (total as f64, count as f64 / total.max(1) as f64));
    let sigma = (0.25 / far.0.max(1.0) + 0.25 / near.0.max(1.0)).sqrt();
    if far.0 > 50.0 && near.0 > 50.0 && (far.1 - near.1).abs() > SIGMAS * sigma {
        let found = format!(
            "whether a photon scatters depends on its last direction: {:.0} % of those near the \
             normal do, and {:.0} % of the others",
            100.0 * near.1,
            100.0 * far.1
        );
        let advice = "Draw a new random number for every roulette; hand a generator by reference, \
                      not by value.";
        verdict.fault(Some("numbers-again"), found, advice);
    }
}

fn judge_threshold(observed: &Observed, verdict: &mut SectionVerdict) {
    let scatters = |more: i32| {
        let call = observed.step(PlanStep::Threshold(more))?.calls.first()?;
        (call.drawn > 0).then(|| call.rays() > 1)
    };
    let [below, at, above] = [-1024, 0, 1024].map(scatters);
    if below == Some(true) && above == Some(false) && at == Some(true) {
        verdict.readings.push("a number equal to P_r scatters, too".to_owned());
    }
}
