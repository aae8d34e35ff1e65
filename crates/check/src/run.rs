//! Running the harness: again after every step in which it dies, so that one step never hides
//! another.

use std::ffi::OsString;
use std::ops::Range;
use std::path::Path;
use std::time::{Duration, Instant};

use serde::Serialize;

use crate::error::CheckError;
use crate::events::Log;
use crate::kit::write;
use crate::messages::Reader;
use crate::plan::{self, PlanCounts, PlanStep};
use crate::sandbox::{Exit, Limits, MOST_BYTES, Program, RunOutcome, on_clock};

/// The processor time of a step with a small scene. It needs a thousandth of it.
const PATIENCE: Duration = Duration::from_secs(3);
/// The signal that ends a step whose processor time is used up.
const SIGPROF: i32 = 27;
/// After so many steps that died, the others are left out, except the whole run. One more than the
/// steps that call `TracePhoton` by itself.
const MOST_DEATHS: usize = 8;
/// The memory of a submission, in MiB.
const MEMORY: u64 = 1 << 10;

/// How a step died.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case", tag = "kind")]
pub enum Death {
    /// It did not end in time.
    TimeOut {
        /// The time, in seconds.
        seconds: u64,
    },
    /// By a signal.
    Signal {
        /// Its number.
        signal: i32,
    },
    /// The program ended itself.
    Exit {
        /// With this code.
        code: i32,
    },
    /// The stack overflowed.
    StackOverflow,
    /// It crashed with its memory used up.
    Memory,
    /// It printed too much.
    TooMuchOutput,
    /// It wrote to the pipe of the recorder.
    Forged,
    /// An exception left the function.
    Exception {
        /// What it says.
        what: String,
    },
    /// Earlier steps died too often.
    LeftOut,
}

impl Death {
    pub(crate) fn is_time_out(&self) -> bool {
        matches!(self, Self::TimeOut { .. })
    }

    /// What happened, as the end of a sentence that starts with what was called.
    pub fn sentence(&self) -> String {
        match self {
            Self::TimeOut { seconds } => {
                format!(
                    "does not end within {seconds} s: look for a loop or a recursion without \
                         end"
                )
            }
            Self::Signal { signal } => match *signal {
                6 => "aborts: an assertion fails, or abort() is called".to_owned(),
                8 => "divides an integer by zero".to_owned(),
                9 | 24 => "uses up its time or its memory, and is ended".to_owned(),
                11 => "crashes (segmentation fault): look for a pointer that points \
                       nowhere"
                    .to_owned(),
                25 => "writes a file that is too large, and is ended".to_owned(),
                31 => "calls what is not allowed, and is ended".to_owned(),
                signal => format!("is ended by signal {signal}"),
            },
            Self::Exit { code } => format!("ends the whole program with exit code {code}"),
            Self::StackOverflow => {
                "overflows the stack: look for a recursion without end, or very large local \
                 variables"
                    .to_owned()
            }
            Self::TooMuchOutput => {
                format!("prints more than {} MB, and is ended", MOST_BYTES >> 20)
            }
            Self::Forged => "writes to the pipe that records what it does, and is ended".to_owned(),
            Self::Memory => format!("uses more than {MEMORY} MB of memory"),
            Self::Exception { what } if what.contains("bad_alloc") => Self::Memory.sentence(),
            Self::Exception { what } => format!("throws an exception: {what}"),
            Self::LeftOut => "was not called, since earlier calls did not end well".to_owned(),
        }
    }
}

/// What the submission did in all steps.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Observed {
    /// What it told.
    pub log: Log,
    /// How steps died, by their number.
    pub deaths: Vec<Option<Death>>,
    /// How the program died before its first step.
    pub before_any: Option<Death>,
    /// The start of what it printed itself.
    pub printed: String,
    /// How many bytes it printed.
    pub printed_bytes: u64,
    /// How long it ran, in seconds.
    pub seconds: f64,
}

impl Observed {
    /// The log of a step, if it was begun.
    pub fn step(&self, step: PlanStep) -> Option<&crate::events::StepLog> {
        let number = plan::steps().iter().position(|other| *other == step)?;
        self.log.steps.get(number)
    }

    /// The calls of a step that did not die: calls up to a death are no fair sample.
    pub fn calls(&self, step: PlanStep) -> &[crate::events::Call] {
        match (self.death(step), self.step(step)) {
            (None, Some(log)) => &log.calls,
            _ => &[],
        }
    }

    /// How a step died.
    pub fn death(&self, step: PlanStep) -> Option<&Death> {
        let number = plan::steps().iter().position(|other| *other == step)?;
        self.deaths.get(number)?.as_ref()
    }
}

