//! Checking one submission from its files to its report.

use std::time::{Duration, Instant};

use compare::differences::Differences;
use compare::report::{Outcome, TOLERANCE, compare};
use grading::text::printable;
use photon_list::reader::PhotonList;
use photon_list::record::Columns;
use photon_mapping::assignment8;
use variants::run::Run;

use crate::error::CheckError;
use crate::events::Notice;
use crate::find::{CppSubmission, LIGHT, RENDERER};
use crate::kit::Kit;
use crate::plan::{CALLS_AROUND, PlanCounts, PlanStep};
use crate::report::{Builds, CheckReport, are_right};
use crate::run::{Observed, run};
use crate::sections;
use crate::workshop::Workshop;

/// The part of the records that rounding may move farther.
const BY_ROUNDING: f32 = 5e-4;

/// How submissions are checked.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CheckSettings {
    /// How much processor time the compiler may use for a file, and the whole run.
    pub time: Duration,
    /// How many photons are emitted in the whole run.
    pub photons: u64,
    /// How many compilers may run at once for one submission.
    pub jobs: usize,
}

impl Default for CheckSettings {
    fn default() -> Self {
        Self { time: Duration::from_secs(60), photons: 200_000, jobs: 1 }
    }
}

/// Compiles and runs `submission`, and judges what it does.
///
/// # Errors
/// When the compiler, the kit or the system is at fault, but not the submission.
pub fn check(
    submission: &CppSubmission,
    kit: &Kit,
    settings: &CheckSettings,
) -> Result<CheckReport, CheckError> {
    let mut report = CheckReport::new(submission, settings.photons);
    let (light, renderer) = match (&submission.light, &submission.renderer) {
        (Some(light), Some(renderer)) => (light, renderer),
        (None, _) => {
            report.builds = Builds::MissingFile { file: LIGHT };
            return Ok(report);
        }
        (_, None) => {
            report.builds = Builds::MissingFile { file: RENDERER };
            return Ok(report);
        }
    };
    let start = Instant::now();
    let workshop = Workshop::new(kit, light, renderer, submission, settings.time)?;
    let built = workshop.build(settings.jobs)?;
    report.seconds[0] = start.elapsed().as_secs_f64();
    let program = match built {
        Ok(program) => program,
        Err(error) => {
            report.builds = Builds::No(error);
            return Ok(report);
        }
    };
    let counts = PlanCounts { photons: settings.photons, around: CALLS_AROUND };
    let observed = run(&program, workshop.path(), counts, settings.time)?;
    report.seconds[1] = observed.seconds;
    if let Some(death) = &observed.before_any {
        let what = death.sentence();
        report.builds = Builds::EndsAtOnce { what };
        return Ok(report);
    }
    let missing = workshop.missing_headers();
    if !missing.is_empty() {
        let names = missing.join(", ");
        report.remarks.push(format!("included, not handed in, and not needed: {names}"));
    }
    add_verdicts(observed, &mut report);
    Ok(report)
}

/// Adds to `report` what is said of `observed`.
pub(crate) fn add_verdicts(observed: Observed, report: &mut CheckReport) {
    report.sections = sections::judge(&observed);
    report.remarks.extend(remarks(&observed));
    add_whole(observed, report);
    if report.whole.is_reference() {
        sections::refute(&mut report.sections);
    } else if are_right(&report.sections)
        && let Some(found) = report.whole.late_roulette()
    {
        sections::add_late_roulette(&mut report.sections, found);
    }
}

fn remarks(observed: &Observed) -> Vec<String> {
    let mut remarks = Vec::new();
    let has = |notice| observed.log.notices.contains(&notice);
    if has(Notice::RandomDevice) {
        remarks.push(
            "std::random_device is read: here it gives the numbers of the photon's stream, so that \
             every run is the same"
                .to_owned(),
        );
    }
    if has(Notice::Process) {
        remarks.push("a process was to be started, which is not allowed here".to_owned());
    }
    if observed.printed_bytes > 0 {
        let first: String =
            observed.printed.lines().next().unwrap_or_default().chars().take(60).collect();
        remarks.push(format!(
            "it prints {} bytes, which start with \"{}\"",
            observed.printed_bytes,
            printable(&first)
        ));
    }
    if has(Notice::NotGuarded) {
        remarks.push(
            "this system has no filter for system calls: run submissions in a container".to_owned(),
        );
    }
    remarks
}

fn add_whole(observed: Observed, report: &mut CheckReport) {
    let death =
        observed.death(PlanStep::Whole).map(|death| format!("the whole run {}", death.sentence()));
    report.whole.death = death;
    let whole = observed.log.whole;
    if whole.is_too_long {
        report.whole.death =
            Some("the whole run stores more than 5,000,000 photons, and is ended".to_owned());
    }
    if let Some([drawn, ..]) = whole.counts {
        report.whole.drawn = Some(drawn);
        report.whole.stored = Some(whole.records.len() as u64);
    }
    let list = PhotonList::of(whole.records);
    let (comparison, remark) = compare_whole(&list, report.whole.photons);
    report.whole.comparison = Some(comparison);
    report.remarks.extend(remark);
    report.list = Some(list);
}

/// `list` beside the reference's of as many photons, under every fair reading. A remark says what
/// differs though the positions are the reference's.
fn compare_whole(list: &PhotonList, photons: u64) -> (compare::report::Report, Option<String>) {
    let run = Run::handout(assignment8::SEED, photons);
    let reference = PhotonList { columns: list.columns, records: run.records(0..photons) };
    let tolerance = TOLERANCE * run.size();
    let report = compare(&reference, list, Some(&run), tolerance, BY_ROUNDING);
    let Differences { wrong_intensity, wrong_to_light, .. } = report.differences;
    if report.outcome != Outcome::Different || wrong_intensity + wrong_to_light == 0 {
        return (report, None);
    }
    // Intensity and direction to the light cost nothing.
    let columns = Columns { intensity: false, to_light: false, ..list.columns };
    let list = PhotonList { columns, ..list.clone() };
    let of_positions = compare(&reference, &list, Some(&run), tolerance, BY_ROUNDING);
    if of_positions.outcome == Outcome::Different {
        return (report, None);
    }
    let what = match (wrong_intensity > 0, wrong_to_light > 0) {
        (true, false) => "intensities",
        (false, _) => "directions to the light",
        (true, true) => "intensities and directions to the light",
    };
    let remark = format!("positions are the reference's, {what} are not. It costs nothing.");
    (of_positions, Some(remark))
}
