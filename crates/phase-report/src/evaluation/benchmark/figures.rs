//! The figures that the documents stand on, as a file beside them.

use phase_eval::{
    benchmark::{Benchmark, Row},
    goals::RecognitionSummary,
    trajectories::ForecastSummary,
};
use serde::Serialize;
use serde_json::ser::{Formatter, Serializer};
use std::io;

/// Lists down to this depth have an item a line; deeper ones stand on one line.
const DEPTH_OF_LINES: usize = 2;

/// A benchmark reduced to what [`page`](super::page), [`overview`](super::overview) and
/// [`leaderboard`](crate::evaluation::leaderboard) show: without scores by kind and by step, bins of
/// calibration, details of parts, and curves.
#[must_use]
pub fn figures(benchmark: &Benchmark) -> Benchmark {
    let mut figures = benchmark.clone();
    figures.goals.iter_mut().for_each(|row| shorten(row, recognition));
    figures.trajectories.iter_mut().for_each(|row| shorten(row, forecast));
    figures.trainings.iter_mut().for_each(|training| training.curves.clear());
    figures
}

/// A benchmark as JSON with a row on each line, so that a difference between two files is one of rows.
///
/// # Errors
/// If a value cannot be written as JSON, for example a map whose keys are no strings.
pub fn to_lines(benchmark: &Benchmark) -> Result<String, serde_json::Error> {
    let mut text = Vec::new();
    benchmark.serialize(&mut Serializer::with_formatter(&mut text, Lines::default()))?;
    text.push(b'\n');
    Ok(String::from_utf8_lossy(&text).into_owned())
}

fn shorten<S>(row: &mut Row<S>, shorten: fn(&mut S, whole: bool)) {
    shorten(&mut row.summary, true);
    row.parts.iter_mut().for_each(|part| shorten(&mut part.summary, false));
}

/// Leaves the scores of all events; of the whole set also those of sets, of roles and of agreement.
fn recognition(summary: &mut RecognitionSummary, whole: bool) {
    summary.kinds.clear();
    summary.layouts.clear();
    summary.watched.clear();
    summary.role_kinds.clear();
    summary.goal_calibration.bins.clear();
    summary.relation_calibration.bins.clear();
    if !whole {
        (summary.sets, summary.roles) = (None, None);
        summary.agreement = None;
        summary.held_out_agreement = None;
        summary.relation_agreement = None;
    }
}

/// Leaves the scores of all events; of the whole set also those of independent and of social events.
fn forecast(summary: &mut ForecastSummary, whole: bool) {
    summary.kinds.clear();
    summary.by_step.clear();
    if !whole {
        (summary.independent, summary.social) = (None, None);
    }
}

/// JSON with lines down to [`DEPTH_OF_LINES`].
#[derive(Default)]
struct Lines {
    depth: usize,
}

impl Lines {
    /// Writes the text before an item or a name.
    fn item<W: io::Write + ?Sized>(&self, writer: &mut W, first: bool) -> io::Result<()> {
        match (first, self.depth <= DEPTH_OF_LINES) {
            (true, true) => write!(writer, "\n{:1$}", "", self.depth),
            (false, true) => write!(writer, ",\n{:1$}", "", self.depth),
            (true, false) => Ok(()),
            (false, false) => writer.write_all(b", "),
        }
    }

    fn end<W: io::Write + ?Sized>(&mut self, writer: &mut W, bracket: &[u8]) -> io::Result<()> {
        let lines = self.depth <= DEPTH_OF_LINES;
        self.depth -= 1;
        if lines {
            write!(writer, "\n{:1$}", "", self.depth)?;
        }
        writer.write_all(bracket)
    }
}

impl Formatter for Lines {
    fn begin_array<W: io::Write + ?Sized>(&mut self, writer: &mut W) -> io::Result<()> {
        self.depth += 1;
        writer.write_all(b"[")
    }

    fn end_array<W: io::Write + ?Sized>(&mut self, writer: &mut W) -> io::Result<()> {
        self.end(writer, b"]")
    }

    fn begin_array_value<W: io::Write + ?Sized>(&mut self, writer: &mut W, first: bool) -> io::Result<()> {
        self.item(writer, first)
    }

    fn begin_object<W: io::Write + ?Sized>(&mut self, writer: &mut W) -> io::Result<()> {
        self.depth += 1;
        writer.write_all(b"{")
    }

    fn end_object<W: io::Write + ?Sized>(&mut self, writer: &mut W) -> io::Result<()> {
        self.end(writer, b"}")
    }

    fn begin_object_key<W: io::Write + ?Sized>(&mut self, writer: &mut W, first: bool) -> io::Result<()> {
        self.item(writer, first)
    }

    fn begin_object_value<W: io::Write + ?Sized>(&mut self, writer: &mut W) -> io::Result<()> {
        writer.write_all(b": ")
    }
}
