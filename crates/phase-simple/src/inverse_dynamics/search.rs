//! The search for candidate actions of both agents that explain one step.

use super::{
    coupling::coupled,
    replay::{CandidateAction, PredictedStep, Replay, TrackedState},
};
use phase_model::{AGENT_COUNT, Action, AgentId, Body, MAX_ENTITIES};

/// Residual below which a step is explained exactly (u). Rows have five decimals, and in a step the kernel
/// departs from the published simulator by little more.
const EXACT: f32 = 0.003;
/// Rounds in which the agents are explained alternately.
const ROUNDS: usize = 3;
/// Explanations of a step that are followed if none is exact, beside those that change grips.
const MAX_INEXACT: usize = 6;
/// Pairs of candidate actions that are compared where agents may act on each other and no exact explanation
/// is to be expected.
const PROMISING: usize = 32;
/// Explanations are followed up to this multiple of the smallest residual.
const WORSE: f32 = 3.0;

/// One explanation of a step.
#[derive(Clone, Debug)]
pub(super) struct Explanation {
    pub(super) candidates: [CandidateAction; AGENT_COUNT],
    pub(super) predicted: PredictedStep,
}

/// The search for the candidate actions of one step.
struct Search<'a> {
    replay: &'a Replay,
    tracked: &'a TrackedState,
    row: &'a [Body; MAX_ENTITIES],
    /// The candidate actions of each agent, which are named by their places here.
    candidates: [Vec<CandidateAction>; AGENT_COUNT],
    /// The residuals (u) of pairs of candidate actions, by the first agent's candidate action and then by the
    /// second's, as far as they are known.
    residuals: Vec<Option<f32>>,
}

/// The path that a step continues.
pub(super) struct Before<'a> {
    pub(super) tracked: &'a TrackedState,
    /// The possible strengths of each agent, one bit for each level.
    pub(super) strengths: [u8; AGENT_COUNT],
    /// The actions of the step before.
    pub(super) actions: [Action; AGENT_COUNT],
    /// Whether the steps before were explained so well that an exact explanation is to be expected.
    pub(super) exact: bool,
}

/// The best explanations of a step, at least one, best first. `row` is the row that it leads to.
pub(super) fn explanations(
    replay: &Replay,
    before: &Before<'_>,
    row: &[Body; MAX_ENTITIES],
) -> Vec<Explanation> {
    let tracked = before.tracked;
    let candidates =
        AgentId::ALL.map(|agent| replay.candidates(&tracked.state, agent, before.strengths[agent]));
    let residuals = vec![None; candidates[0].len() * candidates[1].len()];
    let mut search = Search { replay, tracked, row, candidates, residuals };
    let both = search.shortlist(before);
    let residuals = search.residuals(&both);
    let mut pairs: Vec<_> = both.iter().map(|&pair| search.named(pair)).zip(residuals).collect();
    pairs.sort_by(|a, b| a.1.total_cmp(&b.1));
    let best = best(replay, &pairs);
    let explanation =
        |candidates| Explanation { candidates, predicted: replay.step(tracked, row, candidates) };
    best.into_iter().map(explanation).collect()
}

