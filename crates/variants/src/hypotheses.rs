//! What a submission may have done: the handout, read in one of the fair ways, or one of the
//! misreadings seen in real submissions.

use fast::lanes::offset::Offset;
use glam::Vec3;

use super::variation::Variation;
use crate::reading::{Reading, TangentBasis};
use crate::section::Section;

pub use crate::misreadings::{
    BOUNCE_OFF_BY_ONE, misreadings, no_offset, repeated_paths, stored_twice,
};

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

/// The name of the fair readings for programs.
pub const FAIR: &str = "fair";

impl Hypothesis {
    /// What no other hypothesis is called.
    pub fn key(&self) -> String {
        let mut self_hits = self.variation.self_hits.to_vec();
        self_hits.sort_by(f32::total_cmp);
        self_hits.dedup();
        match self_hits.as_slice() {
            [0.0] => self.title.clone(),
            several => {
                let several: Vec<_> = several.iter().map(f32::to_string).collect();
                format!("{} ({})", self.title, several.join(", "))
            }
        }
    }
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
        id: FAIR,
        title,
        misreading: None,
        variation: Variation { reading, ..Variation::default() },
    };
    let mut all = vec![fair("t and b normalized".to_owned(), Reading::REFERENCE)];
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
