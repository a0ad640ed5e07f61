//! Momentum of bodies that nobody pushes.

use phase_forward::Forward;
use phase_model::{Action, AgentBody, Body, PhysicsConfig, Size, State, Vec2, arena, physics::object_mass};
use proptest::prelude::*;

proptest! {
    #[test]
    fn ground_friction_only_slows(
        velocity in (-40.0..40.0_f32, -40.0..40.0_f32),
        angle in -9.0..9.0_f32,
        size in 0..4_usize,
    ) {
        let physics = PhysicsConfig {
            walls: Vec::new(),
            agents: [AgentBody { radius: Size::ALL[size].radius(), max_force: 300.0 }; 2],
            object_radii: [1.2, 0.8],
            object_count: 1,
        };
        let forward = Forward::new(&physics);
        for (moving, other, mass) in [(0, 2, physics.agents[0].mass()), (2, 0, object_mass(1.2))] {
            let corners = [[8.0, 5.0], [24.0, 5.0], [24.0, 19.0], [8.0, 19.0]];
            let mut state = State::new(corners.map(|[x, y]| Body::at_rest(Vec2::new(x, y), angle)));
            state.bodies[other].position = Vec2::new(8.0, 5.0);
            state.bodies[moving].position = arena::CENTRE;
            state.bodies[moving].velocity = Vec2::new(velocity.0, velocity.1);
            let substeps = forward.step_substeps(&mut state, [Action::NoForce; 2]);
            let mut speed = Vec2::new(velocity.0, velocity.1).length();
            for after in substeps {
                let now = after.bodies[moving].velocity.length();
                prop_assert!(now <= speed + 1e-4, "{speed} -> {now}");
                // Its force never exceeds 100 N, and equals 100 N as long as a disc slides.
                let loss = 100.0 / 60.0 / mass;
                prop_assert!(now >= speed - loss - 1e-3);
                if moving == 2 && speed > loss && speed < 40.0 {
                    prop_assert!((speed - now - loss).abs() < 1e-3, "{speed} -> {now}, not {loss}");
                }
                speed = now;
            }
        }
    }

    #[test]
    fn colliding_bodies_keep_their_momentum(
        offset in -1.5..1.5_f32,
        speed in 1.0..25.0_f32,
        mover in 0..4_usize,
        next in 1..4_usize,
        angle in -4.0..4.0_f32,
    ) {
        let agent = |radius: f32| AgentBody { radius, max_force: 300.0 };
        let physics = PhysicsConfig {
            walls: Vec::new(),
            agents: [agent(0.8), agent(1.2)],
            object_radii: [0.8, 1.2],
            object_count: 2,
        };
        let forward = Forward::new(&physics);
        let masses = [physics.agents[0].mass(), physics.agents[1].mass(), object_mass(0.8), object_mass(1.2)];
        let struck = (mover + next) % 4;
        let corners = [[8.0, 4.0], [24.0, 4.0], [24.0, 20.0], [8.0, 20.0]];
        let mut state = State::new(corners.map(|[x, y]| Body::at_rest(Vec2::new(x, y), angle)));
        state.bodies[mover].position = Vec2::new(12.5, 12.0);
        state.bodies[mover].velocity = Vec2::new(speed, 0.0);
        state.bodies[struck].position = Vec2::new(16.0, 12.0 + offset);
        let momentum = |state: &State| -> Vec2 {
            state.bodies.iter().zip(masses).map(|(body, mass)| body.velocity * mass).sum()
        };
        for _ in 0..6 {
            let mut before = state;
            for after in forward.step_substeps(&mut state, [Action::NoForce; 2]) {
                let change = momentum(&after).distance(momentum(&before));
                prop_assert!(change <= 2.0 * 100.0 / 60.0 + 1e-3, "momentum changed by {change}");
                before = after;
            }
        }
    }
}
