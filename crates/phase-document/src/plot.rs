//! Bar charts and curves as SVG, for browsers and papers.

use crate::markup::escape;
use std::fmt::Write as _;

/// Measures of the drawing (px).
const ROW: usize = 22;
const LABELS: usize = 210;
const BARS: usize = 420;
const TOP: usize = 44;

/// A chart with one horizontal bar for each name, its value behind it. `unit` follows every value; bars of
/// values that are not finite or negative are empty.
#[must_use]
pub fn bars(title: &str, unit: &str, rows: &[(String, f64)]) -> String {
    let width = LABELS + BARS + 90;
    let height = TOP + ROW * rows.len() + 12;
    let longest = rows.iter().map(|(_, number)| length(*number)).fold(f64::MIN_POSITIVE, f64::max);
    let mut svg = head(title, width, height);
    for (k, (name, number)) in rows.iter().enumerate() {
        let y = TOP + ROW * k;
        let long = BARS as f64 * length(*number) / longest;
        let label = LABELS - 8;
        let value = LABELS as f64 + long + 6.0;
        // Writing to a string cannot fail.
        let _ = writeln!(
            svg,
            "<text x=\"{label}\" y=\"{}\" text-anchor=\"end\">{}</text>\
             <rect x=\"{LABELS}\" y=\"{}\" width=\"{long:.1}\" height=\"{}\" fill=\"#4477aa\"/>\
             <text x=\"{value:.1}\" y=\"{}\">{}{}</text>",
            y + 15,
            escape(name),
            y + 3,
            ROW - 6,
            y + 15,
            (number * 10.0).round() / 10.0,
            escape(unit)
        );
    }
    svg + "</svg>\n"
}

/// A table of shares (0 to 1) as a picture: a row for each label, a column for each answer, and in each
/// cell the share in per cent on a ground that is darker the greater it is. Shares that are not finite are
/// blank.
#[must_use]
pub fn matrix(title: &str, rows: &[String], columns: &[String], shares: &[Vec<f64>]) -> String {
    const CELL: usize = 44;
    // Names of columns stand slanted above them.
    let longest = columns.iter().map(|name| name.chars().count()).max().unwrap_or_default();
    let top = TOP + 20 + longest * 5;
    let width = LABELS + CELL * columns.len() + longest * 5 + 20;
    let height = top + CELL * rows.len() + 12;
    let mut svg = head(title, width, height);
    for (k, name) in columns.iter().enumerate() {
        let (x, y) = (LABELS + CELL * k + CELL / 2, top - 6);
        let _ = writeln!(svg, "<text transform=\"translate({x} {y}) rotate(-45)\">{}</text>", escape(name));
    }
    for (k, (name, row)) in rows.iter().zip(shares).enumerate() {
        let y = top + CELL * k;
        let label = LABELS - 8;
        let _ = writeln!(
            svg,
            "<text x=\"{label}\" y=\"{}\" text-anchor=\"end\">{}</text>",
            y + CELL / 2 + 5,
            escape(name)
        );
        for (k, share) in row.iter().enumerate().filter(|(_, share)| share.is_finite()) {
            let share = share.clamp(0.0, 1.0);
            let ink = if share > 0.5 { "white" } else { "black" };
            let x = LABELS + CELL * k;
            let _ = writeln!(
                svg,
                "<rect x=\"{x}\" y=\"{y}\" width=\"{CELL}\" height=\"{CELL}\" fill=\"#4477aa\" \
                 fill-opacity=\"{share:.3}\" stroke=\"#cccccc\"/>\
                 <text x=\"{}\" y=\"{}\" text-anchor=\"middle\" fill=\"{ink}\">{:.0}</text>",
                x + CELL / 2,
                y + CELL / 2 + 5,
                100.0 * share
            );
        }
    }
    svg + "</svg>\n"
}

/// The beginning of a drawing: its size, white ground and title.
fn head(title: &str, width: usize, height: usize) -> String {
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
         viewBox=\"0 0 {width} {height}\" font-family=\"sans-serif\" font-size=\"13\">\n\
         <rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n\
         <text x=\"12\" y=\"26\" font-size=\"16\" font-weight=\"bold\">{}</text>\n",
        escape(title)
    )
}

/// An axis.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Axis<'a> {
    name: &'a str,
    scale: Scale,
}

/// The scale of an axis.
#[derive(Clone, Copy, PartialEq, Debug)]
enum Scale {
    Linear { step: f64, steps: usize },
    Logarithmic { from: f64, to: f64 },
}

impl<'a> Axis<'a> {
    /// A linear axis from 0 to a value above 0, or somewhat further to the next mark; marks are at round
    /// values. The name includes the unit.
    #[must_use]
    pub fn linear(name: &'a str, to: f64) -> Self {
        // Steps between values beyond these are 0 or infinite.
        let to = if to.is_finite() && to > 0.0 { to.clamp(1e-300, 1e300) } else { 1.0 };
        let least = to / MAX_TICKS as f64;
        let power = libm::pow(10.0, libm::log10(least).floor());
        // A rounding error must not lead to the next step.
        let reaches = |step: &f64| *step >= least * (1.0 - 1e-9);
        let step = [1.0, 2.0, 5.0].map(|digit| digit * power).into_iter().find(reaches);
        let step = step.unwrap_or(10.0 * power);
        let steps = (to / step * (1.0 - 1e-9)).ceil() as usize;
        Self { name, scale: Scale::Linear { step, steps } }
    }

    /// A logarithmic axis between two values above 0.
    #[must_use]
    pub const fn logarithmic(name: &'a str, from: f64, to: f64) -> Self {
        Self { name, scale: Scale::Logarithmic { from, to } }
    }

