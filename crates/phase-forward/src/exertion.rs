//! The actions of a step, and the strengths behind them.

use phase_model::{AGENT_COUNT, Action};

/// The actions of both agents in a step, and their strengths.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Exertion {
    /// The action of each agent.
    pub actions: [Action; AGENT_COUNT],
    /// Maximum push of each agent (N).
    pub max_forces: [f32; AGENT_COUNT],
}
