//! Which run a list or a summary belongs to, and which part of it.

use std::ops::Range;

use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

use crate::assignment8;
use crate::rendering::photon_mapping_renderer::PhotonMappingRenderer;

/// A part of a run. Two parts belong together when all but `range` is the same.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Run {
    /// The version of the program.
    pub version: String,
    /// The key of all random numbers.
    pub seed: u64,
    /// How many photons the whole run sends out.
    pub emitted: u64,
    /// How often a photon may bounce.
    pub max_bounces: i32,
    /// 16 hexadecimal digits that name scene, lights and reading.
    pub scene: String,
    /// The photons of this part.
    pub range: Range<u64>,
}

impl Run {
    /// The photons `range` of the run of `renderer`.
    pub fn new(renderer: &PhotonMappingRenderer, range: Range<u64>) -> Self {
        let digest = scene_digest(renderer);
        Self {
            version: env!("CARGO_PKG_VERSION").to_owned(),
            seed: renderer.seed,
            emitted: renderer.emitted(),
            max_bounces: renderer.max_photon_bounces,
            scene: digest.into_iter().map(|byte| format!("{byte:02x}")).collect(),
            range,
        }
    }

    /// Whether it is a run of the handout's scene, with the reference's reading.
    pub fn is_of_assignment8(&self) -> bool {
        let reference = assignment8::create_renderer(assignment8::create_scene());
        self.scene == Self::new(&reference, 0..0).scene
    }

    /// The run as lines of a PLY header's comments.
    pub fn comments(&self) -> Vec<String> {
        let Self { version, seed, emitted, max_bounces, scene, range } = self;
        vec![
            format!("photon-mapping {version}"),
            format!("seed {seed} emitted {emitted} max_bounces {max_bounces}"),
            format!("scene {scene}"),
            format!("range {}..{}", range.start, range.end),
        ]
    }

    /// The run that [`Self::comments`] were written for; `None` when a line is missing.
    pub fn from_comments(comments: &[String]) -> Option<Self> {
        let line = |name: &str| {
            comments.iter().map(|c| c.split(' ').collect::<Vec<_>>()).find(|w| w[0] == name)
        };
        let run = line("seed")?;
        let [_, seed, "emitted", emitted, "max_bounces", max_bounces] = run[..] else {
            return None;
        };
        let (start, end) = line("range")?.get(1)?.split_once("..")?;
        Some(Self {
            version: (*line("photon-mapping")?.get(1)?).to_owned(),
            seed: seed.parse().ok()?,
            emitted: emitted.parse().ok()?,
            max_bounces: max_bounces.parse().ok()?,
            scene: (*line("scene")?.get(1)?).to_owned(),
            range: start.parse().ok()?..end.parse().ok()?,
        })
    }

    /// The part that `parts` make up together; `Err` names the two neighbours that do not fit, by
    /// their places in `parts`, and says why. `order` is sorted as the parts follow each other.
    pub fn join(parts: &[Self], order: &mut [usize]) -> Result<Self, (usize, usize, String)> {
        order.sort_by_key(|part| (parts[*part].range.start, parts[*part].range.end));
        for pair in order.windows(2) {
            let (before, after) = (&parts[pair[0]], &parts[pair[1]]);
            let moved = Self { range: before.range.clone(), ..after.clone() };
            let (end, start) = (before.range.end, after.range.start);
            let message = if moved != *before {
                "belong to different runs".to_owned()
            } else if end < start {
                format!("leave a gap: the photons {end}..{start} are missing")
            } else if end > start {
                format!("overlap in the photons {start}..{}", end.min(after.range.end))
            } else {
                continue;
            };
            return Err((pair[0], pair[1], message));
        }
        let (first, last) = (order[0], order[order.len() - 1]);
        Ok(Self { range: parts[first].range.start..parts[last].range.end, ..parts[first].clone() })
    }
}

/// The start of the SHA-256 of everything but the seed and the counts that decides where photons go.
fn scene_digest(renderer: &PhotonMappingRenderer) -> [u8; 8] {
    let scene = &renderer.stored_scene;
    let mut hash = Sha256::new();
    // The debug format of floats has as many digits as bring back the same bits.
    hash.update(format!("{:?} {:?}", scene.mesh_objects(), scene.lights()));
    hash.update(format!("{:?} {:?}", renderer.reading, renderer.sampler));
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
