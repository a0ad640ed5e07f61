//! Outcomes of simulated events that have no recording to be compared with.

use phase_dataset::summary::{AgentComparison, EventComparison};
use phase_model::{Attitude, Sign};

/// A table in Markdown, a line for each event.
pub(super) fn table(events: &[EventComparison]) -> String {
    let line = |event: &EventComparison| {
        let [first, second] = event.agents.each_ref().map(outcome);
        let id = &event.id;
        let kind = event.kind.name();
        let steps = event.simulated_steps;
        format!("| {id} | {kind} | {steps} | {first} | {second} |\n")
    };
    let lines = events.iter().map(line).collect::<String>();
    format!("| event | kind | steps | agent 0 (red) | agent 1 (green) |\n|---|---|---|---|---|\n{lines}")
}

/// The outcome of an agent's goal, in words.
fn outcome(agent: &AgentComparison) -> String {
    let attitude = match Attitude::try_from(agent.alpha) {
        Ok(Attitude::Help) => "helps; ",
        Ok(Attitude::Hinder) => "hinders; ",
        _ => "",
    };
    let outcome = match (agent.simulated.reached, agent.simulated.steps) {
        (true, Some(steps)) => format!("goal reached after {steps} steps"),
        (true, None) => "goal holds at the end".into(),
        (false, _) if agent.goal.sign() == Sign::Negative => "goal does not hold at the end".into(),
        (false, _) => "goal not reached".into(),
    };
    format!("{attitude}{outcome}")
}
