//! What the submission does in each section of the handout, each by itself.

mod around;
mod directions;
mod emission;
mod limit;
mod sampling;
mod scattering;
mod start;
mod storage;
mod transformation;
mod turns;
mod values;

use serde::Serialize;
use variants::section::Section;

use crate::plan::{COLORS, PlanStep};
use crate::run::{Death, Observed};

const ENDLESS: &str = "Draw again only while x^2 + y^2 + z^2 > 1, with new numbers each time. \
                       Dividing two integers, rand() / RAND_MAX, gives 0, so that x, y and z never \
                       change.";

/// What a section's verdict is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Status {
    /// As the handout asks, and as the reference does it.
    Right,
    /// As the handout asks, in another fair reading than the reference's.
    RightUnderAnotherReading,
    /// Something else.
    Wrong,
    /// Not seen: another section keeps it from being reached.
    NotReached,
}

impl Status {
    /// As people say it.
    pub fn in_words(self) -> &'static str {
        match self {
            Self::Right => "right",
            Self::RightUnderAnotherReading => "right under another fair reading",
            Self::Wrong => "wrong",
            Self::NotReached => "not reached",
        }
    }
}

/// Something wrong in a section.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Fault {
    /// The misreading's name, if it is a known one.
    pub name: Option<&'static str>,
    /// What was seen, with the numbers.
    pub found: String,
    /// What to look at in the code.
    pub advice: &'static str,
}

impl Fault {
    /// What was seen, after its name.
    pub(crate) fn in_words(&self) -> String {
        let name = self.name.map(|name| format!("{name}: ")).unwrap_or_default();
        name + &self.found
    }
}

/// The verdict on one section.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SectionVerdict {
    /// Which section.
    pub section: Section,
    /// The verdict.
    pub status: Status,
    /// The fair readings that it follows, where they are not the reference's.
    pub readings: Vec<String>,
    /// What is wrong.
    pub faults: Vec<Fault>,
    /// What costs nothing, but is worth saying; also why a section was not reached.
    pub remarks: Vec<String>,
}

impl SectionVerdict {
    fn new(section: Section) -> Self {
        let (readings, faults, remarks) = Default::default();
        Self { section, status: Status::Right, readings, faults, remarks }
    }

    /// Whether it is right, under whatever fair reading.
    pub fn is_right(&self) -> bool {
        matches!(self.status, Status::Right | Status::RightUnderAnotherReading)
    }

    /// The status, with the readings that it names.
    pub(crate) fn in_words(&self) -> String {
        let readings = self.readings.join("; ");
        match self.status {
            Status::RightUnderAnotherReading => format!("{}: {readings}", self.status.in_words()),
            status => status.in_words().to_owned(),
        }
    }

    fn fault(&mut self, name: Option<&'static str>, found: String, advice: &'static str) {
        self.faults.push(Fault { name, found, advice });
    }

    fn not_reached(&mut self, why: impl Into<String>) {
        self.status = Status::NotReached;
        self.remarks.push(why.into());
    }

    /// Sets the status by what was found; says how steps died, once for each way. What an earlier
    /// section `told` is not this one's fault, but keeps it from being seen.
    fn finish(
        mut self,
        observed: &Observed,
        function: &str,
        steps: &[PlanStep],
        told: &mut Vec<String>,
    ) -> Self {
        let mut own: Vec<String> = Vec::new();
        let mut is_seen = true;
        for step in steps {
            let Some(death) = observed.death(*step) else { continue };
            // A path without end runs out of stack: that is told already.
            let has_no_limit = self.faults.iter().any(|fault| fault.name == Some("no-limit"));
            if has_no_limit && matches!(step, PlanStep::Remaining(_) | PlanStep::GrowPath) {
                continue;
            }
            let sentence = format!("{function} {}", death.sentence());
            if *death == Death::LeftOut || told.contains(&sentence) {
                is_seen = false;
            } else if !own.contains(&sentence) {
                let found = format!("{sentence} ({})", where_of(*step));
                let advice = match self.section {
                    Section::PhotonEmission if death.is_time_out() => ENDLESS,
                    _ => "Mend this first: what comes after it was not seen.",
                };
                self.faults.push(Fault { name: None, found, advice });
                own.push(sentence);
            }
        }
        told.append(&mut own);
        if !self.faults.is_empty() {
            self.status = Status::Wrong;
        } else if self.status == Status::Right && !is_seen {
            self.not_reached(format!("{function} did not end well in earlier calls"));
        } else if self.status == Status::Right && !self.readings.is_empty() {
            self.status = Status::RightUnderAnotherReading;
        }
        self
    }
}

