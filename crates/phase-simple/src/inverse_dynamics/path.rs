//! One way to explain an event as far as it has been followed.

use super::tracker::{LEVELS, TrackedState};
use phase_model::{AGENT_COUNT, Action, State};

/// A path through an event.
#[derive(Clone, Debug)]
pub(super) struct Path {
    pub(super) tracked: TrackedState,
    pub(super) late_start: bool,
    /// Log-likelihood of the whole path.
    pub(super) cost: f64,
    /// Log-likelihood of the whole path for each strength of an agent.
    pub(super) strength_costs: [[f64; LEVELS]; AGENT_COUNT],
    /// The state after every step, the actions in it, and the residual.
    pub(super) history: Vec<(State, ([Action; AGENT_COUNT], f32))>,
}

impl Path {
    /// The actions of the last step.
    pub(super) fn last_actions(&self) -> [Action; AGENT_COUNT] {
        self.history.last().map_or([Action::NoForce; AGENT_COUNT], |(_, (actions, _))| *actions)
    }

    /// Whether both agents hold the same by the same sides, so that the cheaper path will stay the cheaper.
    pub(super) fn same_grips(&self, other: &Self) -> bool {
        let grips =
            |path: &Self| path.tracked.state.grips.map(|grip| grip.map(|grip| (grip.object, grip.side)));
        self.late_start == other.late_start && grips(self) == grips(other)
    }
}

/// The index of the minimum; the first of equal ones.
pub(super) fn argmin(values: &[f64]) -> usize {
    let mut argmin = 0;
    for (place, number) in values.iter().enumerate() {
        if number < &values[argmin] {
            argmin = place;
        }
    }
    argmin
}
