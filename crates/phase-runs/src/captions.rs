//! Explanation of an agent's decision, in a few lines below its picture.

use phase_event::{ActionEvaluation, BelievedIntent, SubgoalValue, Thought};
use phase_render::Caption;

/// Lines that [`lines`] returns.
pub const COUNT: usize = 2 + SUBGOALS + PLANNED + ACTIONS;
/// Subgoals shown.
pub const SUBGOALS: usize = 3;
/// Steps of the symbolic plan shown.
pub const PLANNED: usize = 2;
/// Root actions shown; or intents, by an agent that does not know the other's goal.
pub const ACTIONS: usize = 4;

/// The subgoals of highest value with V, particles and a bar for the share of particles; the first steps of
/// the symbolic plan; and the most visited actions with visits, mean return and a bar for the share of
/// visits. An agent that does not know what the other wants has the likeliest intents instead of actions,
/// with their particles.
///
/// There are always [`COUNT`] lines, so that the layout does not change between steps of a video.
#[must_use]
pub fn lines(thought: &Thought) -> Vec<Caption> {
    let mut lines = vec![heading(["V", "particles"], "subgoal (bar: share of particles)")];
    let particles: usize = thought.subgoals.iter().map(|proposed| proposed.particles).sum();
    let subgoals = thought.subgoals.iter().take(SUBGOALS);
    lines.extend(subgoals.map(|proposed| subgoal_line(proposed, particles)));
    lines.resize(1 + SUBGOALS, Caption::default());
    lines.extend(plan_lines(thought));
    if !thought.intents.is_empty() {
        lines.push(heading(["", "particles"], "the other wants (bar: share)"));
        let all: usize = thought.intents.iter().map(|it| it.particles).sum();
        let suspicion = thought.suspicion.map(suspicion_line);
        let intents = ACTIONS - usize::from(suspicion.is_some());
        lines.extend(thought.intents.iter().take(intents).map(|it| intent_line(it, all)));
        lines.resize(COUNT - usize::from(suspicion.is_some()), Caption::default());
        lines.extend(suspicion);
        return lines;
    }
    let searched = !thought.actions.is_empty();
    let columns = heading(["visits", "return"], "action (bar: share of visits)");
    lines.push(if searched { columns } else { "no search needed".to_owned().into() });
    let visits: u32 = thought.actions.iter().map(|found| found.visits).sum();
    let mut actions: Vec<&ActionEvaluation> = thought.actions.iter().collect();
    // The sort is stable: ties are in the order of the action set.
    actions.sort_by_key(|found| core::cmp::Reverse(found.visits));
    lines.extend(actions.into_iter().take(ACTIONS).map(|found| action_line(found, visits)));
    lines.resize(COUNT, Caption::default());
    lines
}

fn subgoal_line(proposed: &SubgoalValue, particles: usize) -> Caption {
    let SubgoalValue { subgoal, value, particles: count } = proposed;
    let bar = *count as f32 / particles.max(1) as f32;
    Caption { cells: vec![number(*value, 2), count.to_string()], text: subgoal.to_string(), bar }
}

fn intent_line(believed: &BelievedIntent, particles: usize) -> Caption {
    let BelievedIntent { intent, particles: count } = believed;
    let bar = *count as f32 / particles.max(1) as f32;
    Caption { cells: vec![String::new(), count.to_string()], text: intent.to_string(), bar }
}

fn suspicion_line(probability: f64) -> Caption {
    let cells = vec![String::new(), number(probability, 2)];
    Caption { cells, text: "suspects hindrance".into(), bar: probability as f32 }
}

fn action_line(found: &ActionEvaluation, visits: u32) -> Caption {
    let ActionEvaluation { action, visits: count, value } = found;
    let bar = *count as f32 / visits.max(1) as f32;
    Caption { cells: vec![count.to_string(), number(*value, 3)], text: action.name().into(), bar }
}

fn heading(cells: [&str; 2], text: &str) -> Caption {
    Caption { cells: cells.map(str::to_owned).to_vec(), text: text.into(), bar: 0.0 }
}

/// A number with the given number of decimals, and a minus sign instead of a hyphen.
fn number(value: f64, decimals: usize) -> String {
    format!("{value:.decimals$}").replace('-', "−")
}

/// One step of the plan per line; the last line also states how many more there are.
fn plan_lines(thought: &Thought) -> [Caption; PLANNED] {
    core::array::from_fn(|k| {
        let Some(subgoal) = thought.plan.get(k) else { return Caption::default() };
        let start = if k == 0 { "plan:" } else { "→" };
        let more = thought.plan.len().saturating_sub(PLANNED);
        let end = if k + 1 == PLANNED && more > 0 { format!(" +{more}") } else { String::new() };
        format!("{start} {subgoal}{end}").into()
    })
}
