//! Training samples of the strength regressor.

use phase_event::ObservedEvent;
use phase_model::{AGENT_COUNT, AgentId, Strength};
use phase_simple::strength::{FEATURES, features};

/// Length of the time windows (steps), ΔT of SIMPLE.
pub const WINDOW: usize = 10;

/// A time window of motion and the strength of the agent that moved.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Sample {
    /// The window's [`features`].
    pub features: [f64; FEATURES],
    /// The label.
    pub strength: Strength,
}

/// One agent in one event.
#[derive(Clone, PartialEq, Debug)]
pub struct AgentSamples {
    /// The whole event.
    pub whole: Sample,
    /// Every window of [`WINDOW`] steps in order; the whole event alone if it is shorter than that.
    pub windows: Vec<Sample>,
}

impl AgentSamples {
    /// Both agents of an event, with their strengths.
    #[must_use]
    pub fn of_event(event: &ObservedEvent, strengths: [Strength; AGENT_COUNT]) -> [Self; AGENT_COUNT] {
        let rows = event.rows();
        AgentId::ALL.map(|agent| {
            let size = event.agent_sizes()[agent];
            let strength = strengths[agent];
            let sample = |rows| Sample { features: features(rows, agent, size), strength };
            let whole = sample(rows);
            let mut windows: Vec<Sample> = rows.windows(WINDOW + 1).map(sample).collect();
            if windows.is_empty() {
                windows.push(whole);
            }
            Self { whole, windows }
        })
    }
}
