//! What students do instead of scattering as the handout has it.

use glam::{Mat3, Vec3};

use super::fair::{Taken, Tries};
use photon_mapping::rendering::sampling::sample_hemisphere;
use variants::section::Section;

/// What students do instead, with the direction it gives at a hit with `frame`, where the draws
/// `u1` and `u2` stand for the direction `local` in tangent space. The directions are in world
/// space, of any length, even 0.
pub fn hypotheses(
    frame: Mat3,
    local: Vec3,
    u1: f32,
    u2: f32,
) -> Vec<(Section, &'static str, Vec3)> {
    let Mat3 { x_axis: t, y_axis: b, z_axis: n } = frame;
    let transformation = Section::HemisphereRayTransformation;
    let sampling = Section::HemisphereSampling;
    let disk = |r: f32, z: f32| {
        let around = Vec3::new(local.x, local.y, 0.0).normalize_or_zero();
        frame * (r * around + z * Vec3::Z)
    };
    let height = (1.0 - u1).sqrt();
    let mut all = vec![
        (transformation, "the photon leaves along the normal: t and b have no length", n),
        (
            transformation,
            "the matrix is transposed: t, b and n are its rows",
            frame.transpose() * local,
        ),
        (transformation, "the matrix is applied twice", frame * (frame * local)),
        (
            transformation,
            "the transposed matrix is applied twice",
            frame.transpose() * (frame.transpose() * local),
        ),
        (transformation, "the normal points to the other side", Mat3::from_cols(-t, b, -n) * local),
        (transformation, "the photon leaves below the surface", Mat3::from_cols(t, b, -n) * local),
        (transformation, "the direction is left in tangent space", local),
        (sampling, "the hemisphere is sampled uniformly: z = u1", disk((1.0 - u1 * u1).sqrt(), u1)),
        (
            sampling,
            "the hemisphere is sampled uniformly: z = 1 - u1",
            disk((1.0 - (1.0 - u1) * (1.0 - u1)).sqrt(), 1.0 - u1),
        ),
        (sampling, "r = u1, without the square root", disk(u1, height)),
        (sampling, "z is not the square root of 1 - u1", disk(u1.sqrt(), 1.0 - u1)),
        (sampling, "u1 and u2 are swapped", frame * sample_hemisphere(u2, u1)),
        (sampling, "theta is pi u2, half of what it should be", {
            let theta = std::f32::consts::PI * u2;
            let r = u1.sqrt();
            frame * Vec3::new(r * libm::cosf(theta), r * libm::sinf(theta), height)
        }),
        (transformation, "t and b are swapped", Mat3::from_cols(b, t, n) * local),
        (transformation, "b points to the other side", Mat3::from_cols(t, -b, n) * local),
    ];
    for axis in [Vec3::X, Vec3::Y, Vec3::Z] {
        let tangent = n.cross(axis);
        if let Some(unit_tangent) = tangent.try_normalize() {
            let literal = Mat3::from_cols(tangent, n.cross(tangent), n);
            let normalised = Mat3::from_cols(unit_tangent, n.cross(unit_tangent), n);
            let other_axis = "t is the cross product of n with another axis";
            all.push((transformation, other_axis, normalised * local));
            all.push((transformation, "t and b are not normalized", literal * local));
        }
    }
    all
}

/// What students do instead of drawing from the ball.
pub fn other_emissions(fair: Tries) -> [(Tries, &'static str); 4] {
    let all = Taken::All;
    [
        (
            Tries { taken: all, ..fair },
            "the first try is taken, though it may lie outside the sphere",
        ),
        (Tries { unscaled: true, ..fair }, "x, y and z lie in [0, 1), not in [-1, 1)"),
        (
            Tries { taken: all, unscaled: true, ..fair },
            "x, y and z lie in [0, 1), and the first try is taken",
        ),
        (
            Tries { taken: Taken::Outside, ..fair },
            "tries inside the sphere are rejected, and those outside are taken",
        ),
    ]
}
