//! Misreadings of where a scattered photon goes.

use super::Entry;
use crate::reading::{Reading, TangentBasis};
use crate::sampling::Hemisphere;
use crate::section::Section;
use crate::variation::{Start, Transformation, Variation};

pub(super) fn sampling() -> Vec<Entry> {
    let of = |hemisphere| Variation { hemisphere, ..Variation::default() };
    let section = Section::HemisphereSampling;
    let disk = "Take r = sqrt(u1) and z = sqrt(1 - u1), equations (2) and (6): that is a point of \
                the disk, lifted to the hemisphere.";
    let fresh = "Draw a new number for each of the roulette, u1 and u2.";
    let upper = "Directions have to be in the hemisphere over the normal: take r = sqrt(u1) and \
         z = sqrt(1 - u1), equations (2) and (6).";
    vec![
        Entry::new(
            "uniform-hemisphere",
            section,
            disk,
            [(
                "directions are uniform over the hemisphere, not in proportion to the cosine",
                of(Hemisphere::Uniform),
            )],
        ),
        Entry::new(
            "no-square-root",
            section,
            "Equation (2) has r = sqrt(u1).",
            [
                ("r is u1, not its square root", of(Hemisphere::NoSquareRoot)),
                ("r is u1, and z the root of 1 - r^2", of(Hemisphere::NoSquareRootOnSphere)),
            ],
        ),
        Entry::new(
            "no-square-root-of-height",
            section,
            "Equation (6) has z = sqrt(1 - u1).",
            [("z is 1 - u1, not its square root", of(Hemisphere::NoSquareRootOfHeight))],
        ),
        Entry::new(
            "linear-angle",
            section,
            disk,
            [("the angle to the normal is even, pi/2 u1", of(Hemisphere::LinearAngle))],
        ),
        Entry::new(
            "half-azimuth",
            section,
            "Equation (3) has theta = 2 pi u2.",
            [("directions go half round: theta is pi u2", of(Hemisphere::HalfAzimuth))],
        ),
        Entry::new(
            "one-number",
            section,
            fresh,
            [("u1 and u2 are the same number", of(Hemisphere::SameNumbers))],
        ),
        Entry::new(
            "roulette-number-again",
            section,
            fresh,
            [("the roulette's number is u1 as well", of(Hemisphere::NumberOfRoulette))],
        ),
        Entry::new(
            "numbers-again",
            section,
            "Each number is drawn once. Pass the generator by reference: a copy draws the same \
             numbers again.",
            [(
                "u1 and u2 come again as the next numbers of the path",
                Variation { repeats_numbers: true, ..Variation::default() },
            )],
        ),
        Entry::new(
            "along-normal",
            section,
            "u1 and u2 are always 0: divide by RAND_MAX as a float, since between integers it \
             gives 0.",
            [("all photons leave along the normal", of(Hemisphere::AlongNormal))],
        ),
        Entry::new(
            "normal-and-ball",
            section,
            disk,
            [(
                "directions are the normal plus a point of the unit ball",
                of(Hemisphere::NormalAndBall),
            )],
        ),
        Entry::new(
            "normal-and-cube",
            section,
            disk,
            [("directions are the normal plus a point of the cube", of(Hemisphere::NormalAndCube))],
        ),
        Entry::new(
            "upper-cube",
            section,
            disk,
            [("directions come from the upper half of the cube", of(Hemisphere::UpperCube))],
        ),
        Entry::new(
            "below-surface",
            section,
            upper,
            [
                ("directions are even over the whole sphere", of(Hemisphere::Sphere)),
                (
                    "directions are the normal plus three normally distributed numbers",
                    of(Hemisphere::NormalAndGaussian),
                ),
                ("the angle to the normal goes up to pi", of(Hemisphere::WholeAngle)),
            ],
        ),
    ]
}

pub(super) fn transformation() -> Vec<Entry> {
    let plain = Variation::default();
    let section = Section::HemisphereRayTransformation;
    let never_parallel = |tangent_basis| Reading {
        tangent_basis,
        fallback_threshold: f32::INFINITY,
        ..Reading::REFERENCE
    };
    let transposed = Reading { tangent_basis: TangentBasis::Transposed, ..Reading::REFERENCE };
    let of_frame = |frame| Variation { frame, ..Variation::default() };
    let of_start = |start| Variation { start, ..Variation::default() };
    let columns = |columns| of_frame(Transformation::Columns(columns));
    vec![
        Entry::new(
            "no-absolute-value",
            section,
            "The wall's normal is (-1, 0, 0), so its dot product with (1, 0, 0) is -1: compare the \
             absolute value with your threshold.",
            [
                (
                    "photons leave the right wall along its normal: there t and b have no length",
                    Variation {
                        reading: never_parallel(TangentBasis::LetterOfTheHandout),
                        ..plain
                    },
                ),
                (
                    "photons leave the right wall along its normal: there t and b are left at zero",
                    Variation {
                        reading: never_parallel(TangentBasis::Normalized),
                        zero_frame: true,
                        ..plain
                    },
                ),
            ],
        ),
        Entry::new(
            "nan-frame",
            section,
            "The wall's normal is (-1, 0, 0), so its dot product with (1, 0, 0) is -1. Then t is \
             (0, 0, 0), and normalizing it gives NaN. Compare the absolute value with your \
             threshold.",
            [(
                "photons leave the right wall in directions that are not numbers",
                Variation { reading: never_parallel(TangentBasis::Normalized), ..plain },
            )],
        ),
        Entry::new(
            "half-normalised",
            section,
            "Normalize both t and b, or neither: one of them alone squeezes directions to one \
             side.",
            [("b is normalized, and t is not", of_frame(Transformation::HalfNormalized))],
        ),
        Entry::new(
            "transposed-frame",
            section,
            "The columns of the matrix are t, b and n; glm::mat3(t, b, n) takes columns.",
            [
                (
                    "t, b and n are the rows of the matrix, not its columns",
                    Variation { reading: transposed, ..plain },
                ),
                (
                    "t, b and n are the rows of the matrix; t and b as written",
                    Variation {
                        reading: Reading::LETTER_OF_THE_HANDOUT,
                        ..of_frame(Transformation::Rows)
                    },
                ),
            ],
        ),
        Entry::new(
            "permuted-frame",
            section,
            "The columns of the matrix are t, b and n, in this order: z is the normal's.",
            [
                ("b is the third column of the matrix, not n", columns([0, 2, 1])),
                ("t is the third column of the matrix, not n", columns([1, 2, 0])),
            ],
        ),
        Entry::new(
            "not-transformed",
            section,
            "The sampled direction is in tangent space: multiply it by the matrix of t, b and n.",
            [("directions stay in tangent space", of_frame(Transformation::Forgotten))],
        ),
        Entry::new(
            "flipped-normal",
            section,
            "Use the normal of state.ComputeNormal() as it is, in the matrix's third column.",
            [(
                "photons scatter below the surface they hit",
                Variation { flipped_normal: true, ..plain },
            )],
        ),
        Entry::new(
            "start-not-moved",
            section,
            "The scattered ray starts at the point that was hit, a little above it: set its \
             position with SetRayPosition.",
            [
                ("scattered rays start where the light is", of_start(Start::Light)),
                ("scattered rays start at (0, 0, 0)", of_start(Start::Zero)),
            ],
        ),
    ]
}
