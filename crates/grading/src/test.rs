//! One number's test, of a list or a picture, and what is said of it.

use std::borrow::Cow;

use super::judge_list::SIGNIFICANCE;
use super::naming::Explanation;
use super::verdict::{Finding, Weight};

/// What a test found.
pub(super) struct Test {
    pub(super) check: &'static str,
    /// The chance of this, or of something stranger, with regard to how many tests there are.
    pub(super) p_value: f64,
    pub(super) found: String,
}

impl Test {
    /// The finding. Its advice is that of the misreading that explains it, else
    /// `unexplained`.
    pub(super) fn finding(
        &self,
        expected: String,
        explanation: Option<&Explanation>,
        unexplained: Cow<'static, str>,
    ) -> Finding {
        let passed = self.p_value >= SIGNIFICANCE;
        let misreading = explanation.and_then(|explanation| explanation.hypothesis.misreading);
        let advice = if passed {
            "".into()
        } else {
            misreading.map_or(unexplained, |misreading| misreading.advice.into())
        };
        Finding {
            check: self.check,
            section: misreading.map(|misreading| misreading.section.title()),
            expected,
            found: self.found.clone(),
            p_value: Some(self.p_value),
            passed,
            weight: Weight::Fault,
            advice,
        }
    }
}
