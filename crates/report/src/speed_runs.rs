//! The runs of speed against error: what each stored by facet, and how long it took.

use std::time::Instant;

use glam::DVec3;

use super::csv::{Table, digits};
use super::plan::Plan;
use fast::trace::trace_list;
use model::facets::facet_of_triangles;
use oracle::table::{ExpectedTable, FacetRow};
use photon_mapping::assignment8;
use photon_mapping::photon_list::PhotonRecord;
use photon_mapping::rendering::photon_mapping_renderer::PhotonMappingRenderer;
use photon_mapping::scene::Scene;

/// One run.
pub struct SpeedRun {
    /// Photons emitted.
    pub emitted: u64,
    /// Its seed.
    pub seed: u64,
    /// How long it took.
    pub seconds: f64,
    /// Stored photons by facet.
    pub stored: Vec<u64>,
}

/// All runs, and their expected values.
pub struct Speed {
    /// Photons emitted, ascending.
    pub sizes: Vec<u64>,
    /// Runs at each size.
    pub seeds: u64,
    /// Size by size.
    pub runs: Vec<SpeedRun>,
    /// The expected values.
    pub expected: ExpectedTable,
    /// The surface of each facet.
    pub surfaces: Vec<usize>,
}

/// Runs everything. Traces as `render` does, on all cores.
pub fn measure(plan: &Plan, progress: &(impl Fn(u64) + Sync)) -> Speed {
    let scene = assignment8::create_scene();
    let planes = planes(&scene);
    let expected = ExpectedTable::of_assignment8();
    let surfaces = planes.iter().map(|plane| plane.surface).collect();
    let base = assignment8::create_renderer(scene);
    // The first run of all would pay for waking the threads.
    run(&base, &planes, 0, 10_000);
    let mut runs = Vec::new();
    for (number, emitted) in plan.sizes.iter().enumerate() {
        for seed in 0..plan.seeds {
            runs.push(run(&base, &planes, Plan::seed(number, seed), *emitted));
            progress(*emitted);
        }
    }
    Speed { sizes: plan.sizes.clone(), seeds: plan.seeds, runs, expected, surfaces }
}

fn run(base: &PhotonMappingRenderer, planes: &[PlanePoints], seed: u64, emitted: u64) -> SpeedRun {
    let renderer = PhotonMappingRenderer { seed, photon_count: emitted, ..base.clone() };
    let mut stored = vec![0; planes.len()];
    let start = Instant::now();
    let Ok(_) = trace_list(&renderer, 0..renderer.emitted(), |records, _| {
        records.iter().for_each(|record| stored[facet(record, planes)] += 1);
        Ok::<_, std::convert::Infallible>(())
    });
    SpeedRun { emitted: renderer.emitted(), seed, seconds: start.elapsed().as_secs_f64(), stored }
}

/// The plane of a facet.
struct PlanePoints {
    surface: usize,
    point: DVec3,
    normal: DVec3,
}

fn planes(scene: &Scene) -> Vec<PlanePoints> {
    let mut planes: Vec<PlanePoints> = Vec::new();
    for (triangle, facet) in scene.triangles().iter().zip(facet_of_triangles(scene)) {
        if facet == planes.len() {
            let [a, b, c] = triangle.vertices.map(|vertex| vertex.as_dvec3());
            let normal = (b - a).cross(c - a).normalize();
            planes.push(PlanePoints { surface: triangle.parent_mesh_object, point: a, normal });
        }
    }
    planes
}

/// The facet a photon lies on. A list names its surface, so it is the nearest plane of that.
fn facet(record: &PhotonRecord, planes: &[PlanePoints]) -> usize {
    let position = record.position.as_dvec3();
    let of_surface =
        planes.iter().enumerate().filter(|(_, plane)| plane.surface == usize::from(record.surface));
    let distance = |plane: &PlanePoints| plane.normal.dot(position - plane.point).abs();
    of_surface
        .min_by(|(_, a), (_, b)| distance(a).total_cmp(&distance(b)))
        .expect("every surface has a facet")
        .0
}

impl Speed {
    /// The runs of `size`.
    pub fn runs_of(&self, size: u64) -> impl Iterator<Item = &SpeedRun> {
        self.runs.iter().filter(move |run| run.emitted == size)
    }

    /// Mean seconds of the runs of `size`.
    pub fn seconds(&self, size: u64) -> f64 {
        self.runs_of(size).map(|run| run.seconds).sum::<f64>() / self.seeds as f64
    }

    /// Every run: its seconds and its stored photons by facet. The first row has the expected
    /// values for one photon.
    pub fn runs_table(&self) -> Table {
        let names: Vec<_> = self
            .expected
            .facets
            .iter()
            .map(|row| format!("{}/{}", row.surface, row.facet))
            .collect();
        let fixed = ["emitted", "seed", "seconds"];
        let mut table =
            Table::with_heads(fixed.into_iter().chain(names.iter().map(String::as_str)));
        let mut expected = vec!["expected".to_owned(), "-".to_owned(), "-".to_owned()];
        let hits = |row: &FacetRow| row.hits[1..].iter().sum::<f64>();
        expected.extend(self.expected.facets.iter().map(|row| digits(hits(row))));
        table.push(expected);
        for run in &self.runs {
            let first = [run.emitted.to_string(), run.seed.to_string(), digits(run.seconds)];
            table.push(first.into_iter().chain(run.stored.iter().map(u64::to_string)));
        }
        table
    }
}
