//! The report about beliefs.

use super::{Subject, cost, share};
use phase_document::document::{Block, Document, head};
use phase_eval::beliefs::{AGREEMENT, BeliefScores, BeliefSummary, STRIDE};

/// The report of how well a method tells what agents believe.
#[must_use]
pub fn beliefs(subject: Subject<'_>, summary: &BeliefSummary) -> Document {
    let row = |name: &str, scores: &Option<BeliefScores>| {
        let cells = scores.as_ref().map_or_else(
            || ["0", "0", "-", "-", "-"].map(String::from),
            |scores| {
                let BeliefScores { n, questions, accuracy, brier, calibration } = scores;
                let error = format!("{:.3}", calibration.error);
                [n.to_string(), questions.to_string(), share(accuracy), share(brier), error]
            },
        );
        [name.to_owned()].into_iter().chain(cells).collect()
    };
    let rows = vec![
        row("all entities", &summary.all),
        row("not seen by the agent", &summary.unseen),
        row("moved since the agent could see it", &summary.moved),
    ];
    let columns = ["beliefs about", "events", "questions", "accuracy", "Brier", "calibration error"];
    let text = format!(
        "{}, seed {}: {} events. The method sees a whole event and says, every {STRIDE} steps, in which room each agent \
         believes each other entity to be, or that the agent sees it. The truth is the shares of the agent's particles; \
         asked about is what {:.0} % of them agree on.",
        subject.events,
        subject.seed,
        summary.n,
        100.0 * AGREEMENT
    );
    let blocks = vec![
        Block::Text(text),
        Block::Table { head: head(&columns), rows },
        Block::Text(
            "Square brackets hold the 95 % bootstrap interval over events, which have equal weight. Brier is the squared \
             distance of the probabilities, 0 to 2."
                .into(),
        ),
        Block::Text(cost(summary.cpu_seconds_per_event)),
    ];
    Document { title: format!("Beliefs told by {}", subject.method), blocks }
}
