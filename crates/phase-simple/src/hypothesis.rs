//! Hypotheses: Y = ⟨g_i, g_j, α_ij, α_ji, f_i, f_j⟩ of the paper.

use phase_event::ObservedEvent;
use phase_model::{
    AGENT_COUNT, AgentId, AgentSpec, Attitude, Awareness, Entity, EventKind, Goal, Intent, ObjectSpec,
    Relation, Scene, Strength,
};
use serde::{Deserialize, Serialize};

/// Goals, attitudes and strengths of both agents: Y of the paper, the explanation that an inference weighs.
///
/// ```
/// use phase_model::{AgentId, Attitude, Goal, LandmarkId, Relation, Sign, Strength};
/// use phase_simple::Hypothesis;
///
/// let goal = Goal::AgentOnLandmark {
///     agent: AgentId::ZERO,
///     landmark: LandmarkId::TOP_LEFT,
///     sign: Sign::Positive,
/// };
/// let attitudes = [Attitude::Neutral, Attitude::Hinder];
/// let hypothesis = Hypothesis::new([goal; 2], attitudes, [Strength::ALL[0]; 2]);
/// // Agent 1 wants the opposite of what agent 0 wants.
/// assert_eq!(hypothesis.goals[1], goal.negated());
/// assert_eq!(hypothesis.relation(), Relation::Adversarial);
/// ```
///
/// The goal of an agent that helps or hinders is the other's, negated for a hinderer: labels are defined this
/// way, and an own goal of a social agent would make no difference (Equation 1).
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Serialize, Deserialize)]
pub struct Hypothesis {
    /// Goal of each agent.
    pub goals: [Goal; AGENT_COUNT],
    /// α of each agent towards the other.
    pub attitudes: [Attitude; AGENT_COUNT],
    /// Strength of each agent. The paper's f is a force; here it is one of its four levels, which are the
    /// only ones used.
    pub strengths: [Strength; AGENT_COUNT],
}

impl Hypothesis {
    /// A hypothesis in which a social agent is given the goal that follows from its attitude, whatever was
    /// passed for it.
    #[must_use]
    pub fn new(
        goals: [Goal; AGENT_COUNT],
        attitudes: [Attitude; AGENT_COUNT],
        strengths: [Strength; AGENT_COUNT],
    ) -> Self {
        let goal = |agent: AgentId| match attitudes[agent] {
            Attitude::Neutral => goals[agent],
            Attitude::Help => goals[agent.other()],
            Attitude::Hinder => goals[agent.other()].negated(),
        };
        Self { goals: [goal(AgentId::ZERO), goal(AgentId::ONE)], attitudes, strengths }
    }

    /// The hypothesis that an agent has an intent while the other pursues its own goal, which is the intent's
    /// goal if the agent is social and `others` if it is not.
    #[must_use]
    pub fn of_intent(
        intent: Intent,
        agent: AgentId,
        others: Goal,
        strengths: [Strength; AGENT_COUNT],
    ) -> Self {
        let mut attitudes = [Attitude::Neutral; AGENT_COUNT];
        attitudes[agent] = intent.attitude;
        let mut goals = [intent.goal; AGENT_COUNT];
        if intent.attitude == Attitude::Neutral {
            goals[agent.other()] = others;
        }
        Self::new(goals, attitudes, strengths)
    }

    /// The agent with a social goal, if there is one.
    #[must_use]
    pub fn social_agent(&self) -> Option<AgentId> {
        AgentId::ALL.into_iter().find(|&agent| self.attitudes[agent] != Attitude::Neutral)
    }

    /// Whether neither goal is at a landmark.
    pub(crate) fn is_elsewhere(&self) -> bool {
        self.goals.iter().all(|goal| goal.landmark().is_none())
    }

    /// ln P(g_i)P(g_j)P(α_ij, α_ji)P(f_i)P(f_j) of Equation 2, all uniform: over the goals of each agent,
    /// over no agent, one helping or one hindering, either of the two, and over four strengths each. A social
    /// agent's own goal, which makes no difference, is summed over.
    #[must_use]
    pub fn log_prior(&self, goals: usize) -> f64 {
        let (attitudes, free_goals) = if self.social_agent().is_some() { (6.0, 1.0) } else { (3.0, 2.0) };
        let strengths = libm::log(Strength::ALL.len() as f64) * AGENT_COUNT as f64;
        -libm::log(attitudes) - free_goals * libm::log(goals as f64) - strengths
    }

    /// The relation that goals and attitudes imply.
    #[must_use]
    pub fn relation(&self) -> Relation {
        Relation::of(self.goals, self.attitudes)
    }

    /// The maximum force of each agent (N).
    #[must_use]
    pub fn max_forces(&self) -> [f32; AGENT_COUNT] {
        self.strengths.map(Strength::max_force)
    }

    /// The observed event's scene if the hypothesis is true.
    #[must_use]
    pub fn scene(&self, observed: &ObservedEvent) -> Scene {
        let [first, ..] = observed.rows() else { unreachable!("an observed event has a row") };
        let sizes = observed.agent_sizes();
        let agents = AgentId::ALL.map(|agent| AgentSpec {
            size: sizes[agent],
            strength: self.strengths[agent],
            goal: self.goals[agent],
            attitude: self.attitudes[agent],
            awareness: Awareness::default(),
            start: first[Entity::Agent(agent)],
        });
        let objects = observed.object_sizes().iter().zip(&first[AGENT_COUNT..]);
        Scene {
            layout: observed.layout(),
            agents,
            objects: objects.map(|(&size, &start)| ObjectSpec { size, start }).collect(),
            kind: EventKind::of(self.goals, self.attitudes),
        }
    }
}
