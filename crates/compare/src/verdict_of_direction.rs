//! To which section of the handout does another direction of a scattered photon belong?

use glam::{Mat3, Vec3};

use super::verdict::{Cause, Parting, certain, guess};
use crate::explain::Hit;
use photon_mapping::rendering::sampling::sample_hemisphere;
use variants::misreadings::{Numbers, directions};
use variants::section::Section;

/// Judges the direction `way`, of any length, in which the submission's photon left `hit`.
pub(crate) fn judge_direction(observation: &Parting, hit: &Hit, way: Vec3) -> Option<Cause> {
    let tolerance = observation.tolerance;
    let (Some(u1), Some(u2), Some(tangent), Some(bitangent), Some(expected)) =
        (hit.u1, hit.u2, hit.tangent, hit.bitangent, hit.direction)
    else {
        return None;
    };
    if way.length() < 50.0 * tolerance {
        return None;
    }
    // The start of the ray may be off the hit by the offset, and the end by rounding.
    let offset = observation.known.fair.map_or(0.0, |fair| fair.start.length());
    let allowed = 1e-3 + (2.0 * tolerance + offset) / way.length();
    let direction = way.normalize();
    if direction.distance(Vec3::from_array(expected)) < allowed {
        let reason = "the direction is right, but the scattered ray starts elsewhere";
        return Some(guess(Section::HemisphereRayTransformation, reason));
    }
    let normal = Vec3::from_array(hit.normal);
    let frame = Mat3::from_cols(tangent.into(), bitangent.into(), normal);
    let local = sample_hemisphere(u1, u2);
    let fits = |hypothesis: &Vec3| {
        hypothesis.try_normalize().is_some_and(|it| it.distance(direction) < allowed)
    };
    let numbers = Numbers { roulette: hit.roulette, u1, u2 };
    for (section, reason, hypothesis) in directions(frame, numbers) {
        if fits(&hypothesis) {
            return Some(certain(section, reason));
        }
    }
    // With columns of another length than 1 the transpose is not the inverse.
    let orthonormal =
        Mat3::from_cols(frame.x_axis.normalize_or_zero(), frame.y_axis.normalize_or_zero(), normal);
    let found = orthonormal.transpose() * direction;
    let (section, reason) = judge_tangent_space(found, local.normalize(), allowed)?;
    Some(observation.sure(section, reason))
}

/// Judges a direction that no hypothesis explains by what is left of the right one: `found` and
/// `expected` are unit vectors in tangent space.
fn judge_tangent_space(
    found: Vec3,
    expected: Vec3,
    allowed: f32,
) -> Option<(Section, &'static str)> {
    let around = |v: Vec3| Vec3::new(v.x, v.y, 0.0).normalize_or_zero();
    if found.z < -allowed {
        return Some((Section::HemisphereRayTransformation, "the photon leaves below the surface"));
    }
    // Near the normal the azimuth means nothing.
    let lowest = 0.1;
    let has_azimuth = found.truncate().length() > lowest && expected.truncate().length() > lowest;
    if has_azimuth && around(found).distance(around(expected)) < allowed / lowest {
        return Some((
            Section::HemisphereSampling,
            "the azimuth is right, the angle to the normal is not",
        ));
    }
    if (found.z - expected.z).abs() < allowed {
        return Some((
            Section::HemisphereRayTransformation,
            "the angle to the normal is right, the azimuth is not",
        ));
    }
    None
}
