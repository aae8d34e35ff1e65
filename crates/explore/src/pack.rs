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
    /// Name, type, number of entries and bytes of an entry, in the order of `planes`.
    sections: Vec<(&'static str, &'static str, usize, usize)>,
    /// Of each column first the first bytes of all entries, then all second ones, and so on.
    planes: Vec<u8>,
}

impl PackedColumns {
    fn add<const BYTES: usize>(
        &mut self,
        name: &'static str,
        kind: &'static str,
        entries: impl ExactSizeIterator<Item = [u8; BYTES]> + Clone,
    ) {
        self.sections.push((name, kind, entries.len(), BYTES));
        for plane in 0..BYTES {
            self.planes.extend(entries.clone().map(|bytes| bytes[plane]));
        }
    }

    /// Adds a column of bytes.
    pub fn bytes(&mut self, name: &'static str, column: &[u8]) {
        self.add(name, "u8", column.iter().map(|entry| [*entry]));
    }

    /// Adds a column of 16-bit numbers.
    pub fn shorts(&mut self, name: &'static str, column: &[u16]) {
        self.add(name, "u16", column.iter().map(|entry| entry.to_le_bytes()));
    }

    /// Adds a column of 32-bit numbers.
    pub fn words(&mut self, name: &'static str, column: &[u32]) {
        self.add(name, "u32", column.iter().map(|entry| entry.to_le_bytes()));
    }

    /// Adds a column of floats.
    pub fn floats(&mut self, name: &'static str, column: &[f32]) {
        self.add(name, "f32", column.iter().map(|entry| entry.to_le_bytes()));
    }

    /// Adds a column of vectors, three floats each.
    pub fn vectors(&mut self, name: &'static str, column: &[[f32; 3]]) {
        let bytes = |vector: &[f32; 3]| {
            let mut bytes = [0; 12];
            bytes
                .chunks_exact_mut(4)
                .zip(vector)
                .for_each(|(to, number)| to.copy_from_slice(&number.to_le_bytes()));
            bytes
        };
        self.add(name, "f32", column.iter().map(bytes));
    }

    /// Adds a column of unit vectors, three signed bytes each.
    pub fn normals(&mut self, name: &'static str, column: &[[f32; 3]]) {
        let bytes = |normal: &[f32; 3]| normal.map(|x| ((x * 127.0) as i8).to_le_bytes()[0]);
        self.add(name, "i8", column.iter().map(bytes));
    }

    /// What the page must know to read [`Self::to_base64`].
    pub fn sections(&self) -> &[(&'static str, &'static str, usize, usize)] {
        &self.sections
    }

    /// The columns, packed.
    pub fn to_base64(&self) -> String {
        let mut encoder = ZlibEncoder::new(Vec::with_capacity(self.planes.len()), LEVEL);
        encoder.write_all(&self.planes).expect("a vector takes everything");
        STANDARD.encode(encoder.finish().expect("a vector takes everything"))
    }
}
