//! Speed against error: how far stored densities are from what is expected, and what that costs.

use std::fmt::Write as _;
use std::time::Instant;

use glam::DVec3;

use super::Section;
use super::csv::{Table, digits, percent, short};
use super::hits::facet_of_triangles;
use super::plan::Plan;
use super::plot::{Axes, Line, Mark, draw};
use super::statistics::{log_log_slope, rms, rms_factor};
use crate::accuracy::table::ExpectedTable;
use crate::assignment8;
use crate::photon_list::record::PhotonRecord;
use crate::photon_list::trace::trace_list;
use crate::rendering::photon_mapping_renderer::PhotonMappingRenderer;
use crate::scene::Scene;

/// One run.
pub struct Run {
    emitted: u64,
    seed: u64,
    seconds: f64,
    /// Stored photons by facet.
    stored: Vec<u64>,
}

/// All runs, and what they are held against.
pub struct Speed {
    sizes: Vec<u64>,
    seeds: u64,
    runs: Vec<Run>,
    expected: ExpectedTable,
    /// The surface of each facet.
    surfaces: Vec<usize>,
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

fn run(base: &PhotonMappingRenderer, planes: &[Plane], seed: u64, emitted: u64) -> Run {
    let renderer = PhotonMappingRenderer { seed, photon_count: emitted, ..base.clone() };
    let mut stored = vec![0; planes.len()];
    let start = Instant::now();
    let Ok(()) = trace_list(&renderer, 0..renderer.emitted(), |records, _| {
        records.iter().for_each(|record| stored[facet(record, planes)] += 1);
        Ok::<_, std::convert::Infallible>(())
    });
    Run { emitted: renderer.emitted(), seed, seconds: start.elapsed().as_secs_f64(), stored }
}

/// The plane of a facet.
struct Plane {
    surface: usize,
    point: DVec3,
    normal: DVec3,
}

fn planes(scene: &Scene) -> Vec<Plane> {
    let mut planes: Vec<Plane> = Vec::new();
    for (triangle, facet) in scene.triangles().iter().zip(facet_of_triangles(scene)) {
        if facet == planes.len() {
            let [a, b, c] = triangle.vertices.map(|vertex| vertex.as_dvec3());
            let normal = (b - a).cross(c - a).normalize();
            planes.push(Plane { surface: triangle.parent_mesh_object, point: a, normal });
        }
    }
    planes
}

/// The facet a photon lies on: a list names its surface, so it is the nearest plane of that.
fn facet(record: &PhotonRecord, planes: &[Plane]) -> usize {
    let position = record.position.as_dvec3();
    let of_surface =
        planes.iter().enumerate().filter(|(_, plane)| plane.surface == usize::from(record.surface));
    let distance = |plane: &Plane| plane.normal.dot(position - plane.point).abs();
    of_surface
        .min_by(|(_, a), (_, b)| distance(a).total_cmp(&distance(b)))
        .expect("every surface has a facet")
        .0
}

/// A density that is judged, as a sum of facets.
struct Quantity {
    scope: &'static str,
    name: String,
    facets: Vec<usize>,
    expected: f64,
}

impl Speed {
    fn quantities(&self) -> Vec<Quantity> {
        let expected_of = |facet: usize| self.expected.facets[facet].hits[1..].iter().sum::<f64>();
        let quantity = |scope, name: &str, facets: Vec<usize>| {
            let expected = facets.iter().map(|facet| expected_of(*facet)).sum();
            Quantity { scope, name: name.to_owned(), facets, expected }
        };
        let all = 0..self.surfaces.len();
        let mut quantities = vec![quantity("total", "total", all.clone().collect())];
        for (surface, row) in self.expected.surfaces.iter().enumerate() {
            let facets = all.clone().filter(|facet| self.surfaces[*facet] == surface).collect();
            quantities.push(quantity("surface", &row.name, facets));
        }
        for (facet, row) in self.expected.facets.iter().enumerate() {
            let name = format!("{}/{}", row.surface, row.facet);
            quantities.push(quantity("facet", &name, vec![facet]));
        }
        quantities.retain(|quantity| quantity.expected > 0.0);
        quantities
    }

