//! Which deeds of both agents explain one step.

use super::replay::{Deed, PredictedStep, Replay, TrackedState};
use phase_model::{AGENT_COUNT, Action, AgentId, Body, MAX_ENTITIES};

/// Residual below which a step is explained exactly (u): rows have five decimals, and the kernel departs from the
/// published simulator by less in a step.
pub(super) const EXACT: f32 = 0.003;
/// Rounds in which the agents are explained alternately.
const ROUNDS: usize = 3;
/// Explanations of a step that are followed, if none is exact.
const MAX_INEXACT: usize = 6;
/// Explanations whose residual is so many times that of the best are not followed.
const WORSE: f32 = 3.0;

/// One explanation of a step.
#[derive(Clone, Debug)]
pub(super) struct Explanation {
    pub(super) deeds: [Deed; AGENT_COUNT],
    pub(super) predicted: PredictedStep,
}

/// The best explanations of a step from a state, at least one. `strengths` are those possible for each agent, one bit for
/// each level; the search begins at the deeds `last`.
pub(super) fn explanations(
    replay: &Replay,
    tracked: &TrackedState,
    row: &[Body; MAX_ENTITIES],
    strengths: [u8; AGENT_COUNT],
    last: [Action; AGENT_COUNT],
) -> Vec<Explanation> {
    let deeds = AgentId::ALL.map(|agent| replay.deeds(&tracked.state, agent, strengths[agent]));
    let residual = |deeds: [Deed; AGENT_COUNT]| replay.step(tracked, row, deeds).residual;
    // Alternately: enough where the agents do not act on each other, and often where they do.
    let first = |agent: AgentId| {
        let again = deeds[agent].iter().find(|deed| deed.0 == last[agent]);
        *again.or(deeds[agent].first()).unwrap_or(&(Action::NoForce, 0))
    };
    let mut best = [first(AgentId::ZERO), first(AgentId::ONE)];
    let mut tables: [Vec<f32>; AGENT_COUNT] = [Vec::new(), Vec::new()];
    let mut settled = [None; AGENT_COUNT];
    for _ in 0..ROUNDS {
        for agent in AgentId::ALL {
            let other = agent.other();
            if settled[agent] == Some(best[other]) {
                continue;
            }
            tables[agent] = deeds[agent]
                .iter()
                .map(|&deed| {
                    let mut pair = best;
                    pair[agent] = deed;
                    residual(pair)
                })
                .collect();
            settled[agent] = Some(best[other]);
            best[agent] = deeds[agent][least(&tables[agent])];
        }
    }
    let achieved = tables[1].iter().copied().fold(f32::INFINITY, f32::min);
    let coupled = replay.coupled(&tracked.state);
    let mut pairs: Vec<([Deed; AGENT_COUNT], f32)> = Vec::new();
    if achieved <= EXACT || !coupled {
        let limit = limit(achieved);
        let good = AgentId::ALL.map(|agent| {
            let both = deeds[agent].iter().zip(&tables[agent]);
            both.filter(|(_, residual)| **residual <= limit).map(|(deed, _)| *deed).collect::<Vec<_>>()
        });
        for &a in &good[0] {
            for &b in &good[1] {
                pairs.push(([a, b], residual([a, b])));
            }
        }
    } else {
        for &a in &deeds[0] {
            for &b in &deeds[1] {
                pairs.push(([a, b], residual([a, b])));
            }
        }
    }
    pairs.sort_by(|a, b| a.1.total_cmp(&b.1));
    let least = pairs.first().map_or(f32::INFINITY, |pair| pair.1);
    let count = pairs.iter().filter(|pair| pair.1 <= limit(least)).count();
    let count = if least <= EXACT { count } else { count.clamp(1, MAX_INEXACT) };
    pairs.truncate(count.max(1));
    pairs
        .into_iter()
        .map(|(deeds, _)| Explanation { deeds, predicted: replay.step(tracked, row, deeds) })
        .collect()
}

/// Residual up to which explanations are followed beside one with this residual.
fn limit(least: f32) -> f32 {
    (WORSE * least).max(EXACT)
}

fn least(values: &[f32]) -> usize {
    let mut least = 0;
    for (place, value) in values.iter().enumerate() {
        if *value < values[least] {
            least = place;
        }
    }
    least
}
