//! The choice among the subgoals that the particles propose.

use crate::{aim::Aim, rooms::Rooms};
use phase_model::{AgentId, Entity, Goal, ObjectId, State, arena};

/// A subgoal with the particles that propose it.
#[derive(Clone, Debug)]
pub(crate) struct Proposal {
    pub(crate) aim: Aim,
    /// Share of the particles, less what the distance costs.
    pub(crate) value: f64,
    /// Indices of the particles, in order.
    pub(crate) particles: Vec<usize>,
}

/// All subgoals proposed, the most valuable first; of equally valuable ones the one proposed first. Takes the
/// cost of every particle.
pub(crate) fn proposals(aims: &[Aim], costs: &[f64]) -> Vec<Proposal> {
    let mut proposals: Vec<Proposal> = Vec::new();
    for (particle, &aim) in aims.iter().enumerate() {
        match proposals.iter_mut().find(|proposal| proposal.aim == aim) {
            Some(proposal) => proposal.particles.push(particle),
            None => proposals.push(Proposal { aim, value: 0.0, particles: vec![particle] }),
        }
    }
    for proposal in &mut proposals {
        let count = proposal.particles.len() as f64;
        let cost: f64 = proposal.particles.iter().map(|&particle| costs[particle]).sum();
        proposal.value = count / aims.len() as f64 - cost / count;
    }
    proposals.sort_by(|a, b| b.value.total_cmp(&a.value));
    proposals
}

/// Distance (u) left to go to the final goal, whatever the subgoal: of an agent, its way to the landmark; of
/// an object, its way if the agent holds it, else the agent's way to it. Nothing for all other goals.
pub(crate) fn distance_left(rooms: &Rooms, agent: AgentId, goal: Goal, state: &State) -> f64 {
    let at = |entity| state.position(entity);
    match goal {
        Goal::AgentOnLandmark { agent, landmark, .. } => {
            rooms.distance(at(Entity::Agent(agent)), arena::LANDMARKS[landmark])
        }
        Goal::ObjectOnLandmark { object, landmark, .. } => {
            let place = at(Entity::Object(object));
            if state.holds(agent, object) {
                rooms.distance(place, arena::LANDMARKS[landmark])
            } else {
                rooms.distance(at(Entity::Agent(agent)), place)
            }
        }
        Goal::Touch { .. } => 0.0,
    }
}

/// The subgoal pursued: going to an object or to the other agent if any particle proposes that, else the most
/// valuable. `None` without proposals.
pub(crate) fn pursued(proposals: &[Proposal], agent: AgentId) -> Option<&Proposal> {
    let entities =
        [Entity::Object(ObjectId::ZERO), Entity::Object(ObjectId::ONE), Entity::Agent(agent.other())];
    let approach = |entity: Entity| {
        proposals
            .iter()
            .find(|it| matches!(it.aim, Aim::Touch(who, whom, _) if who == agent && whom == entity))
    };
    entities.into_iter().find_map(approach).or_else(|| proposals.first())
}
