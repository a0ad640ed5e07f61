//! The report about beliefs.

use super::{Subject, cost, share};
use phase_document::document::{Block, Document, head};
use phase_eval::beliefs::{AGREEMENT, BeliefScores, BeliefSummary, STRIDE};
use phase_event::BeliefOrder;

/// Explanation of the columns of scores.
pub(super) const LEGEND: &str = "Square brackets hold the 95 % bootstrap interval over events, which have equal \
    weight. Brier is the squared distance of the probabilities, 0 to 2.";

/// The report of how well a method tells what agents believe.
#[must_use]
pub fn beliefs(subject: Subject<'_>, summary: &BeliefSummary) -> Document {
    let title = if summary.order == BeliefOrder::First { "Beliefs" } else { "Beliefs about beliefs" };
    let (asked, unseen, moved) = match summary.order {
        BeliefOrder::First => (
            "each agent believes each other entity to be, or that the agent sees it",
            "not seen by the agent",
            "moved since the agent could see it",
        ),
        BeliefOrder::Second => (
            "each agent believes the other agent to believe each entity to be, or that the other sees it",
            "not surely seen by the other",
            "moved since the other could see it",
        ),
    };
    let rows = vec![
        scores_row("all entities", summary.all.as_ref()),
        scores_row(unseen, summary.unseen.as_ref()),
        scores_row(moved, summary.moved.as_ref()),
    ];
    let columns = ["beliefs about", "events", "questions", "accuracy", "Brier", "calibration error"];
    let text = format!(
        "{}, seed {}: {} events. The method sees a whole event and says, every {STRIDE} steps, in which room {asked}. The \
         truth follows from the agent's particles; asked about is what has a probability of at least {:.0} % in them.",
        subject.events,
        subject.seed,
        summary.n,
        100.0 * AGREEMENT
    );
    let blocks = vec![
        Block::Text(text),
        Block::Table { head: head(&columns), rows },
        Block::Text(LEGEND.into()),
        Block::Text(cost(summary.cpu_seconds_per_event)),
    ];
    Document { title: format!("{title} told by {}", subject.method), blocks }
}

/// A row of a table of scores.
pub(super) fn scores_row(name: &str, scores: Option<&BeliefScores>) -> Vec<String> {
    let cells = scores.map_or_else(
        || ["0", "0", "-", "-", "-"].map(String::from),
        |BeliefScores { n, questions, accuracy, brier, calibration }| {
            let error = format!("{:.3}", calibration.error);
            [n.to_string(), questions.to_string(), share(accuracy), share(brier), error]
        },
    );
    [name.to_owned()].into_iter().chain(cells).collect()
}
