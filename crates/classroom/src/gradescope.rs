//! A grade as Gradescope's autograders hand it over: `results.json`.

use serde::Serialize;

use super::text;
use grading::policy::{Policy, points};
use grading::verdict::{Finding, Grade};

/// The whole file.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Results<'a> {
    score: f64,
    output: String,
    output_format: &'static str,
    visibility: &'static str,
    stdout_visibility: &'static str,
    tests: Vec<GradescopeTest<'a>>,
    extra_data: &'a Grade,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
struct GradescopeTest<'a> {
    name: &'a str,
    /// Only where the policy gives points for this section: 0 of 0 points would look like a loss.
    #[serde(skip_serializing_if = "Option::is_none")]
    score: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    max_score: Option<f64>,
    status: &'static str,
    number: String,
    output: String,
    output_format: &'static str,
    visibility: &'static str,
    extra_data: &'a Finding,
}

/// The results for `grade` by `policy`. Nothing in them differs from run to run.
pub fn results<'a>(grade: &'a Grade, policy: &Policy) -> Results<'a> {
    let tests = grade.findings.iter().enumerate().map(|(at, finding)| GradescopeTest {
        name: finding.check,
        score: points(grade, at, policy).map(|points| points.score),
        max_score: points(grade, at, policy).map(|points| points.most),
        // What costs nothing must not look as if it did.
        status: if finding.is_fault() { "failed" } else { "passed" },
        number: (at + 1).to_string(),
        output: text::finding(finding),
        output_format: "text",
        visibility: if finding.is_of_others() { "hidden" } else { "visible" },
        extra_data: finding,
    });
    Results {
        score: grade.score,
        output: text::heading(grade, policy.best()),
        output_format: "text",
        visibility: "visible",
        stdout_visibility: "hidden",
        tests: tests.collect(),
        extra_data: grade,
    }
}