    /// Position of a value, from 0 to 1.
    fn place(&self, number: f64) -> f64 {
        let place = match self.scale {
            Scale::Linear { step, steps } => number / (step * steps as f64),
            Scale::Logarithmic { from, to } => libm::log2(number / from) / libm::log2(to / from),
        };
        // If both ends are equal, every value has the same position.
        if place.is_nan() { 0.0 } else { place.clamp(0.0, 1.0) }
    }

    /// The values written along it.
    fn ticks(&self) -> Vec<f64> {
        match self.scale {
            Scale::Linear { step, steps } => (0..=steps).map(|k| step * k as f64).collect(),
            // If a limit is not a number above 0, nothing is written.
            Scale::Logarithmic { from, to } if from > 0.0 && to >= from => {
                let doublings = libm::log2(to / from).min(16.0) as u32;
                (0..=doublings).map(|k| from * f64::from(1_u32 << k)).collect()
            }
            Scale::Logarithmic { .. } => Vec::new(),
        }
    }
}

/// A line through points.
#[derive(Clone, PartialEq, Debug)]
pub struct Series<'a> {
    /// Name of the series, shown beside its line.
    pub name: &'a str,
    /// The points, x and y.
    pub points: Vec<(f64, f64)>,
}

/// Measures of a drawing with two axes (px): of the field between the axes, and of what is left, below and
/// above it.
const FIELD: (f64, f64) = (480.0, 320.0);
const MARGIN: f64 = 64.0;
/// Room for the names of lines beside the field (px): at least, and for each letter.
const MIN_LEGEND_WIDTH: f64 = 100.0;
const CHARACTER_WIDTH: f64 = 7.0;
/// Colours of lines, chosen to be distinguishable with a colour vision deficiency too.
const COLOURS: [&str; 7] = ["#4477aa", "#cc6677", "#888888", "#228833", "#aa3377", "#66ccee", "#ccbb44"];
/// Maximum number of marks along an axis, beside that at 0.
const MAX_TICKS: usize = 5;

/// A chart with two axes, x and y, and a line with dots for each series. Points that are not finite are left
/// out; those beyond an axis are drawn at its end.
#[must_use]
pub fn line_chart(title: &str, [x_axis, y_axis]: [Axis<'_>; 2], series: &[Series<'_>]) -> String {
    let longest = series.iter().map(|line| line.name.chars().count()).max().unwrap_or_default() as f64;
    let names = f64::max(MIN_LEGEND_WIDTH, CHARACTER_WIDTH * longest);
    let width = FIELD.0 + 2.0 * MARGIN + names;
    let height = FIELD.1 + 2.0 * MARGIN;
    let at =
        |(x, y): (f64, f64)| (MARGIN + FIELD.0 * x_axis.place(x), MARGIN + FIELD.1 * (1.0 - y_axis.place(y)));
    let right = MARGIN + FIELD.0;
    let bottom = MARGIN + FIELD.1;
    let middle = MARGIN + FIELD.0 / 2.0;
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
         viewBox=\"0 0 {width} {height}\" font-family=\"sans-serif\" font-size=\"13\">\n\
         <rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n\
         <text x=\"12\" y=\"26\" font-size=\"16\" font-weight=\"bold\">{}</text>\n\
         <text x=\"{middle}\" y=\"{}\" text-anchor=\"middle\">{}</text>\n\
         <text x=\"12\" y=\"{}\">{}</text>\n",
        escape(title),
        bottom + 44.0,
        escape(x_axis.name),
        MARGIN - 14.0,
        escape(y_axis.name),
    );
    let shown = |mark: f64| (mark * 100.0).round() / 100.0;
    // Writing to a string cannot fail.
    for mark in x_axis.ticks() {
        let left = MARGIN + FIELD.0 * x_axis.place(mark);
        let below = bottom + 20.0;
        let _ = writeln!(
            svg,
            "<path d=\"M{left:.1} {MARGIN}V{bottom}\" stroke=\"#dddddd\"/>\
             <text x=\"{left:.1}\" y=\"{below}\" text-anchor=\"middle\">{}</text>",
            shown(mark),
        );
    }
    for mark in y_axis.ticks() {
        let up = MARGIN + FIELD.1 * (1.0 - y_axis.place(mark));
        let beside = MARGIN - 8.0;
        let _ = writeln!(
            svg,
            "<path d=\"M{MARGIN} {up:.1}H{right}\" stroke=\"#dddddd\"/>\
             <text x=\"{beside}\" y=\"{:.1}\" text-anchor=\"end\">{}</text>",
            up + 5.0,
            shown(mark),
        );
    }
    for (k, line) in series.iter().enumerate() {
        let colour = COLOURS[k % COLOURS.len()];
        let finite = line.points.iter().filter(|(x, y)| x.is_finite() && y.is_finite());
        let points: Vec<(f64, f64)> = finite.map(|&point| at(point)).collect();
        let path: Vec<String> = points.iter().map(|(x, y)| format!("{x:.1},{y:.1}")).collect();
        let dots: String = points
            .iter()
            .map(|(x, y)| format!("<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"3.5\" fill=\"{colour}\"/>"))
            .collect();
        let from = right + 10.0;
        let y = MARGIN + 20.0 * (k + 1) as f64;
        let _ = writeln!(
            svg,
            "<polyline points=\"{}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"2\"/>{dots}\
             <circle cx=\"{from}\" cy=\"{}\" r=\"5\" fill=\"{colour}\"/><text x=\"{}\" y=\"{y}\">{}</text>",
            path.join(" "),
            y - 4.0,
            from + 10.0,
            escape(line.name)
        );
    }
    svg + "</svg>\n"
}

/// A value as the length of a bar.
const fn length(number: f64) -> f64 {
    if number.is_finite() && number > 0.0 { number } else { 0.0 }
}
