//! Whether a predicate holds in a physical state.

use crate::threshold;
use phase_model::{Entity, Goal, Literal, PhysicsConfig, Predicate, PredicateTarget, State, arena, layout};

/// Whether a predicate holds. Objects that the scene does not have make it false.
#[must_use]
pub fn holds(physics: &PhysicsConfig, state: &State, predicate: Predicate) -> bool {
    let present = |entity: Entity| entity.index() < physics.entity_count();
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
        Predicate::Close(entity, PredicateTarget::Landmark(landmark)) => {
            present(entity) && layout::room_of(state.position(entity)) == landmark.room()
        }
        Predicate::Close(entity, PredicateTarget::Entity(other)) => {
            present(entity)
                && present(other)
                && state.position(entity).distance(state.position(other))
                    < physics.radius(entity) + physics.radius(other) + threshold::CLOSE_GAP
        }
    }
}

/// Whether a literal is true in a state.
#[must_use]
pub fn is_true(physics: &PhysicsConfig, state: &State, literal: Literal) -> bool {
    holds(physics, state, literal.predicate) == literal.holds
}

/// Whether a goal's condition is satisfied in a state.
#[must_use]
pub fn achieved(physics: &PhysicsConfig, state: &State, goal: Goal) -> bool {
    is_true(physics, state, goal.into())
}
