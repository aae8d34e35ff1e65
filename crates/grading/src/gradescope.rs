//! A grade as Gradescope's autograders hand it over: `results.json`.

use serde::Serialize;

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
    /// Without a score, which is that of the whole: a check alone is worth nothing, and 0 of 0 points would
    /// look like a loss.
    status: &'static str,
    number: String,
    output: String,
    output_format: &'static str,
    visibility: &'static str,
    extra_data: &'a Finding,
}

/// The results for `grade`, of at most `best` points. Nothing in them differs from run to run.
pub fn results(grade: &Grade, best: f64) -> Results<'_> {
    let tests = grade.findings.iter().enumerate().map(|(at, finding)| Test {
        name: finding.check,
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
        output: text::heading(grade, best),
        output_format: "text",
        visibility: "visible",
        stdout_visibility: "hidden",
        tests: tests.collect(),
        extra_data: grade,
    }
}
