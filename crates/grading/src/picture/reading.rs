//! Reading a picture, whoever wrote the file.

use std::fs::File;
use std::io::{Cursor, Read};
use std::path::Path;

use image::codecs::png::PngDecoder;
use image::{DynamicImage, ImageDecoder, Limits, RgbImage};

use photon_mapping::assignment8::{HEIGHT, WIDTH};

/// How every PNG file starts.
pub const PNG: [u8; 8] = *b"\x89PNG\r\n\x1a\n";
/// A larger file is not read: 16 bits for each of four channels, not compressed at all, are 2.5 MB. It
/// bounds what a decoder has to unpack, too.
const MOST_BYTES: u64 = 4 << 20;
/// A picture that is all alike is far shorter than this, unless nothing of it is compressed in the longest format.
const MOST_UNPACKED: usize = (WIDTH * HEIGHT * 8) as usize;
/// What the decoder may allocate besides the picture.
const MOST_MEMORY: u64 = 16 << 20;
/// What other pictures start with, and what they are.
const OTHERS: [(&[u8], &str); 7] = [
    (b"\xff\xd8\xff", "JPEG"),
    (b"GIF8", "GIF"),
    (b"BM", "BMP"),
    (b"II*\0", "TIFF"),
    (b"MM\0*", "TIFF"),
    (b"RIFF", "WebP"),
    (b"%PDF", "PDF"),
];

/// The kind of picture that a file is by its first bytes, whatever its name says.
pub fn kind(start: &[u8]) -> Option<&'static str> {
    if start.starts_with(&PNG) {
        return Some("PNG");
    }
    // A list may start with the letters of BMP, but goes on with text.
    let is_text = start.iter().all(|byte| byte.is_ascii_graphic() || byte.is_ascii_whitespace());
    let other = OTHERS.iter().find(|(magic, _)| start.starts_with(magic));
    other.filter(|_| !is_text).map(|(_, name)| *name)
}

/// The first bytes of the regular file `path`; nothing for what cannot be read, or only once.
pub fn start_of(path: &Path) -> Option<Vec<u8>> {
    if !std::fs::metadata(path).ok()?.is_file() {
        return None;
    }
    let mut start = Vec::new();
    File::open(path).ok()?.take(16).read_to_end(&mut start).ok()?;
    Some(start)
}

/// Reads the picture `path`, in bounded time and memory.
///
/// # Errors
/// The reason, in words, if it is not a PNG picture of the size that the framework writes.
pub fn read_picture(path: &Path) -> Result<RgbImage, String> {
    let unreadable = |error: std::io::Error| format!("it cannot be read: {error}");
    // Asked before it is opened, since to open a pipe may take for ever.
    if !std::fs::metadata(path).map_err(unreadable)?.is_file() {
        return Err("it is not a regular file".to_owned());
    }
    let mut bytes = Vec::new();
    let file = File::open(path).map_err(unreadable)?;
    file.take(MOST_BYTES + 1).read_to_end(&mut bytes).map_err(unreadable)?;
    if bytes.len() as u64 > MOST_BYTES {
        let most = MOST_BYTES >> 20;
        return Err(format!("it has more than {most} MB, more than such a picture can need"));
    }
    match kind(&bytes[..bytes.len().min(16)]) {
        Some("PNG") => {}
        Some(name) => return Err(format!("it is a {name} file{}: {WANTED}", blurs(name))),
        None => return Err("it is not a picture".to_owned()),
    }
    decode(&bytes)
}

/// What a student is asked for.
pub const WANTED: &str = "hand in the PNG that the program itself wrote";

fn blurs(name: &str) -> &'static str {
    if name == "JPEG" { ", whose compression smears dots" } else { "" }
}

fn decode(bytes: &[u8]) -> Result<RgbImage, String> {
    let broken = |error: image::ImageError| format!("it is a broken PNG file: {error}");
    let mut limits = Limits::no_limits();
    limits.max_alloc = Some(MOST_MEMORY);
    // Its header, before anything is unpacked.
    let size = bytes.get(16..24).ok_or("it is a broken PNG file: it ends too early")?;
    let number = |at: usize| u32::from_be_bytes(std::array::from_fn(|byte| size[at + byte]));
    let (width, height) = (number(0), number(4));
    if (width, height) != (WIDTH, HEIGHT) {
        return Err(format!(
            "it has {width} x {height} pixels, where the handout's has {WIDTH} x {HEIGHT}: it was made \
             with another size, or resized, or is a screenshot. Dots are judged at that size alone: {WANTED}"
        ));
    }
    let decoder = PngDecoder::with_limits(Cursor::new(bytes), limits).map_err(broken)?;
    if decoder.is_apng().map_err(broken)? {
        return Err(format!("it is animated: {WANTED}"));
    }
    if !decoder.color_type().has_color() {
        return Err(format!("it is grey, and dots are red: {WANTED}"));
    }
    let picture = DynamicImage::from_decoder(decoder).map_err(broken)?;
    let rgb = picture.to_rgb8();
    let first = *rgb.get_pixel(0, 0);
    if bytes.len() > MOST_UNPACKED && rgb.pixels().all(|pixel| *pixel == first) {
        return Err(
            "it has far more data than its pixels, which are all alike, can need".to_owned()
        );
    }
    if picture.color().has_alpha() {
        let with_alpha = picture.to_rgba8();
        let first = with_alpha.get_pixel(0, 0).0[3];
        if with_alpha.pixels().any(|pixel| pixel.0[3] != first) {
            return Err(format!("some of it is transparent: {WANTED}"));
        }
    }
    Ok(rgb)
}
