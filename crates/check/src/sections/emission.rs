//! Photon Emission: `GenerateRandomPhotonRay`.

use glam::Vec3;
use photon_mapping::random::photon_random;

use super::{SectionVerdict, around, judge_seeds, turns};
use crate::events::Call;
use crate::plan::{LIGHT, PlanStep, SECOND_TRY, first_try};
use crate::run::Observed;
use crate::statistics::{are_alike, mean};
use variants::section::Section;

/// So many directions of every law are drawn, to hold the submission's against.
const DRAWN: u64 = 20_000;

const REJECT: &str = "Draw x, y and z again while x^2 + y^2 + z^2 > 1, before you normalize.";

/// A law that directions may follow: its name, if it is a known misreading, what it is, and one
/// draw of it.
struct EmissionLaw {
    name: &'static str,
    what: &'static str,
    advice: &'static str,
    draw: fn(&mut dyn FnMut() -> f32) -> Vec3,
}

fn cube(rand: &mut dyn FnMut() -> f32) -> Vec3 {
    let x = 2.0 * rand() - 1.0;
    let y = 2.0 * rand() - 1.0;
    Vec3::new(x, y, 2.0 * rand() - 1.0)
}

fn ball(rand: &mut dyn FnMut() -> f32) -> Vec3 {
    loop {
        let point = cube(rand);
        if point.length_squared() <= 1.0 && point != Vec3::ZERO {
            return point;
        }
    }
}

fn outside(rand: &mut dyn FnMut() -> f32) -> Vec3 {
    loop {
        let point = cube(rand);
        if point.length_squared() > 1.0 {
            return point;
        }
    }
}

fn angles(rand: &mut dyn FnMut() -> f32) -> Vec3 {
    let (theta, phi) = (std::f32::consts::PI * rand(), std::f32::consts::TAU * rand());
    let sine = libm::sinf(theta);
    Vec3::new(sine * libm::cosf(phi), sine * libm::sinf(phi), libm::cosf(theta))
}

const LAWS: [EmissionLaw; 5] = [
    EmissionLaw {
        name: "cube-directions",
        what: "directions come from the whole cube, not from the sphere: there are too many \
               towards its corners",
        advice: REJECT,
        draw: cube,
    },
    EmissionLaw {
        name: "octant-directions",
        what: "x, y and z are never negative: all photons go into one eighth of the sphere",
        advice: "Scale the random number from [0, 1) to [-1, 1): 2 * u - 1.",
        draw: |rand| ball(rand).abs(),
    },
    EmissionLaw {
        name: "octant-directions",
        what: "x, y and z are never negative, and come from the whole cube",
        advice: "Scale the random number from [0, 1) to [-1, 1): 2 * u - 1; and draw again while \
                 x^2 + y^2 + z^2 > 1.",
        draw: |rand| cube(rand).abs(),
    },
    EmissionLaw {
        name: "rejection-reversed",
        what: "points inside the sphere are drawn again, and those outside are kept",
        advice: "Turn the loop's condition around: draw again while x^2 + y^2 + z^2 > 1.",
        draw: outside,
    },
    EmissionLaw {
        name: "polar-directions",
        what: "theta = pi u1 and phi = 2 pi u2 crowd the directions around the poles",
        advice: "Use the handout's loop over x, y and z.",
        draw: angles,
    },
];

pub(super) fn judge(observed: &Observed, told: &mut Vec<String>) -> SectionVerdict {
    let mut verdict = SectionVerdict::new(Section::PhotonEmission);
    let steps = [PlanStep::Emit, PlanStep::EmitCorner, PlanStep::EmitOnSphere, PlanStep::EmitZero];
    let function = "GenerateRandomPhotonRay";
    let log = observed.step(PlanStep::Emit);
    let calls = log.map_or([].as_slice(), |log| log.calls.as_slice());
    // Only the last call may have emitted nothing, so that a ray's place is its call's number.
    let rays: Vec<_> = calls.iter().map_while(|call| call.emitted).collect();
    if rays.is_empty() {
        if steps.iter().all(|step| observed.death(*step).is_none()) {
            verdict.not_reached("GenerateRandomPhotonRay was not called");
        }
        return verdict.finish(observed, function, &steps, told);
    }
    judge_start(&rays, &mut verdict);
    let directions: Vec<_> = rays.iter().map(|ray| ray[1]).collect();
    if judge_lengths(&directions, &mut verdict) {
        judge_law(observed, &directions, &mut verdict);
    }
    if verdict.faults.is_empty() {
        judge_scripted(observed, &mut verdict);
    }
    judge_seeds(observed, &mut verdict);
    verdict.finish(observed, function, &steps, told)
}

