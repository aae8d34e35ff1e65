//! To which section of the handout does a difference belong?

use glam::Vec3;

use super::fair::Fair;
use super::fair_search::LONGEST_OFFSET;
use super::known::KnownRun;
use super::position_index::is_near;
use super::tries::other_emissions;
use super::verdict_of_direction::judge_direction;
use crate::explain::{Ending, Hit, Story};
use photon_mapping::photon_list::PhotonRecord;
use photon_mapping::rendering::sampling::CLOSE_TO_PARALLEL;
use variants::section::Section;

/// What a difference is put down to.
#[derive(Clone, Debug, PartialEq)]
pub struct Cause {
    /// The section of the handout.
    pub section: Section,
    /// What speaks for it, as a clause.
    pub reason: String,
    /// Whether the one photon looked at leaves no other plausible explanation.
    pub is_certain: bool,
}

/// One place at which the lists part.
#[derive(Clone, Copy, Debug)]
pub struct Parting<'run> {
    /// What the reference did.
    pub story: &'run Story,
    /// The bounce of the record that differs.
    pub bounce: usize,
    /// The submission's record; none when it is missing.
    pub submission: Option<&'run PhotonRecord>,
    /// Whether the record is known to be this photon's; otherwise it only stands in its place.
    pub is_same_photon: bool,
    /// Whether the submission's directions to the light can be trusted.
    pub has_true_to_light: bool,
    /// The reference's run.
    pub known: &'run KnownRun<'run>,
    /// How far apart two positions may be that count as one, in world units.
    pub tolerance: f32,
}

pub(crate) fn certain(section: Section, reason: impl Into<String>) -> Cause {
    Cause { section, reason: reason.into(), is_certain: true }
}

pub(crate) fn guess(section: Section, reason: impl Into<String>) -> Cause {
    Cause { section, reason: reason.into(), is_certain: false }
}

impl Parting<'_> {
    /// A verdict without doubt if the record is this photon's.
    pub(crate) fn sure(&self, section: Section, reason: impl Into<String>) -> Cause {
        Cause { section, reason: reason.into(), is_certain: self.is_same_photon }
    }

    /// How far the start of a ray may be from the hit, in world units.
    fn reach(&self) -> f32 {
        let run = self.known.run;
        LONGEST_OFFSET * run.size() + 20.0 * self.tolerance
    }

    /// Points from which rays start where it is forgotten to set their position.
    fn forgotten_starts(&self) -> [(Vec3, &'static str); 2] {
        let run = self.known.run;
        let light = run.scene().lights()[self.story.emission.light].position;
        [
            (run.placement.to_world(light), "the scattered ray starts at the light again"),
            (Vec3::ZERO, "the scattered ray starts at (0, 0, 0)"),
        ]
    }
}

/// Names the section in which the submission did something else than the reference.
pub fn judge(observation: &Parting) -> Cause {
    let Parting { story, bounce, tolerance, .. } = *observation;
    let Some(record) = observation.submission else {
        return judge_missing(observation);
    };
    let Some(first) = story.hits.first() else {
        return judge_emission(observation, true);
    };
    // Where lists number bounces in different ways, the path may be shorter than the number says.
    let previous = &story.hits[bounce.clamp(1, story.hits.len()) - 1];
    if !record.position.is_finite() {
        return judge_not_finite(Some(previous));
    }
    let to_light = unit(record.to_light).filter(|_| observation.has_true_to_light);
    if is_near(record.position, first.point(), tolerance) {
        let emission = Vec3::from_array(story.emission.direction);
        let comes_from_light = to_light.map(|to_light| to_light.dot(emission).abs() > 0.9999);
        let reason = "the hit straight from the light is stored";
        return match comes_from_light {
            Some(false) => judge_same_place(observation, first, to_light),
            Some(true) => certain(Section::PhotonStorage, reason),
            None if !first.scattered => certain(Section::PhotonStorage, reason),
            // Were direct hits stored, others would show it without doubt.
            None => Cause { is_certain: false, ..judge_same_place(observation, first, None) },
        };
    }
    if is_near(record.position, previous.point(), tolerance) && previous.scattered {
        return judge_same_place(observation, previous, to_light);
    }
    let way = record.position - previous.point();
    let passes = |start: Vec3| {
        let way = record.position - start;
        to_light.map(|to_light| way.cross(to_light).length() < observation.reach())
    };
    let comes_from_previous = passes(previous.point());
    if let Some(reason) = forgotten_start(observation, previous, comes_from_previous, &passes) {
        return certain(Section::HemisphereRayTransformation, reason);
    }
    if comes_from_previous == Some(false) {
        return judge_other_origin(observation);
    }
    if !previous.scattered {
        let reason = "the submission scatters where the reference absorbs";
        let section = Section::PhotonScatteringAbsorption;
        let is_sure = comes_from_previous == Some(true) || bounce > 1;
        return if is_sure { observation.sure(section, reason) } else { guess(section, reason) };
    }
    if story.ending == Ending::BounceLimit && story.hits.len() == bounce {
        return observation
            .sure(Section::PhotonStorage, "the path goes on beyond the last bounce allowed");
    }
    judge_direction(observation, previous, way).unwrap_or_else(|| {
        let emission = (bounce == 1 && comes_from_previous.is_none())
            .then(|| known_emission(observation))
            .flatten();
        emission.unwrap_or_else(|| {
            guess(Section::HemisphereSampling, "the photon scatters in another direction")
        })
    })
}

