//! What a verdict is worth.

use std::collections::BTreeMap;

use serde::Deserialize;

use super::verdict::{Grade, Verdict};

/// Scores by verdict. The default is the handout's rubric: 4 for dots that look reasonable, 2 or 3
/// for dots that look incorrect, 1 for no dots, 0 for nothing.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "kebab-case")]
pub struct Policy {
    /// For a correct submission.
    pub correct: f64,
    /// For one with too few photons to tell.
    pub undecided: f64,
    /// For an incorrect one whose photons are finite, on surfaces, and indirect only.
    pub plausible: f64,
    /// For any other incorrect one.
    pub incorrect: f64,
    /// For one without dots.
    pub no_dots: f64,
    /// For one that cannot be read, or has nothing of a photon map in it.
    pub unreadable: f64,
    /// For an incorrect one with this misreading, in place of the above.
    pub misreadings: BTreeMap<String, f64>,
    /// For each section of the handout that `check` finds right, by its title, in place of the
    /// above.
    pub sections: BTreeMap<String, f64>,
}

impl Default for Policy {
    fn default() -> Self {
        Self {
            correct: 4.0,
            undecided: 0.0,
            plausible: 3.0,
            incorrect: 2.0,
            no_dots: 1.0,
            unreadable: 0.0,
            misreadings: BTreeMap::new(),
            sections: BTreeMap::new(),
        }
    }
}

impl Policy {
    /// The score of `verdict`, where `is_plausible` tells whether photons are finite, on surfaces,
    /// and indirect only.
    pub fn score(&self, verdict: Verdict, misreading: Option<&str>, is_plausible: bool) -> f64 {
        match verdict {
            Verdict::Correct => self.correct,
            Verdict::Undecided => self.undecided,
            Verdict::NoDots => self.no_dots,
            Verdict::Unreadable => self.unreadable,
            Verdict::Incorrect => match misreading.and_then(|id| self.misreadings.get(id)) {
                Some(score) => *score,
                None if is_plausible => self.plausible,
                None => self.incorrect,
            },
        }
    }

    /// A score, with its name, that is below none or above that for a correct submission.
    pub fn odd_score(&self) -> Option<(&str, f64)> {
        let named = [
            ("correct", self.correct),
            ("undecided", self.undecided),
            ("plausible", self.plausible),
            ("incorrect", self.incorrect),
            ("no-dots", self.no_dots),
            ("unreadable", self.unreadable),
        ];
        let others = self.misreadings.iter().chain(&self.sections);
        let mut all = named.into_iter().chain(others.map(|(id, score)| (id.as_str(), *score)));
        all.find(|(_, score)| !(0.0..=self.correct).contains(score))
    }

    /// The sum of the points of sections; none where they have none.
    pub fn of_all_sections(&self) -> Option<f64> {
        (!self.sections.is_empty()).then(|| rounded(self.sections.values().sum()))
    }

    /// The points for the sections titled `right`; none where sections have none.
    pub fn of_sections<'a>(&self, right: impl Iterator<Item = &'a str>) -> Option<f64> {
        let points = right.map(|title| self.sections.get(title).copied().unwrap_or_default());
        (!self.sections.is_empty()).then(|| rounded(points.sum()))
    }

    /// The highest score.
    pub fn best(&self) -> f64 {
        let others =
            [self.undecided, self.plausible, self.incorrect, self.no_dots, self.unreadable];
        others.into_iter().fold(self.correct, f64::max)
    }
}

/// `score` without what adding in binary leaves behind: 2.4 must not become 2.4000000000000004.
fn rounded(score: f64) -> f64 {
    (score * 1e6).round() / 1e6
}

/// The points of a section of the handout.
pub struct SectionPoints {
    /// Its title.
    pub title: &'static str,
    /// What it got.
    pub score: f64,
    /// What it gets if it is right.
    pub most: f64,
}

/// The points by `policy` of the section that finding `at` of `grade` is the first of, if it has
/// any.
pub fn points(grade: &Grade, at: usize, policy: &Policy) -> Option<SectionPoints> {
    let title = grade.findings[at].check;
    let most = *policy.sections.get(title)?;
    let of_section = || grade.findings.iter().filter(|finding| finding.check == title);
    let is_first = grade.findings[..at].iter().all(|finding| finding.check != title);
    let is_right = of_section().any(|finding| finding.passed);
    let score = if is_right { most } else { 0.0 };
    is_first.then_some(SectionPoints { title, score, most })
}
