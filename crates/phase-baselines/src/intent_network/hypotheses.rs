//! The hypotheses that the network decides between, by their places among its outputs.

use crate::recognition::RELATIONS;
use phase_model::{AGENT_COUNT, AgentId, Attitude, Goal, MAX_OBJECTS, Relation, Strength};
use phase_simple::{
    Hypothesis, Intent,
    intent_network::{OUTPUTS, goal_index},
    physical_goals,
};

/// Goals of an agent in an event with all objects.
pub(super) const GOALS: usize = 14;
/// Added to the logits of goals about absent objects.
const MASKED_LOGIT: f32 = -1e9;

/// All hypotheses of an event with two objects: the logits that each is the sum of, and what it says.
#[derive(Clone, Debug)]
pub(super) struct Hypotheses {
    pub(super) all: Vec<Hypothesis>,
    /// Indices into the logits of an event, SEQUENCES × OUTPUTS.
    pub(super) terms: Vec<[u32; 2]>,
}

impl Hypotheses {
    pub(super) fn new() -> Self {
        let goals = AgentId::ALL.map(|agent| physical_goals(agent, MAX_OBJECTS));
        let term = |owner: AgentId, goal: usize, output: usize| {
            ((owner.index() * GOALS + goal) * OUTPUTS + output) as u32
        };
        let strengths = [Strength::Fair; AGENT_COUNT];
        let mut all = Vec::new();
        let mut terms = Vec::new();
        for (a, first) in goals[0].iter().enumerate() {
            for (b, second) in goals[1].iter().enumerate() {
                all.push(Hypothesis::new([*first, *second], [Attitude::Neutral; AGENT_COUNT], strengths));
                terms.push([term(AgentId::ZERO, a, 0), term(AgentId::ONE, b, 0)]);
            }
        }
        for social in AgentId::ALL {
            let other = social.other();
            for (attitude, output) in [(Attitude::Help, 1), (Attitude::Hinder, 2)] {
                for (k, goal) in goals[other].iter().enumerate() {
                    let intent = Intent { attitude, goal: *goal };
                    all.push(Hypothesis::of_intent(intent, social, *goal, strengths));
                    terms.push([term(other, k, 0), term(other, k, output)]);
                }
            }
        }
        Self { all, terms }
    }

    /// ln P(Y) of each, with −∞ for those about absent objects.
    pub(super) fn log_priors(&self, objects: usize) -> impl Iterator<Item = f32> {
        let goals = physical_goals(AgentId::ZERO, objects).len();
        let absent = move |goal: &Goal| match goal {
            Goal::ObjectOnLandmark { object, .. } => object.index() >= objects,
            Goal::AgentOnLandmark { .. } | Goal::Touch { .. } => false,
        };
        self.all.iter().map(move |hypothesis| {
            if hypothesis.goals.iter().any(absent) {
                MASKED_LOGIT
            } else {
                hypothesis.log_prior(goals) as f32
            }
        })
    }
}

/// The index of the true hypothesis.
pub(super) fn truth(
    goals: [Goal; AGENT_COUNT],
    attitudes: [Attitude; AGENT_COUNT],
    objects: usize,
) -> Option<u32> {
    let index = |agent: AgentId| {
        goal_index(agent, goals[agent], objects)?;
        goal_index(agent, goals[agent], MAX_OBJECTS)
    };
    let social = |agent: AgentId, attitude| {
        let output = usize::from(attitude == Attitude::Hinder);
        Some(GOALS * GOALS + (agent.index() * 2 + output) * GOALS + index(agent.other())?)
    };
    let found = match attitudes {
        [Attitude::Neutral, Attitude::Neutral] => index(AgentId::ZERO)? * GOALS + index(AgentId::ONE)?,
        [attitude, Attitude::Neutral] => social(AgentId::ZERO, attitude)?,
        [Attitude::Neutral, attitude] => social(AgentId::ONE, attitude)?,
        _ => return None,
    };
    u32::try_from(found).ok()
}

impl Hypotheses {
    /// Share of right goals of both agents, and whether the relation is right, by the marginals.
    pub(super) fn score(&self, truth: u32, probabilities: &[f32]) -> [f64; 2] {
        let truth = &self.all[truth as usize];
        let right = |agent: AgentId| {
            let mut sums: Vec<(Goal, f32)> = Vec::new();
            for (hypothesis, p) in self.all.iter().zip(probabilities) {
                let goal = hypothesis.goals[agent];
                match sums.iter_mut().find(|(known, _)| *known == goal) {
                    Some((_, sum)) => *sum += p,
                    None => sums.push((goal, *p)),
                }
            }
            let best = sums.iter().max_by(|a, b| a.1.total_cmp(&b.1)).map(|(goal, _)| *goal);
            f64::from(u8::from(best == Some(truth.goals[agent])))
        };
        let of = |relation: Relation| -> f32 {
            let same = self.all.iter().zip(probabilities).filter(|(it, _)| it.relation() == relation);
            same.map(|(_, p)| p).sum()
        };
        let best = RELATIONS.into_iter().max_by(|a, b| of(*a).total_cmp(&of(*b)));
        let goals = AgentId::ALL.map(right).iter().sum::<f64>() / AGENT_COUNT as f64;
        [goals, f64::from(u8::from(best == Some(truth.relation())))]
    }
}
