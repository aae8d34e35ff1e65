//! What f32 costs: the same photons traced in f32 and in f64.

use std::fmt::Write as _;
use std::time::Instant;

use rayon::prelude::*;

use super::PageSection;
use super::both_precisions::{Path, double, single};
use super::csv::{Table, digits, short};
use super::plan::Plan;
use super::plot::{Axes, Mark, PlotLine, draw};
use super::statistics::{most_per_million, quantile};
use model::facets::facet_of_triangles;
use photon_mapping::assignment8;
use photon_mapping::random::photon_random;
use photon_mapping::scene::numerics::LARGE_EPSILON;

/// How many hits of a path are compared.
const HITS: usize = 8;
/// How often each precision is timed. The fastest time counts.
const ROUNDS: usize = 3;
/// Photons a thread traces before it takes the next piece.
const PIECE: u64 = 4096;
const QUANTILES: [f64; 5] = [0.5, 0.9, 0.99, 0.999, 1.0];

/// What was found.
#[derive(Default)]
pub struct Precision {
    photons: u64,
    /// By number of the hit, the sorted distances between the points in f32 and f64.
    distances: [Vec<f64>; HITS],
    /// Paths whose first different decision was in the emission, in the facet hit, or between hit
    /// and escape.
    emission: u64,
    other_facet: u64,
    hit_or_escape: u64,
    /// Nanoseconds a photon.
    single_time: f64,
    double_time: f64,
}

/// Traces in both precisions.
pub fn measure(plan: &Plan, progress: &(impl Fn(u64) + Sync)) -> Precision {
    let scene = assignment8::create_scene();
    let facets = facet_of_triangles(&scene);
    let offset = LARGE_EPSILON.into();
    let (single, double) = (
        single::PrecisionTracer::new(&scene, offset),
        double::PrecisionTracer::new(&scene, offset),
    );
    let pieces: Vec<_> = (0..plan.precision_photons)
        .step_by(PIECE as usize)
        .map(|start| start..plan.precision_photons.min(start + PIECE))
        .collect();
    let found: Vec<_> = pieces
        .par_iter()
        .map(|piece| {
            let mut found = Precision::default();
            let (mut in_single, mut in_double) = (Path::default(), Path::default());
            for photon in piece.clone() {
                single.trace(&mut photon_random(assignment8::SEED, photon), &mut in_single);
                double.trace(&mut photon_random(assignment8::SEED, photon), &mut in_double);
                found.compare(&in_single, &in_double, &facets);
            }
            progress(2 * (piece.end - piece.start));
            found
        })
        .collect();
    let mut all = Precision { photons: plan.precision_photons, ..Precision::default() };
    for part in found {
        all.emission += part.emission;
        all.other_facet += part.other_facet;
        all.hit_or_escape += part.hit_or_escape;
        all.distances.iter_mut().zip(part.distances).for_each(|(all, part)| all.extend(part));
    }
    all.distances.iter_mut().for_each(|distances| distances.sort_by(f64::total_cmp));
    let timed = plan.precision_photons / (2 * ROUNDS as u64);
    let time = |trace: &(dyn Fn(u64, &mut Path) + Sync)| {
        let start = Instant::now();
        (0..timed).into_par_iter().for_each_init(Path::default, |path, photon| trace(photon, path));
        start.elapsed().as_secs_f64() * 1e9 / timed as f64
    };
    (all.single_time, all.double_time) = (f64::INFINITY, f64::INFINITY);
    for _ in 0..ROUNDS {
        let of_single =
            time(&|i, path| single.trace(&mut photon_random(assignment8::SEED, i), path));
        let of_double =
            time(&|i, path| double.trace(&mut photon_random(assignment8::SEED, i), path));
        all.single_time = all.single_time.min(of_single);
        all.double_time = all.double_time.min(of_double);
        progress(2 * timed);
    }
    all
}

impl Precision {
    fn compare(&mut self, single: &Path, double: &Path, facets: &[usize]) {
        if single.tries != double.tries {
            self.emission += 1;
            return;
        }
        for hit in 0.. {
            match (single.hits.get(hit), double.hits.get(hit)) {
                (None, None) => return,
                (Some((a, _)), Some((b, _))) if facets[*a] != facets[*b] => {
                    self.other_facet += 1;
                    return;
                }
                (Some((_, a)), Some((_, b))) => {
                    if let Some(distances) = self.distances.get_mut(hit) {
                        distances.push(a.distance(*b));
                    }
                }
                _ => {
                    self.hit_or_escape += 1;
                    return;
                }
            }
        }
    }

