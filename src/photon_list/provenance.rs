//! What the header of a PLY list says of the run that wrote it.

use std::fs::File;
use std::io::{BufRead, BufReader, Read};
use std::path::Path;

/// No header of ours is longer.
const LONGEST_HEADER: u64 = 65_536;

/// The run that wrote a list.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Provenance {
    /// The key of all random numbers.
    pub seed: u64,
    /// How many photons all lights sent out.
    pub emitted: u64,
    /// How often a photon might bounce.
    pub max_bounces: i32,
}

/// What the comments of the PLY file `path` say; `None` when they say nothing, as in a CSV file or
/// one of another program.
pub fn provenance(path: &Path) -> Option<Provenance> {
    let file = File::open(path).ok()?;
    // What a pipe has given once it does not give again.
    if !file.metadata().ok()?.is_file() {
        return None;
    }
    BufReader::new(file)
        .take(LONGEST_HEADER)
        .lines()
        .map_while(Result::ok)
        .take_while(|line| line.trim_end() != "end_header")
        .find_map(|line| parse(&line))
}

fn parse(line: &str) -> Option<Provenance> {
    let words: Vec<&str> = line.split_whitespace().collect();
    let ["comment", "seed", seed, "emitted", emitted, "max_bounces", max_bounces] = *words else {
        return None;
    };
    Some(Provenance {
        seed: seed.parse().ok()?,
        emitted: emitted.parse().ok()?,
        max_bounces: max_bounces.parse().ok()?,
    })
}