/// Runs the program `harness` in `folder`. The whole run may take `time` of the processor.
///
/// # Errors
/// When the program cannot be started or the plan cannot be written.
pub fn run(
    harness: &Path,
    folder: &Path,
    counts: PlanCounts,
    time: Duration,
) -> Result<Observed, CheckError> {
    let start = Instant::now();
    let plan_path = folder.join("plan.txt");
    write(&plan_path, plan::file(counts).as_bytes())?;
    let steps = plan::steps();
    let whole = number_of_whole();
    let mut observed = Observed { deaths: vec![None; steps.len()], ..Observed::default() };
    let (mut first, mut end) = (0, steps.len());
    let mut deaths = 0;
    while first < end {
        observed.log.current = None;
        observed.log.stack_overflowed = false;
        observed.log.memory_ran_out = false;
        let has_waited = observed.deaths.iter().flatten().any(Death::is_time_out);
        let small = PATIENCE.min(time);
        // Whoever has waited for an endless loop already waits no longer for the whole.
        let times = Times { small, whole: if has_waited { small } else { time } };
        let outcome = run_from(harness, folder, &plan_path, first..end, times, &mut observed.log)?;
        observed.printed_bytes += outcome.printed_bytes;
        if observed.printed.is_empty() {
            observed.printed = outcome.printed.clone();
        }
        if observed.log.is_complete && !observed.log.is_broken {
            break;
        }
        let death = death_of(&outcome, &observed.log, times.of(&observed.log));
        let Some(current) = observed.log.current else {
            if observed.log.steps.is_empty() {
                observed.before_any = Some(death);
                break;
            }
            // It begins no step, though it did before.
            observed.deaths[first] = Some(death);
            first += 1;
            continue;
        };
        let current = current.clamp(first, end - 1);
        observed.log.is_broken = false;
        let is_endless = death.is_time_out();
        observed.deaths[current] = Some(death);
        deaths += 1;
        first = current + 1;
        if steps[current].is_emission() {
            // One that dies is not called a million times.
            end = end.min(steps.len() - 1);
            // One that never ends ends with no other numbers either.
            while is_endless && first < end && steps[first].is_emission() {
                observed.deaths[first] = Some(Death::LeftOut);
                first += 1;
            }
        }
        if deaths >= MOST_DEATHS && first < whole {
            observed.deaths[first..whole].fill(Some(Death::LeftOut));
            (first, end) = (whole, whole + 1);
        }
    }
    for (death, log) in observed.deaths.iter_mut().zip(&observed.log.steps) {
        let exception = log.calls.iter().find_map(|call| call.exception.clone());
        if let (None, Some(what)) = (&death, exception) {
            *death = Some(Death::Exception { what });
        }
    }
    observed.seconds = start.elapsed().as_secs_f64();
    Ok(observed)
}

fn number_of_whole() -> usize {
    let is_whole = |step: &PlanStep| *step == PlanStep::Whole;
    plan::steps().iter().position(is_whole).expect("it is one of them")
}

/// The processor time that steps may use.
#[derive(Clone, Copy)]
struct Times {
    small: Duration,
    whole: Duration,
}

impl Times {
    /// Of the step that runs.
    fn of(self, log: &Log) -> Duration {
        let is_whole = log.current == Some(number_of_whole());
        if is_whole { self.whole } else { self.small }
    }
}

fn run_from(
    harness: &Path,
    folder: &Path,
    plan_path: &Path,
    steps: Range<usize>,
    times: Times,
    log: &mut Log,
) -> Result<RunOutcome, CheckError> {
    let seconds = |time: Duration| OsString::from(time.as_secs().max(1).to_string());
    let program = Program {
        command: vec![
            harness.into(),
            plan_path.into(),
            steps.start.to_string().into(),
            steps.end.to_string().into(),
            seconds(times.small),
            seconds(times.whole),
        ],
        folder: folder.to_owned(),
        environment: Vec::new(),
        writes: false,
    };
    let time = on_clock(times.small) + on_clock(times.whole);
    // The harness itself counts the processor time of each step.
    let limits = Limits { time, processor: time, memory: MEMORY, file_blocks: 0 };
    let mut reader = Reader::default();
    // One step begins after another; each has its own time.
    let mut step_started = Instant::now();
    let mut last_step = None;
    program.run(limits, |piece| {
        reader.read(piece, log);
        if log.is_broken || log.is_complete {
            return None;
        }
        if log.current != last_step {
            (last_step, step_started) = (log.current, Instant::now());
        }
        Some(on_clock(times.of(log)).saturating_sub(step_started.elapsed()))
    })
}

/// How the step died that had the processor for `time`.
fn death_of(outcome: &RunOutcome, log: &Log, time: Duration) -> Death {
    if log.is_broken {
        return Death::Forged;
    }
    if log.stack_overflowed {
        return Death::StackOverflow;
    }
    if log.memory_ran_out {
        return Death::Memory;
    }
    match outcome.ending {
        Exit::TimeOut => Death::TimeOut { seconds: on_clock(time).as_secs() },
        Exit::Signal(SIGPROF) => Death::TimeOut { seconds: time.as_secs() },
        Exit::TooMuchOutput => Death::TooMuchOutput,
        Exit::Code(code) => Death::Exit { code },
        Exit::Signal(signal) => Death::Signal { signal },
    }
}
