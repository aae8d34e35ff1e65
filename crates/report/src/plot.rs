//! Plots with logarithmic axes, as SVG.

use plotters::coord::Shift;
use plotters::prelude::*;

/// What the axes say.
pub struct Axes {
    /// Above the plot.
    pub title: String,
    /// Below the plot, with its unit.
    pub x: String,
    /// Beside the plot, with its unit.
    pub y: String,
}

/// How the points of a line are shown.
#[derive(Clone, Copy, Debug)]
pub enum Mark {
    /// Joined, without marks.
    Plain,
    /// Joined, with circles.
    Circles,
    /// A dashed line without marks.
    Dashes,
    /// Dashed, with hollow circles.
    Hollow,
}

impl Mark {
    fn is_dashed(self) -> bool {
        matches!(self, Self::Dashes | Self::Hollow)
    }

    fn has_circles(self) -> bool {
        !matches!(self, Self::Dashes | Self::Plain)
    }
}

/// Points of one kind.
pub struct PlotLine {
    /// In the legend.
    pub name: String,
    /// Number in the palette.
    pub color: usize,
    /// How they are shown.
    pub mark: Mark,
    /// All above zero.
    pub points: Vec<(f64, f64)>,
    /// Bars at x, from one y to another.
    pub bars: Vec<(f64, f64, f64)>,
}

/// Okabe and Ito's colors, which the color-blind can tell apart.
const PALETTE: [RGBColor; 7] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(90, 90, 90),
    RGBColor(204, 121, 167),
    RGBColor(86, 180, 233),
    RGBColor(230, 159, 0),
];
const WIDTH: u32 = 900;
/// Of which this much is the legend's.
const LEGEND: u32 = 220;
const HEIGHT: u32 = 460;

type PlotArea<'a> = DrawingArea<SVGBackend<'a>, Shift>;
type DrawingFailure<'a> = DrawingAreaErrorKind<<SVGBackend<'a> as DrawingBackend>::ErrorType>;

/// Draws the plots below one another and gives the SVG.
pub fn draw(plots: &[(Axes, Vec<PlotLine>)]) -> String {
    let mut svg = String::new();
    {
        let size = (WIDTH, HEIGHT * plots.len() as u32);
        let root = SVGBackend::with_string(&mut svg, size).into_drawing_area();
        let drawn = draw_all(&root, plots);
        drawn.expect("writing to a string does not fail");
    }
    svg
}

fn draw_all<'a>(
    root: &PlotArea<'a>,
    plots: &[(Axes, Vec<PlotLine>)],
) -> Result<(), DrawingFailure<'a>> {
    root.fill(&WHITE)?;
    for (area, (axes, lines)) in root.split_evenly((plots.len(), 1)).iter().zip(plots) {
        draw_one(area, axes, lines)?;
    }
    root.present()
}

fn draw_one<'a>(
    area: &PlotArea<'a>,
    axes: &Axes,
    lines: &[PlotLine],
) -> Result<(), DrawingFailure<'a>> {
    let (area, legend) = area.split_horizontally(WIDTH - LEGEND);
    let points = || lines.iter().flat_map(|line| line.points.iter());
    let (x_low, x_high) = range(points().map(|point| point.0));
    let (y_low, y_high) = range(points().map(|point| point.1));
    let mut chart = ChartBuilder::on(&area)
        .caption(&axes.title, ("sans-serif", 20))
        .margin(12)
        .margin_right(24)
        .x_label_area_size(44)
        .y_label_area_size(78)
        .build_cartesian_2d((x_low..x_high).log_scale(), (y_low..y_high).log_scale())?;
    chart
        .configure_mesh()
        .x_desc(&axes.x)
        .y_desc(&axes.y)
        .x_labels(10)
        .y_labels(10)
        .axis_desc_style(("sans-serif", 16))
        .label_style(("sans-serif", 14))
        .light_line_style(RGBColor(240, 240, 240))
        .bold_line_style(RGBColor(215, 215, 215))
        .x_label_formatter(&|x| power_of_ten(*x))
        .y_label_formatter(&|y| power_of_ten(*y))
        .draw()?;
    for line in lines {
        let color = PALETTE[line.color % PALETTE.len()];
        let stroke = color.stroke_width(2);
        let dashed = line.mark.is_dashed();
        if dashed {
            let dashes = DashedLineSeries::new(line.points.clone(), 6, 4, stroke);
            chart.draw_series(dashes)?;
        } else {
            chart.draw_series(LineSeries::new(line.points.clone(), stroke))?;
        }
        let fill = if dashed { WHITE.filled() } else { color.filled() };
        if line.mark.has_circles() {
            let circle = |point: &(f64, f64)| Circle::new(*point, 4, fill);
            chart.draw_series(line.points.iter().map(circle))?;
            let ring = |point: &(f64, f64)| Circle::new(*point, 4, color.stroke_width(2));
            chart.draw_series(line.points.iter().map(ring))?;
        }
        let bar = |&(x, low, high): &(f64, f64, f64)| {
            PathElement::new(vec![(x, low), (x, high)], color.stroke_width(1))
        };
        chart.draw_series(line.bars.iter().map(bar))?;
    }
    draw_legend(&legend, lines)
}

/// Names the lines, beside the plot, where nothing is hidden.
fn draw_legend<'a>(area: &PlotArea<'a>, lines: &[PlotLine]) -> Result<(), DrawingFailure<'a>> {
    for (row, line) in lines.iter().enumerate() {
        let y = 60 + 24 * row as i32;
        let color = PALETTE[line.color % PALETTE.len()];
        let dashes = if line.mark.is_dashed() { vec![0, 10, 18] } else { vec![0] };
        let length = if line.mark.is_dashed() { 6 } else { 24 };
        for x in dashes {
            area.draw(&PathElement::new([(x, y), (x + length, y)], color.stroke_width(2)))?;
        }
        if line.mark.has_circles() {
            let fill = if line.mark.is_dashed() { WHITE.filled() } else { color.filled() };
            area.draw(&Circle::new((12, y), 4, fill))?;
            area.draw(&Circle::new((12, y), 4, color.stroke_width(2)))?;
        }
        area.draw(&Text::new(line.name.clone(), (32, y - 7), ("sans-serif", 14)))?;
    }
    Ok(())
}

/// From below to above `values`, with room at both ends and at least one power of ten.
fn range(values: impl Iterator<Item = f64>) -> (f64, f64) {
    let (low, high) = values
        .fold((f64::INFINITY, 0.0_f64), |(low, high), value| (low.min(value), high.max(value)));
    (low / 2.0, (high * 2.0).max(low * 10.0))
}

fn power_of_ten(value: f64) -> String {
    let power = value.log10();
    if (power - power.round()).abs() < 1e-6 {
        format!("1e{}", power.round())
    } else {
        String::new()
    }
}
