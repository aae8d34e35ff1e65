//! Which run a list or a summary belongs to, and which part of it.

use std::ops::Range;

use serde::{Deserialize, Serialize};

/// A part of a run. Two parts belong together when all but `range` is the same.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct RunPart {
    /// The version of the program.
    pub version: String,
    /// The key of all random numbers.
    pub seed: u64,
    /// How many photons the whole run emits.
    pub emitted: u64,
    /// How often a photon may bounce.
    pub max_bounces: i32,
    /// 16 hexadecimal digits that name scene, lights and reading.
    pub scene: String,
    /// The photons of this part.
    pub range: Range<u64>,
}

impl RunPart {
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

    /// The part that `parts` make up together; `Err` names the two neighbors that do not fit, by
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
