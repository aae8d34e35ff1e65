//! Many submissions as one program, which is compiled once: its name says which of them it is.

use std::fs;
use std::path::{Path, PathBuf};
use std::time::Duration;

use super::{faults, handed_in, kit, read, sections_text};
use crate::checking::add_verdicts;
use crate::find::{CppSubmission, LIGHT, RENDERER};
use crate::plan::PlanCounts;
use crate::report::CheckReport;
use crate::run::{Observed, run};
use crate::workshop::Workshop;
use variants::section::Section;

const TIME: Duration = Duration::from_secs(60);
const PHOTONS: u64 = 2000;
/// Directions around an axis, where degrees are no matter.
pub(super) const FEW: u64 = 100_000;

/// A text of `one_function`, and what replaces it.
pub(super) type Change<'a> = (&'a str, &'a str);

/// Sections, and the names of faults in them.
pub(super) type Faults = &'static [(Section, Option<&'static str>)];

/// A program that asks for its name what to do.
pub(super) struct Program {
    pub(super) workshop: Workshop<'static>,
    path: PathBuf,
}

impl Program {
    /// Of what is handed in at `folder`; nothing where there is no compiler.
    pub(super) fn new(folder: &Path) -> Option<Self> {
        let submission = CppSubmission::find(folder).expect("a submission");
        let [light, renderer] = [&submission.light, &submission.renderer]
            .map(|file| file.as_deref().expect("both are there"));
        let workshop = Workshop::new(kit()?, light, renderer, &submission, TIME);
        let workshop = workshop.expect("a workshop");
        let path = workshop.build(2).expect("a compiler").expect("it compiles");
        Some(Self { workshop, path })
    }

    /// What it does under this name, with so many directions around an axis.
    pub(super) fn run(&self, name: &str, around: u64, time: Duration) -> Observed {
        let folder = self.workshop.path().join("runs").join(name);
        fs::create_dir_all(&folder).expect("can be made");
        // A copy could still be open for writing where another test starts a program.
        fs::hard_link(&self.path, folder.join(name)).expect("can be linked");
        let counts = PlanCounts { photons: PHOTONS, around };
        run(&folder.join(name), &folder, counts, time).expect("it runs")
    }

    /// The report on the case with this number.
    pub(super) fn report(&self, case: usize, around: u64) -> CheckReport {
        let mut report = CheckReport::new(&CppSubmission::default(), PHOTONS);
        let observed = self.run(&case.to_string(), around, TIME);
        assert_eq!(observed.before_any, None);
        add_verdicts(observed, &mut report);
        report
    }
}

/// A program for `one_function` with the changes of each case; nothing without a compiler.
pub(super) fn program<'a>(cases: &[impl AsRef<[Change<'a>]>]) -> Option<Program> {
    let folder = tempfile::tempdir().expect("a folder");
    let texts: Vec<_> = cases.iter().map(|changes| changed(changes.as_ref())).collect();
    for (at, name) in [LIGHT, RENDERER].into_iter().enumerate() {
        let texts = texts.iter().map(|files| files[at].1.as_str());
        fs::write(folder.path().join(name), one_of(&texts.collect::<Vec<_>>()))
            .expect("can be written");
    }
    Program::new(folder.path())
}

/// What is wrong where not just these faults are told, and these words among them.
pub(super) fn wrong(report: &CheckReport, expected: Faults, words: &str) -> Option<String> {
    let told = report.sections.iter().flat_map(|verdict| &verdict.faults);
    let told = told.map(|fault| format!("{} -> {}\n", fault.found, fault.advice));
    let is_right = faults(report) == expected && told.collect::<String>().contains(words);
    let found = || format!("expected {expected:?}, {words:?}\n{}", sections_text(report));
    (!is_right).then(found)
}

/// Checks that just these faults are told of each case, and these words among them; the reports.
pub(super) fn tells(cases: &[(&[Change], Faults, &str)]) -> Vec<CheckReport> {
    let changes: Vec<_> = cases.iter().map(|(changes, ..)| *changes).collect();
    let Some(program) = program(&changes) else { return Vec::new() };
    let reports: Vec<_> = (0..cases.len()).map(|case| program.report(case, FEW)).collect();
    let wrong = cases.iter().zip(&reports).filter_map(|((changes, expected, words), report)| {
        Some(format!("{changes:?}: {}", wrong(report, expected, words)?))
    });
    assert_eq!(wrong.collect::<Vec<_>>(), [""; 0]);
    reports
}

/// The two files of `one_function`, with each change's first text replaced by its second.
pub(super) fn changed(changes: &[Change]) -> [(&'static str, String); 2] {
    let mut unused = changes.to_vec();
    let files = [LIGHT, RENDERER].map(|name| {
        let text = read(name);
        unused.retain(|(from, _)| !text.contains(from));
        (name, changes.iter().fold(text, |text, (from, to)| text.replace(from, to)))
    });
    assert!(unused.is_empty(), "{unused:?} is nowhere");
    files
}

/// A file that does what the file does that its program's name is the number of. They have the
/// same functions.
fn one_of(texts: &[&str]) -> String {
    let files: Vec<_> = texts.iter().map(|text| parts(text)).collect();
    let mut lines: Vec<_> = files.iter().flat_map(|parts| parts.includes.iter()).collect();
    let mut seen = std::collections::BTreeSet::new();
    lines.retain(|line| seen.insert(**line));
    let mut whole: String = lines.iter().map(|line| format!("{line}\n")).collect();
    whole += &fs::read_to_string(handed_in().join("hostile/name.h")).expect("a header");
    whole += "static const int chosen = std::atoi(name_of_program());\n";
    // Where two are alike, the first stands for both.
    let first_like = |case: usize, is_like: &dyn Fn(usize) -> bool| {
        (0..case).find(|other| is_like(*other)).unwrap_or(case)
    };
    let own_of = |case: usize| first_like(case, &|other| files[other].own == files[case].own);
    for (case, parts) in files.iter().enumerate().filter(|(case, _)| own_of(*case) == *case) {
        whole += &format!("namespace of_{case} {{\n{}\n}}\n", parts.own);
    }
    for (at, (head, _)) in files[0].functions.iter().enumerate() {
        whole += &format!("{head}\n{{\n");
        let body = |case: usize| (files[case].functions[at].1, own_of(case));
        for case in 0..files.len() {
            let like = first_like(case, &|other| body(other) == body(case));
            if like == case {
                let is_like = |other: &usize| body(*other) == body(case);
                let numbers = (case..files.len()).filter(is_like);
                let is_one: Vec<_> = numbers.map(|number| format!("chosen == {number}")).collect();
                let (text, own) = body(case);
                whole += &format!(
                    "if ({}) {{\nusing namespace of_{own};\n{text}\n}}\n",
                    is_one.join(" || ")
                );
            }
        }
        whole += "}\n";
    }
    whole
}

/// A file, taken apart.
struct Parts<'a> {
    includes: Vec<&'a str>,
    /// What else stands before the first function.
    own: String,
    /// What stands before the body of each function, and the body.
    functions: Vec<(&'a str, &'a str)>,
}

fn parts(text: &str) -> Parts<'_> {
    let (before, rest) = text.split_once("\n\n").expect("a line between headers and functions");
    let (includes, own): (Vec<_>, Vec<_>) =
        before.lines().partition(|line| line.starts_with("#include"));
    let functions = rest.split_terminator("\n}\n").map(|function| {
        function.split_once("\n{\n").unwrap_or_else(|| panic!("no body in {function}"))
    });
    Parts { includes, own: own.join("\n"), functions: functions.collect() }
}
