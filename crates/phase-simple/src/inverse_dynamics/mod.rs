//! Inverse dynamics: the actions of both agents step by step, and their strengths.
//!
//! Forces are not seen, but what they do is, and there are only fourteen actions and four strengths. [`InverseDynamics`]
//! follows an event through the forward model and asks at every step which actions of both lead to what was observed. That
//! tells actions, grips, the states between steps, and strengths.
//!
//! Key design decision: the state that a step is predicted to end in is carried on as it is, with its contact memory, as long
//! as it is exact; it is corrected by what was observed only where it is not. Contacts amplify small errors, so a state that
//! is corrected by means over a step loses track as soon as bodies touch. Several explanations are followed at once (a beam),
//! since grips and strengths show later than they begin.

mod beam;
mod difference;
mod interpolation;
mod path;
mod reach;
mod reading;
mod replay;
mod search;
mod strength;
#[cfg(test)]
mod tests;

use beam::Beam;
use phase_event::ObservedEvent;
use phase_model::{AGENT_COUNT, Action, AgentId, State, Strength};
use reading::Start;
use replay::{Replay, TrackedState};

/// Residual up to which a step counts as explained (u).
pub const EXPLAINED_RESIDUAL: f32 = 0.05;

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
    /// The physics that explain it.
    replay: Replay,
    /// The states in which steps begin, as the replay has them.
    tracked: Vec<TrackedState>,
}

impl InverseDynamics {
    /// Explains an event.
    #[must_use]
    pub fn new(observed: &ObservedEvent) -> Self {
        let mut beam = Beam::new(observed);
        for t in 1..observed.rows().len() {
            beam.advance(t);
        }
        let (path, replay) = beam.into_best();
        let steps = || path.iter().skip(1);
        let reading = &replay.reading;
        // The start may lie before row 0, or after it.
        let mut states = vec![State::new(observed.rows()[0])];
        states.extend(steps().map(|step| reading.observed_state(&step.tracked.state)));
        let actions: Vec<_> = steps().map(|step| step.actions).collect();
        let tracked: Vec<_> = path.iter().map(|step| step.tracked.clone()).collect();
        // The weakest of those that explain the event equally well.
        let levels = path.last().map_or([0; AGENT_COUNT], |last| {
            last.strengths.map(|strengths| strengths.trailing_zeros() as usize)
        });
        Self {
            states,
            log_strengths: strength::log_likelihoods(&replay, &tracked, &actions, levels),
            actions: actions.iter().map(|both| both.map(|action| reading.observed_action(action))).collect(),
            residuals: steps().map(|step| step.residual).collect(),
            late_start: reading.start == Start::Late,
            replay,
            tracked,
        }
    }

    /// The most likely strengths; the weakest of equally likely ones.
    #[must_use]
    pub fn strengths(&self) -> [Strength; AGENT_COUNT] {
        self.log_strengths.map(|logs| {
            let mut likeliest = 0;
            for (level, log) in logs.iter().enumerate() {
                if *log > logs[likeliest] {
                    likeliest = level;
                }
            }
            Strength::ALL[likeliest]
        })
    }

    /// Whether each step is explained, to within [`EXPLAINED_RESIDUAL`].
    pub fn explained(&self) -> impl Iterator<Item = bool> + '_ {
        self.residuals.iter().map(|&residual| residual <= EXPLAINED_RESIDUAL)
    }

    /// The residual of every step (u) if an agent does each of its actions instead, by [`Action::index`], the
    /// other doing what was inferred.
    #[must_use]
    pub fn alternatives(&self) -> Vec<[[f32; Action::ALL.len()]; AGENT_COUNT]> {
        let reading = &self.replay.reading;
        let levels = self.strengths().map(|strength| usize::from(strength.level()));
        let deed = |agent: AgentId, action| (reading.observed_action(action), levels[agent]);
        let steps = self.tracked.iter().zip(&self.actions).enumerate();
        let alternatives = |(step, (tracked, actions)): (usize, (&TrackedState, &[Action; AGENT_COUNT]))| {
            AgentId::ALL.map(|agent| {
                Action::ALL.map(|action| {
                    let mut deeds = AgentId::ALL.map(|agent| deed(agent, actions[agent]));
                    deeds[agent] = deed(agent, action);
                    self.replay.step(tracked, self.replay.row(step + 1), deeds).residual
                })
            })
        };
        steps.map(alternatives).collect()
    }
}
