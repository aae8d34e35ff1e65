//! What the harness tells of the student's code.

use std::collections::BTreeSet;

use glam::Vec3;
use photon_mapping::photon_list::PhotonRecord;

/// The parts of the circle in which directions around an axis are counted.
pub const AROUND_BINS: usize = 720;

/// A question to the scene: what does this ray meet?
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Trace {
    /// Where the ray starts.
    pub from: Vec3,
    /// Its direction, of any length.
    pub direction: Vec3,
    /// Whether it met something.
    pub met: bool,
    /// Whether what it met was asked for, and not only whether it meets something.
    pub has_state: bool,
    /// The distance in units of the direction's length.
    pub t: f32,
    /// The triangle met.
    pub triangle: u16,
}

impl Trace {
    /// The point met.
    pub fn hit(&self) -> Vec3 {
        self.from + self.t * self.direction
    }
}

/// A photon that was stored.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stored {
    /// Its position.
    pub position: Vec3,
    /// Its intensity.
    pub intensity: Vec3,
    /// The direction of its `toLightRay`.
    pub to_light: Vec3,
}

/// One call of the student's code, and what it did.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Call {
    /// The position and direction of the ray that left the light.
    pub emitted: Option<[Vec3; 2]>,
    /// The questions to the scene, in order.
    pub traces: Vec<Trace>,
    /// The photons stored, in order.
    pub stored: Vec<Stored>,
    /// Whether the call came to its end.
    pub ended: bool,
    /// How many random numbers were drawn from the functions that the harness stands behind.
    pub drawn: u32,
    /// How often `srand` or its like was called with a seed that the step has had before.
    pub seeded_again: u32,
    /// What an exception said that ended the call.
    pub exception: Option<String>,
}

impl Call {
    /// The hits of the path: questions for a state that met something.
    pub fn hits(&self) -> impl Iterator<Item = &Trace> {
        self.traces.iter().filter(|trace| trace.has_state && trace.met)
    }

    /// How many rays of the path were traced.
    pub fn rays(&self) -> usize {
        self.traces.iter().filter(|trace| trace.has_state).count()
    }
}

/// How one step went.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct StepLog {
    /// The calls, in order. One that did not end is missing, or the last.
    pub calls: Vec<Call>,
    /// Whether the student's functions have another signature, so that the step was left out.
    pub other_signature: bool,
    /// Directions around x, y and z, in equal parts of the circle. All are 0 where single calls
    /// tell more.
    pub around: Vec<Vec<u32>>,
    /// Whether the step came to its end.
    pub ended: bool,
}

impl StepLog {
    /// The calls that came to their end. Of another, it is not known what it would have done.
    pub fn ended_calls(&self) -> &[Call] {
        let ended = self.calls.iter().take_while(|call| call.ended).count();
        &self.calls[..ended]
    }
}

/// The whole run.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct WholeLog {
    /// What was stored.
    pub records: Vec<PhotonRecord>,
    /// Numbers drawn, photons emitted, rays traced, hits after the first of a path; nothing when
    /// the run did not end.
    pub counts: Option<[u64; 4]>,
    /// Whether more was stored than anyone reads.
    pub is_too_long: bool,
}

impl WholeLog {
    /// Whether each hit after the first of a path is stored, once, and no other.
    pub fn stores_right_hits(&self) -> bool {
        let place = |record: &PhotonRecord| (record.photon, record.bounce);
        let is_once = || self.records.windows(2).all(|pair| place(&pair[0]) != place(&pair[1]));
        let count = self.records.len() as u64;
        count > 0
            && self.counts.is_some_and(|[.., bounced]| bounced == count)
            && self.records.iter().all(|record| record.bounce > 0)
            && is_once()
    }
}

/// Something that is worth saying, and happened at least once.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Notice {
    /// `std::random_device` was read.
    RandomDevice,
    /// A process was to be started.
    Process,
    /// System calls are not filtered on this system.
    NotGuarded,
}

/// All that was told.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Log {
    /// By the number of the step.
    pub steps: Vec<StepLog>,
    /// The whole run.
    pub whole: WholeLog,
    /// What was noticed.
    pub notices: BTreeSet<Notice>,
    /// The step that was begun last.
    pub current: Option<usize>,
    /// Whether all steps ended.
    pub is_complete: bool,
    /// Whether the stack overflowed.
    pub stack_overflowed: bool,
    /// Whether it crashed with its memory used up.
    pub memory_ran_out: bool,
    /// Whether what was told makes no sense.
    pub is_broken: bool,
}
