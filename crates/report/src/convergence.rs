//! Speed against error: how far stored densities are from what is expected, and what that costs.

use std::fmt::Write as _;

use super::PageSection;
use super::csv::{Table, digits, percent, short};
use super::plot::{Axes, Mark, PlotLine, draw};
use super::speed_runs::{Speed, SpeedRun};
use super::statistics::{Estimate, FEWEST, Runs, log_log_slope, rms, variance_of_one};

/// A density that is judged, as a sum of facets.
struct Quantity {
    scope: &'static str,
    name: String,
    facets: Vec<usize>,
    expected: f64,
}

/// The errors of the total, of each surface, or of each facet.
struct Curve {
    name: &'static str,
    /// Photons expected for one that is emitted, in the cell with the fewest.
    fewest: f64,
    /// By size, over all cells.
    rms: Vec<Estimate>,
    slope: Option<Estimate>,
    squares: Vec<Runs>,
}

/// Whether so many photons are expected that errors have an interval.
fn has_interval(size: u64, expected: f64) -> bool {
    size as f64 * expected >= FEWEST
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

    /// The squared relative errors of `quantities`, by size and run.
    fn squares(&self, quantities: &[&Quantity]) -> Vec<Runs> {
        let square = |run: &SpeedRun, quantity: &Quantity| {
            let stored: u64 = quantity.facets.iter().map(|facet| run.stored[*facet]).sum();
            (stored as f64 / run.emitted as f64 / quantity.expected - 1.0).powi(2)
        };
        let of_run = |run| quantities.iter().map(|quantity| square(run, quantity)).collect();
        let sizes = self.sizes.iter();
        sizes.map(|size| self.runs_of(*size).map(of_run).collect()).collect()
    }

    /// What theory says of one emitted photon: the relative standard deviation of the stored total.
    fn deviation_of_one(&self) -> f64 {
        let variance: f64 = self.expected.covariance.iter().flatten().sum();
        variance.sqrt() / self.expected.total.stored
    }

    /// All that a scope of quantities comes to.
    fn curves(&self) -> [Curve; 3] {
        let quantities = self.quantities();
        [("total", "total"), ("surface", "each surface"), ("facet", "each facet")].map(
            |(scope, name)| {
                let of_scope: Vec<_> =
                    quantities.iter().filter(|quantity| quantity.scope == scope).collect();
                let squares = self.squares(&of_scope);
                let expected: Vec<_> = of_scope.iter().map(|quantity| quantity.expected).collect();
                let fewest = expected.iter().copied().fold(f64::INFINITY, f64::min);
                let rms = squares.iter().map(rms).collect();
                let slope = log_log_slope(&self.sizes, &squares, &expected);
                Curve { name, fewest, rms, slope, squares }
            },
        )
    }
}

/// The section of the page.
pub fn section(speed: &Speed) -> PageSection {
    let curves = speed.curves();
    let files = vec![
        ("speed-runs.csv", speed.runs_table().csv()),
        ("speed.csv", details(speed, &curves).csv()),
        ("speed.svg", plot(speed, &curves)),
    ];
    PageSection { markdown: markdown(speed, &curves), files }
}

/// Errors by size and quantity, with their intervals; last by scope, over all of its quantities.
fn details(speed: &Speed, curves: &[Curve]) -> Table {
    let mut table =
        Table::new("emitted scope name expected_per_photon rms_error low high spread theory");
    let none = || "-".to_owned();
    let interval = |size: u64, expected: f64, rms: Estimate| {
        let is_known = has_interval(size, expected);
        [rms.low, rms.high].map(|end| if is_known { digits(end) } else { none() })
    };
    let quantities = speed.quantities();
    let squares: Vec<_> = quantities.iter().map(|quantity| speed.squares(&[quantity])).collect();
    for (number, size) in speed.sizes.iter().enumerate() {
        for (quantity, squares) in quantities.iter().zip(&squares) {
            let rms = rms(&squares[number]);
            let sizes: Vec<_> =
                squares[number].iter().flatten().map(|square| square.sqrt()).collect();
            let mean = sizes.iter().sum::<f64>() / sizes.len() as f64;
            let variance = sizes.iter().map(|size| (size - mean).powi(2)).sum::<f64>();
            let spread = (variance / sizes.len() as f64).sqrt();
            let [low, high] = interval(*size, quantity.expected, rms);
            let theory = if quantity.scope == "total" {
                digits(speed.deviation_of_one() / (*size as f64).sqrt())
            } else {
                none()
            };
            let names = [size.to_string(), quantity.scope.to_owned(), quantity.name.clone()];
            let numbers = [digits(quantity.expected), digits(rms.value), low, high, digits(spread)];
            table.push(names.into_iter().chain(numbers).chain([theory]));
        }
        for curve in &curves[1..] {
            let rms = curve.rms[number];
            let [low, high] = interval(*size, curve.fewest, rms);
            let names = [size.to_string(), "all".to_owned(), curve.name.replace(' ', "_")];
            let numbers = [none(), digits(rms.value), low, high, none(), none()];
            table.push(names.into_iter().chain(numbers));
        }
    }
    table
}

