//! A run of the assignment in any scene and under any reading.

use std::convert::Infallible;
use std::ops::Range;

use fast::lanes::LaneTracer;
use fast::lanes::width::Width;
use fast::trace::{self, FirstDifference};
use glam::Vec3;
use model::placement::Placement;
use photon_list::run::RunPart;
use photon_mapping::assignment8;
use photon_mapping::photon_list::{PhotonRecord, records};
use photon_mapping::rendering::photon_mapping_renderer::{
    PathVertex, Photon, PhotonMappingRenderer,
};
use photon_mapping::scene::Scene;
use photon_mapping::scene::ray::Ray;
use sha2::{Digest, Sha256};

use crate::reading::{Reading, TangentBasis};
use crate::sampler::Sampler;
use crate::tracer;

/// Which photons are traced, where, and how the handout is read.
#[derive(Clone, Debug)]
pub struct Run {
    /// Scene, seed and counts. The scene is in its own space.
    pub renderer: PhotonMappingRenderer,
    /// Where the scene stands in the world.
    pub placement: Placement,
    /// How the handout is read where it leaves something open.
    pub reading: Reading,
    /// Where the random numbers come from.
    pub sampler: Sampler,
}

impl Run {
    /// The reference run of the handout's scene with `seed` and `photon_count` photons.
    pub fn handout(seed: u64, photon_count: u64) -> Self {
        let scene = assignment8::create_scene();
        Self::of_scene(scene, Placement::WORLD, seed, photon_count)
    }

    /// The reference run of `scene`, which stands in the world at `placement`. A scene of many
    /// triangles gets a tree.
    pub fn of_scene(mut scene: Scene, placement: Placement, seed: u64, photon_count: u64) -> Self {
        fast::tree::accelerate(&mut scene);
        let renderer = assignment8::create_renderer(scene);
        let renderer = PhotonMappingRenderer { seed, photon_count, ..renderer };
        Self { renderer, placement, reading: Reading::REFERENCE, sampler: Sampler::ChaCha }
    }

    /// The scene, in its own space.
    pub fn scene(&self) -> &Scene {
        &self.renderer.stored_scene
    }

    /// The longest edge of the scene's bounding box, in world units.
    pub fn size(&self) -> f32 {
        let vertices = || self.scene().triangles().iter().flat_map(|triangle| triangle.vertices);
        let low = vertices().fold(Vec3::INFINITY, Vec3::min);
        let high = vertices().fold(Vec3::NEG_INFINITY, Vec3::max);
        self.placement.length_to_world((high - low).max_element())
    }

    /// Whether the port traces it.
    pub fn is_reference(&self) -> bool {
        self.reading == Reading::REFERENCE && self.sampler == Sampler::ChaCha
    }

    /// Traces the photons numbered `photons` on this thread. After each photon, `photon_done` gets
    /// its number, its path and what it stored, in the scene's space.
    pub fn trace_photons(
        &self,
        photons: Range<u64>,
        photon_done: impl FnMut(u64, &[PathVertex], &[Photon]),
    ) {
        let Self { renderer, reading, sampler, .. } = self;
        let mut photon_map = Vec::new();
        if self.is_reference() {
            renderer.generic_photon_map_generation(&mut photon_map, photons, photon_done);
        } else {
            tracer::generic_photon_map_generation(
                renderer,
                reading,
                *sampler,
                &mut photon_map,
                photons,
                photon_done,
            );
        }
    }

    /// The path of a photon that leaves its light on `photon_ray` and then draws from `rand`. Scene
    /// space.
    pub fn trace_photon(
        &self,
        photon_ray: &Ray,
        light_intensity: Vec3,
        rand: &mut impl FnMut() -> f32,
    ) -> Vec<PathVertex> {
        let Self { renderer, reading, .. } = self;
        let (mut photon_map, mut path) = (Vec::new(), vec![PathVertex::Light]);
        let bounces = renderer.max_photon_bounces;
        if *reading == Reading::REFERENCE {
            let map = &mut photon_map;
            renderer.trace_photon(map, photon_ray, light_intensity, &mut path, bounces, rand);
        } else {
            tracer::trace_photon(
                renderer,
                reading,
                &mut photon_map,
                *photon_ray,
                light_intensity,
                &mut path,
                bounces,
                rand,
            );
        }
        path
    }

