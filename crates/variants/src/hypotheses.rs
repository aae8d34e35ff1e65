//! What a submission may have done: the handout, read in one of the fair ways, or one of the misreadings
//! seen in real submissions.

use fast::lanes::offset::Offset;
use glam::Vec3;

use super::variation::{FACETS, Hemisphere, Roulette, Variation};
use crate::reading::{Reading, TangentBasis};
use crate::section::Section;

/// A way in which the assignment may have been done.
#[derive(Clone, Debug, PartialEq)]
pub struct Hypothesis {
    /// A name for programs; several ways to the same misreading share theirs.
    pub id: &'static str,
    /// How it differs from the reference.
    pub title: String,
    /// The misreading, if it is one; nothing for a fair reading.
    pub misreading: Option<Misreading>,
    /// How the tracer does it.
    pub variation: Variation,
}

/// What is said to the student.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Misreading {
    /// Where the handout says otherwise.
    pub section: Section,
    /// What to look at in the code.
    pub advice: &'static str,
}

/// The fair readings: the reference's first.
pub fn fair_readings() -> Vec<Hypothesis> {
    let fair = |title: String, reading: Reading| Hypothesis {
        id: "fair",
        title,
        misreading: None,
        variation: Variation { reading, ..Variation::default() },
    };
    let mut all = vec![fair("t and b normalised".to_owned(), Reading::REFERENCE)];
    // One threshold between each two of |n.x| that the scene's normals have: 0, 0.29, 0.30, 0.301,
    // 0.9536, 0.955, 0.96 and 1.
    for (axis, name) in [(Vec3::Y, "(0, 1, 0)"), (Vec3::Z, "(0, 0, 1)")] {
        for threshold in [0.99, 0.957, 0.9543, 0.8, 0.2] {
            if threshold == 0.99 && axis == Vec3::Z {
                // The wall's frame has length 1 with either axis.
                continue;
            }
            let title = format!("t and b as written, {name} from |n.x| > {threshold} on");
            all.push(fair(
                title,
                Reading {
                    tangent_basis: TangentBasis::LetterOfTheHandout,
                    fallback_threshold: threshold,
                    fallback_axis: axis,
                    ..Reading::REFERENCE
                },
            ));
        }
    }
    let offset = |offset| Reading { offset, ..Reading::REFERENCE };
    all.push(fair("offset 1e-3 along the normal".to_owned(), offset(Offset::AlongNormal(1e-3))));
    all.push(fair(
        "offset 1e-5 along the new direction".to_owned(),
        offset(Offset::AlongDirection(1e-5)),
    ));
    all
}

/// Paths that end one bounce too early: unless the limit is small, nothing shows of it.
pub const BOUNCE_OFF_BY_ONE: &str = "bounce-off-by-one";

const WALL: &str = "The wall's normal is (-1, 0, 0), so its dot product with (1, 0, 0) is -1: compare the absolute \
    value with your threshold.";

