//! An agent's memory of a contest for an object.

use phase_model::{AGENT_COUNT, AgentId, Entity, ObjectId, Vec2};
use phase_perception::Observation;

/// Displacement (u) of an object held by both agents that counts as progress. Less is a standstill, even
/// if both turn about the object. Agents are 2.4 to 4.8 u wide.
const PROGRESS: f32 = 1.0;

/// A contest for an object, as one of the two agents remembers it: for how long both have held it and nothing
/// has come of it, and for how long this agent has left it to the other.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Contest {
    /// The object that each agent holds, as far as this one knows.
    held: [Option<ObjectId>; AGENT_COUNT],
    /// Whether it saw that the other held nothing.
    saw_other_free: bool,
    /// The object that both hold, or that the other has kept since this agent let go of it.
    object: Option<ObjectId>,
    /// The agent that held it first.
    first: AgentId,
    /// The object's place (u) at its last progress.
    place: Vec2,
    standstill: u16,
    left_for: u16,
}

impl Default for Contest {
    /// No contest.
    fn default() -> Self {
        Self {
            held: [None; AGENT_COUNT],
            saw_other_free: false,
            object: None,
            first: AgentId::ZERO,
            place: Vec2::ZERO,
            standstill: 0,
            left_for: 0,
        }
    }
}

impl Contest {
    /// The object that an agent should leave to the other, if there is one.
    ///
    /// Of two that have held it for `patience` steps without moving it from its place, the one that held it
    /// first lets go, and keeps its hands off for `respite` steps, as long as the other holds it. Of two that
    /// grasped it in the same step, agent 0 counts as the first; an agent that did not see the other before
    /// takes it for the first.
    #[must_use]
    pub fn ceded(&self, agent: AgentId, patience: u16, respite: u16) -> Option<ObjectId> {
        let is_lost = self.standstill >= patience && self.first == agent && self.left_for < respite;
        self.object.filter(|_| is_lost)
    }

    /// Takes in an agent's observation after a step. The other goes on holding what the agent does not see.
    pub(crate) fn follow(&mut self, observation: &Observation) {
        let me = observation.agent;
        let held_before = self.held[me];
        let grasped_together =
            core::mem::replace(&mut self.saw_other_free, observation.grip(me.other()) == Some(None));
        for agent in AgentId::ALL {
            if let Some(grip) = observation.grip(agent) {
                self.held[agent] = grip.map(|grip| grip.object);
            }
        }
        let place = |object: Option<ObjectId>| observation.body(Entity::Object(object?));
        // An agent that holds an object in view is in view, too.
        if observation.grip(me.other()).is_none() && place(self.held[me.other()]).is_some() {
            self.held[me.other()] = None;
        }
        let contested = self.held[me.other()];
        let place = place(contested);
        match (self.held[me], contested) {
            (Some(own), Some(object)) if own == object => {
                let place = place.map_or(self.place, |body| body.position);
                if self.object != contested || self.left_for > 0 {
                    let first = match (held_before == contested, grasped_together) {
                        (true, _) => me,
                        (false, true) => AgentId::ZERO,
                        (false, false) => me.other(),
                    };
                    (self.object, self.first, self.place) = (contested, first, place);
                    (self.standstill, self.left_for) = (0, 0);
                } else if place.distance(self.place) < PROGRESS {
                    self.standstill = self.standstill.saturating_add(1);
                } else {
                    (self.place, self.standstill) = (place, 0);
                }
            }
            (None, Some(_)) if self.object == contested => self.left_for = self.left_for.saturating_add(1),
            _ => *self = Self { held: self.held, saw_other_free: self.saw_other_free, ..Self::default() },
        }
    }
}