    /// The records of the photons numbered `photons`, traced one by one on this thread. World
    /// space.
    pub fn trace_piece(&self, photons: Range<u64>) -> Vec<PhotonRecord> {
        let mut list = Vec::new();
        self.trace_photons(photons, |photon, path, stored| {
            list.extend(records(self.scene(), photon, path, stored));
        });
        self.to_world(&mut list);
        list
    }

    /// Traces the photons numbered `photons` on all threads of the current rayon pool, as fast as
    /// it can be done to the same bits, and hands their records (world space) to `consume` in
    /// order, with the number of photons done so far. Gives the difference between the fast path
    /// and the port if there is one; all records are then the port's.
    ///
    /// # Errors
    /// The first error of `consume`, which ends the tracing.
    pub fn trace_list<E: Send>(
        &self,
        photons: Range<u64>,
        mut consume: impl FnMut(&[PhotonRecord], u64) -> Result<(), E> + Send,
    ) -> Result<Option<FirstDifference>, E> {
        if self.is_reference() {
            if self.placement == Placement::WORLD {
                return trace::trace_list(&self.renderer, photons, consume);
            }
            return trace::trace_list(&self.renderer, photons, |records, done| {
                let mut records = records.to_vec();
                self.to_world(&mut records);
                consume(&records, done)
            });
        }
        let lanes = self.lanes();
        let trace = |piece: Range<u64>| match &lanes {
            Some(lanes) => {
                let mut records = lanes.trace_piece(piece);
                self.to_world(&mut records);
                records
            }
            None => self.trace_piece(piece),
        };
        fast::in_order::in_order(
            trace::pieces(&photons),
            |piece| (piece.end, trace(piece)),
            |(end, records)| consume(&records, end - photons.start),
        )?;
        Ok(None)
    }

    /// What the photons numbered `photons` store, traced as by [`Self::trace_list`].
    pub fn records(&self, photons: Range<u64>) -> Vec<PhotonRecord> {
        let mut records = Vec::new();
        let Ok(_) = self.trace_list(photons, |piece, _| {
            records.extend_from_slice(piece);
            Ok::<_, Infallible>(())
        });
        records
    }

    /// Lanes for this run, whose records are in the scene's space; `None` where they cannot trace
    /// it.
    pub fn lanes(&self) -> Option<LaneTracer<'_>> {
        let Self { renderer, reading, sampler, .. } = self;
        // Lanes take the last column of the frame for the normal.
        if *sampler != Sampler::ChaCha || reading.tangent_basis == TangentBasis::Transposed {
            return None;
        }
        let frame = |normal| reading.tangent_frame(normal);
        LaneTracer::with_frames(renderer, Width::widest(), frame, reading.offset)
    }

    fn to_world(&self, records: &mut [PhotonRecord]) {
        if self.placement != Placement::WORLD {
            for record in records {
                record.position = self.placement.to_world(record.position);
            }
        }
    }

    /// What names the photons `range` of this run in files.
    pub fn part(&self, range: Range<u64>) -> RunPart {
        let digest = self.scene_digest();
        RunPart {
            version: env!("CARGO_PKG_VERSION").to_owned(),
            seed: self.renderer.seed,
            emitted: self.renderer.emitted(),
            max_bounces: self.renderer.max_photon_bounces,
            scene: digest.into_iter().map(|byte| format!("{byte:02x}")).collect(),
            range,
        }
    }

    /// The start of the SHA-256 of everything but the seed and the counts that decides where
    /// photons go.
    fn scene_digest(&self) -> [u8; 8] {
        let scene = self.scene();
        let mut hash = Sha256::new();
        // The debug format of floats has as many digits as bring back the same bits.
        hash.update(format!("{:?} {:?}", scene.mesh_objects(), scene.lights()));
        hash.update(format!("{:?} {:?}", self.reading, self.sampler));
        for triangle in scene.triangles() {
            let [a, b, c] = triangle.vertices;
            for vector in [a, b, c, triangle.normal] {
                vector.to_array().iter().for_each(|float| hash.update(float.to_le_bytes()));
            }
            hash.update((triangle.parent_mesh_object as u64).to_le_bytes());
        }
        let digest = hash.finalize();
        std::array::from_fn(|byte| digest[byte])
    }
}

/// Whether `part` is of the reference run of the handout's scene.
pub fn is_of_assignment8(part: &RunPart) -> bool {
    part.scene == Run::handout(0, 1).part(0..0).scene
}
