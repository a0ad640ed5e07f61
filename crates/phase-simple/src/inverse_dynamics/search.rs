//! Which deeds of both agents explain one step.

use super::{
    reach::coupled,
    replay::{Deed, PredictedStep, Replay, TrackedState},
};
use phase_model::{AGENT_COUNT, Action, AgentId, Body, MAX_ENTITIES};

/// Residual below which a step is explained exactly (u). Rows have five decimals, and in a step the kernel departs from the
/// published simulator by little more.
const EXACT: f32 = 0.003;
/// Rounds in which the agents are explained alternately.
const ROUNDS: usize = 3;
/// Explanations of a step that are followed if none is exact, beside those that change grips.
const MAX_INEXACT: usize = 6;
/// Explanations are followed up to this multiple of the smallest residual.
const WORSE: f32 = 3.0;

/// One explanation of a step.
#[derive(Clone, Debug)]
pub(super) struct Explanation {
    pub(super) deeds: [Deed; AGENT_COUNT],
    pub(super) predicted: PredictedStep,
}

/// The search for the deeds of one step.
struct Search<'a> {
    replay: &'a Replay,
    tracked: &'a TrackedState,
    row: &'a [Body; MAX_ENTITIES],
    /// What each agent can do. Deeds are named by their places here.
    deeds: [Vec<Deed>; AGENT_COUNT],
    /// The residuals (u) of pairs of deeds, by the first agent's deed and then by the second's, as far as they are known.
    residuals: Vec<Option<f32>>,
}

/// The best explanations of a step from a state, at least one, best first. `strengths` are those possible for each agent, one
/// bit for each level; the search begins with the actions `last`.
pub(super) fn explanations(
    replay: &Replay,
    tracked: &TrackedState,
    row: &[Body; MAX_ENTITIES],
    strengths: [u8; AGENT_COUNT],
    last: [Action; AGENT_COUNT],
) -> Vec<Explanation> {
    let deeds = AgentId::ALL.map(|agent| replay.deeds(&tracked.state, agent, strengths[agent]));
    let residuals = vec![None; deeds[0].len() * deeds[1].len()];
    let mut search = Search { replay, tracked, row, deeds, residuals };
    let [firsts, seconds] = search.candidates(last);
    let both = firsts.iter().flat_map(|&first| seconds.iter().map(move |&second| [first, second]));
    let both: Vec<_> = both.collect();
    let residuals = search.residuals(&both);
    let mut pairs: Vec<_> = both.iter().map(|&pair| search.named(pair)).zip(residuals).collect();
    pairs.sort_by(|a, b| a.1.total_cmp(&b.1));
    let best = best(&pairs);
    let explanation = |deeds| Explanation { deeds, predicted: replay.step(tracked, row, deeds) };
    best.into_iter().map(explanation).collect()
}

impl Search<'_> {
    fn named(&self, [first, second]: [usize; AGENT_COUNT]) -> [Deed; AGENT_COUNT] {
        [self.deeds[0][first], self.deeds[1][second]]
    }

    /// The residuals of some pairs of deeds (u), each computed once.
    fn residuals(&mut self, pairs: &[[usize; AGENT_COUNT]]) -> Vec<f32> {
        pairs.iter().map(|&pair| self.residual(pair)).collect()
    }

    fn residual(&mut self, [first, second]: [usize; AGENT_COUNT]) -> f32 {
        let place = first * self.deeds[1].len() + second;
        if let Some(residual) = self.residuals[place] {
            return residual;
        }
        let residual = self.replay.step(self.tracked, self.row, self.named([first, second])).residual;
        self.residuals[place] = Some(residual);
        residual
    }

    /// The deeds of each agent that are to be combined with those of the other.
    fn candidates(&mut self, last: [Action; AGENT_COUNT]) -> [Vec<usize>; AGENT_COUNT] {
        let again =
            |agent: AgentId| self.deeds[agent].iter().position(|deed| deed.0 == last[agent]).unwrap_or(0);
        let mut best = AgentId::ALL.map(again);
        let mut residuals: [Vec<f32>; AGENT_COUNT] = [Vec::new(), Vec::new()];
        let mut given = [None; AGENT_COUNT];
        // Alternately: all that it takes where the agents do not act on each other, and often enough where they do.
        for _ in 0..ROUNDS {
            for agent in AgentId::ALL {
                if given[agent] == Some(best[agent.other()]) {
                    continue;
                }
                given[agent] = Some(best[agent.other()]);
                let instead = |deed: usize| {
                    let mut pair = best;
                    pair[agent] = deed;
                    pair
                };
                let pairs: Vec<_> = (0..self.deeds[agent].len()).map(instead).collect();
                residuals[agent] = self.residuals(&pairs);
                let deeds = residuals[agent].iter().enumerate();
                if let Some((deed, _)) = deeds.min_by(|a, b| a.1.total_cmp(b.1)) {
                    best[agent] = deed;
                }
            }
        }
        let least = residuals[1].iter().copied().fold(f32::INFINITY, f32::min);
        if least > EXACT && coupled(self.replay, &self.tracked.state) {
            return AgentId::ALL.map(|agent| (0..self.deeds[agent].len()).collect());
        }
        let limit = limit(least);
        AgentId::ALL.map(|agent| {
            let follow = |(deed, residual): (usize, &f32)| {
                let good = *residual <= limit || deed == best[agent];
                (good || least > EXACT && changes_grip(self.deeds[agent][deed])).then_some(deed)
            };
            residuals[agent].iter().enumerate().filter_map(follow).collect()
        })
    }
}

/// The pairs of deeds to be followed, of all those that were tried, sorted by their residuals (u).
fn best(pairs: &[([Deed; AGENT_COUNT], f32)]) -> Vec<[Deed; AGENT_COUNT]> {
    let least = pairs.first().map_or(0.0, |pair| pair.1);
    let good = pairs.iter().filter(|pair| pair.1 <= limit(least)).count();
    let count = if least <= EXACT { good } else { good.min(MAX_INEXACT) };
    // Who changes its grip. What a grip does often shows later, so the best of each such kind is followed, too.
    let mut kinds: Vec<[bool; AGENT_COUNT]> = Vec::new();
    let mut best = Vec::new();
    for (place, (deeds, _)) in pairs.iter().enumerate() {
        let kind = deeds.map(changes_grip);
        let new = !kinds.contains(&kind);
        if new {
            kinds.push(kind);
        }
        if new || place < count {
            best.push(*deeds);
        }
    }
    best
}

/// Whether a deed of those that an agent can do changes what it holds.
fn changes_grip((action, _): Deed) -> bool {
    matches!(action, Action::Attach | Action::Detach)
}

/// Residual up to which explanations are followed beside one with this residual (u).
fn limit(least: f32) -> f32 {
    (WORSE * least).max(EXACT)
}
