//! Reports of evaluations: one method on one task, and the benchmark of many.

mod beliefs;
mod benchmark;
mod goals;
mod intents;
mod leaderboard;
mod questions;
mod trajectories;

pub use beliefs::beliefs;
pub use benchmark::{Page, benchmark, figures, overview, page, to_lines};
pub use goals::goals;
pub use intents::intents;
pub use leaderboard::{LEADERBOARD_FORMAT, Measures, Score, Scores, SealedSet, Source, leaderboard};
pub use questions::{AskedQuestions, TypeScore, questions_page};
pub use trajectories::trajectories;

use phase_document::{document::Block, plot::bars};
use phase_eval::Estimate;

/// The subject of a report.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Subject<'a> {
    /// The method's name.
    pub method: &'a str,
    /// Whether the method is external, with predictions from a file.
    pub given: bool,
    /// The events, in words.
    pub events: &'a str,
    /// The run's seed.
    pub seed: u64,
}

impl Subject<'_> {
    /// The method's name beside those of the published ones.
    fn label(&self) -> String {
        format!("{} ({})", self.method, if self.given { "predictions" } else { "ours" })
    }
}

/// Whether higher or lower is better, stated below the first table.
const BESIDE: &str = "Square brackets hold the 95 % bootstrap interval over events. Published figures are of the 100 \
                      test recordings of the published simulator; beside other events they only give an idea of size.";

/// A share of 1 with its interval.
fn share(estimate: &Estimate) -> String {
    format!("{:.3} [{:.3}, {:.3}]", estimate.value, estimate.low, estimate.high)
}

/// A length with its interval.
fn length(estimate: &Estimate) -> String {
    format!("{:.2} [{:.2}, {:.2}]", estimate.value, estimate.low, estimate.high)
}

/// Bars of one figure, PHASE's above those that are published.
fn bars_beside<'a>(
    file: &'static str,
    title: &str,
    unit: &str,
    ours: (&'a str, f64),
    published: impl Iterator<Item = (&'a str, f64)>,
) -> Block {
    let rows = [ours].into_iter().chain(published).map(|(name, value)| (name.to_owned(), value));
    let svg = bars(title, unit, &rows.collect::<Vec<_>>());
    Block::Plot { file, title: title.into(), svg }
}

/// CPU time of an event, in words.
fn cost(seconds: Option<f64>) -> String {
    match seconds {
        Some(seconds) if seconds < 0.1 => {
            format!("CPU time for an event: {:.3} ms on average, of one thread.", 1000.0 * seconds)
        }
        Some(seconds) => format!("CPU time for an event: {seconds:.1} s on average, of one thread."),
        None => "CPU time is not known.".into(),
    }
}