impl Search<'_> {
    fn named(&self, [first, second]: [usize; AGENT_COUNT]) -> [CandidateAction; AGENT_COUNT] {
        [self.candidates[0][first], self.candidates[1][second]]
    }

    /// The residuals of some pairs of candidate actions (u), each computed once.
    fn residuals(&mut self, pairs: &[[usize; AGENT_COUNT]]) -> Vec<f32> {
        pairs.iter().map(|&pair| self.residual(pair)).collect()
    }

    fn residual(&mut self, [first, second]: [usize; AGENT_COUNT]) -> f32 {
        let place = first * self.candidates[1].len() + second;
        if let Some(residual) = self.residuals[place] {
            return residual;
        }
        let residual = self.replay.step(self.tracked, self.row, self.named([first, second])).residual;
        self.residuals[place] = Some(residual);
        residual
    }

    /// The pairs of candidate actions that are to be compared.
    fn shortlist(&mut self, before: &Before<'_>) -> Vec<[usize; AGENT_COUNT]> {
        let again = |agent: AgentId| {
            self.candidates[agent]
                .iter()
                .position(|candidate| candidate.0 == before.actions[agent])
                .unwrap_or(0)
        };
        let mut best = AgentId::ALL.map(again);
        let mut residuals: [Vec<f32>; AGENT_COUNT] = [Vec::new(), Vec::new()];
        let mut given = [None; AGENT_COUNT];
        // Alternately: all that it takes where the agents do not act on each other, and often enough where
        // they do.
        for _ in 0..ROUNDS {
            for agent in AgentId::ALL {
                if given[agent] == Some(best[agent.other()]) {
                    continue;
                }
                given[agent] = Some(best[agent.other()]);
                let instead = |candidate: usize| {
                    let mut pair = best;
                    pair[agent] = candidate;
                    pair
                };
                let pairs: Vec<_> = (0..self.candidates[agent].len()).map(instead).collect();
                residuals[agent] = self.residuals(&pairs);
                let candidates = residuals[agent].iter().enumerate();
                if let Some((candidate, _)) = candidates.min_by(|a, b| a.1.total_cmp(b.1)) {
                    best[agent] = candidate;
                }
            }
        }
        let least = residuals[1].iter().copied().fold(f32::INFINITY, f32::min);
        let inexact = least > self.replay.exact();
        if inexact && coupled(self.replay, &self.tracked.state) {
            let count = if before.exact { usize::MAX } else { PROMISING };
            return self.promising(&residuals, least, count);
        }
        let limit = self.replay.limit(least);
        let [firsts, seconds] = AgentId::ALL.map(|agent| {
            let follow = |(candidate, residual): (usize, &f32)| {
                let good = *residual <= limit || candidate == best[agent];
                (good || inexact && changes_grip(self.candidates[agent][candidate])).then_some(candidate)
            };
            residuals[agent].iter().enumerate().filter_map(follow).collect::<Vec<_>>()
        });
        firsts.iter().flat_map(|&first| seconds.iter().map(move |&second| [first, second])).collect()
    }

    /// So many pairs of candidate actions, and the first that changes other grips than those: the most
    /// promising ones if what either agent does changes the residual as much whatever the other does, so that
    /// the squares of `residuals`, each with the other's best action, add up.
    fn promising(
        &self,
        residuals: &[Vec<f32>; AGENT_COUNT],
        least: f32,
        count: usize,
    ) -> Vec<[usize; AGENT_COUNT]> {
        let [firsts, seconds] = residuals;
        let square = |first: usize, second: usize| {
            firsts[first] * firsts[first] + seconds[second] * seconds[second] - least * least
        };
        let mut pairs: Vec<([usize; AGENT_COUNT], f32)> = (0..firsts.len())
            .flat_map(|first| (0..seconds.len()).map(move |second| ([first, second], square(first, second))))
            .collect();
        pairs.sort_by(|a, b| a.1.total_cmp(&b.1));
        let mut kinds: Vec<[bool; AGENT_COUNT]> = Vec::new();
        let mut promising = Vec::new();
        for (place, (pair, _)) in pairs.into_iter().enumerate() {
            let kind = self.named(pair).map(changes_grip);
            let new = !kinds.contains(&kind);
            if new {
                kinds.push(kind);
            }
            if new || place < count {
                promising.push(pair);
            }
        }
        promising
    }
}

/// The pairs of candidate actions to be followed, of all those that were tried, sorted by their residuals
/// (u).
fn best(
    replay: &Replay,
    pairs: &[([CandidateAction; AGENT_COUNT], f32)],
) -> Vec<[CandidateAction; AGENT_COUNT]> {
    let least = pairs.first().map_or(0.0, |pair| pair.1);
    let good = pairs.iter().filter(|pair| pair.1 <= replay.limit(least)).count();
    let count = if least <= EXACT && replay.noise == 0.0 { good } else { good.min(MAX_INEXACT) };
    // Who changes its grip. What a grip does often shows later, so the best of each such kind is followed,
    // too.
    let mut kinds: Vec<[bool; AGENT_COUNT]> = Vec::new();
    let mut best = Vec::new();
    for (place, (candidates, _)) in pairs.iter().enumerate() {
        let kind = candidates.map(changes_grip);
        let new = !kinds.contains(&kind);
        if new {
            kinds.push(kind);
        }
        if new || place < count {
            best.push(*candidates);
        }
    }
    best
}

/// Whether a candidate action of those that an agent can do changes what it holds.
fn changes_grip((action, _): CandidateAction) -> bool {
    matches!(action, Action::Attach | Action::Detach)
}

impl Replay {
    /// Residual below which a step is explained as well as rows are exact (u).
    fn exact(&self) -> f32 {
        EXACT.max(1.5 * self.noise)
    }

    /// Residual up to which explanations are followed beside one with this residual (u).
    fn limit(&self, least: f32) -> f32 {
        if self.noise > 0.0 { least + self.noise } else { (WORSE * least).max(EXACT) }
    }
}
