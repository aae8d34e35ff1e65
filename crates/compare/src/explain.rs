//! The whole story of one photon: every draw and what it was for, every hit and what came of it.
//!
//! There is no second tracer: the story is what `trace_photon` did, told
//! from its path and from the numbers it drew.

use std::cell::RefCell;
use std::fmt::Write as _;

use glam::{Mat3, Vec3};
use serde::Serialize;

use photon_mapping::random::photon_random;
use photon_mapping::rendering::photon_mapping_renderer::PathVertex;
use photon_mapping::rendering::sampling::sample_hemisphere;
use photon_mapping::scene::point_light::PointLight;
use photon_mapping::scene::ray::IntersectionState;
use variants::run::Run;

/// How a photon's path ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Ending {
    /// The roulette ended it at its last hit.
    Absorbed,
    /// It flew on and met nothing.
    LeftTheScene,
    /// It would have scattered, but had bounced as often as it may.
    BounceLimit,
}

/// The story of one photon. Positions and directions are in world space.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Story {
    /// The photon's number, counted from 0 over all lights.
    pub photon: u64,
    /// The key of the run's random numbers.
    pub seed: u64,
    /// How it left its light.
    pub emission: Departure,
    /// Every surface it hit, in order.
    pub hits: Vec<Hit>,
    /// Why there is no further hit.
    pub ending: Ending,
}

/// How a photon leaves its light.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Departure {
    /// Which light, in the scene's order.
    pub light: usize,
    /// Every x, y, z that was tried; the last one was taken.
    pub tries: Vec<[f32; 3]>,
    /// The unit direction taken.
    pub direction: [f32; 3],
}

/// One surface hit, and what was decided there.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Hit {
    /// How often the photon had bounced before: 0 for the hit straight from the light.
    pub bounce: usize,
    /// The name of the mesh object hit.
    pub surface: String,
    /// Its place in the model file, as in the column `surface` of a list.
    pub surface_index: usize,
    /// Which face of that mesh object.
    pub facet: usize,
    /// The distance along the ray.
    pub t: f32,
    /// The point hit.
    pub position: [f32; 3],
    /// The unit normal there.
    pub normal: [f32; 3],
    /// The number that decided between scattering and absorption.
    pub roulette: f32,
    /// P_r: below it, the photon scatters.
    pub survival: f32,
    /// Whether it did.
    pub scattered: bool,
    /// Whether the photon was stored here.
    pub stored: bool,
    /// Why it was stored or not.
    pub why: &'static str,
    /// The first number of the hemisphere sample, if the photon scattered; so for all that follow.
    pub u1: Option<f32>,
    /// The second one.
    pub u2: Option<f32>,
    /// The tangent t, as long as it was used.
    pub tangent: Option<[f32; 3]>,
    /// The bitangent b.
    pub bitangent: Option<[f32; 3]>,
    /// The unit direction in which the photon leaves.
    pub direction: Option<[f32; 3]>,
}

/// Traces photon `photon` of `run`'s run again and tells what happens; `None` when the run has
/// no such photon.
pub fn explain(run: &Run, photon: u64) -> Option<Story> {
    let (light, point_light, light_photons) = light_of(run, photon)?;
    let draws = RefCell::new(Vec::new());
    let mut rand = photon_random(run.renderer.seed, photon);
    let mut logged_rand = || {
        let number = rand();
        draws.borrow_mut().push(number);
        number
    };
    let photon_ray = point_light.generate_random_photon_ray(&mut logged_rand);
    let emission_draws = draws.borrow().len();
    let intensity = point_light.color / light_photons as f32;
    let path = run.trace_photon(&photon_ray, intensity, &mut logged_rand);

    let draws = draws.into_inner();
    let (emission_draws, path_draws) = draws.split_at(emission_draws);
    let mut path_draws = path_draws.iter().copied();
    let states = path.iter().filter_map(|vertex| match vertex {
        PathVertex::Light => None,
        PathVertex::Surface(state) => Some(state),
    });
    let hits: Vec<_> = states
        .enumerate()
        .map(|(bounce, state)| {
            let mut next = || path_draws.next().expect("every hit draws its numbers");
            let roulette = next();
            let scattered = roulette < survival(run, state);
            let sample = scattered.then(|| {
                let (u1, u2) = (next(), next());
                let frame = run.reading.tangent_frame(state.compute_normal(run.scene()));
                Sample { u1, u2, frame, local: sample_hemisphere(u1, u2) }
            });
            hit(run, bounce, state, roulette, sample)
        })
        .collect();
    let ending = match hits.last() {
        Some(last) if !last.scattered => Ending::Absorbed,
        Some(last) if last.bounce as i64 == i64::from(run.renderer.max_photon_bounces) => {
            Ending::BounceLimit
        }
        _ => Ending::LeftTheScene,
    };
    let tries = emission_draws.chunks_exact(3).map(|xyz| [0, 1, 2].map(|i| 2.0 * xyz[i] - 1.0));
    let emission = Departure {
        light,
        tries: tries.collect(),
        direction: photon_ray.ray_direction().to_array(),
    };
    Some(Story { photon, seed: run.renderer.seed, emission, hits, ending })
}

