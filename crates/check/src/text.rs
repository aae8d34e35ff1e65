//! The report as people read it.

use std::fmt::Write as _;

use crate::report::{Builds, Report};
use crate::sections::{Status, Verdict};

/// The report as text.
pub fn text(report: &Report) -> String {
    let mut text = format!("{}\n", report.submission);
    let mut line = |words: String| writeln!(text, "{words}").expect("a string takes everything");
    match &report.builds {
        Builds::Yes => line("  builds: yes".to_owned()),
        Builds::MissingFile { file } => line(format!("  builds: no, there is no file {file}")),
        Builds::EndsAtOnce { what } => line(format!(
            "  builds: yes, but the program {what} before any function of the assignment is called: look at \
             static variables and their constructors"
        )),
        Builds::No(error) => {
            let place = match (&error.file, error.line) {
                (Some(file), Some(number)) => format!("{file}:{number}: "),
                _ => String::new(),
            };
            line(format!("  builds: no\n    {place}{}", error.message));
            if let Some(missing) = &error.missing {
                line(format!("    `{missing}` is declared in no file you handed in"));
            }
        }
    }
    for verdict in &report.sections {
        section(verdict, &mut line);
    }
    if !report.sections.is_empty() {
        let whole = &report.whole;
        match (&whole.death, whole.stored) {
            (Some(death), _) => line(format!("  the whole: {death}")),
            (None, Some(stored)) => {
                line(format!("  the whole: {stored} photons stored, {} sent out", whole.photons));
            }
            (None, None) => line("  the whole: not reached".to_owned()),
        }
    }
    for remark in &report.remarks {
        line(format!("  remark: {remark}"));
    }
    text
}

fn section(verdict: &Verdict, line: &mut impl FnMut(String)) {
    let title = verdict.section.title();
    let status = match verdict.status {
        Status::Right => "right".to_owned(),
        Status::RightUnderAnotherReading => {
            format!("right under another fair reading: {}", verdict.readings.join("; "))
        }
        Status::Wrong => "WRONG".to_owned(),
        Status::NotReached => "not reached".to_owned(),
    };
    line(format!("  {title}: {status}"));
    for fault in &verdict.faults {
        let name = fault.name.map(|name| format!("{name}: ")).unwrap_or_default();
        line(format!("    {name}{}", fault.found));
        line(format!("    -> {}", fault.advice));
    }
    for remark in &verdict.remarks {
        line(format!("    remark: {remark}"));
    }
}
