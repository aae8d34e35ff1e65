//! The fast path: many photons side by side, to the bits of
//! [`PhotonMappingRenderer::trace_photon`]. Nobody needs to read this to understand photon mapping.
//!
//! A wave of photons takes each step together:
//!
//! - `emission` draws their directions in the lanes of the processor's vectors.
//! - `outlook` tells what a photon from a light may meet, and `first_hit` what it meets. Directions
//!   are divided into `cells`, and `occlusion` finds the triangles of each.
//! - [`closest_hit`] tells what a scattered photon meets.
//! - `scattering` gives those that survive the roulette a new direction.
//! - `wave` is the loop around them.
//!
//! [`picture`] traces camera rays and `shadows` in the same way. `views` and `neighborhood` tell it
//! what need not be asked. [`width`] chooses the vector instructions when the program runs.
//!
//! **How the two paths stay the same.** `trace_photon` is the specification. This module may only
//! do the same roundings in another order.
//!
//! - It calls what can be shared: the edge functions, the frame of a surface, the offset of a ray,
//!   the shares of the lights. Where a lane is in doubt, it traces that photon with scalar code.
//! - What it must write again is small, one formula a file. A test compares each with the scalar
//!   code by bits, for all inputs where there are few enough.
//! - `crates/variants/tests/lanes.rs` traces random scenes, lights, seeds, ranges and bounces
//!   through both paths at every width, and compares records by bits.
//! - Every run traces a sample of its photons both ways ([`crate::trace`]).
//!
//! If you change `trace_photon`, these tests fail until you make the same change here.

mod axes;
mod cells;
pub mod chacha;
pub mod closest_hit;
mod draws;
mod emission;
mod first_hit;
mod neighborhood;
mod occlusion;
pub mod offset;
mod outlook;
pub mod picture;
pub mod rays;
mod scattering;
mod shadows;
mod trigonometry;
mod views;
mod wave;
pub mod width;

use std::ops::Range;

use glam::{Mat3, Vec3};
use photon_mapping::photon_list::PhotonRecord;
use photon_mapping::rendering::photon_mapping_renderer::PhotonMappingRenderer;
use photon_mapping::rendering::sampling::tangent_frame;
use photon_mapping::scene::point_light::PointLight;
use photon_mapping::scene::triangle::Triangle;

use closest_hit::SharedCorners;
use offset::Offset;
use outlook::Outlook;
use wave::Wave;
use width::Width;

/// Scenes with more triangles than this are traced one ray at a time, with the scene's tree.
///
/// Nanoseconds for the closest hit of a ray that leaves one of many boxes in a room, in lanes and
/// with the tree (AVX-512 and AVX2, Zen 4; `benches/speed.rs`):
///
/// - 24 triangles: 17 and 36
/// - 48 triangles: 39 and 42
/// - 64 triangles: 42 and 42
/// - 96 triangles: 126 and 46
/// - 128 triangles: 120 and 51
///
/// Beyond the tie lanes still win. They also draw the numbers of many photons at once, which one
/// ray at a time cannot.
pub const MOST_TRIANGLES: usize = 128;

/// Traces the photons of one renderer in lanes.
#[derive(Clone, Debug)]
pub struct LaneTracer<'renderer> {
    renderer: &'renderer PhotonMappingRenderer,
    seed: u64,
    width: Width,
    corners: SharedCorners,
    surfaces: Vec<LaneSurface>,
    offset: Offset,
    /// What each light sees.
    outlooks: Vec<Outlook>,
}

/// A part of the way of a wave.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// Photons draw their directions, and those that may go on are sorted out.
    Emission,
    /// What these meet first.
    FirstHit,
    /// The numbers for roulette and scattering that the first block did not have.
    Numbers,
    /// Roulette, and the direction after it.
    Scattering,
    /// What scattered photons meet.
    LaterHits,
    /// The records of what is stored, in order.
    Records,
}

/// What a photon needs to know of a triangle that it hits.
#[derive(Clone, Copy, Debug)]
struct LaneSurface {
    mesh_object: u16,
    probability_of_reflection: f32,
    /// The columns of [`tangent_frame`], one after another.
    frame: [f32; 9],
}

impl LaneSurface {
    fn new(renderer: &PhotonMappingRenderer, triangle: &Triangle, frame: Mat3) -> Option<Self> {
        let mesh_object = &renderer.stored_scene.mesh_objects()[triangle.parent_mesh_object];
        Some(Self {
            mesh_object: u16::try_from(triangle.parent_mesh_object).ok()?,
            probability_of_reflection: mesh_object.material.base_diffuse_reflection().max_element(),
            frame: frame.to_cols_array(),
        })
    }
}

impl<'renderer> LaneTracer<'renderer> {
    /// Prepares `renderer`'s scene for vectors of `width`. `None` when the scene or the run is too
    /// large for lanes.
    pub fn new(renderer: &'renderer PhotonMappingRenderer, width: Width) -> Option<Self> {
        Self::with_frames(renderer, width, tangent_frame, Offset::AsNeeded)
    }

    /// As [`Self::new`], for photons that leave a surface with the unit normal n through the matrix
    /// `tangent_frame(n)`, whose last column must be n, from a start at `offset`.
    pub fn with_frames(
        renderer: &'renderer PhotonMappingRenderer,
        width: Width,
        tangent_frame: impl Fn(Vec3) -> Mat3,
        offset: Offset,
    ) -> Option<Self> {
        let scene = &renderer.stored_scene;
        if scene.triangles().len() > MOST_TRIANGLES || renderer.emitted() > 1 << 32 {
            return None;
        }
        let surface = |triangle: &Triangle| {
            LaneSurface::new(renderer, triangle, tangent_frame(triangle.normal))
        };
        let surfaces: Vec<LaneSurface> =
            scene.triangles().iter().map(surface).collect::<Option<_>>()?;
        let reflection: Vec<f32> = surfaces.iter().map(|s| s.probability_of_reflection).collect();
        let outlook = |light: &PointLight| Outlook::new(scene, light.position, &reflection);
        Some(Self {
            renderer,
            seed: renderer.seed,
            width,
            corners: SharedCorners::new(scene),
            surfaces,
            offset,
            outlooks: scene.lights().iter().map(outlook).collect(),
        })
    }

    /// Traces with `seed` from now on. To find out anew what lights see takes longer than thousands
    /// of photons.
    pub fn set_seed(&mut self, seed: u64) {
        self.seed = seed;
    }

    /// Traces the photons numbered `photons` on this thread: the records of
    /// [`crate::trace::trace_with_port`], bit for bit.
    pub fn trace_piece(&self, photons: Range<u64>) -> Vec<PhotonRecord> {
        self.trace_piece_by_stages(photons, |_, _| ())
    }

    /// As [`Self::trace_piece`]. `done` is told of every part that is done and for how many
    /// photons: see `benches/stages.rs`.
    pub fn trace_piece_by_stages(
        &self,
        photons: Range<u64>,
        mut done: impl FnMut(Stage, usize),
    ) -> Vec<PhotonRecord> {
        let mut records = Vec::new();
        let lights = self.renderer.stored_scene.lights();
        let of_lights = self.renderer.photons_of_lights();
        for ((light, outlook), of_light) in lights.iter().zip(&self.outlooks).zip(of_lights) {
            let photons = of_light.start.max(photons.start)..of_light.end.min(photons.end);
            if !photons.is_empty() {
                let intensity = light.color / (of_light.end - of_light.start) as f32;
                let wave = Wave::new(self, (light, outlook), intensity, &mut done);
                records.append(&mut wave.trace(photons));
            }
        }
        records
    }
}
