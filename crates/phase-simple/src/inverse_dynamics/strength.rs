//! What an explained event tells about strengths.

use super::{
    path,
    replay::{ALL_LEVELS, Deed, LEVELS, Replay, TrackedState},
};
use phase_model::{AGENT_COUNT, Action, AgentId, Body, MAX_ENTITIES};

/// Costs of one agent's and of the other's levels of strength in a step, in logarithms.
pub(super) type LevelCosts = [[f64; LEVELS]; AGENT_COUNT];

/// What one step costs with each level of each agent's strength, weakest first, in logarithms: what the best action explains, the
/// other agent doing what was found, with these levels of strength. `row` is the row that the step leads to.
pub(super) fn level_costs(
    replay: &Replay,
    tracked: &TrackedState,
    row: &[Body; MAX_ENTITIES],
    actions: [Action; AGENT_COUNT],
    levels: [usize; AGENT_COUNT],
) -> LevelCosts {
    let found = [(actions[0], levels[0]), (actions[1], levels[1])];
    AgentId::ALL.map(|agent| {
        let mut costs = [f64::INFINITY; LEVELS];
        let deeds = replay.deeds(&tracked.state, agent, ALL_LEVELS);
        let instead = |&deed: &Deed| {
            let mut both = found;
            both[agent] = deed;
            both
        };
        for deed in &deeds {
            let cost = path::cost(replay.step(tracked, row, instead(deed)).residual);
            let pushes = deed.0.push().is_some();
            for (level, least) in costs.iter_mut().enumerate() {
                if !pushes || level == deed.1 {
                    *least = least.min(cost);
                }
            }
        }
        costs
    })
}
