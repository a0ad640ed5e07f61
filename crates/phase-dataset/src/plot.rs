//! Bar charts and curves as SVG, which every browser shows and every paper takes.

use crate::gallery::escape;
use std::fmt::Write as _;

/// Measures of the drawing (px).
const ROW: usize = 22;
const LABELS: usize = 210;
const BARS: usize = 420;
const TOP: usize = 44;

/// A chart with one horizontal bar for each name, its number behind it. `unit` stands behind every number; bars of
/// numbers that are not finite or negative are empty.
#[must_use]
pub fn bars(title: &str, unit: &str, rows: &[(String, f64)]) -> String {
    let (width, height) = (LABELS + BARS + 90, TOP + ROW * rows.len() + 12);
    let longest = rows.iter().map(|(_, number)| length(*number)).fold(f64::MIN_POSITIVE, f64::max);
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
         viewBox=\"0 0 {width} {height}\" font-family=\"sans-serif\" font-size=\"13\">\n\
         <rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n\
         <text x=\"12\" y=\"26\" font-size=\"16\" font-weight=\"bold\">{}</text>\n",
        escape(title)
    );
    for (k, (name, number)) in rows.iter().enumerate() {
        let (y, long) = (TOP + ROW * k, BARS as f64 * length(*number) / longest);
        let (label, value) = (LABELS - 8, LABELS as f64 + long + 6.0);
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

/// An axis from 0.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Axis<'a> {
    /// What it shows, with the unit.
    pub name: &'a str,
    /// Where it ends; above 0.
    pub to: f64,
}

/// A line through points.
#[derive(Clone, PartialEq, Debug)]
pub struct Series<'a> {
    /// What it shows.
    pub name: &'a str,
    /// The points, x and y.
    pub points: Vec<(f64, f64)>,
}

/// Measures of a drawing with two axes (px): of the field between the axes, and of what is left, below and above it.
const FIELD: (f64, f64) = (480.0, 320.0);
const MARGIN: f64 = 64.0;
/// Colours of lines, which are told apart by people who see few colours too.
const COLOURS: [&str; 4] = ["#4477aa", "#cc6677", "#888888", "#228833"];
/// Marks along an axis.
const MARKS: usize = 5;

/// A chart with two axes, x and y, from 0 on and a line with dots for each series. Points that are not finite are
/// left out; those beyond an axis are drawn at its end.
#[must_use]
pub fn curves(title: &str, [x_axis, y_axis]: [Axis<'_>; 2], series: &[Series<'_>]) -> String {
    let (width, height) = (FIELD.0 + 2.0 * MARGIN + 100.0, FIELD.1 + 2.0 * MARGIN);
    let place = |number: f64, axis: &Axis<'_>| (number / axis.to.max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
    let at = |(x, y): (f64, f64)| {
        (MARGIN + FIELD.0 * place(x, &x_axis), MARGIN + FIELD.1 * (1.0 - place(y, &y_axis)))
    };
    let (right, bottom, middle) = (MARGIN + FIELD.0, MARGIN + FIELD.1, MARGIN + FIELD.0 / 2.0);
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
    for k in 0..=MARKS {
        let (x, y) = (x_axis.to * k as f64 / MARKS as f64, y_axis.to * k as f64 / MARKS as f64);
        let ((left, _), (_, up)) = (at((x, 0.0)), at((0.0, y)));
        let [x, y] = [x, y].map(|number| (number * 100.0).round() / 100.0);
        // Writing to a string cannot fail.
        let _ = writeln!(
            svg,
            "<path d=\"M{left:.1} {MARGIN}V{bottom}M{MARGIN} {up:.1}H{right}\" stroke=\"#dddddd\"/>\
             <text x=\"{left:.1}\" y=\"{}\" text-anchor=\"middle\">{x}</text>\
             <text x=\"{}\" y=\"{:.1}\" text-anchor=\"end\">{y}</text>",
            bottom + 20.0,
            MARGIN - 8.0,
            up + 5.0,
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
        let (from, y) = (right + 10.0, MARGIN + 20.0 * (k + 1) as f64);
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

/// A number as the length of a bar.
const fn length(number: f64) -> f64 {
    if number.is_finite() && number > 0.0 { number } else { 0.0 }
}
