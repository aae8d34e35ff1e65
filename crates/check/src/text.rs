//! The report as people read it.

use std::fmt::Write as _;

use crate::report::Report;
use crate::sections::{Status, Verdict};

/// The report as text, without its first line, which is the grade's.
pub fn text(report: &Report) -> String {
    let mut text = String::new();
    let mut line = |words: String| writeln!(text, "{words}").expect("a string takes everything");
    line(format!("  builds: {}", report.builds.sentence()));
    for verdict in &report.sections {
        section(verdict, &mut line);
    }
    if !report.sections.is_empty() {
        line(format!("  the whole: {}", report.whole.sentence()));
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
