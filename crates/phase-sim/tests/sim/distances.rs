//! Distances to go, by hand.

use phase_model::{AgentId, Entity, ObjectId, Scene, State, Vec2, arena};
use phase_sim::{Distances, Engine, Episode};
use serde_json::{Value, json};

/// Agent 0, at (8.5, 8), helps or hinders agent 1, at (23.5, 8), whose goal is given.
fn scene(base: u8, alpha: i8, goal: &Value) -> Scene {
    let agent = |alpha: i8, x: f32| {
        json!({ "size_level": 0, "strength_level": 2, "alpha": alpha, "goal": goal,
        "start": { "x": x, "y": 8, "angle": 0 } })
    };
    let object = json!({ "size_level": 0, "start": { "x": 8.5, "y": 13.5, "angle": 0 } });
    let scene = json!({ "layout": { "base": base }, "objects": [object], "event": "independent",
        "agents": [agent(alpha, 8.5), agent(0, 23.5)] });
    Scene::from_json(&scene.to_string()).expect("the scene is valid")
}

fn start(scene: &Scene) -> State {
    *Episode::new(scene, Engine::World).state()
}

#[test]
fn distances_are_straight_in_an_open_arena() {
    let on = json!({ "kind": "agent_on_landmark", "agent": 1, "landmark": 1, "sign": 1 });
    let open = scene(0, 1, &on);
    let [own, other] = Distances::new(&open).goals(&start(&open));
    assert_eq!(own, other);
    assert!(
        (own - Vec2::new(23.5, 8.0).distance(arena::LANDMARKS[open.goals()[0].landmark().unwrap()])).abs()
            < 1e-3
    );
    assert_eq!(Distances::new(&open).approaches(&start(&open)), [0.0; 2], "there is no object to fetch");

    let carry = json!({ "kind": "object_on_landmark", "object": 0, "landmark": 0, "sign": 1 });
    let open = scene(0, 1, &carry);
    let mut distances = Distances::new(&open);
    assert!((distances.goals(&start(&open))[0] - 6.0).abs() < 1e-3);
    let [helper, helped] = distances.approaches(&start(&open));
    assert!((helper - (5.5 - 1.6)).abs() < 1e-3, "less both radii: {helper}");
    assert!((helped - (15.0_f32.hypot(5.5) - 1.6)).abs() < 1e-3, "{helped}");

    let flee = json!({ "kind": "touch", "agent": 1, "other": 0, "sign": -1 });
    let open = scene(0, 0, &flee);
    assert!((Distances::new(&open).goals(&start(&open))[1] + 15.0 - 1.6).abs() < 1e-3, "away is better");
}

/// In every layout the way is at least as long as the straight line, and in some longer; it ends at 0.
#[test]
fn ways_lead_around_walls() {
    let mut longer = 0;
    for base in 0..22 {
        let carry = json!({ "kind": "object_on_landmark", "object": 0, "landmark": 2, "sign": 1 });
        let scene = scene(base, 0, &carry);
        let mut distances = Distances::new(&scene);
        let mut state = start(&scene);
        let straight = scene.goals()[0].distance(&state);
        let [way, _] = distances.goals(&state);
        assert!(way >= straight - 1e-3, "{way} u, straight {straight} u");
        longer += usize::from(way > straight + 0.1);
        state.body_mut(Entity::Object(ObjectId::ZERO)).position =
            arena::LANDMARKS[scene.goals()[0].landmark().unwrap()];
        assert!(distances.goals(&state)[0] < 1e-3);
        state.body_mut(Entity::Agent(AgentId::ZERO)).position =
            state.position(Entity::Object(ObjectId::ZERO));
        assert_eq!(distances.approaches(&state)[0], 0.0, "at least 0");
    }
    assert!(longer > 5, "{longer}");
}