/// The first photon from `start` on that stores at least `stored` photons; `None` when the run has
/// none.
pub fn first_that_stores(run: &Run, start: u64, stored: usize) -> Option<u64> {
    (start..run.renderer.emitted())
        .find(|photon| run.trace_piece(*photon..photon + 1).len() >= stored)
}

/// The index of the light that emits `photon`, the light, and how many photons it emits.
pub(crate) fn light_of(run: &Run, photon: u64) -> Option<(usize, &PointLight, u64)> {
    let lights = run.scene().lights().iter().zip(run.renderer.photons_of_lights());
    let mut lights = lights.enumerate();
    let (index, (light, photons)) = lights.find(|(_, (_, photons))| photons.contains(&photon))?;
    Some((index, light, photons.end - photons.start))
}

/// How a photon leaves a hit.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sample {
    /// The first number of the hemisphere sample.
    pub u1: f32,
    /// The second one.
    pub u2: f32,
    /// From tangent space to world space.
    pub frame: Mat3,
    /// The direction in tangent space.
    pub local: Vec3,
}

/// P_r at the hit `state`.
pub(crate) fn survival(run: &Run, state: &IntersectionState) -> f32 {
    let scene = run.scene();
    let mesh_object = &scene.mesh_objects()[state.primitive(scene).parent_mesh_object];
    mesh_object.material.base_diffuse_reflection().max_element()
}

/// The hit `state`, which the number `roulette` decides; with `sample` the photon scatters.
pub(crate) fn hit(
    run: &Run,
    bounce: usize,
    state: &IntersectionState,
    roulette: f32,
    sample: Option<Sample>,
) -> Hit {
    let scene = run.scene();
    let triangle = state.primitive(scene);
    let mesh_object = &scene.mesh_objects()[triangle.parent_mesh_object];
    let direction = sample.map(|sample| (sample.frame * sample.local).normalize().to_array());
    let world = &run.placement;
    Hit {
        bounce,
        surface: mesh_object.name.clone(),
        surface_index: triangle.parent_mesh_object,
        facet: triangle.facet,
        t: world.length_to_world(state.intersection_t),
        position: world.to_world(state.intersection_point()).to_array(),
        normal: state.compute_normal(scene).to_array(),
        roulette,
        survival: survival(run, state),
        scattered: sample.is_some(),
        stored: bounce > 0,
        why: if bounce > 0 { "it has bounced" } else { "it comes straight from the light" },
        u1: sample.map(|sample| sample.u1),
        u2: sample.map(|sample| sample.u2),
        tangent: sample.map(|sample| sample.frame.x_axis.to_array()),
        bitangent: sample.map(|sample| sample.frame.y_axis.to_array()),
        direction,
    }
}

impl Story {
    /// The story as text, in the order in which it happened. Floats have as few digits as bring
    /// back the same bits.
    pub fn text(&self) -> String {
        let mut text = format!("photon {} of seed {}\n\nemission\n", self.photon, self.seed);
        let mut line = |name: &str, value: String| {
            writeln!(text, "  {name:<11}{value}").expect("a string takes everything");
        };
        for (index, xyz) in self.emission.tries.iter().enumerate() {
            let [x, y, z] = *xyz;
            let length_squared = x * x + y * y + z * z;
            let is_last = index + 1 == self.emission.tries.len();
            let verdict = if is_last { "taken" } else { "rejected" };
            let sum = format!("x2 + y2 + z2 = {length_squared}: {verdict}");
            line(&format!("try {}", index + 1), format!("{}  {sum}", vector(xyz)));
        }
        line("direction", vector(&self.emission.direction));
        for hit in &self.hits {
            text += &hit.text();
        }
        let ending = match self.ending {
            Ending::Absorbed => "the photon is absorbed",
            Ending::LeftTheScene => "the photon leaves the scene",
            Ending::BounceLimit => "the photon has bounced as often as it may",
        };
        text + "\n" + ending + "\n"
    }
}

impl Hit {
    fn text(&self) -> String {
        let Self { bounce, surface, facet, t, roulette, survival, .. } = self;
        let mut text = format!("\nbounce {bounce}: {surface}, facet {facet}, t = {t}\n");
        let mut line = |name: &str, value: String| {
            writeln!(text, "  {name:<11}{value}").expect("a string takes everything");
        };
        line("point", vector(&self.position));
        line("normal", vector(&self.normal));
        line("stored", format!("{}: {}", if self.stored { "yes" } else { "no" }, self.why));
        let (sign, decision) = if self.scattered { ("<", "scatters") } else { (">=", "absorbed") };
        line("roulette", format!("{roulette} {sign} P_r {survival}: {decision}"));
        let scattering = (self.u1, self.u2, self.tangent, self.bitangent, self.direction);
        if let (Some(u1), Some(u2), Some(tangent), Some(bitangent), Some(direction)) = scattering {
            line("u1, u2", format!("{u1}, {u2}"));
            line("tangent", vector(&tangent));
            line("bitangent", vector(&bitangent));
            line("direction", vector(&direction));
        }
        text
    }

    /// The point hit.
    pub fn point(&self) -> Vec3 {
        Vec3::from_array(self.position)
    }
}

/// `(x, y, z)` with as few digits as bring back the same bits.
pub fn vector(xyz: &[f32; 3]) -> String {
    let [x, y, z] = xyz;
    format!("({x}, {y}, {z})")
}