    fn runs_of(&self, size: u64) -> impl Iterator<Item = &Run> {
        self.runs.iter().filter(move |run| run.emitted == size)
    }

    /// Errors of `quantity` relative to what is expected, one for each run of `size`.
    fn errors(&self, size: u64, quantity: &Quantity) -> Vec<f64> {
        let error = |run: &Run| {
            let stored: u64 = quantity.facets.iter().map(|facet| run.stored[*facet]).sum();
            stored as f64 / run.emitted as f64 / quantity.expected - 1.0
        };
        self.runs_of(size).map(error).collect()
    }

    /// RMS error over the runs and over all quantities of `scope`.
    fn scope_rms(&self, size: u64, quantities: &[Quantity], scope: &str) -> f64 {
        let of_scope = quantities.iter().filter(|quantity| quantity.scope == scope);
        rms(&of_scope.flat_map(|quantity| self.errors(size, quantity)).collect::<Vec<_>>())
    }

    /// Mean seconds of the runs of `size`.
    fn seconds(&self, size: u64) -> f64 {
        self.runs_of(size).map(|run| run.seconds).sum::<f64>() / self.seeds as f64
    }

    /// What theory says of one emitted photon: the relative standard deviation of the stored total.
    fn deviation_of_one(&self) -> f64 {
        let variance: f64 = self.expected.covariance.iter().flatten().sum();
        variance.sqrt() / self.expected.total.stored
    }

