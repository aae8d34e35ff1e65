//! One step of the reference done in another way, and what is stored then: by the same tracer, which is
//! given another reading, other materials, other normals, or other random numbers.

use std::cell::{Cell, RefCell};
use std::ops::Range;

use glam::Vec3;

use crate::reading::{Reading, TangentBasis};
use crate::tracer;
use fast::lanes::LaneTracer;
use fast::lanes::width::Width;
use model::facets::facets;
use photon_list::record::ABSENT;
use photon_mapping::assignment8;
use photon_mapping::photon_list::PhotonRecord;
use photon_mapping::random::photon_random;
use photon_mapping::rendering::photon_mapping_renderer::{PathVertex, PhotonMappingRenderer};
use photon_mapping::scene::Material;
use photon_mapping::scene::MeshObject;
use photon_mapping::scene::Scene;
use photon_mapping::scene::ray::Ray;
use photon_mapping::scene::triangle::Triangle;

/// How far above the wall a photon starts that leaves along its normal, in world units.
const ABOVE: f32 = 1e-5;
/// How many facets the assignment's scene has.
pub const FACETS: usize = 12;

/// What decides whether a photon is scattered.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Roulette {
    /// The largest channel of the diffuse response: the handout's.
    #[default]
    Largest,
    /// The mean of its channels.
    Mean,
    /// Its red channel.
    Red,
    /// The smallest of its channels: in this scene, blue everywhere.
    Smallest,
    /// Its luminance, by the weights of ITU-R BT.709.
    Luminance,
    /// This chance, on every material; with 1, every photon is scattered.
    Constant(f32),
}

/// How a direction over the surface is sampled.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Hemisphere {
    /// In proportion to the cosine: the handout's.
    #[default]
    Cosine,
    /// Evenly.
    Uniform,
    /// With r = u1 instead of its square root, normalised.
    NoSquareRoot,
}

/// One step, or none, of the reference done in another way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Variation {
    /// How the handout is read where it leaves something open.
    pub reading: Reading,
    /// What decides whether a photon is scattered.
    pub roulette: Roulette,
    /// How a direction over the surface is sampled.
    pub hemisphere: Hemisphere,
    /// Whether directions from the light come from the whole cube.
    pub cube_directions: bool,
    /// Whether photons that come directly from the light are stored.
    pub direct_stored: bool,
    /// Whether photons leave along the normal where t and b are not numbers, as where a safe normalisation leaves
    /// them at zero.
    pub zero_frame: bool,
    /// Whether normals point to the other side.
    pub flipped_normal: bool,
    /// How many bounces fewer than allowed.
    pub fewer_bounces: i32,
    /// How often a photon may bounce at most, whatever is allowed.
    pub most_bounces: i32,
    /// For each facet, the part of its scattered photons that meet it again, by rounding.
    pub self_hits: [f32; FACETS],
}

impl Default for Variation {
    fn default() -> Self {
        Self {
            reading: Reading::REFERENCE,
            roulette: Roulette::Largest,
            hemisphere: Hemisphere::Cosine,
            cube_directions: false,
            direct_stored: false,
            zero_frame: false,
            flipped_normal: false,
            fewer_bounces: 0,
            most_bounces: i32::MAX,
            self_hits: [0.0; FACETS],
        }
    }
}

impl Variation {
    /// Whether the fast path can trace it: it knows readings, materials and normals.
    pub fn is_fast(&self) -> bool {
        self.hemisphere == Hemisphere::Cosine
            && self.reading.tangent_basis != TangentBasis::Transposed
            && !self.cube_directions
            && !self.direct_stored
            && self.self_hits == [0.0; FACETS]
            && !self.makes_nan()
    }

    /// Whether the frame of the right wall has columns that are not numbers.
    fn makes_nan(&self) -> bool {
        self.reading.tangent_frame(Vec3::NEG_X).is_nan()
    }
}

/// P_r of every facet.
pub fn survival_of_facets() -> [f32; FACETS] {
    let scene = assignment8::create_scene();
    let mut survivals = [0.0; FACETS];
    for (of_facet, triangles) in survivals.iter_mut().zip(facets(&scene)) {
        let material = &scene.mesh_objects()[triangles[0].parent_mesh_object].material;
        *of_facet = survival(material.base_diffuse_reflection(), Roulette::Largest);
    }
    survivals
}

