//! The pictures of a page: photons over direct light, and where there are more or fewer of them.

use base64::Engine as _;
use base64::prelude::BASE64_STANDARD;
use glam::Vec3;
use image::{Rgb, RgbImage};

use fast::lanes::picture::take_picture;
use fast::lanes::width::Width;
use fast::trace::trace_list;
use photon_mapping::assignment8;
use photon_mapping::rendering::photon_map::PhotonMap;

/// A reference of more photons than this is drawn with this many.
pub const MOST_EMITTED: u64 = 20_000_000;
/// Dots are compared over squares that reach this far from their middle, in pixels.
const REACH: usize = 18;
/// About how many pixels a dot has.
const PIXELS_OF_A_DOT: f64 = 2.0;
/// A difference of fewer standard deviations than the first has no color, of the second the full
/// one.
const NONE: f64 = 2.5;
const FULL: f64 = 6.0;
/// What the handout paints dots with.
const DOT: Rgb<u8> = Rgb([255, 0, 0]);
const MORE: [f64; 3] = [255.0, 140.0, 0.0];
const FEWER: [f64; 3] = [40.0, 140.0, 255.0];

/// The handout's view of the scene without photons.
pub fn direct_light() -> RgbImage {
    with_dots(Vec::new())
}

/// The handout's view with dots at `positions`.
pub fn with_dots(positions: Vec<Vec3>) -> RgbImage {
    let mut renderer = assignment8::create_renderer(assignment8::create_scene());
    renderer.diffuse_map = PhotonMap::new(positions);
    let (width, height) = (assignment8::WIDTH, assignment8::HEIGHT);
    let camera = assignment8::create_camera(width, height);
    take_picture(&renderer, Width::widest(), &camera, width, height, || ()).picture
}

/// The handout's view with the photons of the reference, `emitted` of them emitted.
pub fn of_the_reference(emitted: u64, max_bounces: i32) -> RgbImage {
    let mut renderer = assignment8::create_renderer(assignment8::create_scene());
    renderer.photon_count = emitted.clamp(1, MOST_EMITTED);
    renderer.max_photon_bounces = max_bounces;
    let mut positions = Vec::new();
    let traced: Result<_, std::convert::Infallible> =
        trace_list(&renderer, 0..renderer.emitted(), |records, _| {
            positions.extend(records.iter().map(|record| record.position));
            Ok(())
        });
    let Ok(_) = traced;
    with_dots(positions)
}

/// Where `submission` has more dots than `reference` (orange), and where fewer (blue), both over
/// `plain`, which has none.
pub fn difference(submission: &RgbImage, reference: &RgbImage, plain: &RgbImage) -> RgbImage {
    let ours = DotSums::of(reference, plain);
    let theirs = DotSums::of(submission, plain);
    let mut picture = RgbImage::new(plain.width(), plain.height());
    for (x, y, pixel) in picture.enumerate_pixels_mut() {
        let (reference, submission) = (ours.around(x, y), theirs.around(x, y));
        // Dots fall independently, but each has several pixels.
        let spread = (PIXELS_OF_A_DOT * (reference + submission + PIXELS_OF_A_DOT)).sqrt();
        let away = (submission - reference) / spread;
        let share = strength(away);
        let [r, g, b] = plain.get_pixel(x, y).0.map(f64::from);
        let gray = 30.0 + (r + g + b) / 6.0;
        let color = if away > 0.0 { MORE } else { FEWER };
        *pixel = Rgb(color.map(|channel| (gray + share * (channel - gray)) as u8));
    }
    picture
}

/// `picture` with every dot over `plain` a pixel larger to all sides.
pub fn enlarged(picture: &RgbImage, plain: &RgbImage) -> RgbImage {
    let mut larger = picture.clone();
    let (width, height) = picture.dimensions();
    for (x, y, pixel) in picture.enumerate_pixels() {
        if pixel == plain.get_pixel(x, y) {
            continue;
        }
        for y in y.saturating_sub(1)..=(y + 1).min(height - 1) {
            for x in x.saturating_sub(1)..=(x + 1).min(width - 1) {
                larger.put_pixel(x, y, DOT);
            }
        }
    }
    larger
}

/// How strong the color is of what is `away` standard deviations from its expectation, from 0 to
/// 1.
pub fn strength(away: f64) -> f64 {
    ((away.abs() - NONE) / (FULL - NONE)).clamp(0.0, 1.0)
}

/// How many pixels above and left of each have a dot.
struct DotSums {
    width: usize,
    height: usize,
    sums: Vec<f64>,
}

impl DotSums {
    fn of(picture: &RgbImage, plain: &RgbImage) -> Self {
        let (width, height) = (plain.width() as usize, plain.height() as usize);
        let mut sums = vec![0.0; (width + 1) * (height + 1)];
        for (x, y, pixel) in picture.enumerate_pixels() {
            let (x, y) = (x as usize, y as usize);
            let is_dot = pixel != plain.get_pixel(x as u32, y as u32);
            let at = (y + 1) * (width + 1) + x + 1;
            sums[at] = f64::from(u8::from(is_dot)) + sums[at - 1] + sums[at - width - 1]
                - sums[at - width - 2];
        }
        Self { width, height, sums }
    }

    /// How many pixels about (x, y) have a dot.
    fn around(&self, x: u32, y: u32) -> f64 {
        let range = |at: u32, end: usize| {
            let at = at as usize;
            [at.saturating_sub(REACH), (at + REACH + 1).min(end)]
        };
        let ([left, right], [top, bottom]) = (range(x, self.width), range(y, self.height));
        let sum = |x: usize, y: usize| self.sums[y * (self.width + 1) + x];
        sum(right, bottom) - sum(left, bottom) - sum(right, top) + sum(left, top)
    }
}

/// `picture` as an address that holds the whole of it.
pub fn address(picture: &RgbImage) -> String {
    let mut png = Vec::new();
    picture
        .write_to(&mut std::io::Cursor::new(&mut png), image::ImageFormat::Png)
        .expect("writing to memory does not fail");
    address_of_png(&png)
}

/// The same for the bytes of a PNG file.
pub fn address_of_png(png: &[u8]) -> String {
    format!("data:image/png;base64,{}", BASE64_STANDARD.encode(png))
}
