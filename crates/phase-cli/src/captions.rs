//! Why an agent does what it does, in a few lines to be written below its picture.

use phase_event::{ActionValue, SubgoalValue, Thought};
use phase_render::Caption;

/// Lines that [`lines`] returns.
pub const COUNT: usize = 3 + SUBGOALS + PLANNED + ACTIONS;
/// Subgoals shown.
pub const SUBGOALS: usize = 3;
/// Steps of the symbolic plan shown.
pub const PLANNED: usize = 2;
/// Root actions shown.
pub const ACTIONS: usize = 4;

/// A title; the most valuable subgoals with V, particles and a bar for the share of particles; the first steps of
/// the symbolic plan; and the actions most searched with visits, mean return and a bar for the share of visits.
///
/// There are always [`COUNT`] lines, so that nothing jumps from step to step of a video.
#[must_use]
pub fn lines(title: String, thought: &Thought) -> Vec<Caption> {
    let mut lines = vec![title.into(), "V, particles (bar), subgoal".to_owned().into()];
    let particles: usize = thought.subgoals.iter().map(|proposed| proposed.particles).sum();
    let subgoals = thought.subgoals.iter().take(SUBGOALS);
    lines.extend(subgoals.map(|proposed| subgoal_line(proposed, particles)));
    lines.resize(2 + SUBGOALS, Caption::default());
    lines.extend(plan_lines(thought));
    let searched = !thought.actions.is_empty();
    let heading = if searched { "visits (bar), mean return, action" } else { "no search needed" };
    lines.push(heading.to_owned().into());
    let visits: u32 = thought.actions.iter().map(|found| found.visits).sum();
    let mut actions: Vec<&ActionValue> = thought.actions.iter().collect();
    // The sort is stable: of equally visited actions the first of the action set comes first.
    actions.sort_by_key(|found| core::cmp::Reverse(found.visits));
    lines.extend(actions.into_iter().take(ACTIONS).map(|found| action_line(found, visits)));
    lines.resize(COUNT, Caption::default());
    lines
}

fn subgoal_line(proposed: &SubgoalValue, particles: usize) -> Caption {
    let SubgoalValue { subgoal, value, particles: count } = proposed;
    let bar = *count as f32 / particles.max(1) as f32;
    Caption { text: format!("{value:5.2} {count:2} {subgoal}"), bar }
}

fn action_line(found: &ActionValue, visits: u32) -> Caption {
    let ActionValue { action, visits: count, value } = found;
    let bar = *count as f32 / visits.max(1) as f32;
    Caption { text: format!("{count:5} {value:7.3} {}", action.name()), bar }
}

/// One step of the plan a line; the last line also says how many more there are.
fn plan_lines(thought: &Thought) -> [Caption; PLANNED] {
    core::array::from_fn(|k| {
        let Some(subgoal) = thought.plan.get(k) else { return Caption::default() };
        let start = if k == 0 { "plan:" } else { "  >" };
        let more = thought.plan.len().saturating_sub(PLANNED);
        let end = if k + 1 == PLANNED && more > 0 { format!(" +{more}") } else { String::new() };
        format!("{start} {subgoal}{end}").into()
    })
}