/// The misreadings of which the grader knows what they do.
pub fn misreadings() -> Vec<Hypothesis> {
    let plain = Variation::default();
    let never_parallel = |tangent_basis| Reading {
        tangent_basis,
        fallback_threshold: f32::INFINITY,
        ..Reading::REFERENCE
    };
    let with_basis = |tangent_basis| Reading { tangent_basis, ..Reading::REFERENCE };
    let mut all = vec![
        known(
            "direct-stored",
            "photons straight from the light are stored as well",
            Section::PhotonStorage,
            "Store a photon only where the size of 'path' is larger than 1, and let 'path' grow with \
             every call.",
            Variation { direct_stored: true, ..plain },
        ),
        known(
            "uniform-hemisphere",
            "directions are uniform over the hemisphere, not in proportion to the cosine",
            Section::HemisphereSampling,
            "Take r = sqrt(u1) and z = sqrt(1 - u1), equations (2) and (6): that is a point of the \
             disk, lifted to the hemisphere.",
            Variation { hemisphere: Hemisphere::Uniform, ..plain },
        ),
        known(
            "no-square-root",
            "r is u1, not its square root",
            Section::HemisphereSampling,
            "Equation (2) has r = sqrt(u1).",
            Variation { hemisphere: Hemisphere::NoSquareRoot, ..plain },
        ),
        known(
            "cube-directions",
            "directions from the light come from the whole cube, not the sphere",
            Section::PhotonEmission,
            "Draw x, y and z again while x^2 + y^2 + z^2 > 1, before you normalise.",
            Variation { cube_directions: true, ..plain },
        ),
        known(
            "no-absolute-value",
            "photons leave the right wall along its normal: there t and b have no length",
            Section::HemisphereRayTransformation,
            WALL,
            Variation { reading: never_parallel(TangentBasis::LetterOfTheHandout), ..plain },
        ),
        known(
            "no-absolute-value",
            "photons leave the right wall along its normal: there t and b are left at zero",
            Section::HemisphereRayTransformation,
            WALL,
            Variation {
                reading: never_parallel(TangentBasis::Normalised),
                zero_frame: true,
                ..plain
            },
        ),
        known(
            "nan-frame",
            "photons leave the right wall in directions that are not numbers",
            Section::HemisphereRayTransformation,
            "The wall's normal is (-1, 0, 0), so its dot product with (1, 0, 0) is -1, t is (0, 0, 0), \
             and normalising it gives NaN: compare the absolute value with your threshold.",
            Variation { reading: never_parallel(TangentBasis::Normalised), ..plain },
        ),
        known(
            "mean-roulette",
            "photons survive with the mean of the diffuse response, not its maximum",
            Section::PhotonScatteringAbsorption,
            "Equation (1): P_r = max(d_r, d_g, d_b).",
            Variation { roulette: Roulette::Mean, ..plain },
        ),
        known(
            "red-roulette",
            "photons survive with the red of the diffuse response alone, not its maximum",
            Section::PhotonScatteringAbsorption,
            "Equation (1): P_r = max(d_r, d_g, d_b).",
            Variation { roulette: Roulette::Red, ..plain },
        ),
        known(
            "smallest-roulette",
            "photons survive with the smallest channel of the diffuse response, not its largest",
            Section::PhotonScatteringAbsorption,
            "Equation (1): P_r = max(d_r, d_g, d_b).",
            Variation { roulette: Roulette::Smallest, ..plain },
        ),
        known(
            "luminance-roulette",
            "photons survive with the luminance of the diffuse response, not its largest channel",
            Section::PhotonScatteringAbsorption,
            "Equation (1): P_r = max(d_r, d_g, d_b).",
            Variation { roulette: Roulette::Luminance, ..plain },
        ),
        known(
            "transposed-frame",
            "t, b and n are the rows of the matrix, not its columns",
            Section::HemisphereRayTransformation,
            "The columns of the matrix are t, b and n; glm::mat3(t, b, n) takes columns.",
            Variation { reading: with_basis(TangentBasis::Transposed), ..plain },
        ),
        known(
            "flipped-normal",
            "photons scatter below the surface they hit",
            Section::HemisphereRayTransformation,
            "Use the normal of state.ComputeNormal() as it is, in the matrix's third column.",
            Variation { flipped_normal: true, ..plain },
        ),
        known(
            BOUNCE_OFF_BY_ONE,
            "paths end one bounce too early",
            Section::PhotonStorage,
            "TracePhoton ends when remainingBounces is LESS THAN 0, not when it is 0.",
            Variation { fewer_bounces: 1, ..plain },
        ),
    ];
    for chance in [0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9] {
        let title = format!("photons survive with the same chance, {chance}, on every material");
        all.push(no_roulette(&title, chance, i32::MAX));
    }
    for most_bounces in [3, 4, 5, 6, 8, 10, 20] {
        let title = format!("every photon is scattered, up to {most_bounces} times");
        all.push(no_roulette(&title, 1.0, most_bounces));
    }
    // Whoever misreads one step may take t and b as they are written.
    let literal = all.iter().filter(|hypothesis| {
        hypothesis.variation.reading.tangent_basis == TangentBasis::Normalised
            && !["nan-frame", "no-absolute-value"].contains(&hypothesis.id)
    });
    let literal: Vec<_> = literal.map(to_the_letter).collect();
    all.extend(literal);
    all
}

/// `hypothesis`, but with t and b as equations (7) and (8) have them.
pub fn to_the_letter(hypothesis: &Hypothesis) -> Hypothesis {
    let reading =
        Reading { tangent_basis: TangentBasis::LetterOfTheHandout, ..hypothesis.variation.reading };
    Hypothesis {
        title: format!("{}; t and b as written", hypothesis.title),
        variation: Variation { reading, ..hypothesis.variation },
        ..hypothesis.clone()
    }
}

/// Photons that meet the surface they leave. How many do depends on rounding, and so on the program:
/// `self_hits` has the part for every facet.
pub fn no_offset(self_hits: [f32; FACETS]) -> Hypothesis {
    known(
        "no-offset",
        "scattered photons hit the triangle they leave",
        Section::HemisphereRayTransformation,
        "Start the scattered ray a little above the surface: the hit point plus 1e-5 times the normal, \
         as the framework does for shadow rays.",
        Variation { self_hits, ..Variation::default() },
    )
}

/// A roulette that takes no notice of the material. Positions alone can hardly tell one way to it from another.
fn no_roulette(title: &str, chance: f32, most_bounces: i32) -> Hypothesis {
    known(
        "no-roulette",
        title,
        Section::PhotonScatteringAbsorption,
        "Scatter only if a random number in [0, 1) is less than P_r, which equation (1) takes from the \
         material that was hit, and end the path otherwise.",
        Variation { roulette: Roulette::Constant(chance), most_bounces, ..Variation::default() },
    )
}

fn known(
    id: &'static str,
    title: &str,
    section: Section,
    advice: &'static str,
    variation: Variation,
) -> Hypothesis {
    let misreading = Some(Misreading { section, advice });
    Hypothesis { id, title: title.to_owned(), misreading, variation }
}
