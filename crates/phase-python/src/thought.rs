//! The reasons of decisions, with subgoals as text.

use phase_event::Thought;
use serde_json::{Value, json};

/// A thought with its subgoals as people write them, such as `On(agent 0, landmark 1)`.
pub(crate) fn value(thought: &Thought) -> Value {
    let Thought { subgoal, subgoals, plan, actions } = thought;
    let proposed = subgoals
        .iter()
        .map(|it| json!({ "subgoal": it.subgoal.to_string(), "value": it.value, "particles": it.particles }));
    json!({
        "subgoal": subgoal.to_string(),
        "subgoals": proposed.collect::<Vec<_>>(),
        "plan": plan.iter().map(ToString::to_string).collect::<Vec<_>>(),
        "actions": actions,
    })
}
