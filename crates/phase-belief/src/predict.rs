//! One step of the dynamics under constant motion.

use crate::consistency::{PENETRATION_TOLERANCE, overlap_beyond_tolerance, shrunk_outline};
use phase_model::{
    AGENT_COUNT, Action, AgentId, BodySet, Dynamics, Entity, PhysicsConfig, State, Vec2, arena,
};

/// Advances all particles by one step in which the believing agent acts and the other continues its motion.
///
/// Without an action the dynamics would let the other agent slide to a stop. The constant-motion assumption
/// keeps its velocity instead, and that of the object it holds, unless something is in the way; then the
/// result of the dynamics is kept. This is skipped if the other agent is observed at the end of the step.
/// Free objects slide under friction.
pub(crate) fn predict(
    dynamics: &impl Dynamics,
    physics: &PhysicsConfig,
    particles: &mut [State],
    agent: AgentId,
    own_action: Action,
    observed: BodySet,
) {
    let mut actions = [Action::NoForce; AGENT_COUNT];
    actions[agent] = own_action;
    let other = agent.other();
    for particle in particles {
        let before = *particle;
        dynamics.step(particle, actions);
        if !observed.contains(Entity::Agent(other)) {
            apply_constant_motion(physics, &before, particle, other);
        }
    }
}

/// Moves an agent and the object it holds as constant motion would have, if the path is free.
fn apply_constant_motion(physics: &PhysicsConfig, before: &State, after: &mut State, agent: AgentId) {
    let velocity = before.body(Entity::Agent(agent)).velocity;
    let held = before.held_object(agent).filter(|&object| object.index() < physics.object_count);
    if velocity == Vec2::ZERO {
        return;
    }
    let mut moving = BodySet::EMPTY;
    moving.insert(Entity::Agent(agent));
    if let Some(object) = held {
        moving.insert(Entity::Object(object));
    }
    if (1..=arena::SUBSTEPS).all(|substep| {
        let way = velocity * (substep as f32 * arena::SUBSTEP_SECONDS);
        moving.iter().all(|entity| is_free(physics, before, after, moving, entity, way))
    }) {
        let way = velocity * arena::STEP_SECONDS as f32;
        for entity in moving.iter() {
            let mut body = *before.body(entity);
            body.position += way;
            body.velocity = velocity;
            body.angular_velocity = 0.0;
            *after.body_mut(entity) = body;
        }
    }
}

/// Whether an entity that has been moved by a vector overlaps no wall and no body, neither where that was
/// before the step nor where it is after it: pushing is left to the dynamics.
fn is_free(
    physics: &PhysicsConfig,
    before: &State,
    after: &State,
    moving: BodySet,
    entity: Entity,
    way: Vec2,
) -> bool {
    let mut body = *before.body(entity);
    body.position += way;
    let outline = shrunk_outline(physics, entity, &body, PENETRATION_TOLERANCE);
    outline.inside_arena()
        && !physics.walls.iter().any(|&wall| outline.overlaps_wall(wall))
        && physics.entities().filter(|&other| !moving.contains(other)).all(|other| {
            !overlap_beyond_tolerance(physics, (entity, &body), (other, before.body(other)))
                && !overlap_beyond_tolerance(physics, (entity, &body), (other, after.body(other)))
        })
}
