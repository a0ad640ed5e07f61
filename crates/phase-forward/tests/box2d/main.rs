//! Imagined steps beside those of Box2D itself (`steps.py`), bit for bit.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::indexing_slicing, clippy::panic)]

use phase_forward::Imagined;
use phase_model::{
    Action, AgentBody, AgentId, Body, Dynamics, Entity, Grip, Layout, ObjectId, PhysicsConfig, Side, Size,
    State, Strength, Vec2,
};
use serde_json::Value;

const NAMES: [&str; 14] = [
    "turnleft",
    "turnright",
    "up",
    "down",
    "left",
    "right",
    "upleft",
    "upright",
    "downleft",
    "downright",
    "stop",
    "noforce",
    "attach",
    "detach",
];

fn level(it: &Value) -> u8 {
    it.as_u64().unwrap() as u8
}

fn physics(scene: &Value) -> PhysicsConfig {
    let radius = |k: usize| Size::from_level(level(&scene["sizes"][k])).unwrap().radius();
    let agent = |k: usize| {
        let strength = Strength::from_level(level(&scene["strengths"][k])).unwrap();
        AgentBody { radius: radius(k), max_force: strength.max_force() }
    };
    PhysicsConfig {
        walls: Layout::new(level(&scene["base"]), None).unwrap().walls(),
        agents: [agent(0), agent(1)],
        object_radii: [radius(2), radius(3)],
        object_count: 2,
    }
}

fn state(it: &Value) -> State {
    let body = |k: usize| {
        let number = |n: usize| it["bodies"][k][n].as_f64().unwrap() as f32;
        let (position, velocity) = (Vec2::new(number(0), number(1)), Vec2::new(number(3), number(4)));
        Body { position, velocity, angle: number(2), angular_velocity: number(5) }
    };
    let mut state = State::new([body(0), body(1), body(2), body(3)]);
    for agent in AgentId::ALL {
        // A spring asks neither for the side nor for the angle.
        state.grips[agent] = it["grips"][agent.index()].as_u64().map(|object| Grip {
            object: if object == 0 { ObjectId::ZERO } else { ObjectId::ONE },
            side: Side::Head,
            relative_angle: 0.0,
        });
    }
    state
}

#[test]
fn imagined_steps_are_those_of_box2d() {
    let file: Value = serde_json::from_str(include_str!("steps.json")).unwrap();
    let (mut steps, mut touching) = (0, 0);
    for (number, case) in file["cases"].as_array().unwrap().iter().enumerate() {
        let imagined = Imagined::new(&physics(&case["scene"]));
        let mut before = state(case);
        for step in case["steps"].as_array().unwrap() {
            let action = |k: usize| NAMES.iter().position(|name| step["actions"][k] == **name).unwrap();
            let mut after = before;
            imagined.step(&mut after, [Action::ALL[action(0)], Action::ALL[action(1)]]);
            let known = state(step);
            assert_eq!(after.bodies, known.bodies, "case {number}, {}", step["actions"]);
            let held = |state: &State| state.grips.map(|grip| grip.map(|grip| grip.object));
            assert_eq!(held(&after), held(&known), "case {number}");
            touching += usize::from(after.touching(Entity::ALL[0], Entity::ALL[1]));
            (before, steps) = (known, steps + 1);
        }
    }
    assert_eq!(steps, 160);
    assert!(touching > 10, "{touching}");
}