/// Traces photons of the assignment's scene under one variation.
#[derive(Clone, Debug)]
pub struct Simulation {
    variation: Variation,
    renderer: PhotonMappingRenderer,
    /// P_r of every facet, before self-hits are accounted for.
    survival: Vec<f32>,
}

impl Simulation {
    /// The run of `emitted` photons with `seed` under `variation`, where photons may bounce
    /// `max_bounces` times.
    pub fn new(variation: Variation, seed: u64, emitted: u64, max_bounces: i32) -> Self {
        let scene = assignment8::create_scene();
        // A mesh object for every facet, so that each can have a material of its own.
        let mut mesh_objects: Vec<MeshObject> = Vec::new();
        let mut triangles = Vec::new();
        let mut survivals = Vec::new();
        let turn = if variation.flipped_normal { -1.0 } else { 1.0 };
        for facet in facets(&scene) {
            let index = mesh_objects.len();
            let of_model = &scene.mesh_objects()[facet[0].parent_mesh_object];
            let diffuse = of_model.material.base_diffuse_reflection();
            let survival = survival(diffuse, variation.roulette);
            // Of those that survive, some meet their surface again and have to survive once more.
            let self_hits = variation.self_hits[index];
            let leaves = survival * (1.0 - self_hits) / (1.0 - survival * self_hits);
            let material = Material::new(Vec3::splat(leaves));
            mesh_objects.push(MeshObject { name: of_model.name.clone(), material });
            survivals.push(survival);
            triangles.extend(facet.iter().map(|triangle| Triangle {
                normal: turn * triangle.normal,
                parent_mesh_object: index,
                ..*triangle
            }));
        }
        let survival = survivals;
        let varied = Scene::new(mesh_objects, triangles, scene.lights().to_vec());
        let mut renderer = assignment8::create_renderer(varied);
        renderer.seed = seed;
        renderer.photon_count = emitted;
        renderer.max_photon_bounces =
            (max_bounces - variation.fewer_bounces).min(variation.most_bounces);
        Self { variation, renderer, survival }
    }

    /// How many photons all lights send out.
    pub fn emitted(&self) -> u64 {
        self.renderer.emitted()
    }

    /// What the photons numbered `photons` store, on this thread: path after path. The column `surface`
    /// has the facet.
    pub fn trace(&self, photons: Range<u64>) -> Vec<PhotonRecord> {
        let reading = self.variation.reading;
        let frame = |normal| reading.tangent_frame(normal);
        let lanes =
            || LaneTracer::with_frames(&self.renderer, Width::widest(), frame, reading.offset);
        match self.variation.is_fast().then(lanes).flatten() {
            Some(lanes) => lanes.trace_piece(photons),
            None => {
                self.trace_one_by_one(photons, |photon| photon_random(self.renderer.seed, photon))
            }
        }
    }

    /// As [`Self::trace`], but with `numbers`, each in [0, 1), one after another for all photons: as a
    /// program has it that knows nothing of streams.
    pub fn trace_with(
        &self,
        photons: Range<u64>,
        numbers: impl Iterator<Item = f32>,
    ) -> Vec<PhotonRecord> {
        let numbers = RefCell::new(numbers);
        let next = || numbers.borrow_mut().next().expect("a generator does not end");
        self.trace_one_by_one(photons, |_| next)
    }