/// Where the scattered ray starts if its position was not set: seen by where it points to, or by
/// where it goes.
fn forgotten_start(
    observation: &Parting,
    previous: &Hit,
    comes_from_previous: Option<bool>,
    passes: &dyn Fn(Vec3) -> Option<bool>,
) -> Option<&'static str> {
    let record = observation.submission?;
    observation.forgotten_starts().into_iter().find_map(|(start, reason)| {
        let is_start = match comes_from_previous {
            Some(true) => false,
            Some(false) => observation.bounce == 1 && passes(start) == Some(true),
            None => previous.direction.is_some_and(|direction| {
                let way = (record.position - start).normalize_or_zero();
                way.distance(Vec3::from_array(direction)) < 2e-3
            }),
        };
        is_start.then_some(reason)
    })
}

fn judge_missing(observation: &Parting) -> Cause {
    let max_bounces = observation.known.run.renderer.max_photon_bounces;
    if observation.bounce as i64 == i64::from(max_bounces) {
        return guess(
            Section::PhotonStorage,
            "nothing is stored at the last bounce allowed: the path ends only when \
             remainingBounces is less than 0",
        );
    }
    guess(
        Section::PhotonScatteringAbsorption,
        "the submission absorbs where the reference scatters",
    )
}

/// Whether (1, 0, 0) builds no t at `hit`.
pub(crate) fn has_parallel_normal(hit: &Hit) -> bool {
    hit.normal[0].abs() > CLOSE_TO_PARALLEL
}

/// Judges a position that is no number after the hit `previous`, if that is known.
pub(crate) fn judge_not_finite(previous: Option<&Hit>) -> Cause {
    let section = Section::HemisphereRayTransformation;
    if let Some(hit) = previous.filter(|hit| has_parallel_normal(hit)) {
        let [x, y, z] = hit.normal;
        let reason = format!(
            "the normal ({x}, {y}, {z}) is parallel to (1, 0, 0), so that t has no length, and \
             normalizing it gives NaN"
        );
        return certain(section, reason);
    }
    guess(section, "the submission's position is not a number")
}

/// Judges a photon that met the surface at `hit` again as soon as it left.
fn judge_same_place(observation: &Parting, hit: &Hit, to_light: Option<Vec3>) -> Cause {
    let below = to_light.map(|to_light| -to_light);
    if let Some(down) = below.filter(|down| down.dot(Vec3::from_array(hit.normal)) < -1e-3) {
        let known = judge_direction(observation, hit, down);
        return known.unwrap_or_else(|| {
            let reason = "the photon leaves below the surface";
            observation.sure(Section::HemisphereRayTransformation, reason)
        });
    }
    let reason = format!(
        "the scattered ray met the surface it left ({}): it must start off the surface",
        hit.surface
    );
    certain(Section::HemisphereRayTransformation, reason)
}

/// The submission's photon came from elsewhere than where the reference's bounced last.
fn judge_other_origin(observation: &Parting) -> Cause {
    if observation.bounce > 1 {
        return guess(Section::PhotonStorage, "to_light does not point to the hit before");
    }
    if !observation.is_same_photon {
        return guess(Section::HemisphereSampling, "the photon comes from elsewhere");
    }
    judge_emission(observation, false)
}

/// Judges a photon that left the light in another direction; `is_sure` if nothing else can explain
/// it.
fn judge_emission(observation: &Parting, is_sure: bool) -> Cause {
    if let Some(known) = known_emission(observation) {
        return known;
    }
    let draws = match observation.story.emission.tries.len() - 1 {
        0 => "at the first try".to_owned(),
        1 => "after a rejected try".to_owned(),
        rejected => format!("after {rejected} rejected tries"),
    };
    let reason =
        format!("the photon left the light in another direction than the one taken {draws}");
    let is_certain = is_sure && observation.is_same_photon;
    Cause { section: Section::PhotonEmission, reason, is_certain }
}

/// The misreading of the emission under which the photon is stored just where the submission has
/// it.
fn known_emission(observation: &Parting) -> Option<Cause> {
    let record = observation.submission?;
    let known = observation.known;
    let fair = known.fair()?;
    other_emissions(fair.tries).into_iter().find_map(|(tries, reason)| {
        let other = Fair { tries, ..fair };
        let story = other.story(known.run, observation.story.photon)?;
        let position = *other.stored(&story).first()?;
        is_near(position, record.position, observation.tolerance)
            .then(|| certain(Section::PhotonEmission, reason))
    })
}

/// `vector` if it is a unit vector, as a direction to the light should be.
fn unit(vector: Vec3) -> Option<Vec3> {
    ((vector.length() - 1.0).abs() < 0.01).then_some(vector)
}
