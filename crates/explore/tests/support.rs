//! A run of the reference with all that a page of it needs.

use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use explore::Exploration;
use explore::comparison::{ListComparison, Other};
use fast::lanes::picture::take_picture;
use fast::lanes::width::Width;
use image::RgbImage;
use oracle::summary::{SurfaceSummary, Tally};
use oracle::table::ExpectedTable;
use photon_list::reader::PhotonList;
use photon_mapping::assignment8::{self, HEIGHT, WIDTH};
use photon_mapping::photon_list::PhotonRecord;
use photon_mapping::rendering::photon_map::PhotonMap;
use serde_json::Value;
use variants::run::Run;

use crate::browser::{Borrowed, launch};

/// A run of the handout with its list, table and picture.
pub struct Traced {
    pub run: Run,
    pub records: Vec<PhotonRecord>,
    pub table: (Vec<SurfaceSummary>, SurfaceSummary),
    pub picture: RgbImage,
}

impl Traced {
    /// The run with `photons` emitted.
    pub fn new(photons: u64) -> Self {
        Self::of(Run::handout(assignment8::SEED, photons), Some(&ExpectedTable::of_assignment8()))
    }

    /// Traces `run`, for which `expected` is known.
    pub fn of(run: Run, expected: Option<&ExpectedTable>) -> Self {
        let emitted = run.renderer.emitted();
        let records = run.records(0..emitted);
        let names = run.scene().mesh_objects().iter().map(|object| object.name.clone());
        let mut tally = Tally::new(names);
        records.iter().for_each(|record| tally.add(record));
        let max_bounces = run.renderer.max_photon_bounces as usize;
        let table = tally.surfaces(emitted, max_bounces, expected);
        let picture = picture(&run, &records);
        Self { run, records, table, picture }
    }

    /// Its list.
    pub fn list(&self) -> PhotonList {
        PhotonList::of(self.records.clone())
    }

    /// Its list beside `list`.
    pub fn beside(&self, other: Other, list: PhotonList) -> ListComparison {
        ListComparison::new(other, self.list(), list, &self.run)
    }

    /// What its page shows, with `comparison` laid over it.
    pub fn exploration<'a>(&'a self, comparison: Option<&'a ListComparison>) -> Exploration<'a> {
        Exploration {
            run: &self.run,
            is_handout: true,
            records: &self.records,
            table: (&self.table.0, &self.table.1),
            picture: &self.picture,
            photon: None,
            comparison,
        }
    }
}

/// The picture of the handout's camera in which `run` has stored `records`.
pub fn picture(run: &Run, records: &[PhotonRecord]) -> RgbImage {
    let mut renderer = run.renderer.clone();
    renderer.diffuse_map = PhotonMap::new(records.iter().map(|record| record.position));
    let camera = assignment8::create_camera(WIDTH, HEIGHT);
    take_picture(&renderer, Width::widest(), &camera, WIDTH, HEIGHT, || ()).picture
}

/// Writes the page `name` to the folder of the tests.
pub fn write_page(name: &str, page: &str) -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("explore-{name}.html"));
    std::fs::write(&path, page).expect("the folder of the tests can be written");
    path
}

/// The number `value`.
pub fn float(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is no number"))
}

/// The run of the handout, and its page.
pub fn handout() -> &'static (Traced, PathBuf) {
    static PAGE: OnceLock<(Traced, PathBuf)> = OnceLock::new();
    PAGE.get_or_init(|| traced_page("handout", assignment8::PHOTON_COUNT))
}

/// A run whose page is like the handout's, but quicker to load and to draw.
pub fn short() -> &'static (Traced, PathBuf) {
    static PAGE: OnceLock<(Traced, PathBuf)> = OnceLock::new();
    PAGE.get_or_init(|| traced_page("short", 20_000))
}

fn traced_page(name: &str, photons: u64) -> (Traced, PathBuf) {
    let run = Traced::new(photons);
    let path = write_page(name, &run.exploration(None).page());
    (run, path)
}

/// The page of the short run at `link`, in a browser if there is one.
pub fn open_short(link: &str) -> Option<Borrowed> {
    let browser = launch(true)?;
    browser.open(&short().1, link);
    Some(browser)
}
