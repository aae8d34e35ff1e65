//! Traces the assignment's scene under one variation.

use std::cell::RefCell;
use std::collections::VecDeque;
use std::ops::Range;

use glam::Vec3;

use crate::variation::{FACETS, Roulette, Start, Variation};
use fast::lanes::LaneTracer;
use fast::lanes::width::Width;
use model::facets::facets;
use photon_list::record::ABSENT;
use photon_mapping::assignment8;
use photon_mapping::photon_list::PhotonRecord;
use photon_mapping::random::photon_random;
use photon_mapping::rendering::photon_mapping_renderer::PhotonMappingRenderer;
use photon_mapping::scene::Material;
use photon_mapping::scene::MeshObject;
use photon_mapping::scene::Scene;
use photon_mapping::scene::ray::{IntersectionState, Ray};
use photon_mapping::scene::triangle::Triangle;

/// How far above the wall a photon starts that leaves along its normal, in world units.
const ABOVE: f32 = 1e-5;

/// P_r of every facet.
pub fn survival_of_facets() -> [f32; FACETS] {
    let scene = assignment8::create_scene();
    let mut survivals = [0.0; FACETS];
    for (of_facet, triangles) in survivals.iter_mut().zip(facets(&scene)) {
        let material = &scene.mesh_objects()[triangles[0].parent_mesh_object].material;
        *of_facet = Roulette::Largest.survival(material.base_diffuse_reflection());
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
            let survival = variation.roulette.survival(diffuse);
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
        let varied = Scene::new(mesh_objects, triangles, scene.lights().to_vec());
        let mut renderer = assignment8::create_renderer(varied);
        renderer.seed = seed;
        renderer.photon_count = emitted;
        let allowed = max_bounces - variation.fewer_bounces;
        renderer.max_photon_bounces = variation.most_bounces.map_or(allowed, |it| it.min(allowed));
        Self { variation, renderer, survival: survivals }
    }

    /// How many photons all lights emit.
    pub fn emitted(&self) -> u64 {
        self.renderer.emitted()
    }

    /// What the photons numbered `photons` store, on this thread: path after path. The column
    /// `surface` has the facet.
    pub fn trace(&self, photons: Range<u64>) -> Vec<PhotonRecord> {
        let frame = |normal| self.variation.tangent_frame(normal);
        let offset = self.variation.reading.offset;
        let lanes = || LaneTracer::with_frames(&self.renderer, Width::widest(), frame, offset);
        match self.variation.is_fast().then(lanes).flatten() {
            Some(lanes) => lanes.trace_piece(photons),
            None => {
                self.trace_one_by_one(photons, |photon| photon_random(self.renderer.seed, photon))
            }
        }
    }

    /// As [`Self::trace`], but with `numbers`, each in [0, 1), one after another for all photons:
    /// as a program has it that knows nothing of streams.
    pub fn trace_with(
        &self,
        photons: Range<u64>,
        numbers: impl Iterator<Item = f32>,
    ) -> Vec<PhotonRecord> {
        let numbers = RefCell::new(numbers);
        let next = || numbers.borrow_mut().next().expect("a generator does not end");
        self.trace_one_by_one(photons, |_| next)
    }

    /// As [`Self::trace`], but with the numbers, each in [0, 1), that `generator` has for a photon.
    pub fn trace_one_by_one<R: FnMut() -> f32>(
        &self,
        photons: Range<u64>,
        generator: impl Fn(u64) -> R,
    ) -> Vec<PhotonRecord> {
        let mut records = Vec::new();
        for photon in photons {
            let mut rand = generator(photon);
            let mut coming = VecDeque::new();
            if self.variation.repeats_numbers {
                // Whoever is given a copy of the generator draws what comes next without using it
                // up.
                self.trace_photon(photon as u32, &mut records, |is_copy, ahead| match is_copy {
                    true => {
                        while coming.len() <= ahead {
                            coming.push_back(rand());
                        }
                        coming[ahead]
                    }
                    false => coming.pop_front().unwrap_or_else(&mut rand),
                });
            } else {
                self.trace_photon(photon as u32, &mut records, |_, _| rand());
            }
        }
        records
    }

    /// Adds what one photon stores. `draw` gives the next number, or, for the sampler of directions
    /// over the surface, its first, second and so on.
    fn trace_photon(
        &self,
        photon: u32,
        records: &mut Vec<PhotonRecord>,
        mut draw: impl FnMut(bool, usize) -> f32,
    ) {
        let Self { variation, renderer, survival } = self;
        let scene = &renderer.stored_scene;
        let light = &scene.lights()[0];
        let intensity = light.color / renderer.emitted() as f32;
        let direction = variation.emission.direction(&mut || draw(false, 0));
        let mut ray = Ray::new(light.position, direction);
        let mut bounce = 0;
        for hit in 0..=renderer.max_photon_bounces {
            let mut state = IntersectionState::new();
            if !scene.trace(&ray, Some(&mut state)) {
                return;
            }
            let facet = state.primitive(scene).parent_mesh_object;
            let material = &scene.mesh_objects()[facet].material;
            let number = draw(false, 0);
            let is_scattered = hit < i32::from(variation.sure_hits)
                || number < material.base_diffuse_reflection().max_element();
            let record = |bounce| PhotonRecord {
                position: state.intersection_point(),
                intensity,
                to_light: -ray.ray_direction(),
                photon,
                bounce,
                surface: facet as u16,
            };
            if variation.storage.stores(bounce, is_scattered) {
                records.push(record(bounce));
            }
            bounce += 1;
            let again = survival[facet] * variation.self_hits[facet];
            while again > 0.0 && draw(false, 0) < again {
                records.push(record(bounce));
                bounce += 1;
            }
            if !is_scattered {
                return;
            }
            let mut ahead = 0;
            let mut of_sampler = || {
                ahead += 1;
                draw(true, ahead - 1)
            };
            let normal = state.compute_normal(scene);
            let frame = variation.tangent_frame(normal);
            let sampled = variation.hemisphere.direction(normal, &frame, number, &mut of_sampler);
            match self.scattered_ray(&state, normal, sampled.normalize()) {
                Some(scattered) => ray = scattered,
                None => {
                    // Where the direction is not a number, the framework's tests find a hit that is
                    // not one.
                    let nowhere = PhotonRecord { position: Vec3::NAN, photon, ..ABSENT };
                    records.push(PhotonRecord { bounce, ..nowhere });
                    while draw(false, 0) < survival[0] {
                        bounce += 1;
                        records.push(PhotonRecord { bounce, ..nowhere });
                    }
                    return;
                }
            }
        }
    }

    /// The ray that leaves the hit of `state` in `direction`, if it is one.
    fn scattered_ray(
        &self,
        state: &IntersectionState,
        normal: Vec3,
        direction: Vec3,
    ) -> Option<Ray> {
        let Self { variation, renderer, .. } = self;
        let scene = &renderer.stored_scene;
        let point = state.intersection_point();
        if direction.is_nan() {
            return variation.zero_frame.then(|| Ray::new(point + ABOVE * normal, normal));
        }
        Some(match variation.start {
            Start::Light => Ray::new(scene.lights()[0].position, direction),
            Start::Zero => Ray::new(Vec3::ZERO, direction),
            Start::Hit => {
                let needed = scene.offset(state.intersected_primitive, point, state.intersection_t);
                let offset = variation.reading.offset;
                let mut ray = Ray::new(offset.start(point, normal, direction, needed), direction);
                ray.start_error = offset.start_error(needed);
                ray
            }
        })
    }
}
