//! Holding objects, alone and together, and carrying them.

use crate::Track;
use phase_model::{AGENT_COUNT, AgentId, Entity, ObjectId, State};
use phase_perception::observed_set;
use serde::{Deserialize, Serialize};

/// A time during which one agent held one object without a break.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
pub struct HoldInterval {
    /// The agent.
    pub agent: AgentId,
    /// The object.
    pub object: ObjectId,
    /// The first step at whose end it was held.
    pub from: usize,
    /// The last step at whose end it was held.
    pub to: usize,
}

impl HoldInterval {
    /// Its duration (steps).
    #[must_use]
    pub const fn steps(&self) -> usize {
        self.to + 1 - self.from
    }
}

/// Every hold of an event, agent 0's first, each agent's in order of time.
#[must_use]
pub fn holds(track: &Track) -> Vec<HoldInterval> {
    let mut holds: Vec<HoldInterval> = Vec::new();
    for agent in AgentId::ALL {
        for (t, state) in track.states.iter().enumerate() {
            let Some(object) = state.held_object(agent) else { continue };
            match holds.last_mut() {
                Some(last) if last.agent == agent && last.object == object && last.to + 1 == t => last.to = t,
                _ => holds.push(HoldInterval { agent, object, from: t, to: t }),
            }
        }
    }
    holds
}

/// Steps in which an agent held an object, and how far the object went in them.
#[must_use]
pub fn carried(track: &Track, agent: AgentId, object: ObjectId) -> CarryStatistics {
    carrying(track, object, |state| holders(state, object)[agent])
}

/// Steps in which both agents held the same object, and how far it went in them: it is carried together where
/// it moves, and fought over where it does not.
#[must_use]
pub fn carried_together(track: &Track, object: ObjectId) -> CarryStatistics {
    carrying(track, object, |state| holders(state, object) == [true; AGENT_COUNT])
}

/// Steps in which an agent held an object and the other did not, and how far it went in them.
#[must_use]
pub fn carried_alone(track: &Track, agent: AgentId, object: ObjectId) -> CarryStatistics {
    carrying(track, object, |state| holds_alone(state, agent, object))
}

/// Steps in which an agent held an object and the other perceived neither, and how far it went in them.
#[must_use]
pub fn carried_unseen(track: &Track, agent: AgentId, object: ObjectId) -> CarryStatistics {
    carrying(track, object, |state| {
        holds_alone(state, agent, object) && {
            let seen = observed_set(&track.physics, state, agent.other());
            !seen.contains(Entity::Agent(agent)) && !seen.contains(Entity::Object(object))
        }
    })
}

/// For how long an object was held in some way, and how far it went.
#[derive(Clone, Copy, PartialEq, Debug, Default, Serialize, Deserialize)]
pub struct CarryStatistics {
    /// Steps.
    pub steps: usize,
    /// Distance the object travelled in them (u).
    pub distance: f32,
    /// Approach to each landmark in them (u); negative where it moved away.
    pub approach: [f32; 4],
}

fn carrying(track: &Track, object: ObjectId, counts: impl Fn(&State) -> bool) -> CarryStatistics {
    let mut carrying = CarryStatistics::default();
    let entity = Entity::Object(object);
    for (t, pair) in track.states.windows(2).enumerate() {
        if !counts(&pair[1]) {
            continue;
        }
        carrying.steps += 1;
        carrying.distance += track.distance_in_step(entity, t + 1);
        for (approach, landmark) in carrying.approach.iter_mut().zip(phase_model::arena::LANDMARKS) {
            *approach += pair[0].position(entity).distance(landmark);
            *approach -= pair[1].position(entity).distance(landmark);
        }
    }
    carrying
}

fn holders(state: &State, object: ObjectId) -> [bool; AGENT_COUNT] {
    AgentId::ALL.map(|agent| state.holds(agent, object))
}

fn holds_alone(state: &State, agent: AgentId, object: ObjectId) -> bool {
    let holders = holders(state, object);
    holders[agent] && !holders[agent.other()]
}
