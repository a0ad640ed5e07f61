//! What agents do in a step.

use phase_model::{AGENT_COUNT, Action};

/// What both agents do in a step, and how strong they are.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Exertion {
    /// The action of each agent.
    pub actions: [Action; AGENT_COUNT],
    /// Maximum push of each agent (N).
    pub max_forces: [f32; AGENT_COUNT],
}
