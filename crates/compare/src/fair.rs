//! A fair way to do the assignment, and what is stored then: the draws in another order, another
//! frame, another start of the scattered ray, positions stored a little off the surface.

use glam::Vec3;

use crate::explain::{Departure, Ending, Hit, Sample, Story, hit, light_of, survival};
use crate::measured_frame::MeasuredFrame;
use crate::tries::Tries;
use photon_mapping::random::photon_random;
use photon_mapping::rendering::sampling::sample_hemisphere;
use photon_mapping::scene::ray::{IntersectionState, Ray};
use variants::frame::Frame;
use variants::run::Run;
use variants::section::Section;

/// Which of the three numbers of a hit is the roulette's, u1 and u2.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct HitDraws {
    /// The places of the roulette's number, u1 and u2 among the draws.
    pub order: [usize; 3],
    /// Whether 1 - u1 takes the place of u1.
    pub complement: bool,
}

/// A shift of a point, in world units.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Shift {
    /// Along the normal of the surface.
    pub along_normal: f32,
    /// Back along the ray that came in.
    pub back: f32,
}

/// A fair way to do the assignment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fair {
    /// The numbers of the emission.
    pub tries: Tries,
    /// The numbers of a hit.
    pub draws: HitDraws,
    /// The frame around the normal.
    pub frame: Frame,
    /// How that is turned, where it is none of the known ones.
    pub measured: Option<MeasuredFrame>,
    /// How far the start of the scattered ray is from where the reference has it.
    pub start: Shift,
    /// How far positions are stored from the hit.
    pub stored: Shift,
}

/// Where a photon hits, in world space.
#[derive(Clone, Copy, Debug)]
pub struct HitPoint {
    /// The point.
    pub point: Vec3,
    /// The normal there.
    pub normal: Vec3,
    /// The direction of the photon.
    pub incoming: Vec3,
}

impl HitPoint {
    /// Where the scattered ray starts.
    pub(crate) fn start(&self, shift: Shift) -> Vec3 {
        self.point + shift.vector(self.normal, self.incoming)
    }
}

/// The start is moved this far along the ray as well, so that no rounding lets it meet the surface
/// it leaves. World units for the handout's scene; it changes no path.
const AHEAD: f32 = 2e-5;

impl Shift {
    fn is_none(self) -> bool {
        self == Self::default()
    }

    /// The vector for a hit with `normal` and the incoming direction `incoming`.
    pub(crate) fn vector(self, normal: Vec3, incoming: Vec3) -> Vec3 {
        self.along_normal * normal - self.back * incoming
    }

    /// An upper bound of its length.
    pub fn length(self) -> f32 {
        self.along_normal.abs() + self.back.abs()
    }
}

impl Fair {
    /// What `run` itself does; nothing where its reading is no fair one.
    pub fn of(run: &Run) -> Option<Self> {
        Some(Self {
            tries: Tries::REFERENCE,
            draws: HitDraws { order: [0, 1, 2], complement: false },
            frame: Frame::of(&run.reading)?,
            measured: None,
            start: Shift::default(),
            stored: Shift::default(),
        })
    }

    /// The story of photon `photon` of `run` under this reading; nothing when the run has no such
    /// photon.
    pub fn story(&self, run: &Run, photon: u64) -> Option<Story> {
        let (light_index, light, _) = light_of(run, photon)?;
        let mut rand = photon_random(run.renderer.seed, photon);
        let tries = self.tries.until_taken(&mut rand);
        let direction = tries[tries.len() - 1].normalize();
        let mut ray = Ray::new(light.position, direction);
        let mut hits: Vec<Hit> = Vec::new();
        let mut ending = Ending::LeftTheScene;
        for bounce in 0..=run.renderer.max_photon_bounces.max(0) as usize {
            let mut state = IntersectionState::new();
            if !run.scene().trace(&ray, Some(&mut state)) {
                break;
            }
            let (roulette, sample) = self.scatter(run, &state, &mut rand);
            hits.push(hit(run, bounce, &state, roulette, sample));
            let Some(sample) = sample else {
                ending = Ending::Absorbed;
                break;
            };
            if bounce as i64 == i64::from(run.renderer.max_photon_bounces) {
                ending = Ending::BounceLimit;
            }
            ray = self.next_ray(run, &state, sample);
        }
        let tries = tries.into_iter().map(|point| point.to_array()).collect();
        let emission = Departure { light: light_index, tries, direction: direction.to_array() };
        Some(Story { photon, seed: run.renderer.seed, emission, hits, ending })
    }

    /// What photon `photon` of `run` hits first.
    pub fn first_hit(&self, run: &Run, photon: u64) -> Option<HitPoint> {
        let (_, light, _) = light_of(run, photon)?;
        let tries = self.tries.until_taken(&mut photon_random(run.renderer.seed, photon));
        let incoming = tries[tries.len() - 1].normalize();
        let mut state = IntersectionState::new();
        let ray = Ray::new(light.position, incoming);
        run.scene().trace(&ray, Some(&mut state)).then(|| HitPoint {
            point: run.placement.to_world(state.intersection_point()),
            normal: state.compute_normal(run.scene()),
            incoming,
        })
    }

    fn scatter(
        &self,
        run: &Run,
        state: &IntersectionState,
        rand: &mut impl FnMut() -> f32,
    ) -> (f32, Option<Sample>) {
        let [place, of_u1, of_u2] = self.draws.order;
        let mut numbers = [0.0; 3];
        // As the roulette decides, so many are drawn.
        numbers[..=place].fill_with(&mut *rand);
        let roulette = numbers[place];
        if roulette >= survival(run, state) {
            return (roulette, None);
        }
        numbers[place + 1..].fill_with(rand);
        let (u1, u2) = (numbers[of_u1], numbers[of_u2]);
        let u1 = if self.draws.complement { 1.0 - u1 } else { u1 };
        let normal = state.compute_normal(run.scene());
        let known = self.frame.matrix(normal);
        let frame = self.measured.map_or(known, |measured| known * measured.turn(normal));
        (roulette, Some(Sample { u1, u2, frame, local: sample_hemisphere(u1, u2) }))
    }

