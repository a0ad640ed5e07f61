//! Gibbs sweeps: part after part of a hypothesis is drawn anew from all it could be, given the rest.
//!
//! Algorithm 2 of the paper proposes a whole hypothesis at once, of which one wrong part is enough to be refused.
//! With simulations that are put back to the event time and again, what an agent does depends little on what is
//! supposed of the other, and its part can be found by itself.

use crate::{Hypothesis, Proposal, cue::normalised, proposal::drawn, simulations::Simulations};
use core::ops::ControlFlow;
use phase_model::{AGENT_COUNT, Attitude, Goal, Strength, random::Pcg64Mcg};
use phase_pomcp::PomcpError;

/// Less likely than the best alternative by so much (in logarithms), a hypothesis is as good as never drawn and need
/// not be simulated to the end.
const NEGLIGIBLE: f64 = 12.0;

/// A hypothesis with the goals that its agents would have if they were not social.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct Parts {
    goals: [Goal; AGENT_COUNT],
    attitudes: [Attitude; AGENT_COUNT],
    strengths: [Strength; AGENT_COUNT],
}

impl Parts {
    /// A first guess.
    pub(crate) fn guess(proposal: &Proposal, random: &mut Pcg64Mcg) -> Self {
        let hypothesis = proposal.sample(random);
        let goals = core::array::from_fn(|agent| proposal.sample_goal(agent, random));
        Self { goals, attitudes: hypothesis.attitudes, strengths: hypothesis.strengths }
    }

    fn hypothesis(&self) -> Hypothesis {
        Hypothesis::new(self.goals, self.attitudes, self.strengths)
    }

    /// What an agent can want, the other's part being what it is: each of its goals, or helping or hindering if
    /// the other is not social itself.
    fn wants(&self, agent: usize, goals: &[Goal]) -> Vec<Self> {
        let neutral = |goal: &Goal| {
            let mut parts = *self;
            (parts.goals[agent], parts.attitudes[agent]) = (*goal, Attitude::Neutral);
            parts
        };
        // What it is supposed to want now comes first: whatever is worse is broken off the sooner.
        let mut options = vec![*self];
        options.extend(goals.iter().map(neutral).filter(|option| option != self));
        if self.attitudes[1 - agent] == Attitude::Neutral {
            let social = [Attitude::Help, Attitude::Hinder].map(|attitude| {
                let mut parts = *self;
                parts.attitudes[agent] = attitude;
                parts
            });
            options.extend(social.into_iter().filter(|option| option != self));
        }
        options
    }

    /// Who may be social towards whom, and about what: nobody, or either helping or hindering the other with any of
    /// its goals. Only with the right goal does it look right that somebody helps or hinders, and the other way
    /// round, so that these two are drawn together.
    fn relations(&self, goals: [&[Goal]; AGENT_COUNT]) -> Vec<Self> {
        let mut options = vec![*self, Self { attitudes: [Attitude::Neutral; AGENT_COUNT], ..*self }];
        for (social, attitude) in [0, 1]
            .into_iter()
            .flat_map(|agent| [Attitude::Help, Attitude::Hinder].map(|attitude| (agent, attitude)))
        {
            options.extend(goals[1 - social].iter().map(|goal| {
                let mut parts = *self;
                parts.goals[1 - social] = *goal;
                parts.attitudes = [Attitude::Neutral; AGENT_COUNT];
                parts.attitudes[social] = attitude;
                parts
            }));
        }
        // Each once.
        let mut different: Vec<Self> = Vec::with_capacity(options.len());
        for option in options {
            if !different.contains(&option) {
                different.push(option);
            }
        }
        different
    }

    /// How strong an agent can be.
    fn strengths(&self, agent: usize) -> Vec<Self> {
        let option = |strength| {
            let mut parts = *self;
            parts.strengths[agent] = strength;
            parts
        };
        Strength::ALL.map(option).to_vec()
    }
}

/// Draws every part of a hypothesis anew, one after the other; `None` if `tick` broke it off.
pub(crate) fn sweep(
    mut parts: Parts,
    proposal: &Proposal,
    simulations: &mut Simulations<'_>,
    random: &mut Pcg64Mcg,
    tick: &mut dyn FnMut() -> ControlFlow<()>,
) -> Result<Option<Parts>, PomcpError> {
    for block in 0..5 {
        let options = match block {
            0 | 1 => parts.wants(block, proposal.goals(block)),
            2 => parts.relations([proposal.goals(0), proposal.goals(1)]),
            _ => parts.strengths(block - 3),
        };
        let mut logs = Vec::with_capacity(options.len());
        let mut best = f64::NEG_INFINITY;
        for option in &options {
            if tick().is_break() {
                return Ok(None);
            }
            let hypothesis = option.hypothesis();
            let prior = hypothesis.log_prior(proposal.goals(0).len());
            let log = simulations.above(&hypothesis, best - NEGLIGIBLE - prior)?;
            let log = log.map_or(f64::NEG_INFINITY, |log| log + prior);
            best = best.max(log);
            logs.push(log);
        }
        parts = options[drawn(&normalised(logs), random)];
    }
    Ok(Some(parts))
}
