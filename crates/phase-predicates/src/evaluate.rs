//! Whether a predicate holds in a physical state.

use crate::{Literal, Place, Predicate, threshold};
use phase_model::{Entity, Goal, Physique, Sign, State, arena, layout};

/// Whether a predicate holds. Objects that the scene does not have make it false.
#[must_use]
pub fn holds(physique: &Physique, state: &State, predicate: Predicate) -> bool {
    let present = |entity: Entity| entity.index() < physique.entity_count();
    match predicate {
        Predicate::On(entity, landmark) => {
            let limit = match entity {
                Entity::Agent(_) => threshold::ON_AGENT,
                Entity::Object(_) => threshold::ON_OBJECT,
            };
            present(entity) && state.position(entity).distance(arena::LANDMARKS[landmark]) < limit
        }
        Predicate::Touch(agent, entity) => {
            let agent = Entity::Agent(agent);
            present(agent) && present(entity) && state.touching(agent, entity)
        }
        Predicate::Attach(agent, object) => present(Entity::Agent(agent)) && state.holds(agent, object),
        Predicate::Close(entity, Place::Landmark(landmark)) => {
            present(entity) && layout::room_of(state.position(entity)) == landmark.room()
        }
        Predicate::Close(entity, Place::Entity(other)) => {
            present(entity)
                && present(other)
                && state.position(entity).distance(state.position(other))
                    < physique.radius(entity) + physique.radius(other) + threshold::CLOSE_GAP
        }
    }
}

impl Literal {
    /// Whether the literal is true in a state.
    #[must_use]
    pub fn is_true(self, physique: &Physique, state: &State) -> bool {
        holds(physique, state, self.predicate) == self.holds
    }
}

impl From<Goal> for Literal {
    /// The final goal state as a predicate or its negation.
    fn from(goal: Goal) -> Self {
        let predicate = match goal {
            Goal::AgentOnLandmark { agent, landmark, .. } => Predicate::On(Entity::Agent(agent), landmark),
            Goal::ObjectOnLandmark { object, landmark, .. } => {
                Predicate::On(Entity::Object(object), landmark)
            }
            Goal::Touch { agent, other, .. } => Predicate::Touch(agent, Entity::Agent(other)),
        };
        Self { predicate, holds: goal.sign() == Sign::Positive }
    }
}

/// Whether a goal's condition is satisfied in a state.
#[must_use]
pub fn achieved(physique: &Physique, state: &State, goal: Goal) -> bool {
    Literal::from(goal).is_true(physique, state)
}