fn judge_start(rays: &[[Vec3; 2]], verdict: &mut SectionVerdict) {
    let elsewhere = rays.iter().filter(|ray| !ray[0].abs_diff_eq(LIGHT, 1e-2)).count();
    let first = rays.iter().find(|ray| !ray[0].abs_diff_eq(LIGHT, 1e-2));
    if let Some([from, _]) = first {
        let found = format!(
            "{elsewhere} of {} rays do not start at the light: the light is at {}, the first of \
             them starts at {}",
            rays.len(),
            vector(LIGHT),
            vector(*from)
        );
        verdict.fault(None, found, "Call ray.SetRayPosition with the light's GetPosition().");
    }
}

/// Whether the directions can be judged any further.
fn judge_lengths(directions: &[Vec3], verdict: &mut SectionVerdict) -> bool {
    let total = directions.len();
    let not_finite = directions.iter().filter(|direction| !direction.is_finite()).count();
    if not_finite > 0 {
        let found = format!("{not_finite} of {total} directions are not finite numbers");
        verdict.fault(
            None,
            found,
            "Look for a division by zero, or the root of a negative number.",
        );
        return false;
    }
    let first = directions[0];
    if directions.iter().all(|direction| direction.abs_diff_eq(first, 1e-6)) {
        let found = format!("all {total} directions are the same, {}", vector(first));
        let advice = "Call ray.SetRayDirection with random numbers drawn anew in every call; \
                      dividing two integers, rand() / RAND_MAX, gives 0.";
        verdict.fault(Some("same-direction"), found, advice);
        return false;
    }
    let zero = directions.iter().filter(|direction| direction.length() < 1e-6).count();
    if zero > 0 {
        let found = format!("{zero} of {total} directions have no length");
        verdict.fault(None, found, "Dividing two integers, rand() / RAND_MAX, gives 0.");
        return false;
    }
    let lengths: Vec<_> =
        directions.iter().map(|direction| f64::from(direction.length())).collect();
    let other = lengths.iter().filter(|length| (*length - 1.0).abs() > 1e-3).count();
    if other > 0 {
        let [least, most] = [f64::min, f64::max]
            .map(|pick| lengths.iter().copied().reduce(pick).unwrap_or_default());
        let found = format!(
            "{other} of {total} directions are not unit vectors: their lengths go from {least:.2} \
             to {most:.2}"
        );
        let advice = "Normalize the vector before you hand it to SetRayDirection, which does not.";
        verdict.fault(Some("not-normalised"), found, advice);
    }
    true
}