fn markdown(speed: &Speed, curves: &[Curve; 3]) -> String {
    let mut text = String::from(
        "## 1. Speed against error\n\n![RMS error over emitted photons](speed.svg)\n\n",
    );
    let _ = writeln!(
        text,
        "Relative error of the stored density against the expected value: the root of its mean \
         square over {} seeds at each size. No two runs share a photon. Intervals hold the true \
         value with 95 %. They are jackknifed over the seeds, so no law of the errors is assumed. \
         Where a surface or facet expects fewer than {FEWEST} photons, its error has no interval \
         and no part in a slope. Seconds are means, for tracing on all cores and counting by \
         facet.\n",
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
        let (rms, seconds) = (curves[0].rms[k], speed.seconds(*size));
        let total = rms.value;
        table.push([
            short(*size as f64, 1),
            percent(total),
            if has_interval(*size, curves[0].fewest) {
                format!("{} to {}", percent(rms.low), percent(rms.high))
            } else {
                "-".to_owned()
            },
            percent(speed.deviation_of_one() / (*size as f64).sqrt()),
            percent(curves[1].rms[k].value),
            percent(curves[2].rms[k].value),
            short(seconds, 3),
            short(*size as f64 / seconds, 3),
            short(1.0 / (total * total * seconds), 3),
        ]);
    }
    text += &table.markdown();
    text += "\n";
    for Curve { name, slope, .. } in curves {
        let slope = slope.map_or_else(
            || "not known from so few photons".to_owned(),
            |slope| format!("**{:.3}** (95 %: {:.3} to {:.3})", slope.value, slope.low, slope.high),
        );
        let _ = writeln!(text, "- Log-log slope, {name}: {slope}, expected -0.5.");
    }
    let largest = *speed.sizes.last().expect("a plan has sizes");
    let photons_per_second = largest as f64 / speed.seconds(largest);
    let of_one = variance_of_one(&speed.sizes, &curves[0].squares);
    for goal in [0.01, 0.001] {
        let photons = of_one.value / (goal * goal);
        let theory = (speed.deviation_of_one() / goal).powi(2);
        let _ = writeln!(
            text,
            "- To {} % of the stored total: **{} photons**, **{} s** at {} photons/s. 95 %: {} to \
             {} photons; theory: {}.",
            100.0 * goal,
            short(photons, 3),
            short(photons / photons_per_second, 3),
            short(photons_per_second, 3),
            short(of_one.low / (goal * goal), 3),
            short(of_one.high / (goal * goal), 3),
            short(theory, 3),
        );
    }
    text += "\nThe photons to a goal are goal^-2 times the mean over all sizes of (emitted x \
             squared RMS). The speed is that at the largest size. Theory is the variance of whole \
             paths from `photon-mapping expect`, which traces no photon. Data: [every \
             run](speed-runs.csv), and [by surface and facet](speed.csv) with the spread of the \
             absolute error over seeds.\n";
    text
}

fn plot(speed: &Speed, curves: &[Curve]) -> String {
    let line = |(color, curve): (usize, &Curve)| {
        let sizes = || speed.sizes.iter().zip(&curve.rms);
        let known = sizes().filter(|(size, _)| has_interval(**size, curve.fewest));
        PlotLine {
            name: format!("{} (bars: 95 %)", curve.name),
            color,
            mark: Mark::Circles,
            points: sizes().map(|(size, rms)| (*size as f64, rms.value)).collect(),
            bars: known.map(|(size, rms)| (*size as f64, rms.low, rms.high)).collect(),
        }
    };
    let mut lines: Vec<_> = curves.iter().enumerate().map(line).collect();
    let theory = |size: &u64| (*size as f64, speed.deviation_of_one() / (*size as f64).sqrt());
    lines.push(PlotLine {
        name: "total, theory (slope -1/2)".to_owned(),
        color: 3,
        mark: Mark::Dashes,
        points: speed.sizes.iter().map(theory).collect(),
        bars: Vec::new(),
    });
    let axes = Axes {
        title: "Error of the stored density".to_owned(),
        x: "emitted photons".to_owned(),
        y: "RMS relative error".to_owned(),
    };
    draw(&[(axes, lines)])
}