    fn next_ray(&self, run: &Run, state: &IntersectionState, sample: Sample) -> Ray {
        let scene = run.scene();
        let normal = state.compute_normal(scene);
        let direction = (sample.frame * sample.local).normalize();
        let point = state.intersection_point();
        let needed = scene.offset(state.intersected_primitive, point, state.intersection_t);
        let mut start = run.reading.offset.start(point, normal, direction, needed);
        if !self.start.is_none() {
            let scale = 1.0 / run.placement.length_to_world(1.0);
            let shift = self.start.vector(normal, state.intersection_ray.ray_direction());
            start += scale * shift + AHEAD * direction;
        }
        let mut ray = Ray::new(start, direction);
        ray.start_error = run.reading.offset.start_error(needed);
        ray
    }

    /// The positions that are stored for `story`, in world space.
    pub fn stored(&self, story: &Story) -> Vec<Vec3> {
        let hits = story.hits.windows(2);
        hits.map(|pair| {
            let incoming = pair[0].direction.map_or(Vec3::ZERO, Vec3::from_array);
            pair[1].point() + self.stored.vector(Vec3::from_array(pair[1].normal), incoming)
        })
        .collect()
    }

    /// What is done in another way than in `run`, each with its section of the handout.
    pub fn changes(&self, run: &Run) -> Vec<(Section, String)> {
        let Some(base) = Self::of(run) else { return Vec::new() };
        let mut changes = Vec::new();
        let mut add = |section, what| changes.push((section, what));
        if self.tries.order != base.tries.order {
            let names = named(self.tries.order, ["x", "y", "z"]);
            add(Section::PhotonEmission, format!("in each try, {names} drawn in this order"));
        }
        let turned: Vec<_> = ["x", "y", "z"]
            .into_iter()
            .zip(self.tries.turned)
            .filter_map(|(name, is_turned)| is_turned.then_some(name))
            .collect();
        if !turned.is_empty() {
            let what = format!("{} as 1 - 2u in place of 2u - 1", turned.join(", "));
            add(Section::PhotonEmission, what);
        }
        if self.draws.order != base.draws.order {
            let names = named(self.draws.order, ["the roulette's number", "u1", "u2"]);
            let what = format!("at each hit, {names} drawn in this order");
            add(Section::HemisphereSampling, what);
        }
        if self.draws.complement {
            add(Section::HemisphereSampling, "1 - u1 in place of u1".to_owned());
        }
        let transformation = Section::HemisphereRayTransformation;
        for change in self.frame.changes(&base.frame, &normals(run)) {
            add(transformation, change);
        }
        if self.measured.is_some() {
            add(transformation, "another frame of unit vectors around the normal".to_owned());
        }
        if let Some(change) = self.start_change(run) {
            add(transformation, change);
        }
        if let Some(name) = shift_name(self.stored) {
            add(Section::PhotonStorage, format!("positions stored {name}"));
        }
        changes
    }

    fn start_change(&self, run: &Run) -> Option<String> {
        if self.start.is_none() {
            return None;
        }
        let along_normal = self.start.along_normal + needed(run);
        let shift = Shift { along_normal, ..self.start };
        // What is left of the reference's own offset is rounding.
        Some(match shift_name(shift) {
            Some(name) => format!("offset {name}"),
            None => "offset along the new direction".to_owned(),
        })
    }
}

/// The different normals of the run's scene.
pub fn normals(run: &Run) -> Vec<Vec3> {
    let mut normals: Vec<Vec3> = Vec::new();
    for triangle in run.scene().triangles() {
        if normals.len() < 64 && !normals.iter().any(|n| n.abs_diff_eq(triangle.normal, 1e-5)) {
            normals.push(triangle.normal);
        }
    }
    normals
}

/// The offset of the run itself along the normal, in world units: what a typical hit needs.
pub fn needed(run: &Run) -> f32 {
    let scene = run.scene();
    let Some(triangle) = scene.triangles().first() else { return 0.0 };
    let zero = Vec3::ZERO;
    let needed = scene.offset(0, triangle.vertices[0], 1.0);
    let start = run.reading.offset.start(zero, Vec3::Z, zero, needed);
    run.placement.length_to_world(start.z)
}

fn named(order: [usize; 3], names: [&str; 3]) -> String {
    let mut drawn = [""; 3];
    for (place, name) in order.into_iter().zip(names) {
        drawn[place] = name;
    }
    drawn.join(", ")
}

/// `1e-3 along the normal`, and the like; nothing for a shift that is rounding.
fn shift_name(shift: Shift) -> Option<String> {
    let one = |length: f32, way: &str| {
        (length.abs() >= 5e-6).then(|| format!("{} {way}", two_digits(length.abs())))
    };
    let parts: Vec<_> = [
        one(
            shift.along_normal,
            if shift.along_normal < 0.0 { "below" } else { "along the normal" },
        ),
        one(shift.back, if shift.back < 0.0 { "on along the ray" } else { "back along the ray" }),
    ]
    .into_iter()
    .flatten()
    .collect();
    (!parts.is_empty()).then(|| parts.join(" and "))
}

/// `length` with two digits, as a student may have written it.
fn two_digits(length: f32) -> String {
    let rounded: f32 = format!("{length:.1e}").parse().unwrap_or(length);
    format!("{rounded:e}")
}
