//! What a file is, by its first bytes.

use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

use file_format::FileFormat;

/// How every PNG file starts.
pub const PNG: [u8; 8] = *b"\x89PNG\r\n\x1a\n";

/// So many bytes tell what a file is.
pub const START: usize = 4096;

/// How packed files start, and what they are.
const PACKED: [(&[u8], &str); 7] = [
    (b"\x1f\x8b", "gzip"),
    (b"PK\x03\x04", "zip"),
    (b"\xfd7zXZ\0", "xz"),
    (b"7z\xbc\xaf\x27\x1c", "7-Zip"),
    (b"Rar!", "RAR"),
    (b"BZh", "bzip2"),
    (b"\x28\xb5\x2f\xfd", "Zstandard"),
];

/// The names of packed documents end in these.
const OFFICE: [(&str, &str); 7] = [
    ("docx", "Word"),
    ("xlsx", "Excel"),
    ("pptx", "PowerPoint"),
    ("odt", "OpenDocument"),
    ("ods", "OpenDocument"),
    ("odp", "OpenDocument"),
    ("pages", "Pages"),
];

/// Formats that say nothing of pictures: where their first letters stand, and these.
const OTHERS: [(usize, &[u8], &str); 9] = [
    (257, b"ustar", "a tar archive"),
    (0, b"\x93NUMPY", "a NumPy array"),
    (0, b"\x89HDF\r\n\x1a\n", "an HDF5 file"),
    (0, b"MATLAB 5.0", "a MATLAB file"),
    (0, b"PAR1", "a Parquet file"),
    (0, b"SQLite format 3\0", "an SQLite database"),
    (0, b"\x7fELF", "a program"),
    (0, b"\xff\xfe\0\0", "text in UTF-32"),
    (0, b"\0\0\xfe\xff", "text in UTF-32"),
];

const TARGA: [&str; 3] = ["tga", "targa", "icb"];

/// The first bytes of `path`.
///
/// # Errors
/// When it cannot be read.
pub fn start(path: &Path) -> io::Result<Vec<u8>> {
    let mut start = Vec::new();
    File::open(path)?.take(START as u64).read_to_end(&mut start)?;
    Ok(start)
}

/// What a file is that is no photon list.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A picture in the format of this name.
    Picture(String),
    /// A document, film or sound, which may have pictures in it.
    Document(String),
    /// Packed with the program of this name.
    Packed(&'static str),
}

/// The kind of the file `path`, which starts with `start`; of pictures it does not matter what the
/// name says.
pub fn kind(start: &[u8], path: &Path) -> Option<Kind> {
    if start.starts_with(&PNG) {
        return Some(Kind::Picture("PNG".to_owned()));
    }
    let extension = path.extension().unwrap_or_default().to_string_lossy().to_lowercase();
    if let Some((_, kind)) = PACKED.iter().find(|(magic, _)| start.starts_with(magic)) {
        // Office documents are packed, too, but nobody unpacks them.
        let office = OFFICE.iter().find(|(known, _)| *kind == "zip" && extension == *known);
        return Some(
            office.map_or(Kind::Packed(kind), |(_, name)| Kind::Document((*name).to_owned())),
        );
    }
    // A list may start with the letters of BMP, but goes on with text.
    let is_text = start.iter().all(|byte| byte.is_ascii_graphic() || byte.is_ascii_whitespace());
    let has_svg = start.windows(4).any(|bytes| bytes == b"<svg");
    let format = FileFormat::from_bytes(start);
    let name = format.short_name().unwrap_or(format.name());
    match (format, format.kind()) {
        _ if start.starts_with(b"BM") && !is_text => Some(Kind::Picture("BMP".to_owned())),
        // Targa files start with nothing of their own.
        _ if TARGA.contains(&extension.as_str()) && !is_text => {
            Some(Kind::Picture("TGA".to_owned()))
        }
        _ if has_svg && start.starts_with(b"<") => Some(Kind::Picture("SVG".to_owned())),
        (_, file_format::Kind::Image) => Some(Kind::Picture(name.to_owned())),
        (
            _,
            file_format::Kind::Document
            | file_format::Kind::Presentation
            | file_format::Kind::Spreadsheet
            | file_format::Kind::Video
            | file_format::Kind::Audio,
        ) => Some(Kind::Document(name.to_owned())),
        (FileFormat::CompoundFileBinary, _) => Some(Kind::Document("Office".to_owned())),
        (FileFormat::HypertextMarkupLanguage, _) => Some(Kind::Document("HTML".to_owned())),
        (FileFormat::Mpeg4Part14, _) => Some(Kind::Document("MP4".to_owned())),
        _ => None,
    }
}

/// Which format the file `path` has, which starts with `start`, if it is one that no photon list
/// has.
pub fn other_format(start: &[u8], path: &Path) -> Option<String> {
    let is_other = |(at, magic, _): &&(usize, &[u8], &str)| {
        start.get(*at..).is_some_and(|start| start.starts_with(magic))
    };
    if let Some((_, _, name)) = OTHERS.iter().find(is_other) {
        return Some((*name).to_owned());
    }
    let text = start.strip_prefix(b"\xef\xbb\xbf").unwrap_or(start).trim_ascii_start();
    Some(match kind(start, path) {
        Some(Kind::Packed("xz")) => "an xz archive".to_owned(),
        Some(Kind::Packed(name)) => format!("a {name} archive"),
        Some(Kind::Picture(name)) => format!("a picture ({name})"),
        Some(Kind::Document(name)) => format!("a document ({name})"),
        None if text.starts_with(b"{") || text.starts_with(b"[") => "JSON".to_owned(),
        None => return None,
    })
}

/// The width and height of the PNG file that starts with `start`.
pub fn png_size(start: &[u8]) -> Option<(u32, u32)> {
    let size = start.strip_prefix(&PNG)?.get(8..16)?;
    let number = |at: usize| Some(u32::from_be_bytes(size[at..at + 4].try_into().ok()?));
    Some((number(0)?, number(4)?))
}
