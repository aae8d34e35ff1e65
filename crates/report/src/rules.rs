//! The rules for where a scattered ray starts that the report compares, and the places of the
//! scene.

use super::transform::Displacement;

/// How rays are started.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum HitRule {
    /// At the point hit.
    None,
    /// This far along the normal, in the units of the scene as it comes.
    Fixed(f32),
    /// The program's rule for a model that it loads.
    Reference,
}

impl HitRule {
    /// All rules of the report.
    pub fn all() -> Vec<Self> {
        let fixed = [1e-9, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 1e-1].map(Self::Fixed);
        [Self::None].into_iter().chain(fixed).chain([Self::Reference]).collect()
    }

    /// What the page calls it.
    pub fn name(self) -> String {
        match self {
            Self::None => "none".to_owned(),
            Self::Fixed(length) => format!("{length:.0e} n"),
            Self::Reference => "reference".to_owned(),
        }
    }
}

/// All pairs of rule and place.
pub fn cases() -> Vec<(HitRule, Displacement)> {
    let of_place = |place| HitRule::all().into_iter().map(move |rule| (rule, place));
    Displacement::all().into_iter().flat_map(of_place).collect()
}
