//! The world behind the interface of planners.

use crate::{assert_close, lone_agent, lone_state, step};
use phase_model::{Action, Dynamics, Size, Strength, Vec2};
use phase_world::{World, WorldDynamics};

#[test]
fn one_step_is_that_of_a_world_in_the_same_state() {
    let physics = lone_agent(Size::Medium, Strength::Strong);
    let mut state = lone_state(Vec2::new(12.0, 12.0), 0.4);
    let expected = World::new(&physics, &state).step([Action::UpLeft, Action::TurnRight])[4];
    WorldDynamics { physics }.step(&mut state, [Action::UpLeft, Action::TurnRight]);
    assert_eq!(state, expected);
}

#[test]
fn many_steps_go_as_in_one_lasting_world() {
    let physics = lone_agent(Size::Medium, Strength::Strong);
    let mut state = lone_state(Vec2::new(12.0, 8.0), 0.4);
    // Within reach of the agent's front, so that grabbing and carrying occur.
    state.bodies[2].position = state.bodies[0].position + state.bodies[0].forward() * 2.0;
    let mut world = World::new(&physics, &state);
    let dynamics = WorldDynamics { physics };
    for action in [Action::Attach, Action::Up, Action::Up, Action::TurnLeft, Action::Down, Action::Stop] {
        dynamics.step(&mut state, [action, Action::TurnLeft]);
        let lasting = step_both(&mut world, action);
        assert_eq!(state.grips[0].map(|grip| grip.side), lasting.grips[0].map(|grip| grip.side));
        for k in 0..4 {
            let apart = state.bodies[k].position.distance(lasting.bodies[k].position);
            assert_close(apart, 0.0, 1e-3, action.name());
        }
    }
    assert!(step(&mut world, Action::Detach).grips[0].is_none());
}

fn step_both(world: &mut World, action: Action) -> phase_model::State {
    world.step([action, Action::TurnLeft])[4]
}
