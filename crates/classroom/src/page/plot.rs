//! Histograms beside what is expected, and maps of cells, as SVG.

use maud::{Markup, html};
use plotters::coord::Shift;
use plotters::prelude::*;

use super::pictures::strength;
use super::profile::Axis;
use grading::places::FacetCells;
use grading::text::rounded;

const SIZE: (u32, u32) = (320, 150);
/// Fewer bins than this have a tick each.
const MANY_BINS: usize = 10;
const FOUND: RGBColor = RGBColor(40, 100, 170);
const EXPECTED: RGBColor = RGBColor(20, 20, 20);
const MISREAD: RGBColor = RGBColor(213, 94, 0);

type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
type Failure<'a> = DrawingAreaErrorKind<<SVGBackend<'a> as DrawingBackend>::ErrorType>;

/// Counts in equal parts of an interval.
pub struct Histogram<'a> {
    /// Below the plot.
    pub what: String,
    /// The interval.
    pub ends: [f64; 2],
    /// What was found.
    pub found: &'a [f64],
    /// What is expected.
    pub expected: &'a [f64],
    /// What the named misreading leads to expect.
    pub misread: Option<&'a [f64]>,
}

impl Histogram<'_> {
    /// Bars for what was found, a line and the band of two standard deviations for what is
    /// expected, and an orange line for the misreading.
    pub fn svg(&self) -> String {
        let mut svg = String::new();
        {
            let area = SVGBackend::with_string(&mut svg, SIZE).into_drawing_area();
            self.draw(&area).expect("writing to a string does not fail");
        }
        svg
    }

    fn draw<'a>(&self, area: &Area<'a>) -> Result<(), Failure<'a>> {
        let [low, high] = self.ends;
        let highest = |counts: &[f64]| counts.iter().copied().fold(1.0, f64::max);
        let expected = highest(self.expected);
        let most = highest(self.found).max(expected + 2.0 * expected.sqrt());
        let most = 1.05 * most.max(self.misread.map_or(0.0, highest));
        let mut chart = ChartBuilder::on(area)
            .margin(4)
            .margin_right(10)
            .x_label_area_size(30)
            .y_label_area_size(42)
            .build_cartesian_2d(low..high, 0.0..most)?;
        chart
            .configure_mesh()
            .disable_x_mesh()
            .x_desc(&self.what)
            .x_labels(if self.found.len() < MANY_BINS { MANY_BINS } else { 6 })
            .y_labels(4)
            .label_style(("sans-serif", 11))
            .axis_desc_style(("sans-serif", 12))
            .light_line_style(WHITE)
            .bold_line_style(RGBColor(225, 225, 225))
            .x_label_formatter(&tick)
            .y_label_formatter(&|count| {
                if count.fract() == 0.0 { tick(count) } else { String::new() }
            })
            .draw()?;
        let step = (high - low) / self.found.len() as f64;
        let left = |bin: usize| low + step * bin as f64;
        let bars = self.found.iter().enumerate().map(|(bin, count)| {
            Rectangle::new([(left(bin), 0.0), (left(bin + 1), *count)], FOUND.mix(0.3).filled())
        });
        chart.draw_series(bars)?;
        let band = self.expected.iter().enumerate().map(|(bin, count)| {
            let spread = 2.0 * count.sqrt();
            let corners = [
                (left(bin), (count - spread).max(0.0)),
                (left(bin + 1), (count + spread).min(most)),
            ];
            Rectangle::new(corners, EXPECTED.mix(0.12).filled())
        });
        chart.draw_series(band)?;
        let steps = |counts: &[f64]| -> Vec<(f64, f64)> {
            let ends = |(bin, count): (usize, &f64)| [(left(bin), *count), (left(bin + 1), *count)];
            counts.iter().enumerate().flat_map(ends).collect()
        };
        chart.draw_series(LineSeries::new(steps(self.found), FOUND.stroke_width(2)))?;
        if let Some(misread) = self.misread {
            chart.draw_series(LineSeries::new(steps(misread), MISREAD.stroke_width(2)))?;
        }
        chart.draw_series(LineSeries::new(steps(self.expected), EXPECTED.stroke_width(1)))?;
        area.present()
    }
}

/// The label of the place `at` on an axis: with no more decimals than it needs.
fn tick(at: &f64) -> String {
    // Never "-0".
    format!("{}", (at * 100.0).round() / 100.0 + 0.0)
}

/// The cells of `facet`, the world's x or y to the right and y or z up: in each, how many times as
/// many photons as expected it has, in color beyond two standard deviations. `found`, `expected`
/// and `variance` are by cell of the scene.
pub fn map(
    facet: &FacetCells,
    axes: &[Axis; 2],
    found: &[f64],
    expected: &[f64],
    variance: &[f64],
) -> Markup {
    let [columns, rows] = Axis::order(axes);
    let (across, up) = (&axes[columns], &axes[rows]);
    let (width, height) = (across.ends[1] - across.ends[0], up.ends[1] - up.ends[0]);
    let scale = 150.0 / width.max(height);
    let (width, height) = (scale * width, scale * height);
    let divisions = facet.divisions;
    let (cell_width, cell_height) = (width / divisions as f64, height / divisions as f64);
    let cells = (0..divisions * divisions).map(|at| {
        let middle = |at: usize| (at as f64 + 0.5) / divisions as f64;
        let along = [middle(at % divisions), middle(at / divisions)];
        let x = across.ascending(along[columns]) * width - cell_width / 2.0;
        let y = (1.0 - up.ascending(along[rows])) * height - cell_height / 2.0;
        let cell = facet.first_cell + at;
        (x, y, found[cell], expected[cell], variance[cell])
    });
    html! {
        svg viewBox=(format!("-1 -1 {:.1} {:.1}", width + 2.0, height + 2.0))
            width=(format!("{:.0}", width + 2.0)) role="img" aria-label="density by cell" {
            @for (x, y, found, expected, variance) in cells {
                @let away = (found - expected) / variance.max(1.0).sqrt();
                rect x=(format!("{x:.1}")) y=(format!("{y:.1}"))
                    width=(format!("{cell_width:.1}")) height=(format!("{cell_height:.1}"))
                    fill=(if away > 0.0 { "#e69f00" } else { "#3f8fe0" })
                    fill-opacity=(format!("{:.2}", strength(away))) stroke="#999" {
                    title { (format!("{} found, {expected:.1} expected ({away:+.1} \
                                      standard deviations)", rounded(found))) }
                }
                text x=(format!("{:.1}", x + cell_width / 2.0))
                    y=(format!("{:.1}", y + cell_height / 2.0 + 4.0)) {
                    (ratio(found, expected))
                }
            }
        }
    }
}

/// `found` divided by `expected`, where that says something.
pub fn ratio(found: f64, expected: f64) -> String {
    if expected >= 0.5 { format!("{:.2}", found / expected) } else { format!("{found:.0}") }
}
