//! The matter of a decision: what is to be searched, and the draw from what was found.

use crate::policy::Features;
use phase_event::SubgoalValue;
use phase_model::{
    Action, AgentId, BodySet, Entity, Literal, PhysicsConfig, Predicate, PredicateTarget, State, Subgoal,
};
use phase_planner::Candidate;
use rand::{Rng, RngExt};

/// A decision before it is made, as the policy network sees it.
#[derive(Clone, Debug)]
pub struct Consideration {
    /// The subgoal pursued.
    pub subgoal: Subgoal,
    /// The actions to choose from, at least two.
    pub actions: &'static [Action],
    /// The network's input.
    pub features: Features,
    /// The action of the heuristic in the first particle.
    pub heuristic: Action,
    /// The prior weight of each action by habit in the first particle.
    pub habits: Vec<f64>,
}

/// The matter of a decision.
pub(crate) enum Matter {
    /// No particle proposes a subgoal.
    Nothing,
    /// The other agent is watched by this action, whatever the subgoals that were proposed.
    Watch(Action, Vec<SubgoalValue>),
    /// An action is to be found.
    Search(Question),
}

/// The matter of a search.
pub(crate) struct Question {
    pub(crate) subgoal: Subgoal,
    pub(crate) subgoals: Vec<SubgoalValue>,
    pub(crate) plan: Vec<Subgoal>,
    pub(crate) actions: &'static [Action],
    /// The particles that it is searched from, at least one.
    pub(crate) particles: Vec<usize>,
    /// Their states of the world.
    pub(crate) roots: Vec<State>,
}

/// Draws an index with a probability proportional to its visits to the power of `exponent`; `None` if all are
/// zero.
pub(crate) fn sample(visits: &[f64], exponent: f64, random: &mut impl Rng) -> Option<usize> {
    let most = visits.iter().copied().fold(0.0, f64::max);
    if most <= 0.0 {
        return None;
    }
    let weights = visits.iter().map(|visits| libm::pow(visits / most, exponent));
    let sum: f64 = weights.clone().sum();
    if !sum.is_finite() {
        return None;
    }
    let mut left = random.random_range(0.0..sum);
    for (index, weight) in weights.enumerate() {
        if left < weight {
            return Some(index);
        }
        left -= weight;
    }
    None
}

/// The index of the greatest probability.
pub(crate) fn likeliest(policy: &[f64]) -> usize {
    let greatest = policy.iter().enumerate().max_by(|a, b| a.1.total_cmp(b.1));
    greatest.map_or(0, |(index, _)| index)
}

/// The entity that a subgoal sends an agent to.
pub(crate) fn target_entity(subgoal: Subgoal, agent: AgentId) -> Option<Entity> {
    let Subgoal::Achieve(Literal { predicate, holds: true }) = subgoal else { return None };
    match predicate {
        Predicate::Close(who, PredicateTarget::Entity(entity)) if who == Entity::Agent(agent) => Some(entity),
        Predicate::Touch(_, entity) => Some(entity),
        Predicate::Attach(_, object) => Some(Entity::Object(object)),
        _ => None,
    }
}

pub(crate) fn summary_of(candidate: &Candidate) -> SubgoalValue {
    SubgoalValue { subgoal: candidate.subgoal, value: candidate.value, particles: candidate.particles.len() }
}

/// Entities on whose position all particles agree, to within `agreement` (u). An agent need not verify the
/// position of an object it has just put down. It has to, if the object is out of sight and in the other's
/// hands in any particle: the other may carry it anywhere.
pub(crate) fn localised(
    physics: &PhysicsConfig,
    particles: &[State],
    agent: AgentId,
    agreement: f32,
) -> BodySet {
    let mut known = BodySet::EMPTY;
    let Some(first) = particles.first() else { return known };
    for entity in physics.entities() {
        let place = first.position(entity);
        let lies_there = |particle: &State| {
            let is_carried =
                matches!(entity, Entity::Object(object) if particle.holds(agent.other(), object));
            !is_carried && particle.position(entity).distance(place) <= agreement
        };
        if particles.iter().all(lies_there) {
            known.insert(entity);
        }
    }
    known
}