    fn trace_one_by_one<R: FnMut() -> f32>(
        &self,
        photons: Range<u64>,
        generator: impl Fn(u64) -> R,
    ) -> Vec<PhotonRecord> {
        let mut records = Vec::new();
        let lights = self.renderer.stored_scene.lights();
        let (light, intensity) = (&lights[0], lights[0].color / self.renderer.emitted() as f32);
        let (mut photon_map, mut path) = (Vec::new(), Vec::new());
        for photon in photons {
            let mut rand = generator(photon);
            let photon_ray = if self.variation.cube_directions {
                let cube = [0; 3].map(|_| 2.0 * rand() - 1.0);
                Ray::new(light.position, Vec3::from_array(cube).normalize())
            } else {
                light.generate_random_photon_ray(&mut rand)
            };
            photon_map.clear();
            path.clear();
            path.push(PathVertex::Light);
            let draws = Cell::new(0);
            let mut varied_rand = || {
                draws.set(draws.get() + 1);
                // At every hit the roulette's number is drawn first, then u1, then u2.
                if draws.get() % 3 == 2 { self.vary_u1(rand()) } else { rand() }
            };
            let mut ray = photon_ray;
            loop {
                let before = path.len();
                let bounces = (before - 1) as i32;
                tracer::trace_photon(
                    &self.renderer,
                    &self.variation.reading,
                    &mut photon_map,
                    ray,
                    intensity,
                    &mut path,
                    self.renderer.max_photon_bounces - bounces,
                    &mut varied_rand,
                );
                let is_zero = self.variation.zero_frame && path.len() > before;
                match path.last().and_then(|vertex| self.along_parallel(vertex)) {
                    Some(along_normal) if is_zero && draws.get() % 3 == 0 => ray = along_normal,
                    _ => break,
                }
            }
            let has_scattered_last = draws.get() % 3 == 0 && draws.get() > 0;
            let mut to_light = -photon_ray.ray_direction();
            let mut bounce = 0;
            for (place, vertex) in path.iter().enumerate().skip(1) {
                let PathVertex::Surface(state) = vertex else {
                    unreachable!("a path has one light, at its start");
                };
                let facet = state.primitive(&self.renderer.stored_scene).parent_mesh_object;
                let record = |to_light, bounce| PhotonRecord {
                    position: state.intersection_point(),
                    intensity,
                    to_light,
                    photon: photon as u32,
                    bounce,
                    surface: facet as u16,
                };
                if place > 1 {
                    to_light = photon_map[place - 2].to_light_ray.ray_direction();
                }
                if place > 1 || self.variation.direct_stored {
                    records.push(record(to_light, bounce));
                }
                bounce += 1;
                let again = self.survival[facet] * self.variation.self_hits[facet];
                while again > 0.0 && rand() < again {
                    records.push(record(to_light, bounce));
                    bounce += 1;
                }
            }
            // Where the direction is not a number, the framework's tests find a hit that is not one.
            let mut is_lost = self.variation.makes_nan()
                && !self.variation.zero_frame
                && has_scattered_last
                && path.last().is_some_and(|vertex| self.along_parallel(vertex).is_some());
            while is_lost {
                let position = Vec3::NAN;
                let photon = photon as u32;
                records.push(PhotonRecord { position, photon, bounce, ..ABSENT });
                bounce += 1;
                is_lost = rand() < self.survival[0];
            }
        }
        records
    }

    /// The u1 with which equations (2) to (6) give the direction that the variation takes for `u1`.
    fn vary_u1(&self, u1: f32) -> f32 {
        match self.variation.hemisphere {
            Hemisphere::Cosine => u1,
            // z = u1, and z = sqrt(1 - u1) of the handout.
            Hemisphere::Uniform => 1.0 - u1 * u1,
            // (u1, sqrt(1 - u1)) normalised; the square of its first is the u1 that gives it.
            Hemisphere::NoSquareRoot => u1 * u1 / (u1 * u1 + 1.0 - u1),
        }
    }

    /// The ray that leaves `vertex` along its normal, if that is one along which the frame has no length.
    fn along_parallel(&self, vertex: &PathVertex) -> Option<Ray> {
        let PathVertex::Surface(state) = vertex else { return None };
        let normal = state.compute_normal(&self.renderer.stored_scene);
        let start = state.intersection_point() + ABOVE * normal;
        (normal.x.abs() > 0.999).then(|| Ray::new(start, normal))
    }
}

fn survival(diffuse: Vec3, roulette: Roulette) -> f32 {
    match roulette {
        Roulette::Largest => diffuse.max_element(),
        Roulette::Mean => diffuse.element_sum() / 3.0,
        Roulette::Red => diffuse.x,
        Roulette::Smallest => diffuse.min_element(),
        Roulette::Luminance => diffuse.dot(Vec3::new(0.2126, 0.7152, 0.0722)),
        Roulette::Constant(chance) => chance,
    }
}
