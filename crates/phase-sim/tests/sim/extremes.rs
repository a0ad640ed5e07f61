//! Events can be written and read again, from any valid start, whatever its speeds.

use phase_event::{Event, Recording, from_json, to_json};
use phase_model::{
    AGENT_COUNT, Action, Body, EventKind, Scene, Vec2,
    physics::{MAX_ANGLE, MAX_SPEED},
    random::{Purpose, stream},
};
use phase_sim::{Engine, Simulation, SimulationSettings, replay};
use proptest::prelude::*;

/// Steps of an event.
const STEPS: usize = 4;

/// Places at the boundary, where bodies are pressed out, and anywhere else.
fn place() -> impl Strategy<Value = Vec2> {
    let side = |low: f32, high: f32| prop_oneof![Just(low), Just(high), low..=high];
    (side(6.0, 26.0), side(2.0, 22.0)).prop_map(|(x, y)| Vec2::new(x, y))
}

/// Ordinary numbers, and those up to what engines move, of two components together.
fn speed() -> impl Strategy<Value = f32> {
    let most = MAX_SPEED * core::f32::consts::FRAC_1_SQRT_2;
    prop_oneof![-20.0..20.0f32, -most..=most, Just(most), Just(-most)]
}

fn body() -> impl Strategy<Value = Body> {
    (place(), speed(), speed(), prop_oneof![-7.0..7.0f32, -MAX_ANGLE..=MAX_ANGLE], speed()).prop_map(
        |(position, x, y, angle, angular_velocity)| Body {
            position,
            velocity: Vec2::new(x, y),
            angle,
            angular_velocity,
        },
    )
}

fn action() -> impl Strategy<Value = Action> {
    prop::sample::select(Action::ALL.to_vec())
}

fn scene(seed: u64, starts: &[Body; 4]) -> Scene {
    let kind = EventKind::ALL[seed as usize % EventKind::ALL.len()];
    let mut scene = phase_sampler::sample_kind(kind, &mut stream(seed, Purpose::Scene, 0))
        .expect("a scene of every kind");
    for (agent, start) in scene.agents.iter_mut().zip(starts) {
        agent.start = *start;
    }
    for (object, start) in scene.objects.iter_mut().zip(&starts[AGENT_COUNT..]) {
        object.start = *start;
    }
    scene
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn every_event_that_is_written_is_read_back(
        seed in 0..1000u64,
        starts in [body(), body(), body(), body()],
        actions in prop::collection::vec([action(), action()], STEPS),
    ) {
        let scene = scene(seed, &starts);
        prop_assert!(scene.validate().is_ok());
        for engine in Engine::ALL {
            let settings = SimulationSettings { engine, ..SimulationSettings::default() };
            let without = [false; AGENT_COUNT];
            let mut simulation = Simulation::with_minds(&scene, seed, &settings, without).expect("a start");
            for &[a, b] in &actions {
                simulation.step([Some(a), Some(b)]).expect("no search");
            }
            let event = simulation.into_event();
            let copy = event.clone();
            let recording = Recording::of_event("extreme", copy, "test".into(), serde_json::Value::Null);
            let text = to_json(&[recording]).expect("finite numbers");
            let read = from_json(&text);
            prop_assert!(read.is_ok(), "{}: {}", engine.name(), read.expect_err("refused"));
            let read: Event = read.expect("read").remove(0).simulation.expect("simulated").event;
            prop_assert_eq!(&read, &event, "{}", engine.name());
            // And its motion follows from what was read.
            for (step, again) in read.steps.iter().zip(replay(&read, &settings)) {
                prop_assert_eq!(step.substeps, again, "{}", engine.name());
            }
        }
    }
}
