//! Writing lists, row by row, and naming them by their hash.

use std::io::{self, BufWriter, Seek, SeekFrom, Write};

use sha2::{Digest, Sha256};

use super::record::{PhotonRecord, ROW_BYTES};
use super::{csv, ply};

/// How many rows are put together before they are hashed or written.
const ROWS_AT_ONCE: usize = 256;

/// The format of a list that is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// Binary little-endian PLY.
    Ply,
    /// Comma-separated values.
    Csv,
}

/// The SHA-256 of a list's rows.
#[derive(Clone, Default)]
pub struct ListHash(Sha256);

impl ListHash {
    /// Adds a row.
    pub fn update(&mut self, record: &PhotonRecord) {
        self.0.update(record.to_row());
    }

    /// Adds the rows of `records`.
    pub fn update_all(&mut self, records: &[PhotonRecord]) {
        // Many rows at a time: the hash starts slowly for each call.
        for records in records.chunks(ROWS_AT_ONCE) {
            let mut rows = [[0; ROW_BYTES]; ROWS_AT_ONCE];
            rows.iter_mut().zip(records).for_each(|(row, record)| *row = record.to_row());
            self.0.update(rows[..records.len()].as_flattened());
        }
    }

    /// The hash so far, as 64 hexadecimal digits.
    pub fn hex(&self) -> String {
        self.0.clone().finalize().iter().map(|byte| format!("{byte:02x}")).collect()
    }
}

/// Writes a list to `output`.
pub struct ListWriter<W: Write + Seek> {
    output: BufWriter<W>,
    format: Format,
    comments: Vec<String>,
    count: u64,
    text: String,
}

impl<W: Write + Seek> ListWriter<W> {
    /// Starts a list; `comments` go into the header of a PLY file, a line each.
    ///
    /// # Errors
    /// Those of `output`.
    pub fn new(output: W, format: Format, comments: Vec<String>) -> io::Result<Self> {
        let mut output = BufWriter::with_capacity(1 << 18, output);
        let header = match format {
            Format::Ply => ply::header(0, &comments),
            Format::Csv => csv::header(),
        };
        output.write_all(header.as_bytes())?;
        Ok(Self { output, format, comments, count: 0, text: String::new() })
    }

    /// Adds `records`.
    ///
    /// # Errors
    /// Those of the output.
    pub fn write(&mut self, records: &[PhotonRecord]) -> io::Result<()> {
        self.count += records.len() as u64;
        match self.format {
            Format::Ply => records.chunks(ROWS_AT_ONCE).try_for_each(|records| {
                let mut rows = [[0; ROW_BYTES]; ROWS_AT_ONCE];
                rows.iter_mut().zip(records).for_each(|(row, record)| *row = record.to_row());
                self.output.write_all(rows[..records.len()].as_flattened())
            }),
            Format::Csv => {
                self.text.clear();
                records.iter().for_each(|record| csv::push_line(&mut self.text, record));
                self.output.write_all(self.text.as_bytes())
            }
        }
    }

    /// Fills in the header, and gives the output back.
    ///
    /// # Errors
    /// Those of the output.
    pub fn finish(mut self) -> io::Result<W> {
        if self.format == Format::Ply {
            self.output.seek(SeekFrom::Start(0))?;
            self.output.write_all(ply::header(self.count, &self.comments).as_bytes())?;
        }
        self.output.flush()?;
        self.output.into_inner().map_err(io::IntoInnerError::into_error)
    }
}
