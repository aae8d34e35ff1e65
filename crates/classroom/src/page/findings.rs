//! The sections of the handout and the findings of a page.

use std::collections::HashSet;

use maud::{Markup, html};

use crate::text::chance;
use grading::verdict::{Finding, Grade, Weight};

/// What the C++ of each section does, where it was run.
pub fn sections(grade: &Grade) -> Markup {
    let sections: Vec<&Finding> = grade.findings.iter().filter(|f| f.is_section()).collect();
    let is_new = |at: usize| at == 0 || sections[at - 1].check != sections[at].check;
    html! {
        @if !sections.is_empty() {
            h2 { "Sections of the handout" }
            table.sections {
                @for (at, finding) in sections.iter().enumerate() {
                    tr.(kind(finding)) {
                        th scope="row" { @if is_new(at) { (finding.check) } }
                        td {
                            (finding.found)
                            @if !finding.advice.is_empty() { p { (finding.advice) } }
                        }
                    }
                }
            }
        }
    }
}

/// The findings of `grade` besides sections; the advice `said` stands on the page already.
pub fn findings(grade: &Grade, said: Option<&str>) -> Markup {
    // What several findings advise is said once.
    let mut said: HashSet<&str> = said.into_iter().collect();
    let mut card = |finding| card(finding, &mut said);
    let shown = grade.findings.iter().filter(|f| !f.is_of_others() && !f.is_section());
    let (faults, others): (Vec<_>, Vec<_>) = shown.partition(|f| f.is_fault());
    let (passed, remarks): (Vec<_>, Vec<_>) = others.into_iter().partition(|f| f.passed);
    html! {
        @if !faults.is_empty() { h2 { "What is wrong" } }
        @for finding in faults { (card(finding)) }
        @if !remarks.is_empty() { h2 { "Remarks, which cost nothing" } }
        @for finding in remarks { (card(finding)) }
        @if !passed.is_empty() {
            details {
                summary { "What is as it should be (" (passed.len()) ")" }
                @for finding in passed { (card(finding)) }
            }
        }
    }
}

fn card<'a>(finding: &'a Finding, said: &mut HashSet<&'a str>) -> Markup {
    let is_new = !finding.advice.is_empty() && said.insert(&finding.advice);
    html! {
        div.card.(kind(finding)) {
            h3 {
                (finding.check)
                @if let Some(section) = finding.section { span.section { (section) } }
            }
            dl {
                @if !finding.expected.is_empty() { dt { "expected" } dd { (finding.expected) } }
                dt { "found" } dd { (finding.found) }
                @if let Some(p_value) = finding.p_value {
                    dt { "by chance" } dd { (by_chance(p_value)) }
                }
            }
            @if is_new { p { (finding.advice) } }
        }
    }
}

/// How odd what was found is, in words.
fn by_chance(p_value: f64) -> String {
    match 100.0 * p_value {
        percent if percent >= 0.5 => format!("{percent:.0} of 100 correct ones look as odd"),
        _ => format!("hardly any correct one looks as odd, {}", chance(p_value)),
    }
}

fn kind(finding: &Finding) -> &'static str {
    match (finding.passed, finding.weight) {
        (true, _) => "passed",
        (false, Weight::Remark) => "remark",
        (false, _) => "fault",
    }
}
