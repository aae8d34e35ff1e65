//! The report as people read it.

use std::fmt::Write as _;

use grading::text::verdict_in_words;
use grading::verdict::Grade;

use crate::grade::of_statistics;
use crate::report::CheckReport;
use crate::sections::SectionVerdict;

/// The report and its `grade`, of at most `best` points, as text.
pub fn text(report: &CheckReport, grade: &Grade, best: f64) -> String {
    let verdict = verdict_in_words(grade.verdict);
    let mut text = format!("{}: {verdict}, {} of {best} points\n", grade.submission, grade.score);
    let mut line = |words: String| writeln!(text, "{words}").expect("a string takes everything");
    line(format!("  builds: {}", report.builds.sentence()));
    for verdict in &report.sections {
        section(verdict, &mut line);
    }
    if !report.sections.is_empty() {
        line(format!("  whole run: {}", report.whole.sentence(&report.sections)));
    }
    let statistics: Vec<_> = of_statistics(grade).collect();
    if !statistics.is_empty() {
        let faults: Vec<_> = statistics.iter().filter(|finding| finding.is_fault()).collect();
        line(format!(
            "  statistics: {} of {} checks of the list are as they should be",
            statistics.len() - faults.len(),
            statistics.len()
        ));
        for finding in faults {
            line(format!(
                "    {}: {}; expected {}",
                finding.check, finding.found, finding.expected
            ));
            line(format!("    -> {}", finding.advice));
        }
    }
    for remark in &report.remarks {
        line(format!("  remark: {remark}"));
    }
    text
}

fn section(verdict: &SectionVerdict, line: &mut impl FnMut(String)) {
    line(format!("  {}: {}", verdict.section.title(), verdict.in_words()));
    for fault in &verdict.faults {
        line(format!("    {}", fault.in_words()));
        line(format!("    -> {}", fault.advice));
    }
    for remark in &verdict.remarks {
        line(format!("    remark: {remark}"));
    }
}
