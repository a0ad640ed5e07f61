//! The strengths of agents, from the steps of an explained event.

use super::{
    path,
    replay::{ALL_LEVELS, CandidateAction, LEVELS, Replay, TrackedState},
};
use phase_model::{AGENT_COUNT, Action, AgentId, Body, MAX_ENTITIES};

/// Costs of one agent's and of the other's levels of strength in a step, in logarithms.
pub(super) type LevelCosts = [[f64; LEVELS]; AGENT_COUNT];

/// The costs of one step with each level of each agent's strength, weakest first, in logarithms: those of the
/// same push with that strength, or of the best action that needs none, the other agent doing what was found,
/// with these levels of strength. A step in which an agent does not push tells nothing about its strength.
/// `row` is the row that the step leads to.
pub(super) fn level_costs(
    replay: &Replay,
    tracked: &TrackedState,
    row: &[Body; MAX_ENTITIES],
    actions: [Action; AGENT_COUNT],
    levels: [usize; AGENT_COUNT],
) -> LevelCosts {
    let found = [(actions[0], levels[0]), (actions[1], levels[1])];
    AgentId::ALL.map(|agent| {
        if actions[agent].push().is_none() {
            return [0.0; LEVELS];
        }
        let mut costs = [f64::INFINITY; LEVELS];
        let candidates = replay.candidates(&tracked.state, agent, ALL_LEVELS);
        let pushes = |candidate: &CandidateAction| candidate.0.push().is_some();
        for candidate in candidates.iter().filter(|it| !pushes(it) || it.0 == actions[agent]) {
            let mut instead = found;
            instead[agent] = *candidate;
            let cost = path::cost(replay.step(tracked, row, instead).residual, replay.noise);
            for (level, least) in costs.iter_mut().enumerate() {
                if !pushes(candidate) || level == candidate.1 {
                    *least = least.min(cost);
                }
            }
        }
        costs
    })
}
