//! One way to explain an event as far as it has been followed.

use super::tracker::{LEVELS, TrackedState};
use phase_model::{AGENT_COUNT, Action, State};

/// A path through an event.
#[derive(Clone, Debug)]
pub(super) struct Path {
    pub(super) tracked: TrackedState,
    pub(super) late_start: bool,
    /// Of the whole path, in logarithms.
    pub(super) cost: f64,
    /// Of the whole path, if an agent were this strong.
    pub(super) strength_costs: [[f64; LEVELS]; AGENT_COUNT],
    /// The state after every step, what was done in it, and what stays unexplained.
    pub(super) history: Vec<(State, ([Action; AGENT_COUNT], f32))>,
}

impl Path {
    /// What was done in the last step.
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

/// The place of the least number; the first of those that are as small.
pub(super) fn argmin(values: &[f64]) -> usize {
    let mut argmin = 0;
    for (place, number) in values.iter().enumerate() {
        if number < &values[argmin] {
            argmin = place;
        }
    }
    argmin
}
