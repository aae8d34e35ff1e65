//! A grade as Gradescope's autograders hand it over: `results.json`.

use serde::Serialize;

use super::policy::Policy;
use super::text;
use super::verdict::{Finding, Grade};

/// The whole file.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Results<'a> {
    score: f64,
    output: String,
    output_format: &'static str,
    visibility: &'static str,
    stdout_visibility: &'static str,
    tests: Vec<Test<'a>>,
    extra_data: &'a Grade,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
struct Test<'a> {
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
    let tests = grade.findings.iter().enumerate().map(|(at, finding)| Test {
        name: finding.check,
        score: points(grade, at, policy).map(|(score, _)| score),
        max_score: points(grade, at, policy).map(|(_, most)| most),
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

/// The points and the most points of finding `at`, if it is the first of a section that has points.
fn points(grade: &Grade, at: usize, policy: &Policy) -> Option<(f64, f64)> {
    let title = grade.findings[at].check;
    let most = *policy.sections.get(title)?;
    let of_section = || grade.findings.iter().filter(|finding| finding.check == title);
    let is_first = grade.findings[..at].iter().all(|finding| finding.check != title);
    let is_right = of_section().any(|finding| finding.passed);
    is_first.then_some((if is_right { most } else { 0.0 }, most))
}
