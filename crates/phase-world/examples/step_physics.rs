//! An agent pushes an object: the reference world, stepped by actions.
//!
//! `cargo run --release --package phase-world --example step_physics`

use phase_model::{Action, AgentBody, AgentId, Body, Entity, ObjectId, PhysicsConfig, State, Vec2};
use phase_world::World;

fn main() {
    let body = AgentBody { radius: 0.8, max_force: 450.0 };
    let physics =
        PhysicsConfig { walls: Vec::new(), agents: [body; 2], object_radii: [0.8, 0.0], object_count: 1 };
    // Agent 0, which faces +y, is below the object; agent 1 is out of the way.
    let places = [Vec2::new(12.0, 6.0), Vec2::new(22.0, 16.0), Vec2::new(12.0, 9.0), Vec2::ZERO];
    let mut world = World::new(&physics, &State::new(places.map(|place| Body::at_rest(place, 0.0))));

    for step in 1..=12 {
        let substeps = world.step([Action::Up, Action::NoForce]);
        let [agent, object] = [Entity::Agent(AgentId::ZERO), Entity::Object(ObjectId::ZERO)]
            .map(|entity| substeps[substeps.len() - 1].position(entity).y);
        println!("step {step:2}: the agent is at y = {agent:5.2} u, the object at y = {object:5.2} u");
    }
    assert!(world.state().position(Entity::Object(ObjectId::ZERO)).y > places[2].y, "it was pushed");
}

#[test]
fn it_runs() {
    main();
}
