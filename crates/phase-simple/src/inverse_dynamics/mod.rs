//! Inverse dynamics: the actions of both agents step by step, and their strengths.
//!
//! Forces are not seen, but what they do is, and there are only fourteen actions and four strengths. [`InverseDynamics`]
//! follows an event through the forward model and asks at every step which actions lead to what was observed. That
//! tells actions, grips, the states between steps, and strengths.

mod interpolation;
mod path;
mod reading;
mod replay;
mod search;
#[cfg(test)]
mod tests;

use path::Beam;
use phase_event::ObservedEvent;
use phase_model::{AGENT_COUNT, Action, AgentId, State, Strength};
use reading::{Reading, Start};
use replay::{Deed, LEVELS, Replay, TrackedState};

/// Paths that are followed at once.
const BEAM_WIDTH: usize = 16;

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
    /// How the rows were read.
    reading: Reading,
    replay: Replay,
    /// The states that the steps begin in, as the reading has them.
    tracked: Vec<TrackedState>,
}

impl InverseDynamics {
    /// Explains an event.
    #[must_use]
    pub fn new(observed: &ObservedEvent) -> Self {
        let readings: Vec<(Reading, Replay)> = Reading::all(observed)
            .into_iter()
            .map(|reading| {
                let replay = Replay::new(&reading);
                (reading, replay)
            })
            .collect();
        let between: Vec<Vec<State>> =
            readings.iter().map(|(reading, _)| interpolation::states(&reading.event)).collect();
        let mut beam = Beam::new(&readings, BEAM_WIDTH);
        for t in 1..observed.rows().len() {
            beam.advance(&readings, &between, t);
        }
        let mut path = vec![beam.ends[0]];
        while let Some(before) = path.last().and_then(|&node| beam.nodes[node].before) {
            path.push(before);
        }
        path.reverse();
        let nodes = path.iter().map(|&node| &beam.nodes[node]);
        let (reading, replay) = readings[beam.nodes[path[0]].reading].clone();
        let mut states: Vec<State> =
            nodes.clone().map(|node| reading.observed_state(&node.tracked.state)).collect();
        states[0] = State::new(observed.rows()[0]);
        let mut result = Self {
            states,
            actions: nodes.clone().skip(1).map(|node| node.actions).collect(),
            log_strengths: [[0.0; LEVELS]; AGENT_COUNT],
            residuals: nodes.clone().skip(1).map(|node| node.residual).collect(),
            late_start: reading.start == Start::Late,
            tracked: nodes.map(|node| node.tracked.clone()).collect(),
            reading,
            replay,
        };
        let strengths = beam.nodes[beam.ends[0]].strengths;
        result.weigh_strengths(strengths.map(|mask| mask.trailing_zeros() as usize % LEVELS));
        for actions in &mut result.actions {
            *actions = actions.map(|action| result.reading.observed_action(action));
        }
        result
    }

    /// Weighs the strengths of each agent, given those that were found.
    fn weigh_strengths(&mut self, levels: [usize; AGENT_COUNT]) {
        let rows = self.reading.event.rows();
        for (step, actions) in self.actions.iter().enumerate() {
            let tracked = &self.tracked[step];
            let found: [Deed; AGENT_COUNT] = [(actions[0], levels[0]), (actions[1], levels[1])];
            for agent in AgentId::ALL {
                let mut costs = [f64::INFINITY; LEVELS];
                for deed in self.replay.deeds(&tracked.state, agent, (1 << LEVELS) - 1) {
                    let mut deeds = found;
                    deeds[agent] = deed;
                    let cost = path::cost(self.replay.step(tracked, &rows[step + 1], deeds).residual);
                    let pushes = deed.0.push().is_some();
                    for (level, least) in costs.iter_mut().enumerate() {
                        if !pushes || level == deed.1 {
                            *least = least.min(cost);
                        }
                    }
                }
                for (sum, cost) in self.log_strengths[agent].iter_mut().zip(costs) {
                    *sum -= cost;
                }
            }
        }
    }

    /// The most likely strengths; the weakest of equally likely ones.
    #[must_use]
    pub fn strengths(&self) -> [Strength; AGENT_COUNT] {
        self.log_strengths.map(|logs| {
            let mut best = 0;
            for (level, log) in logs.iter().enumerate() {
                if *log > logs[best] {
                    best = level;
                }
            }
            Strength::ALL[best]
        })
    }

    /// The residual of every step (u) if an agent does each of its actions instead, by [`Action::index`], the
    /// other doing what was inferred.
    #[must_use]
    pub fn alternatives(&self, _observed: &ObservedEvent) -> Vec<[[f32; Action::ALL.len()]; AGENT_COUNT]> {
        let levels = self.strengths().map(|strength| usize::from(strength.level()));
        let rows = self.reading.event.rows().iter().skip(1);
        let steps = self.tracked.iter().zip(&self.actions).zip(rows);
        steps
            .map(|((tracked, actions), row)| {
                let actions = actions.map(|action| self.reading.observed_action(action));
                AgentId::ALL.map(|agent| {
                    Action::ALL.map(|action| {
                        let mut deeds = [(actions[0], levels[0]), (actions[1], levels[1])];
                        deeds[agent] = (self.reading.observed_action(action), levels[agent]);
                        self.replay.step(tracked, row, deeds).residual
                    })
                })
            })
            .collect()
    }
}
