//! Real C++, compiled, run and judged.

mod angles;
mod building;
mod cases;
mod causes;
mod hostile;
mod mistakes;
mod other_solutions;
mod styles;
mod styles_of_state;

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;
use std::sync::atomic::{AtomicUsize, Ordering};

use variants::section::Section;

use crate::checking::{CheckSettings, check};
use crate::find::CppSubmission;
use crate::kit::{Kit, write};
use crate::report::CheckReport;
use crate::sections::{SectionVerdict, Status};

use cases::{Change, changed};

/// The kit, made ready once for all tests and kept for the next run of them; nothing, with a
/// message, where there is no compiler or no glm. In CI there must be both.
fn kit() -> Option<&'static Kit> {
    static KIT: OnceLock<Option<Kit>> = OnceLock::new();
    let made = KIT.get_or_init(|| match Kit::kept_in(target().as_deref(), None) {
        Ok(kit) => {
            kit.prepare_for(100);
            Some(kit)
        }
        Err(error) if std::env::var_os("CI").is_some() => panic!("{error}"),
        Err(error) => {
            eprintln!("skipped: {error}");
            None
        }
    });
    made.as_ref()
}

/// Where all tests of the workspace keep the kit: beside the folders of what cargo builds.
fn target() -> Option<PathBuf> {
    Some(std::env::current_exe().ok()?.ancestors().nth(3)?.join("tmp"))
}

/// Does `work` on all of `items`, two at a time: some only wait.
fn two_at_a_time<T: Sync>(items: &[T], work: impl Fn(&T) + Sync) {
    let next = AtomicUsize::new(0);
    let work_on = || {
        while let Some(item) = items.get(next.fetch_add(1, Ordering::Relaxed)) {
            work(item);
        }
    };
    std::thread::scope(|scope| (0..2).for_each(|_| drop(scope.spawn(work_on))));
}

/// The folder of what the tests hand in.
fn handed_in() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests")
}

/// A file of the right solution in one function.
fn read(name: &str) -> String {
    fs::read_to_string(handed_in().join("submissions/one_function").join(name)).expect("a file")
}

/// The report on a submission of these files, in a folder.
fn report_on(files: &[(&str, Vec<u8>)]) -> Option<CheckReport> {
    let kit = kit()?;
    let folder = tempfile::tempdir().expect("a folder");
    for (path, content) in files {
        write(&folder.path().join(path), content).expect("can be written");
    }
    let submission = CppSubmission::find(folder.path()).expect("a submission");
    let settings = CheckSettings { photons: 2000, ..CheckSettings::default() };
    Some(check(&submission, kit, &settings).expect("it can be checked"))
}

/// The report on `one_function`, with each pair's first text replaced by its second.
fn report(changes: &[Change]) -> Option<CheckReport> {
    report_on(&changed(changes).map(|(name, text)| (name, text.into_bytes())))
}

/// What is said of the sections, for messages of tests.
fn sections_text(report: &CheckReport) -> String {
    let line = |verdict: &SectionVerdict| format!("{verdict:#?}");
    report.sections.iter().map(line).collect::<Vec<_>>().join("\n")
}

/// A letter for each section.
fn statuses(report: &CheckReport) -> String {
    let letter = |verdict: &SectionVerdict| match verdict.status {
        Status::Right => '+',
        Status::RightUnderAnotherReading => '~',
        Status::Wrong => 'x',
        Status::NotReached => '?',
    };
    report.sections.iter().map(letter).collect()
}

fn faults(report: &CheckReport) -> Vec<(Section, Option<&'static str>)> {
    let sections = report.sections.iter();
    let faults = sections
        .flat_map(|verdict| verdict.faults.iter().map(|fault| (verdict.section, fault.name)));
    faults.collect()
}
