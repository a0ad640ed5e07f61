//! Whether a helper knows the other's goal, inferred from how it helps.

use core::ops::ControlFlow;
use phase_event::ObservedEvent;
use phase_model::{AgentId, Attitude, Awareness, Intent, Knowledge, Level, Scene};
use phase_simple::{Inference, Models, NeutralKnowledge, Simple};
use std::sync::Arc;

/// Agent 0 clears an object out of a door for agent 1, which wants to be behind it.
fn scene(knows: Knowledge) -> Scene {
    let scene = r#"{"layout": {"base": 4}, "event": "helping", "objects": [{"size_level": 2,
             "start": {"x": 7.6, "y": 10.1, "angle": 0}}], "agents": [
            {"size_level": 0, "strength_level": 3, "alpha": 1, "start": {"x": 13, "y": 8, "angle": 1.5708},
             "goal": {"kind": "agent_on_landmark", "agent": 1, "landmark": 0, "sign": 1}},
            {"size_level": 0, "strength_level": 0, "alpha": 0, "start": {"x": 14, "y": 4, "angle": 0},
             "goal": {"kind": "agent_on_landmark", "agent": 1, "landmark": 0, "sign": 1}}]}"#;
    let mut scene = Scene::from_json(scene).expect("a scene");
    scene.agents.iter_mut().for_each(|agent| agent.awareness = Awareness { knows, ..Awareness::default() });
    scene
}

/// An event of a scene, as a method sees it.
fn observed(scene: &Scene) -> ObservedEvent {
    let mut settings = phase_sim::SimulationSettings::default();
    (settings.min_steps, settings.max_steps) = (60, 60);
    let event = phase_sim::simulate(scene, 1, &settings).expect("an event");
    let rows = core::iter::once(event.initial.bodies)
        .chain(event.steps.iter().map(|step| phase_event::mean_state(step).bodies));
    ObservedEvent::in_scene(scene, rows.collect()).expect("observed")
}

fn infer(method: &str, scene: &Scene) -> Inference {
    let observed = observed(scene);
    let simple = Simple::named(method, &Arc::new(Models::bundled().expect("models"))).expect("a variant");
    let prepared = simple.prepare(&observed, 1);
    let inferred = simple.infer(&prepared, 1, &mut || ControlFlow::Continue(()));
    inferred.expect("sound").expect("not cancelled")
}

#[test]
fn how_an_agent_helps_tells_whether_it_knows_what_the_other_wants() {
    let knows = |knowledge: Knowledge| {
        let scene = scene(knowledge);
        let inference = infer("simple-knowledge", &scene);
        let [helper, _] = inference.knowledge.expect("knowledge is latent");
        assert!(helper.social > 0.5, "{knowledge:?}: {}", helper.social);
        assert!((helper.knows + helper.levels.iter().sum::<f64>() - 1.0).abs() < 1e-9, "{helper:?}");
        assert!((helper.believed.values().sum::<f64>() - 1.0).abs() < 1e-9, "{helper:?}");
        let wanted = Intent { attitude: Attitude::Neutral, goal: scene.agents[AgentId::ONE].goal };
        assert!(helper.believed[&wanted] > 0.5, "{knowledge:?}: {helper:?}");
        helper.knows
    };
    let (knowing, finding_out) = (knows(Knowledge::Goals), knows(Knowledge::Nothing(Level::One)));
    assert!(knowing > 0.5 && finding_out < 0.5, "{knowing} {finding_out}");
    // The method that assumes knowledge has nothing to say of it.
    assert_eq!(infer("simple", &scene(Knowledge::Goals)).knowledge, None);
}

#[test]
fn what_neutral_agents_know_matters_for_their_beliefs_alone() {
    let scene = scene(Knowledge::Nothing(Level::One));
    let models = Arc::new(Models::bundled().expect("models"));
    let evidence = |method: &str| {
        let simple = Simple::named(method, &models).expect("a variant");
        let found =
            simple.intent_belief_evidence(&observed(&scene), &[4, 32], 1, &mut || ControlFlow::Continue(()));
        found.expect("sound").expect("not cancelled").0
    };
    let latent = evidence("simple-knowledge");
    let believed = |knows, level_zero| latent.intents(&NeutralKnowledge { knows, level_zero });
    let all = [believed(1.0, 0.0), believed(0.0, 0.0), believed(0.0, 1.0)];
    for of in all.iter().flatten().flatten() {
        assert!((of.values().sum::<f64>() - 1.0).abs() < 1e-9, "{of:?}");
    }
    // The helper is not neutral in nearly all explanations; who is helped is, and supposes what it sees.
    let helped = all.each_ref().map(|it| it[1][AgentId::ONE].clone());
    assert!(helped[0] != helped[1] && helped[1] != helped[2], "{helped:?}");
    let wanted = Intent { attitude: Attitude::Help, goal: scene.agents[AgentId::ONE].goal };
    assert!(helped[0][&wanted] > 0.5 && helped[0][&wanted] > helped[2][&wanted], "{helped:?}");
    // The method that assumes knowledge has nothing to average.
    let assumed = evidence("simple");
    let priors = [0.0, 1.0].map(|knows| NeutralKnowledge { knows, level_zero: 0.5 });
    assert_eq!(assumed.intents(&priors[0]), assumed.intents(&priors[1]));
}
