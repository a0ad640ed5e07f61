//! Inverse dynamics: the actions of both agents step by step, and their strengths.
//!
//! Forces are not seen, but what they do is, and there are only fourteen actions and four strengths. [`InverseDynamics`]
//! follows an event through the forward model and asks at every step which actions lead to what was observed. That
//! tells actions, grips, the states between steps, and strengths.

mod interpolation;
mod path;
#[cfg(test)]
mod tests;
mod tracker;

use path::Path;
use phase_event::ObservedEvent;
use phase_model::{AGENT_COUNT, Action, AgentId, State, Strength};
use tracker::{TrackedState, Tracker};

/// States with different grips that are followed at once.
const BEAM_WIDTH: usize = 6;

/// An event explained by what its agents did.
#[derive(Clone, Debug)]
pub struct InverseDynamics {
    /// The state at the end of every step, state 0 being row 0: one for each row.
    pub states: Vec<State>,
    /// The actions of both in every step, as far as they can be told: an agent at rest may as well have
    /// grabbed at nothing.
    pub actions: Vec<[Action; AGENT_COUNT]>,
    /// ln P(motion | f) of each agent's strengths but for a constant, weakest first.
    pub log_strengths: [[f64; Strength::ALL.len()]; AGENT_COUNT],
    /// Residual of every step (u), over positions, velocities and angles of all bodies.
    pub residuals: Vec<f32>,
    /// Whether row 0 is the state after the first substep of the first step, as in some recordings.
    pub late_start: bool,
}

impl InverseDynamics {
    /// Explains an event.
    #[must_use]
    pub fn new(observed: &ObservedEvent) -> Self {
        let tracker = Tracker::new(observed);
        let between = interpolation::states(observed);
        let start = State::new(observed.rows()[0]);
        let mut paths = vec![tracker.path(start, false), tracker.path(start, true)];
        for (row, between) in observed.rows().iter().zip(&between).skip(1) {
            let mut longer: Vec<Path> =
                paths.iter().flat_map(|path| tracker.successors(path, row, between)).collect();
            longer.sort_by(|a, b| a.cost.total_cmp(&b.cost));
            paths.clear();
            for path in longer {
                if paths.len() < BEAM_WIDTH && !paths.iter().any(|better| better.same_grips(&path)) {
                    paths.push(path);
                }
            }
        }
        // Sorted by cost, and there is always one.
        let best = paths.swap_remove(0);
        let (states, rest): (Vec<State>, Vec<_>) = best.history.into_iter().unzip();
        let (actions, residuals) = rest.into_iter().unzip();
        Self {
            states: [start].into_iter().chain(states).collect(),
            actions,
            log_strengths: best.strength_costs.map(|costs| costs.map(|cost| -cost)),
            residuals,
            late_start: best.late_start,
        }
    }

    /// The most likely strengths; the weakest of equally likely ones.
    #[must_use]
    pub fn strengths(&self) -> [Strength; AGENT_COUNT] {
        self.log_strengths.map(|logs| Strength::ALL[path::argmin(&logs.map(|log| -log))])
    }

    /// The residual of every step (u) if an agent does each of its actions instead, by [`Action::index`], the
    /// other doing what was inferred.
    #[must_use]
    pub fn alternatives(&self, observed: &ObservedEvent) -> Vec<[[f32; Action::ALL.len()]; AGENT_COUNT]> {
        let tracker = Tracker::new(observed);
        let levels = self.strengths().map(|strength| usize::from(strength.level()));
        let rows = observed.rows().iter().skip(1);
        let steps = self.states.iter().zip(&self.actions).zip(rows).enumerate();
        steps
            .map(|(step, ((state, actions), row))| {
                let tracked = TrackedState {
                    state: *state,
                    cache: tracker.fresh_cache(state),
                    late: self.late_start && step == 0,
                };
                AgentId::ALL.map(|agent| {
                    Action::ALL.map(|action| {
                        let mut actions = *actions;
                        actions[agent] = action;
                        tracker.step(&tracked, row, levels, actions).residual
                    })
                })
            })
            .collect()
    }
}
