//! A file as lines of text, whatever its encoding and line ends.

use std::borrow::Cow;
use std::io::{self, BufRead, BufReader, Cursor, Read};
use std::path::Path;

use encoding_rs::{UTF_16BE, UTF_16LE, WINDOWS_1252};
use encoding_rs_io::DecodeReaderBytesBuilder;

use super::error::ListError;

/// A line longer than this is no row of a photon list.
const LONGEST_LINE: usize = 65_536;
/// So many bytes tell UTF-16 from other text.
const SNIFFED: u64 = 4;

/// What `input` holds, without a byte order mark and with UTF-16 as UTF-8.
pub(super) fn decoded(mut input: impl Read + 'static) -> io::Result<BufReader<Box<dyn Read>>> {
    let mut start = Vec::new();
    input.by_ref().take(SNIFFED).read_to_end(&mut start)?;
    let encoding = match start.as_slice() {
        [0xff, 0xfe, ..] | [1..=255, 0, 1..=255, 0] => Some(UTF_16LE),
        [0xfe, 0xff, ..] | [0, 1..=255, 0, 1..=255] => Some(UTF_16BE),
        _ => None,
    };
    let start = match start.strip_prefix(b"\xef\xbb\xbf") {
        Some(rest) => rest.to_vec(),
        None => start,
    };
    let whole = Cursor::new(start).chain(input);
    let whole: Box<dyn Read> = match encoding {
        None => Box::new(whole),
        Some(_) => Box::new(DecodeReaderBytesBuilder::new().encoding(encoding).build(whole)),
    };
    Ok(BufReader::with_capacity(1 << 18, whole))
}

/// The lines of a file, which LF, CR LF or CR ends.
pub(super) struct Lines<'path, Input> {
    pub input: Input,
    pub path: &'path Path,
    line: Vec<u8>,
    number: u64,
    /// Whether a CR is not followed by an LF: then an LF behind one belongs to binary data.
    cr_alone: bool,
}

impl<'path, Input: BufRead> Lines<'path, Input> {
    pub fn new(input: Input, path: &'path Path) -> Self {
        Self { input, path, line: Vec::new(), number: 0, cr_alone: false }
    }

    /// The next line, or `None` at the end. What is not UTF-8 is taken for Windows-1252.
    pub fn next(&mut self) -> Result<Option<(u64, Cow<'_, str>)>, ListError> {
        self.line.clear();
        let mut is_ended = false;
        while !is_ended {
            let unreadable = |error| ListError::unreadable(self.path, error);
            let bytes = match self.input.fill_buf() {
                Err(error) if error.kind() == io::ErrorKind::Interrupted => continue,
                bytes => bytes.map_err(unreadable)?,
            };
            if bytes.is_empty() {
                if self.line.is_empty() {
                    return Ok(None);
                }
                break;
            }
            let end = bytes.iter().position(|byte| matches!(byte, b'\n' | b'\r'));
            let (taken, is_cr) = match end {
                None => (bytes.len(), false),
                Some(end) => (end, bytes[end] == b'\r'),
            };
            self.line.extend_from_slice(&bytes[..taken]);
            is_ended = end.is_some();
            self.input.consume(taken + usize::from(is_ended));
            if is_cr && !self.cr_alone {
                let next = self.input.fill_buf().map_err(unreadable)?;
                match next.first() {
                    Some(b'\n') => self.input.consume(1),
                    _ => self.cr_alone = self.number == 0,
                }
            }
            if self.line.len() > LONGEST_LINE {
                let message =
                    format!("expected at most {LONGEST_LINE} bytes in a line, found more");
                return Err(ListError::in_line(self.path, self.number + 1, message));
            }
        }
        self.number += 1;
        if self.line.contains(&0) {
            let message = "expected text, found a zero byte";
            return Err(ListError::in_line(self.path, self.number, message));
        }
        let text = match std::str::from_utf8(&self.line) {
            Ok(text) => Cow::Borrowed(text),
            Err(_) => WINDOWS_1252.decode_without_bom_handling(&self.line).0,
        };
        Ok(Some((self.number, text)))
    }
}
