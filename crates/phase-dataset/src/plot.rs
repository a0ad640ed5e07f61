//! Bar charts as SVG, which every browser shows and every paper takes.

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

/// A number as the length of a bar.
const fn length(number: f64) -> f64 {
    if number.is_finite() && number > 0.0 { number } else { 0.0 }
}
