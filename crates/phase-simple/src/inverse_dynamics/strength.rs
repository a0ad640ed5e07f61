//! What an explained event tells about strengths.

use super::{
    path,
    replay::{ALL_LEVELS, LEVELS, Replay, TrackedState},
};
use phase_model::{AGENT_COUNT, Action, AgentId};

/// ln P(motion | f) of each agent's strengths but for a constant, weakest first: the sum over all steps of what the best
/// action explains, the other agent doing what was found, with these levels of strength.
pub(super) fn log_likelihoods(
    replay: &Replay,
    tracked: &[TrackedState],
    actions: &[[Action; AGENT_COUNT]],
    levels: [usize; AGENT_COUNT],
) -> [[f64; LEVELS]; AGENT_COUNT] {
    let mut logs = [[0.0; LEVELS]; AGENT_COUNT];
    for (step, (tracked, actions)) in tracked.iter().zip(actions).enumerate() {
        let found = [(actions[0], levels[0]), (actions[1], levels[1])];
        for agent in AgentId::ALL {
            let mut costs = [f64::INFINITY; LEVELS];
            for deed in replay.deeds(&tracked.state, agent, ALL_LEVELS) {
                let mut deeds = found;
                deeds[agent] = deed;
                let cost = path::cost(replay.step(tracked, replay.row(step + 1), deeds).residual);
                let pushes = deed.0.push().is_some();
                for (level, least) in costs.iter_mut().enumerate() {
                    if !pushes || level == deed.1 {
                        *least = least.min(cost);
                    }
                }
            }
            for (log, cost) in logs[agent].iter_mut().zip(costs) {
                *log -= cost;
            }
        }
    }
    logs
}
