//! The report about believed intents.

use super::{Subject, beliefs::scores_row, cost};
use phase_document::document::{Block, Document, head};
use phase_eval::{
    beliefs::{AGREEMENT, STRIDE},
    intents::IntentSummary,
};

/// Steps between the rows of the table by time: four seconds of video.
const EVERY: usize = 16;

/// The report of how well a method tells what agents take each other to want.
#[must_use]
pub fn intents(subject: Subject<'_>, summary: &IntentSummary) -> Document {
    let mut rows = vec![
        scores_row("all", summary.all.as_ref()),
        scores_row("not what the other wants", summary.mistaken.as_ref()),
    ];
    let later = summary.by_step.iter().filter(|it| it.step % EVERY == 0);
    rows.extend(later.map(|it| scores_row(&format!("after {} s", it.step / STRIDE), Some(&it.scores))));
    let columns = ["believed intents", "events", "questions", "accuracy", "Brier", "calibration error"];
    let text = format!(
        "{}, seed {}: {} events. The method sees a whole event and says, every {STRIDE} steps, what each agent that does not \
         know the other's goal takes the other to want: goal and attitude. The truth are the agent's particles; asked about \
         is what at least {:.0} % of them have.",
        subject.events,
        subject.seed,
        summary.n,
        100.0 * AGREEMENT
    );
    let blocks = vec![
        Block::Text(text),
        Block::Table { head: head(&columns), rows },
        Block::Text(super::beliefs::LEGEND.into()),
        Block::Text(cost(summary.cpu_seconds_per_event)),
    ];
    Document { title: format!("Believed intents told by {}", subject.method), blocks }
}
