//! Synthetic scenes, events and files.

use phase_event::{ActionEvaluation, Event, Step, SubgoalValue, Thought};
use phase_model::{
    Action, AgentId, AgentSpec, Attitude, Body, Entity, EventKind, Flip, Goal, Grip, LandmarkId, Layout,
    Literal, ObjectId, ObjectSpec, Predicate, Scene, Side, Sign, Size, State, Strength, Subgoal, Vec2,
};
use serde_json::{Value, json};

/// A scene in which agent 0 helps agent 1 to put object 0 on landmark 1.
pub(crate) fn scene() -> Scene {
    let goal = Goal::ObjectOnLandmark {
        object: ObjectId::ZERO,
        landmark: LandmarkId::TOP_RIGHT,
        sign: Sign::Positive,
    };
    let agent = |attitude, x, angle| AgentSpec {
        size: Size::Medium,
        strength: Strength::Strong,
        goal,
        attitude,
        awareness: phase_model::Awareness::default(),
        start: Body::at_rest(Vec2::new(x, 14.0), angle),
    };
    let object = |size, y| ObjectSpec { size, start: Body::at_rest(Vec2::new(18.0, y), 0.0) };
    Scene {
        layout: Layout::new(20, Some(Flip::AntiDiagonal)).expect("a layout"),
        agents: [agent(Attitude::Help, 8.0, 0.5), agent(Attitude::Neutral, 24.0, -2.0)],
        objects: vec![object(Size::Small, 4.0), object(Size::Huge, 8.0)],
        kind: EventKind::Helping,
    }
}

/// An event of `steps` steps in which everything that a file contains changes at some point. `number`
/// generates its numbers.
pub(crate) fn event(steps: usize, mut number: impl FnMut() -> f32) -> Event {
    let scene = scene();
    let initial = scene.initial_state();
    let mut state = initial;
    let mut recorded = Vec::new();
    for t in 0..steps {
        let substeps = core::array::from_fn(|k| {
            advance(&mut state, &mut number);
            if (t, k) == (1, 2) {
                let relative_angle = number();
                state.grips[1] = Some(Grip { object: ObjectId::ONE, side: Side::Tail, relative_angle });
            }
            if k == 3 {
                state.contacts.insert(Entity::Agent(AgentId::ZERO), Entity::Object(ObjectId::ALL[t % 2]));
            }
            state
        });
        let actions = [Action::ALL[t % 14], Action::ALL[(t + 5) % 14]];
        recorded.push(Step { actions, thoughts: [thought(t, &mut number), idle()], substeps });
    }
    Event { scene, seed: u64::MAX - 3, initial, steps: recorded }
}

/// An event whose numbers are pairwise distinct and mostly have long decimal representations.
pub(crate) fn plain_event(steps: usize) -> Event {
    let mut k = 0_u32;
    event(steps, || {
        k += 1;
        libm_free_noise(k)
    })
}

fn libm_free_noise(k: u32) -> f32 {
    (k.wrapping_mul(2_654_435_761) >> 8) as f32 / (1 << 24) as f32
}

/// All entities move; positions stay inside the arena.
fn advance(state: &mut State, number: &mut impl FnMut() -> f32) {
    for body in &mut state.bodies {
        body.position = Vec2::new(7.0 + 18.0 * number(), 3.0 + 18.0 * number());
        body.velocity = Vec2::new(60.0 * number() - 30.0, 60.0 * number() - 30.0);
        body.angle += 2.0 * number() - 1.0;
        body.angular_velocity = number();
    }
}

fn thought(t: usize, number: &mut impl FnMut() -> f32) -> Thought {
    let literal = if t.is_multiple_of(2) {
        Literal::is(Predicate::Attach(AgentId::ZERO, ObjectId::ONE))
    } else {
        Literal::not(Predicate::Touch(AgentId::ZERO, Entity::Agent(AgentId::ONE)))
    };
    let subgoal = Subgoal::Achieve(literal);
    let mut value = || f64::from(number()) / 3.0;
    Thought {
        subgoal,
        subgoals: vec![
            SubgoalValue { subgoal, value: value(), particles: 40 },
            SubgoalValue { subgoal: Subgoal::Stay, value: -value(), particles: 10 },
        ],
        plan: vec![
            subgoal,
            Subgoal::Achieve(Literal::is(Predicate::On(
                Entity::Object(ObjectId::ONE),
                LandmarkId::BOTTOM_LEFT,
            ))),
            Subgoal::Stay,
        ],
        intents: vec![],
        suspicion: t.is_multiple_of(2).then_some(0.25),
        actions: Action::ALL
            .into_iter()
            .map(|action| ActionEvaluation { action, visits: 71, value: value() })
            .collect(),
    }
}

fn idle() -> Thought {
    Thought::IDLE
}

/// A measured recording with every optional field.
pub(crate) fn file() -> Value {
    let row = |x: f64| json!([x, 14.0, 0.5, -0.25, 1.5]);
    let track = |x: f64| json!([row(x), row(x + 0.125), row(x + 0.25)]);
    json!({
        "format": "phase-events/1",
        "events": [{
            "id": "made-up-1",
            "layout": {"base": 4, "flip": 2},
            "walls": [[[16.0, 12.0], [26.0, 12.0]], [[16.0, 12.0], [16.0, 4.5]]],
            "landmarks": [[8.5, 19.5], [23.5, 19.5], [23.5, 4.5], [8.5, 4.5]],
            "agents": [
                {"radius": 0.8, "size_level": 0, "max_force": 450.0, "strength_level": 2,
                 "goal": {"kind": "object_on_landmark", "object": 0, "landmark": 2, "sign": 1}, "alpha": 1},
                {"radius": 1.01, "size_level": 3, "max_force": 150.0, "strength_level": 0,
                 "goal": {"kind": "object_on_landmark", "object": 0, "landmark": 2, "sign": 1}, "alpha": 0},
            ],
            "objects": [{"radius": 1.2, "size_level": 1}],
            "event": "helping",
            "relation": "friendly",
            "relation_human": "neutral",
            "step_seconds": 0.25,
            "row_0": "after 1/60 s",
            "recorded_steps": 100,
            "trajectory": {
                "columns": ["x", "y", "vx", "vy", "angle"],
                "agents": [track(8.0), track(12.0)],
                "objects": [track(20.0)],
            },
            "recovered_actions": {"steps": [["up", "noforce"], ["attach", "turnleft"]], "note": "to the end"},
        }],
    })
}