fn judge_law(observed: &Observed, directions: &[Vec3], verdict: &mut SectionVerdict) {
    let found = features(directions.iter().map(|direction| direction.normalize()));
    if fits(&found, ball) {
        let around =
            directions.iter().map(|v| f64::from(libm::atan2f(v.y, v.x)) / std::f64::consts::TAU);
        let turns = turns::turns(&(0..).zip(around).collect::<Vec<_>>());
        let counted = observed.step(PlanStep::AroundLight).map_or([].as_slice(), |log| &log.around);
        let found = match turns {
            Some(turns) => turns::fault(turns, "phi"),
            None => counted
                .iter()
                .find_map(|counts| Some(("angle-in-degrees", around::degrees(counts, "phi")?))),
        };
        if let Some((name, found)) = found {
            verdict.fault(Some(name), found, "Use the handout's loop over x, y and z.");
        }
        return;
    }
    if let Some(law) = LAWS.iter().find(|law| fits(&found, law.draw)) {
        verdict.fault(Some(law.name), law.what.to_owned(), law.advice);
        return;
    }
    let [x, y, z] = [0, 1, 2].map(|axis| mean(&found[axis]));
    let pairs = [("x and y", 0, 1), ("y and z", 1, 2), ("x and z", 0, 2)];
    let same = |(_, a, b): &&(&str, usize, usize)| directions.iter().all(|v| v[*a] == v[*b]);
    if let Some((names, ..)) = pairs.iter().find(same) {
        let found = format!("{names} are the same in all {} directions", directions.len());
        verdict.fault(None, found, "Draw a random number for each of x, y and z.");
        return;
    }
    let above = directions.iter().filter(|direction| direction.z > 0.0).count();
    let mean = Vec3::new(x as f32, y as f32, z as f32);
    let aims = mean.length() > 0.3 && mean.normalize().dot(-LIGHT.normalize()) > 0.999;
    let is_half = above == 0 || above == directions.len();
    let found = format!(
        "directions are not even over the sphere: their mean is ({x:.3}, {y:.3}, {z:.3}), where \
         (0, 0, 0) is expected, and {above} of {} go up{}",
        directions.len(),
        if aims { "; they go from the light toward the point (0, 0, 0) of the scene" } else { "" }
    );
    verdict.fault(
        is_half.then_some("half-directions"),
        found,
        "Draw x, y and z one by one in [-1, 1), and again while x^2 + y^2 + z^2 > 1.",
    );
}

/// Numbers of every direction in which laws differ.
fn features(directions: impl Iterator<Item = Vec3>) -> Vec<Vec<f64>> {
    let mut features = vec![Vec::new(); 7];
    for v in directions {
        let of_one = [v.x, v.y, v.z, v.abs().max_element(), v.x * v.y, v.y * v.z, v.z * v.x];
        for (feature, number) in features.iter_mut().zip(of_one) {
            feature.push(f64::from(number));
        }
    }
    features
}

fn fits(found: &[Vec<f64>], law: fn(&mut dyn FnMut() -> f32) -> Vec3) -> bool {
    let mut rand = photon_random(1, 0);
    let drawn = features((0..DRAWN).map(|_| law(&mut rand).normalize()));
    found.iter().zip(&drawn).all(|(found, drawn)| are_alike(found, drawn))
}

/// What the first draws decide, for those who draw x, y, z from `rand()`.
fn judge_scripted(observed: &Observed, verdict: &mut SectionVerdict) {
    let second = Vec3::from_array(SECOND_TRY).normalize();
    let result = |step: PlanStep| {
        let call: &Call = observed.step(step)?.calls.first()?;
        Some((call.emitted?[1].normalize_or_zero(), call.drawn))
    };
    let Some((direction, drawn)) = result(PlanStep::EmitCorner) else { return };
    let corner = first_try(PlanStep::EmitCorner).map(|xyz| Vec3::from_array(xyz).normalize());
    if drawn == 3 && corner.is_some_and(|corner| corner.abs_diff_eq(direction, 1e-3)) {
        verdict.fault(
            Some("cube-directions"),
            "a point in the corner of the cube is not drawn again".to_owned(),
            REJECT,
        );
    }
    // Only who takes the second try is known to draw x, y, z in turn.
    let follows = drawn == 6 && direction.abs_diff_eq(second, 1e-3);
    if !follows {
        return;
    }
    if let Some((direction, 6)) = result(PlanStep::EmitOnSphere)
        && direction.abs_diff_eq(second, 1e-3)
    {
        verdict.remarks.push(
            "a point exactly on the sphere is drawn again; the handout keeps it. It makes no \
             difference."
                .to_owned(),
        );
    }
    let zero = observed.step(PlanStep::EmitZero).and_then(|log| log.calls.first()?.emitted);
    if zero.is_some_and(|ray| !ray[1].is_finite()) {
        verdict.remarks.push(
            "the point (0, 0, 0) gives a direction of NaN: draw again there, too. It hardly ever \
             happens."
                .to_owned(),
        );
    }
}

fn vector(v: Vec3) -> String {
    format!("({}, {}, {})", v.x, v.y, v.z)
}
