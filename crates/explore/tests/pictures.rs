//! The pictures of the documentation. With `UPDATE_PICTURES=1` in the environment, these tests
//! write them.

use std::path::{Path, PathBuf};

use explore::comparison::Other;
use explore::misreading::{FEW_BOUNCES, names, needs_few_bounces, trace};
use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{Rgb, RgbImage};
use photon_list::reader::PhotonList;
use photon_mapping::assignment8::{self, HEIGHT, WIDTH};
use serde_json::json;
use variants::run::Run;

use crate::browser::launch;
use crate::support::{handout, picture, write_page};

const EMITTED: u64 = 100_000;
/// Each pixel shows so many pixels of the handout's picture, to every side.
const PART: u32 = 3;
const GAP: u32 = 4;
/// A file may have so many bytes.
const MOST_BYTES: usize = 8 << 10;
/// The size of a picture of a page.
const PAGE: (u32, u32) = (1280, 960);

fn is_update() -> bool {
    std::env::var_os("UPDATE_PICTURES").is_some()
}

fn file(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs").join(name)
}

/// `picture` at a third of its size: dots in red, all else in few shades, so that files are small.
fn small(picture: &RgbImage) -> RgbImage {
    RgbImage::from_fn(WIDTH / PART, HEIGHT / PART, |x, y| {
        let part = || {
            let inside = (0..PART * PART).map(|at| (at % PART, at / PART));
            inside.map(|(dx, dy)| *picture.get_pixel(PART * x + dx, PART * y + dy))
        };
        let is_dot = part().any(|pixel| pixel[0] == 255);
        let middle = picture.get_pixel(PART * x + 1, PART * y + 1);
        if is_dot { Rgb([255, 0, 0]) } else { Rgb(middle.0.map(|channel| channel & 0xe0)) }
    })
}

fn pair(left: &RgbImage, right: &RgbImage) -> RgbImage {
    let (width, height) = left.dimensions();
    let mut pair = RgbImage::from_pixel(2 * width + GAP, height, Rgb([255; 3]));
    image::imageops::replace(&mut pair, left, 0, 0);
    image::imageops::replace(&mut pair, right, i64::from(width + GAP), 0);
    pair
}

/// For each misreading its dots, and those of the reference to the right.
#[test]
fn the_documentation_shows_each_misreading() {
    let run = |max_bounces: Option<i32>| {
        let mut run = Run::handout(assignment8::SEED, EMITTED);
        run.renderer.max_photon_bounces = max_bounces.unwrap_or(run.renderer.max_photon_bounces);
        run
    };
    let plain = |run: &Run| small(&picture(run, &run.records(0..EMITTED)));
    let reference = plain(&run(None));
    for name in names() {
        let few = needs_few_bounces(name).then_some(FEW_BOUNCES);
        let run = run(few);
        let (_, records) = trace(name, &run).expect("it is in the table");
        let beside = few.map_or_else(|| reference.clone(), |_| plain(&run));
        let picture = pair(&small(&picture(&run, &records)), &beside);
        let file = file(&format!("misreadings/{name}.png"));
        if is_update() {
            let mut png = Vec::new();
            let encoder =
                PngEncoder::new_with_quality(&mut png, CompressionType::Best, FilterType::NoFilter);
            picture.write_with_encoder(encoder).expect("memory takes everything");
            assert!(png.len() < MOST_BYTES, "{name}: {} bytes", png.len());
            std::fs::write(&file, png).expect("it can be written");
        }
        let kept = image::open(&file).unwrap_or_else(|error| panic!("{name}: {error}"));
        let is_same = kept.into_rgb8() == picture;
        assert!(is_same, "{name}: run this test with UPDATE_PICTURES=1 and look at the picture");
    }
}

/// Writes what the browser shows of `page` at `link` to the picture `name`.
fn take(name: &str, page: &Path, link: &str) {
    let Some(browser) = launch(true) else { panic!("pictures need chromium") };
    browser.size(PAGE.0, PAGE.1);
    browser.call("Emulation.setScrollbarsHidden", json!({ "hidden": true }));
    browser.open(page, link);
    browser.screenshot().save(file(name)).expect("it can be written");
}

/// What browsers draw differs by their fonts, so no pixels are compared.
#[test]
fn the_documentation_shows_the_page() {
    if is_update() {
        let (run, page) = handout();
        take("explore.png", page, "#photon=73&bounce=0&step=roulette");
        let (misreading, records) =
            trace("transposed-frame", &run.run).expect("it is in the table");
        let list = PhotonList::of(records);
        let comparison = run.beside(Other::Misreading(misreading), list);
        let page = write_page("picture", &run.exploration(Some(&comparison)).page());
        take("explore-comparison.png", &page, "");
    }
    for name in ["explore.png", "explore-comparison.png"] {
        let size = image::image_dimensions(file(name));
        assert_eq!(size.ok(), Some(PAGE), "{name}: run this test with UPDATE_PICTURES=1");
    }
}
