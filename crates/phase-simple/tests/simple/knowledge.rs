//! Knowledge and beliefs of agents about objects, inferred from where they go.

use core::ops::ControlFlow;
use phase_event::{BeliefOrder, BeliefReader, Event, ObservedEvent};
use phase_model::{AgentId, Scene};
use phase_simple::{KnowledgeSettings, Simple};

/// Agent 0 waits behind a wall while agent 1 carries the object to another room; then it goes for the object.
fn event(sees: &str) -> Event {
    let scene = format!(
        r#"{{"layout": {{"base": 16}}, "event": "competing", "objects": [{{"size_level": 0,
             "start": {{"x": 9, "y": 15.5, "angle": 0}}}}], "agents": [
            {{"size_level": 0, "strength_level": 2, "alpha": 0, "sees": "{sees}", "waits": 40,
             "start": {{"x": 14.5, "y": 10.3, "angle": -0.785}},
             "goal": {{"kind": "object_on_landmark", "object": 0, "landmark": 3, "sign": 1}}}},
            {{"size_level": 0, "strength_level": 3, "alpha": 0, "start": {{"x": 9, "y": 18, "angle": 3.1416}},
             "goal": {{"kind": "object_on_landmark", "object": 0, "landmark": 2, "sign": 1}}}}]}}"#
    );
    let scene = Scene::from_json(&scene).expect("a scene");
    let mut settings = phase_sim::SimulationSettings::default();
    (settings.min_steps, settings.max_steps) = (60, 60);
    phase_sim::simulate(&scene, 1, &settings).expect("an event")
}

#[test]
fn where_an_agent_looks_tells_what_it_knows() {
    let simple = Simple::bundled().expect("models");
    let share = |sees: &str| {
        let event = event(sees);
        let rows = core::iter::once(event.initial.bodies)
            .chain(event.steps.iter().map(|step| phase_event::mean_state(step).bodies));
        let observed = ObservedEvent::in_scene(&event.scene, rows.collect()).expect("observed");
        let mut tick = || ControlFlow::Continue(());
        let evidence = simple.belief_evidence(&observed, BeliefOrder::First, &[40], 1, &mut tick);
        let (evidence, _) = evidence.expect("an answer").expect("not cancelled");
        let deaf = KnowledgeSettings { inverse_temperature: 0.0 };
        assert!(evidence.knowledge(AgentId::ZERO, &deaf).iter().all(|it| (it - 1.0 / 3.0).abs() < 1e-9));
        let answer = simple.read_beliefs(&observed, BeliefOrder::First, &[40], 1, &mut tick);
        let (beliefs, details) = answer.expect("an answer").expect("not cancelled");
        let of = |sight: &str| details["sees"][0][sight].as_f64().expect("a probability");
        assert!((of("own") + of("start") + of("objects") - 1.0).abs() < 1e-9);
        // The object was in the upper left, and is in the lower right.
        assert_eq!(beliefs, evidence.beliefs(&KnowledgeSettings::default()));
        let places = beliefs[0][AgentId::ZERO][1];
        let second = simple.read_beliefs(&observed, BeliefOrder::Second, &[40], 1, &mut tick);
        let (ascribed, _) = second.expect("an answer").expect("not cancelled");
        // Agent 1, which moved the object, ascribes the same belief to agent 0.
        let ascribed = ascribed[0][AgentId::ONE][1];
        assert_eq!(ascribed[0] > ascribed[2], places[0] > places[2], "{sees}: {ascribed:?} {places:?}");
        (of("start"), of("objects"), places[0], places[2])
    };
    let (start, told, old, new) = share("start");
    assert!(start > told && old > new, "unaware: {start} {told} {old} {new}");
    let (start, told, old, new) = share("objects");
    assert!(told > start && new > old, "told: {start} {told} {old} {new}");
}
