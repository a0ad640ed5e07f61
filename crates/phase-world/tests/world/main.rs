//! Behaviour of the reference world, checked against hand formulas, recordings and invariants.

mod contact;
mod determinism;
mod dynamics;
mod grip;
mod impact;
mod motion;
mod probes;
mod release;
mod safety;

use phase_model::{Action, AgentBody, Body, Entity, ObjectId, PhysicsConfig, Size, State, Strength, Vec2};
use phase_world::World;

/// A point in the upper right quarter of an empty arena, far from everything relevant.
const ASIDE: Vec2 = Vec2::new(24.0, 20.0);

/// An empty arena with two agents and two objects of radius 0.8.
fn physics(agents: [(Size, Strength); 2], objects: [Size; 2]) -> PhysicsConfig {
    PhysicsConfig {
        walls: Vec::new(),
        agents: agents
            .map(|(size, strength)| AgentBody { radius: size.radius(), max_force: strength.max_force() }),
        object_radii: objects.map(Size::radius),
        object_count: 2,
    }
}

/// One agent under test; the other bodies are far away.
fn lone_agent(size: Size, strength: Strength) -> PhysicsConfig {
    physics([(size, strength), (Size::Small, Strength::Weak)], [Size::Small; 2])
}

/// Agent 0 at rest at a point, all other bodies far away from it and from each other.
fn lone_state(position: Vec2, angle: f32) -> State {
    let aside = |x: f32, y: f32| Body::at_rest(ASIDE - Vec2::new(x, y), 0.0);
    State::new([Body::at_rest(position, angle), aside(0.0, 0.0), aside(5.0, 0.0), aside(0.0, 4.0)])
}

/// Steps with agent 0 acting and agent 1 idle; the state after the last substep.
fn step(world: &mut World, action: Action) -> State {
    world.step([action, Action::NoForce])[4]
}

fn assert_close(actual: f32, expected: f32, tolerance: f32, what: &str) {
    assert!((actual - expected).abs() <= tolerance, "{what}: {actual}, not {expected} ± {tolerance}");
}

fn assert_share(actual: f32, expected: f32, share: f32, what: &str) {
    assert_close(actual, expected, (expected * share).abs(), what);
}

const OBJECT: Entity = Entity::Object(ObjectId::ZERO);
