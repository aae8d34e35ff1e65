//! The photon list: every stored photon with its place in the run, its hash, and its PLY file.
//!
//! A list is in order of photon, then bounce. The SHA-256 of its rows names it.

use std::fmt::Write as _;
use std::io::{self, Write};

use glam::Vec3;
use sha2::{Digest, Sha256};

use crate::assignment8;
use crate::rendering::photon_mapping_renderer::{PathVertex, Photon};
use crate::scene::Scene;

/// The columns of a list, in the order in which they are written.
pub const COLUMNS: [&str; 12] = [
    "x",
    "y",
    "z",
    "intensity_r",
    "intensity_g",
    "intensity_b",
    "to_light_x",
    "to_light_y",
    "to_light_z",
    "photon",
    "bounce",
    "surface",
];

/// How many bytes a row takes in binary.
pub const ROW_BYTES: usize = 44;

/// How many rows are put together before they are hashed or written.
const ROWS_AT_ONCE: usize = 256;

/// The most digits of a count in a PLY header: 2^32 - 1 photons that all bounce 1000 times.
const COUNT_DIGITS: usize = 13;

/// A stored photon and its place in the run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PhotonRecord {
    /// The point hit, in world space.
    pub position: Vec3,
    /// The light's color divided by the number of photons it emits.
    pub intensity: Vec3,
    /// The unit direction back to where the photon came from.
    pub to_light: Vec3,
    /// The number of the emitted photon, counted from 0 over all lights.
    pub photon: u32,
    /// How often the photon had bounced before: at least 1.
    pub bounce: u16,
    /// The index of the mesh object hit.
    pub surface: u16,
}

impl PhotonRecord {
    /// The row in binary: nine f32, a u32 and two u16, little-endian, in the order of [`COLUMNS`].
    pub fn to_row(&self) -> [u8; ROW_BYTES] {
        let mut row = [0; ROW_BYTES];
        let floats = [self.position, self.intensity, self.to_light].map(|vector| vector.to_array());
        for (bytes, float) in row.chunks_exact_mut(4).zip(floats.as_flattened()) {
            bytes.copy_from_slice(&float.to_le_bytes());
        }
        row[36..40].copy_from_slice(&self.photon.to_le_bytes());
        row[40..42].copy_from_slice(&self.bounce.to_le_bytes());
        row[42..44].copy_from_slice(&self.surface.to_le_bytes());
        row
    }
}

/// The records of the photon numbered `photon`, which took `path` through `scene` and stored
/// `stored`.
///
/// # Panics
/// When the photon's number, bounce or surface does not fit its column.
pub fn records<'a>(
    scene: &'a Scene,
    photon: u64,
    path: &'a [PathVertex],
    stored: &'a [Photon],
) -> impl Iterator<Item = PhotonRecord> + 'a {
    let photon = u32::try_from(photon).expect("a run has fewer than 2^32 photons");
    let stored_vertices = path.iter().skip(2);
    (1..).zip(stored_vertices.zip(stored)).map(move |(bounce, (vertex, stored))| {
        let PathVertex::Surface(state) = vertex else {
            unreachable!("a path has one light, at its start");
        };
        let surface = state.primitive(scene).parent_mesh_object;
        PhotonRecord {
            position: stored.position,
            intensity: stored.intensity,
            to_light: stored.to_light_ray.ray_direction(),
            photon,
            bounce,
            surface: u16::try_from(surface).expect("a scene has fewer than 2^16 mesh objects"),
        }
    })
}

/// The list of the handout's scene with `seed` and `emitted` photons.
///
/// ```
/// let list = photon_mapping::trace(148, 1000);
/// assert_eq!((list[0].photon, list[0].bounce), (73, 1));
/// ```
pub fn trace(seed: u64, emitted: u64) -> Vec<PhotonRecord> {
    let mut renderer = assignment8::create_renderer(assignment8::create_scene());
    renderer.seed = seed;
    renderer.photon_count = emitted;
    let mut list = Vec::new();
    renderer.generic_photon_map_generation(
        &mut Vec::new(),
        0..renderer.emitted(),
        |photon, path, stored| {
            list.extend(records(&renderer.stored_scene, photon, path, stored));
        },
    );
    list
}

/// The SHA-256 of a list's rows.
#[derive(Clone, Debug, Default)]
pub struct ListHash(Sha256);

impl ListHash {
    /// Adds the rows of `records`.
    pub fn update(&mut self, records: &[PhotonRecord]) {
        for_rows(records, |rows| {
            self.0.update(rows);
            Ok(())
        })
        .expect("hashing cannot fail");
    }

    /// The hash so far, as 64 hexadecimal digits.
    pub fn hex(&self) -> String {
        self.0.clone().finalize().iter().map(|byte| format!("{byte:02x}")).collect()
    }
}

/// The header of a binary PLY list of `count` rows, with a comment line for each of `comments`. Its
/// length does not depend on `count`, so it can be written before the rows are counted.
pub fn ply_header(count: u64, comments: &[String]) -> String {
    let mut header = String::from("ply\nformat binary_little_endian 1.0\n");
    for comment in comments {
        let _ = writeln!(header, "comment {}", comment.replace(['\n', '\r'], " "));
    }
    let count = count.to_string();
    let _ = writeln!(header, "element vertex {count}");
    for name in COLUMNS {
        let kind = match name {
            "photon" => "uint",
            "bounce" | "surface" => "ushort",
            _ => "float",
        };
        let _ = writeln!(header, "property {kind} {name}");
    }
    let padding = ".".repeat(COUNT_DIGITS.saturating_sub(count.len()));
    header + &format!("comment {padding}\nend_header\n")
}

/// Writes the rows of `records` in binary, the body of a PLY list.
///
/// # Errors
/// Those of `output`.
pub fn write_rows(output: &mut impl Write, records: &[PhotonRecord]) -> io::Result<()> {
    for_rows(records, |rows| output.write_all(rows))
}

/// Gives `take` the rows of `records`, many at a time: hashing and writing start slowly for each
/// call.
fn for_rows(
    records: &[PhotonRecord],
    mut take: impl FnMut(&[u8]) -> io::Result<()>,
) -> io::Result<()> {
    for records in records.chunks(ROWS_AT_ONCE) {
        let mut rows = [[0; ROW_BYTES]; ROWS_AT_ONCE];
        rows.iter_mut().zip(records).for_each(|(row, record)| *row = record.to_row());
        take(rows[..records.len()].as_flattened())?;
    }
    Ok(())
}
