//! Equal inputs give equal bits.

use crate::physics;
use phase_model::{Action, Body, Layout, PhysicsConfig, Size, State, Strength, Vec2};
use phase_world::World;

/// A crowded scene in which all bodies collide with each other.
fn scene() -> (PhysicsConfig, State) {
    let mut physics = physics(
        [(Size::Small, Strength::Mighty), (Size::Large, Strength::Strong)],
        [Size::Medium, Size::Huge],
    );
    physics.walls = Layout::new(21, None).expect("base 21 exists").walls();
    let bodies = [(8.0, 14.0, 0.3), (11.0, 15.0, -1.0), (8.0, 16.2, 0.0), (12.5, 19.0, 2.0)];
    (physics, State::new(bodies.map(|(x, y, angle)| Body::at_rest(Vec2::new(x, y), angle))))
}

/// Every state of sixty steps of a fixed, varied sequence of actions.
fn run() -> Vec<State> {
    let (physics, state) = scene();
    let mut world = World::new(&physics, &state);
    let mut states = vec![world.state(), world.settle()];
    for step in 0..60 {
        let actions = [Action::ALL[(step * 5 + 12) % 14], Action::ALL[(step * step + 2) % 14]];
        states.extend(world.step(actions));
    }
    states
}

/// The states as raw bits, so that no two different floats compare equal.
fn bits(states: &[State]) -> Vec<u32> {
    let body = |body: &Body| {
        [
            body.position.x,
            body.position.y,
            body.velocity.x,
            body.velocity.y,
            body.angle,
            body.angular_velocity,
        ]
        .map(f32::to_bits)
    };
    states.iter().flat_map(|state| state.bodies.iter().flat_map(body)).collect()
}

#[test]
fn runs_repeat_bit_for_bit_on_any_thread() {
    let first = run();
    assert!(first.iter().any(|state| state.contacts != phase_model::Contacts::NONE), "the run is eventful");
    assert!(first.iter().any(|state| state.grips.iter().any(Option::is_some)));
    fn can_move_between_threads<T: Send>() {}
    can_move_between_threads::<World>();
    let others: Vec<_> = (0..4).map(|_| std::thread::spawn(run)).collect();
    for other in others {
        let other = other.join().expect("the run ends");
        assert_eq!(bits(&first), bits(&other));
        assert_eq!(first, other);
    }
}

#[test]
fn worlds_do_not_share_anything() {
    let (physics, state) = scene();
    let mut disturbed = World::new(&physics, &state);
    let mut bystander = World::new(&physics, &state);
    let mut alone = World::new(&physics, &state);
    for step in 0..20 {
        disturbed.step([Action::ALL[step % 14], Action::TurnLeft]);
        assert_eq!(bystander.step([Action::Up; 2]), alone.step([Action::Up; 2]));
    }
}
