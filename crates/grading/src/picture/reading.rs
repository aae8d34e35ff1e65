//! Reading a picture, whoever wrote the file.

use std::fs::File;
use std::io::{Cursor, Read};
use std::path::Path;

use image::codecs::png::PngDecoder;
use image::{DynamicImage, ImageDecoder, Limits, RgbImage};

use crate::intake::kinds::{Kind, PNG, START, kind};
use photon_mapping::assignment8::{HEIGHT, WIDTH};

/// A larger file is not read: 16 bits for each of four channels, not compressed at all, are 2.5 MB.
/// It bounds what a decoder has to unpack, too.
const MOST_BYTES: u64 = 4 << 20;
/// A picture that is all alike is far shorter than this, unless nothing of it is compressed in the
/// longest format.
const MOST_UNPACKED: usize = (WIDTH * HEIGHT * 8) as usize;
/// The chunks of a PNG file that make its pixels, and the bytes of a chunk besides its contents.
const PIXEL_CHUNKS: [&[u8; 4]; 5] = [b"IHDR", b"PLTE", b"tRNS", b"IDAT", b"IEND"];
const CHUNK_FRAME: usize = 12;
/// What the decoder may allocate besides the picture.
const MOST_MEMORY: u64 = 16 << 20;
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
    match kind(&bytes[..bytes.len().min(START)], path) {
        Some(Kind::Picture(name)) if name == "PNG" => {}
        Some(Kind::Picture(name) | Kind::Document(name)) => {
            return Err(format!("{name}, not PNG{}: {WANTED}", blurs(&name)));
        }
        Some(Kind::Packed(_)) | None => return Err("it is not a picture".to_owned()),
    }
    decode(&bytes)
}

/// What a student is asked for.
pub const WANTED: &str = "hand in the PNG that the framework writes";

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
            "it has {width} x {height} pixels, where the handout's has {WIDTH} x {HEIGHT}: it was \
             made with another size, or resized, or is a screenshot. Dots are judged at that size \
             alone: {WANTED}"
        ));
    }
    if chunks(bytes).any(|chunk| chunk.get(4..8) == Some(b"acTL")) {
        return Err(format!("it is animated: {WANTED}"));
    }
    let pixels = pixels_alone(bytes);
    let decoder = PngDecoder::with_limits(Cursor::new(&pixels), limits).map_err(broken)?;
    if !decoder.color_type().has_color() {
        return Err(format!("it is gray, and dots are red: {WANTED}"));
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

/// The PNG file `bytes` without what does not change its pixels: colour profiles and texts may
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
