//! Reading a picture, whoever wrote the file.

use std::fs::File;
use std::io::{Cursor, Read};
use std::path::Path;

use image::codecs::png::PngDecoder;
use image::{DynamicImage, Limits, RgbImage};

use super::kinds::{Kind, PNG, START, kind, png_size};
pub use crate::limits::pictures::MOST_BYTES;
use crate::limits::pictures::{MOST_BYTES_OF_ANY, MOST_MEMORY, MOST_PIXELS, MOST_UNPACKED};
use photon_mapping::assignment8::{HEIGHT, WIDTH};

/// The chunks of a PNG file that make its pixels, and the bytes of a chunk besides its contents.
const PIXEL_CHUNKS: [&[u8; 4]; 5] = [b"IHDR", b"PLTE", b"tRNS", b"IDAT", b"IEND"];
const CHUNK_FRAME: usize = 12;

/// Reads the picture `path`, in bounded time and memory.
///
/// # Errors
/// The reason, in words, if it is not a PNG picture of the size that the framework writes.
pub fn read_picture(path: &Path) -> Result<RgbImage, String> {
    let bytes = read_bytes(path, MOST_BYTES)?;
    let (width, height) = size(&bytes)?;
    if (width, height) != (WIDTH, HEIGHT) {
        return Err(format!(
            "it has {width} x {height} pixels, where the handout's has {WIDTH} x {HEIGHT}: it was \
             made with another size, or resized, or is a screenshot. Dots are judged at that size \
             alone: {WANTED}"
        ));
    }
    check(&bytes, decode(&bytes)?)
}

/// As [`read_picture`], for a picture of any size that `render` draws.
///
/// # Errors
/// The reason, in words, if it is not a PNG picture or too large.
pub fn read_any_picture(path: &Path) -> Result<RgbImage, String> {
    let bytes = read_bytes(path, MOST_BYTES_OF_ANY)?;
    let (width, height) = size(&bytes)?;
    if u64::from(width) * u64::from(height) > MOST_PIXELS {
        return Err(format!("it has {width} x {height} pixels, more than {MOST_PIXELS} in all"));
    }
    let picture = decode(&bytes)?;
    check_opaque(&picture)?;
    Ok(picture.into_rgb8())
}

/// The bytes of the PNG file `path`.
fn read_bytes(path: &Path, most: u64) -> Result<Vec<u8>, String> {
    let unreadable = |error: std::io::Error| format!("it cannot be read: {error}");
    // Asked before it is opened, since to open a pipe may take for ever.
    if !std::fs::metadata(path).map_err(unreadable)?.is_file() {
        return Err("it is not a regular file".to_owned());
    }
    let mut bytes = Vec::new();
    let file = File::open(path).map_err(unreadable)?;
    file.take(most + 1).read_to_end(&mut bytes).map_err(unreadable)?;
    if bytes.len() as u64 > most {
        let most = most / 1_000_000;
        return Err(format!("it has more than {most} MB, more than such a picture can need"));
    }
    match kind(&bytes[..bytes.len().min(START)], path) {
        Some(Kind::Picture(name)) if name == "PNG" => Ok(bytes),
        Some(Kind::Picture(name) | Kind::Document(name)) => {
            Err(format!("{name}, not PNG{}: {WANTED}", blurs(&name)))
        }
        Some(Kind::Packed(_)) | None => Err("it is not a picture".to_owned()),
    }
}

/// What a student is asked for.
pub const WANTED: &str = "hand in the PNG that the framework writes";

fn blurs(name: &str) -> &'static str {
    if name == "JPEG" { ", whose compression smears dots" } else { "" }
}

/// The width and height in the header of the PNG file `bytes`, before anything is unpacked.
fn size(bytes: &[u8]) -> Result<(u32, u32), String> {
    png_size(bytes).ok_or_else(|| "it is a broken PNG file: it ends too early".to_owned())
}

/// Unpacks the pixels of the PNG file `bytes`, and nothing else.
fn decode(bytes: &[u8]) -> Result<DynamicImage, String> {
    let broken = |error: image::ImageError| format!("it is a broken PNG file: {error}");
    if chunks(bytes).any(|chunk| chunk.get(4..8) == Some(b"acTL")) {
        return Err(format!("it is animated: {WANTED}"));
    }
    let mut limits = Limits::no_limits();
    limits.max_alloc = Some(MOST_MEMORY);
    let pixels = pixels_alone(bytes);
    let decoder = PngDecoder::with_limits(Cursor::new(&pixels), limits).map_err(broken)?;
    DynamicImage::from_decoder(decoder).map_err(broken)
}

/// The colors of `picture`, whose file is `bytes`, if it can be one with dots.
fn check(bytes: &[u8], picture: DynamicImage) -> Result<RgbImage, String> {
    if !picture.color().has_color() {
        return Err(format!("it is gray, and dots are red: {WANTED}"));
    }
    let rgb = picture.to_rgb8();
    let first = *rgb.get_pixel(0, 0);
    if bytes.len() > MOST_UNPACKED && rgb.pixels().all(|pixel| *pixel == first) {
        return Err(
            "it has far more data than its pixels, which are all alike, can need".to_owned()
        );
    }
    check_opaque(&picture)?;
    Ok(rgb)
}

/// Whether all pixels are as opaque as the first: a program may write any value everywhere.
fn check_opaque(picture: &DynamicImage) -> Result<(), String> {
    if picture.color().has_alpha() {
        let with_alpha = picture.to_rgba8();
        let first = with_alpha.get_pixel(0, 0).0[3];
        if with_alpha.pixels().any(|pixel| pixel.0[3] != first) {
            return Err(format!("some of it is transparent: {WANTED}"));
        }
    }
    Ok(())
}

/// The PNG file `bytes` without what does not change its pixels: color profiles and texts may
/// unpack to far more than they are.
fn pixels_alone(bytes: &[u8]) -> Vec<u8> {
    let kept = chunks(bytes).filter(|chunk| {
        let kind = chunk.get(4..8).unwrap_or_default();
        PIXEL_CHUNKS.iter().any(|known| kind == *known) || chunk.len() < CHUNK_FRAME
    });
    [&PNG[..]].into_iter().chain(kept).collect::<Vec<_>>().concat()
}

/// The chunks of the PNG file `bytes`, with length, kind and checksum; the last one may be cut.
fn chunks(bytes: &[u8]) -> impl Iterator<Item = &[u8]> {
    let mut rest = bytes.get(PNG.len()..).unwrap_or_default();
    std::iter::from_fn(move || {
        let (length, _) = rest.split_first_chunk::<4>()?;
        let length = u32::from_be_bytes(*length) as usize + CHUNK_FRAME;
        let (chunk, after) = rest.split_at(length.min(rest.len()));
        rest = after;
        Some(chunk)
    })
}
