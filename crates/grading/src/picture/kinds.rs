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

/// The width and height of the PNG file that starts with `start`.
pub fn png_size(start: &[u8]) -> Option<(u32, u32)> {
    let size = start.strip_prefix(&PNG)?.get(8..16)?;
    let number = |at: usize| Some(u32::from_be_bytes(size[at..at + 4].try_into().ok()?));
    Some((number(0)?, number(4)?))
}
