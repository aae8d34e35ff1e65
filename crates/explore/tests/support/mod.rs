//! A run of the reference with all that a page of it needs.

use std::path::{Path, PathBuf};

use explore::Exploration;
use explore::comparison::Comparison;
use image::RgbImage;
use photon_mapping::accuracy::table::ExpectedTable;
use photon_mapping::assignment8;
use photon_mapping::lanes::picture::take_picture;
use photon_mapping::lanes::width::Width;
use photon_mapping::photon_list::reader::PhotonList;
use photon_mapping::photon_list::record::{Columns, PhotonRecord};
use photon_mapping::photon_list::trace::trace_list;
use photon_mapping::rendering::photon_map::PhotonMap;
use photon_mapping::rendering::photon_mapping_renderer::PhotonMappingRenderer;
use photon_mapping::summary::{SurfaceSummary, Tally};
use serde_json::Value;

/// A run, its list, table and picture.
pub struct Run {
    pub renderer: PhotonMappingRenderer,
    pub records: Vec<PhotonRecord>,
    pub table: (Vec<SurfaceSummary>, SurfaceSummary),
    pub picture: RgbImage,
}

impl Run {
    /// The handout's run with `photons` emitted.
    pub fn new(photons: u64) -> Self {
        let mut renderer = assignment8::create_renderer(assignment8::create_scene());
        renderer.photon_count = photons;
        let mut records = Vec::new();
        let traced = trace_list(&renderer, 0..renderer.emitted(), |piece: &[PhotonRecord], _| {
            records.extend_from_slice(piece);
            Ok::<(), std::convert::Infallible>(())
        });
        let Ok(()) = traced;
        let names = renderer.stored_scene.mesh_objects().iter().map(|object| object.name.clone());
        let mut tally = Tally::new(names);
        records.iter().for_each(|record| tally.add(record));
        let table = tally.surfaces(photons, 1000, Some(&ExpectedTable::of_assignment8()));
        renderer.diffuse_map = PhotonMap::new(records.iter().map(|record| record.position));
        let camera = assignment8::create_camera(640, 480);
        let picture = take_picture(&renderer, Width::widest(), &camera, 640, 480, || ());
        Self { renderer, records, table, picture }
    }

    /// Its list.
    pub fn list(&self) -> PhotonList {
        let columns =
            Columns { intensity: true, to_light: true, photon: true, bounce: true, surface: true };
        PhotonList { columns, records: self.records.clone() }
    }

    /// What its page shows, with `comparison` laid over it.
    pub fn exploration<'a>(&'a self, comparison: Option<&'a Comparison>) -> Exploration<'a> {
        Exploration {
            renderer: &self.renderer,
            is_handout: true,
            records: &self.records,
            table: (&self.table.0, &self.table.1),
            picture: &self.picture,
            photon: None,
            comparison,
        }
    }
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