/// The scene of a step, in words.
fn where_of(step: PlanStep) -> String {
    match step {
        PlanStep::Emit => "4,000 rays from a light".to_owned(),
        PlanStep::AroundLight => "1,500,000 rays from a light".to_owned(),
        PlanStep::EmitCorner => "a point in the corner of the cube is drawn first".to_owned(),
        PlanStep::EmitOnSphere => "a point on the sphere is drawn first".to_owned(),
        PlanStep::EmitZero => "the point (0, 0, 0) is drawn first".to_owned(),
        PlanStep::StoreFirst => "one black wall, a path of length 1".to_owned(),
        PlanStep::StoreLater(path) => format!("one black wall, a path of length {path}"),
        PlanStep::StoreMiss => "a ray that meets nothing".to_owned(),
        PlanStep::Remaining(remaining) => {
            format!("closed white cubes, remainingBounces = {remaining}")
        }
        PlanStep::GrowPath => "closed white cubes, a path of length 1".to_owned(),
        PlanStep::Black => "a wall with P_r = 0".to_owned(),
        PlanStep::White | PlanStep::Around => "a wall with P_r = 1".to_owned(),
        PlanStep::Color(index) => {
            format!("a colored wall with P_r = {}", COLORS[index].max_element())
        }
        PlanStep::GrayCube => "closed cubes with P_r = 0.5".to_owned(),
        PlanStep::Threshold(_) => {
            "a wall with P_r = 0.5, the first number drawn near 0.5".to_owned()
        }
        PlanStep::Floor => "a floor with P_r = 0.5".to_owned(),
        PlanStep::Wall(n) => format!("a wall with the normal ({}, {}, {})", n.x, n.y, n.z),
        PlanStep::Whole => "the handout's scene".to_owned(),
    }
}

/// Tells where a seed is set anew for every photon. Here that changes no number; elsewhere, all
/// photons of a second are then alike.
fn judge_seeds(observed: &Observed, verdict: &mut SectionVerdict) {
    let seeded = |step: PlanStep| {
        let calls = observed.step(step).map_or(&[][..], |log| &log.calls);
        (calls.iter().filter(|call| call.seeded_again > 0).count(), calls.len())
    };
    let is_emission = verdict.section == Section::PhotonEmission;
    let in_light = seeded(PlanStep::Emit);
    let is_in_trace = seeded(PlanStep::Remaining(1)).0 > 0;
    let ((count, total), function) = match (is_emission, is_in_trace) {
        (true, _) if in_light.0 > 0 => (in_light, "GenerateRandomPhotonRay"),
        (true, false) => (seeded(PlanStep::Floor), "GenericPhotonMapGeneration"),
        (false, true) => (seeded(PlanStep::Floor), "TracePhoton"),
        _ => return,
    };
    // A few photons may be the first of something.
    if 8 * count > total {
        let found = format!(
            "{function} calls srand with the same seed again for {count} of {total} photons: \
             random numbers then repeat from photon to photon"
        );
        let advice = "Call srand once, in the constructor of PhotonMappingRenderer.";
        verdict.fault(Some("seeded-again"), found, advice);
    }
}

/// Takes back what a whole run with the reference's photons refutes, and what it shows.
pub fn refute(verdicts: &mut [SectionVerdict]) {
    const SHOWN: [&str; 5] =
        ["never-scatters", "no-roulette", "inverted-roulette", "late-roulette", "numbers-again"];
    for verdict in verdicts {
        let faults = verdict.faults.len();
        verdict.faults.retain(|fault| !fault.name.is_some_and(|name| SHOWN.contains(&name)));
        let is_refuted = verdict.faults.is_empty() && faults > 0;
        if is_refuted || verdict.status == Status::NotReached {
            verdict.status = Status::Right;
            verdict.remarks =
                vec!["TracePhoton alone does not show it, but the whole run does".to_owned()];
        }
    }
}

/// Adds what a whole run alone `found`: the probes see the roulette in few places.
pub fn add_late_roulette(verdicts: &mut [SectionVerdict], found: String) {
    let section = Section::PhotonScatteringAbsorption;
    for verdict in verdicts.iter_mut().filter(|verdict| verdict.section == section) {
        let advice = "Let the same roulette decide at every hit, with P_r of the material hit.";
        verdict.fault(Some("late-roulette"), found.clone(), advice);
        verdict.status = Status::Wrong;
    }
}

/// Judges all five sections.
pub fn judge(observed: &Observed) -> Vec<SectionVerdict> {
    let told = &mut Vec::new();
    let directions = directions::Directions::of(observed);
    vec![
        emission::judge(observed, told),
        storage::judge(observed, told),
        scattering::judge(observed, told),
        sampling::judge(observed, &directions, told),
        transformation::judge(observed, &directions, told),
    ]
}