    /// The hits with enough photons for quantiles.
    fn shown(&self) -> impl Iterator<Item = (usize, &Vec<f64>)> {
        self.distances.iter().enumerate().filter(|(_, distances)| distances.len() >= 100)
    }
}

/// The section of the page.
pub fn section(precision: &Precision) -> PageSection {
    let other = precision.emission + precision.other_facet + precision.hit_or_escape;
    let mut text =
        String::from("## 2. Precision\n\n![Distance between f32 and f64](precision.svg)\n\n");
    let _ = writeln!(
        text,
        "{} photons with the random numbers of seed {}, each in f32 and in f64. One piece of code \
         does both; in f32 it gives the bits of the reference. Distances between the points hit, \
         in scene units (the box is 2 wide), while both paths decide alike:\n",
        precision.photons,
        assignment8::SEED
    );
    let mut csv = Table::new("hit compared median q90 q99 q999 largest");
    let mut table =
        Table::with_heads(["hit", "compared", "median", "90 %", "99 %", "99.9 %", "largest"]);
    for (hit, distances) in precision.shown() {
        let row = |number: fn(f64) -> String| {
            let numbers = QUANTILES.map(|fraction| number(quantile(distances, fraction)));
            [(hit + 1).to_string(), distances.len().to_string()].into_iter().chain(numbers)
        };
        csv.push(row(digits));
        table.push(row(|number| short(number, 2)));
    }
    text += &table.markdown();
    let ratio = precision.double_time / precision.single_time;
    let per_million = other as f64 * 1e6 / precision.photons as f64;
    let _ = writeln!(
        text,
        "\n- **{} of a million paths decide otherwise**: {} in all. {} accept another try of the \
         emission, {} hit another facet, {} hit where the other escapes. The roulette cannot \
         differ, because both compare the same numbers.{}",
        short(per_million, 3),
        other,
        precision.emission,
        precision.other_facet,
        precision.hit_or_escape,
        if other == 0 {
            let most = short(most_per_million(precision.photons), 2);
            format!(" With none seen, fewer than {most} of a million are likely (95 %).")
        } else {
            String::new()
        }
    );
    let _ = writeln!(
        text,
        "- **f64 takes {} times as long** as f32 in this code: {} against {} ns a photon, on all \
         cores, the fastest of {ROUNDS} rounds. Neither is vectorized by hand. `render` may be \
         faster than both, and wide f64 lanes would be half as many.",
        short(ratio, 3),
        short(precision.double_time, 3),
        short(precision.single_time, 3)
    );
    let mut summary = Table::new(
        "photons other_decision emission other_facet hit_or_escape f32_nanoseconds f64_nanoseconds \
         time_ratio",
    );
    let counts = [
        precision.photons,
        other,
        precision.emission,
        precision.other_facet,
        precision.hit_or_escape,
    ];
    let times = [precision.single_time, precision.double_time, ratio];
    summary.push(counts.map(|count| count.to_string()).into_iter().chain(times.map(digits)));
    text += "\nData: [distances](precision.csv), [decisions and times](precision-summary.csv).\n";
    let files = vec![
        ("precision.csv", csv.csv()),
        ("precision-summary.csv", summary.csv()),
        ("precision.svg", plot(precision)),
    ];
    PageSection { markdown: text, files }
}

/// For every hit, the share of points that are farther off than a distance.
fn plot(precision: &Precision) -> String {
    let line = |(hit, distances): (usize, &Vec<f64>)| {
        let count = distances.len();
        // Two points for each factor of two in the tail.
        let tails = (0..).map(|k| 2_f64.powf(-f64::from(k) / 2.0));
        let points = tails
            .take_while(|tail| tail * count as f64 >= 1.0)
            .map(|tail| (quantile(distances, 1.0 - tail), tail))
            .filter(|(distance, _)| *distance > 1e-9);
        PlotLine {
            name: format!("hit {}", hit + 1),
            color: hit,
            mark: Mark::Plain,
            points: points.collect(),
            bars: Vec::new(),
        }
    };
    let axes = Axes {
        title: "How far f32 is off: share of points beyond a distance".to_owned(),
        x: "distance between f32 and f64 (scene units)".to_owned(),
        y: "share of points farther off".to_owned(),
    };
    draw(&[(axes, precision.shown().take(5).map(line).collect())])
}