    fn runs_table(&self) -> Table {
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
        let hits = |row: &crate::accuracy::table::FacetRow| row.hits[1..].iter().sum::<f64>();
        expected.extend(self.expected.facets.iter().map(|row| digits(hits(row))));
        table.push(expected);
        for run in &self.runs {
            let first = [run.emitted.to_string(), run.seed.to_string(), digits(run.seconds)];
            table.push(first.into_iter().chain(run.stored.iter().map(u64::to_string)));
        }
        table
    }
}

/// The section of the page.
pub fn section(speed: &Speed) -> Section {
    let quantities = speed.quantities();
    let factor = rms_factor(speed.seeds);
    let mut details =
        Table::new("emitted scope name expected_per_photon rms_error low high spread");
    for size in &speed.sizes {
        for quantity in &quantities {
            let errors = speed.errors(*size, quantity);
            let sizes: Vec<_> = errors.iter().map(|error| error.abs()).collect();
            let mean = sizes.iter().sum::<f64>() / sizes.len() as f64;
            let spread = rms(&sizes.iter().map(|size| size - mean).collect::<Vec<_>>());
            let rms = rms(&errors);
            let numbers = [quantity.expected, rms, rms / factor, rms * factor, spread].map(digits);
            let names = [size.to_string(), quantity.scope.to_owned(), quantity.name.clone()];
            details.push(names.into_iter().chain(numbers));
        }
    }
    let scopes = ["total", "surface", "facet"];
    let curve = |scope: &str| -> Vec<f64> {
        speed.sizes.iter().map(|size| speed.scope_rms(*size, &quantities, scope)).collect()
    };
    let curves = scopes.map(curve);
    let mut files = vec![
        ("speed-runs.csv", speed.runs_table().csv()),
        ("speed.csv", details.csv()),
        ("speed.svg", plot(speed, &curves)),
    ];
    files.sort_by_key(|file| file.0);
    Section { markdown: markdown(speed, &curves), files }
}

fn markdown(speed: &Speed, curves: &[Vec<f64>; 3]) -> String {
    let mut text = String::from(
        "## 1. Speed against error\n\n![RMS error over emitted photons](speed.svg)\n\n",
    );
    let factor = rms_factor(speed.seeds);
    let _ = writeln!(
        text,
        "Relative error of the stored density against the expectation, as the root of its mean square \
         over {} seeds at each size; no two runs share a photon. With that many seeds an RMS is known \
         to within a factor {factor:.2} either way (95 %). Seconds are means, for tracing on all cores \
         and counting by facet.\n",
        speed.seeds
    );
    let mut table = Table::with_heads([
        "emitted",
        "total",
        "95 % interval",
        "theory",
        "each surface",
        "each facet",
        "seconds",
        "photons/s",
        "efficiency 1/(variance s)",
    ]);
    for (k, size) in speed.sizes.iter().enumerate() {
        let (total, seconds) = (curves[0][k], speed.seconds(*size));
        table.push([
            short(*size as f64, 1),
            percent(total),
            format!("{} to {}", percent(total / factor), percent(total * factor)),
            percent(speed.deviation_of_one() / (*size as f64).sqrt()),
            percent(curves[1][k]),
            percent(curves[2][k]),
            short(seconds, 3),
            short(*size as f64 / seconds, 3),
            short(1.0 / (total * total * seconds), 3),
        ]);
    }
    text += &table.markdown();
    text += "\n";
    let slopes = curves.each_ref().map(|curve| log_log_slope(&speed.sizes, curve, speed.seeds));
    for (name, slope) in ["total", "each surface", "each facet"].iter().zip(slopes) {
        let _ = writeln!(
            text,
            "- Log-log slope, {name}: **{:.3} +- {:.3}** (95 %), expected -0.5.",
            slope.slope, slope.half_width
        );
    }
    let largest = *speed.sizes.last().expect("a plan has sizes");
    let photons_per_second = largest as f64 / speed.seconds(largest);
    let squares =
        speed.sizes.iter().zip(&curves[0]).map(|(size, error)| *size as f64 * error * error);
    let constant = squares.sum::<f64>() / speed.sizes.len() as f64;
    let known_within = rms_factor(speed.seeds * speed.sizes.len() as u64).powi(2);
    for goal in [0.01, 0.001] {
        let photons = constant / (goal * goal);
        let theory = (speed.deviation_of_one() / goal).powi(2);
        let _ = writeln!(
            text,
            "- To {} % of the stored total: **{} photons**, **{} s** at {} photons/s. 95 %: {} to {} photons; theory: {}.",
            100.0 * goal,
            short(photons, 3),
            short(photons / photons_per_second, 3),
            short(photons_per_second, 3),
            short(photons / known_within, 3),
            short(photons * known_within, 3),
            short(theory, 3),
        );
    }
    text += "\nThe photons to a goal are goal^-2 times the mean over all sizes of (emitted x squared RMS); \
             the speed is that at the largest size. Theory is the variance of whole paths from \
             `photon-mapping expect`, in which no photon is traced. Data: \
             [every run](speed-runs.csv), [by surface and facet](speed.csv), with the spread of the \
             absolute error over seeds.\n";
    text
}

fn plot(speed: &Speed, curves: &[Vec<f64>; 3]) -> String {
    let factor = rms_factor(speed.seeds);
    let names = ["total", "each surface", "each facet"];
    let mut lines: Vec<_> = names
        .iter()
        .zip(curves)
        .enumerate()
        .map(|(colour, (name, curve))| {
            let points = speed.sizes.iter().zip(curve);
            Line {
                name: format!("{name} (bars: 95 %)"),
                colour,
                mark: Mark::Bars(factor),
                points: points.map(|(size, error)| (*size as f64, *error)).collect(),
            }
        })
        .collect();
    let theory = |size: &u64| (*size as f64, speed.deviation_of_one() / (*size as f64).sqrt());
    lines.push(Line {
        name: "total, theory (slope -1/2)".to_owned(),
        colour: 3,
        mark: Mark::Dashes,
        points: speed.sizes.iter().map(theory).collect(),
    });
    let axes = Axes {
        title: "Error of the stored density".to_owned(),
        x: "emitted photons".to_owned(),
        y: "RMS relative error".to_owned(),
    };
    draw(&[(axes, lines)])
}
