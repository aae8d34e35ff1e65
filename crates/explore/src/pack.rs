//! Columns of numbers as the page reads them: plane by plane, deflated, in base64.

use std::io::Write as _;

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use flate2::Compression;
use flate2::write::ZlibEncoder;

/// Mantissas do not deflate, whatever the effort, and all else does at once.
const LEVEL: Compression = Compression::new(3);

/// The columns of a page.
#[derive(Debug, Default)]
pub struct PackedColumns {
    /// Name, type and number of entries, in the order of `planes`.
    sections: Vec<(String, &'static str, usize)>,
    /// The bytes: of each column first all lowest bytes, then all second ones, and so on.
    planes: Vec<u8>,
}

impl PackedColumns {
    fn add<const BYTES: usize>(
        &mut self,
        name: impl Into<String>,
        kind: &'static str,
        entries: impl ExactSizeIterator<Item = [u8; BYTES]> + Clone,
    ) {
        self.sections.push((name.into(), kind, entries.len()));
        for plane in 0..BYTES {
            self.planes.extend(entries.clone().map(|bytes| bytes[plane]));
        }
    }

    /// Adds a column of bytes.
    pub fn bytes(&mut self, name: impl Into<String>, column: &[u8]) {
        self.add(name, "u8", column.iter().map(|entry| [*entry]));
    }

    /// Adds a column of 16-bit numbers.
    pub fn shorts(&mut self, name: impl Into<String>, column: &[u16]) {
        self.add(name, "u16", column.iter().map(|entry| entry.to_le_bytes()));
    }

    /// Adds a column of 32-bit numbers.
    pub fn words(&mut self, name: impl Into<String>, column: &[u32]) {
        self.add(name, "u32", column.iter().map(|entry| entry.to_le_bytes()));
    }

    /// Adds a column of floats.
    pub fn floats(&mut self, name: impl Into<String>, column: &[f32]) {
        self.add(name, "f32", column.iter().map(|entry| entry.to_le_bytes()));
    }

    /// Adds three columns of floats, `name` with `_x`, `_y` and `_z`.
    pub fn vectors(&mut self, name: &str, column: &[[f32; 3]]) {
        for (axis, letter) in ["x", "y", "z"].into_iter().enumerate() {
            let entries = column.iter().map(|vector| vector[axis].to_le_bytes());
            self.add(format!("{name}_{letter}"), "f32", entries);
        }
    }

    /// What the page must know to read [`Self::to_base64`].
    pub fn sections(&self) -> &[(String, &'static str, usize)] {
        &self.sections
    }

    /// The columns, packed.
    pub fn to_base64(&self) -> String {
        let mut encoder = ZlibEncoder::new(Vec::with_capacity(self.planes.len()), LEVEL);
        encoder.write_all(&self.planes).expect("a vector takes everything");
        STANDARD.encode(encoder.finish().expect("a vector takes everything"))
    }
}
