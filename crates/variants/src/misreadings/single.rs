//! What a misreading makes of one photon, whose random numbers are known.

use glam::{Mat3, Vec3};

use super::misreadings;
use crate::hypotheses::{Hypothesis, Misreading};
use crate::reading::TangentBasis;
use crate::sampling::Hemisphere;
use crate::section::Section;
use crate::variation::{Transformation, Variation};

/// The two numbers that a direction is sampled from, and the roulette's before them.
#[derive(Clone, Copy, Debug)]
pub struct Numbers {
    /// The roulette's.
    pub roulette: f32,
    /// The first of the sampler's.
    pub u1: f32,
    /// The second.
    pub u2: f32,
}

/// What students do instead of scattering as the handout has it, with the direction, of any length,
/// that it gives at a hit with `frame`: the misreadings of the table, then what shows only in a
/// photon whose numbers are known.
pub fn directions(frame: Mat3, numbers: Numbers) -> Vec<(Section, String, Vec3)> {
    let mut all = Vec::new();
    let mut misreadings = misreadings();
    // What a photon does by the normal it meets, before what all do.
    misreadings.sort_by_key(|it| it.variation.reading.fallback_threshold <= 1.0);
    for Hypothesis { title, misreading, variation, .. } in misreadings {
        let direction = variation.direction_of_one(frame, numbers);
        if let (Some(Misreading { section, .. }), Some(direction)) = (misreading, direction) {
            all.push((section, title, direction));
        }
    }
    let of_one = of_one_photon(frame, numbers).into_iter();
    all.extend(of_one.map(|(section, title, direction)| (section, title.to_owned(), direction)));
    all
}

/// What no table of counts tells: it leaves photons where the handout does, or hardly anybody does
/// it.
fn of_one_photon(frame: Mat3, numbers: Numbers) -> Vec<(Section, &'static str, Vec3)> {
    let Mat3 { x_axis: t, y_axis: b, z_axis: n } = frame;
    let Numbers { u1, u2, .. } = numbers;
    let transformation = Section::HemisphereRayTransformation;
    let sampling = Section::HemisphereSampling;
    let cosine = |frame: &Mat3, numbers| sample(Hemisphere::Cosine, n, frame, numbers);
    let local = cosine(&Mat3::IDENTITY, numbers);
    let swapped = Numbers { u1: u2, u2: u1, ..numbers };
    let low = Numbers { u1: 1.0 - u1, ..numbers };
    let mut all = vec![
        (transformation, "the matrix is applied twice", frame * (frame * local)),
        (
            transformation,
            "the transposed matrix is applied twice",
            frame.transpose() * (frame.transpose() * local),
        ),
        (transformation, "the photon leaves below the surface", Mat3::from_cols(t, b, -n) * local),
        (
            sampling,
            "the hemisphere is sampled uniformly: z = 1 - u1",
            sample(Hemisphere::Uniform, n, &frame, low),
        ),
        (sampling, "u1 and u2 are swapped", cosine(&frame, swapped)),
        (transformation, "t and b are swapped", Mat3::from_cols(b, t, n) * local),
        (transformation, "b points to the other side", Mat3::from_cols(t, -b, n) * local),
    ];
    for axis in [Vec3::X, Vec3::Y, Vec3::Z] {
        let tangent = n.cross(axis);
        if let Some(unit_tangent) = tangent.try_normalize() {
            let literal = Mat3::from_cols(tangent, n.cross(tangent), n);
            let normalized = Mat3::from_cols(unit_tangent, n.cross(unit_tangent), n);
            let other_axis = "t is the cross product of n with another axis";
            all.push((transformation, other_axis, normalized * local));
            all.push((transformation, "t and b are not normalized", literal * local));
        }
    }
    all
}

fn sample(hemisphere: Hemisphere, normal: Vec3, frame: &Mat3, numbers: Numbers) -> Vec3 {
    let mut drawn = [numbers.u1, numbers.u2].into_iter().cycle();
    let mut draw = || drawn.next().unwrap_or_default();
    hemisphere.direction(normal, frame, numbers.roulette, &mut draw)
}

impl Variation {
    /// The direction, of any length, in which a photon is scattered at a hit with `frame`; none
    /// where these `numbers` do not tell, or that is no matter of the direction.
    fn direction_of_one(&self, frame: Mat3, numbers: Numbers) -> Option<Vec3> {
        let Mat3 { x_axis: t, y_axis: b, z_axis: n } = frame;
        let hemisphere = self.hemisphere;
        let basis = self.reading.tangent_basis;
        let of = |frame| Some(sample(hemisphere, n, &frame, numbers));
        if self.flipped_normal {
            return of(Mat3::from_cols(-t, b, -n));
        }
        if self.reading.fallback_threshold > 1.0 {
            let has_length = n.cross(Vec3::X).length_squared() > 1e-6;
            return (!has_length && !self.makes_nan()).then_some(n);
        }
        match (self.frame, basis) {
            (_, TangentBasis::LetterOfTheHandout) => None,
            (_, TangentBasis::Transposed) => of(frame.transpose()),
            (Transformation::Rows, _) => of(frame.transpose()),
            (Transformation::Forgotten, _) => of(Mat3::IDENTITY),
            (Transformation::Columns(columns), _) => {
                let [x, y, z] = columns.map(|column| frame.col(column));
                of(Mat3::from_cols(x, y, z))
            }
            (Transformation::HalfNormalized, _) => of(self.tangent_frame(n)),
            (Transformation::AsRead, _) => {
                let is_told = hemisphere.uses_frame() || hemisphere == Hemisphere::AlongNormal;
                (is_told && hemisphere != Hemisphere::Cosine).then(|| of(frame)).flatten()
            }
        }
    }
}
