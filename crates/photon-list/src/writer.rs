//! Writing lists, row by row.

use std::io::{self, BufWriter, Seek, SeekFrom, Write};

use photon_mapping::photon_list::{PhotonRecord, ply_header, write_rows};

use super::csv;

/// The format of a list that is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// Binary little-endian PLY.
    Ply,
    /// Comma-separated values.
    Csv,
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
            Format::Ply => ply_header(0, &comments),
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
            Format::Ply => write_rows(&mut self.output, records),
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
            self.output.write_all(ply_header(self.count, &self.comments).as_bytes())?;
        }
        self.output.flush()?;
        self.output.into_inner().map_err(io::IntoInnerError::into_error)
    }
}
