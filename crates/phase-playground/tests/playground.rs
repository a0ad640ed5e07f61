//! Pages are given what the crates below give.

use core::ops::ControlFlow;
use phase_eval::goals::Answer;
use phase_event::{Recogniser, Recording, from_json, to_json};
use phase_model::{Action, AgentId, Scene};
use phase_perception::observe;
use phase_playground::{PageObserver, PageSimulation, PageTracker, Picture, packed, scenes};
use phase_render::{Overlay, Palette, SceneRenderer, Style};
use phase_sim::{SimulationSettings, simulate};
use phase_simple::Simple;
use serde_json::Value;

const OPTIONS: &str = r#"{"max_steps": 6, "minds": {"simulations": 30, "particles": 8}}"#;

fn settings() -> SimulationSettings {
    let mut settings = SimulationSettings { max_steps: 6, ..SimulationSettings::default() };
    settings.minds = settings.minds.with_simulations(30);
    settings.minds = settings.minds.with_particles(8);
    settings
}

fn scene() -> String {
    scenes::sample("hindering", None, 3).expect("a scene")
}

#[test]
fn a_show_is_the_event_that_is_simulated() {
    let mut show = PageSimulation::new(&scene(), 9, OPTIONS).unwrap();
    let mut shown = show.frames();
    while !show.is_over() {
        show.step([None, None]).unwrap();
        shown.extend(show.frames());
    }
    let model = Scene::from_json(&scene()).unwrap();
    let event = simulate(&model, 9, &settings()).unwrap();
    let mut expected = Vec::new();
    event.frames().for_each(|state| packed::push(state, &mut expected));
    assert_eq!(shown, expected);

    let value = serde_json::to_value(settings()).unwrap();
    let recording = Recording::of_event("it", event, "phase 0.1.0".into(), value);
    let text = to_json(&[recording]).unwrap();
    assert_eq!(show.document("it").unwrap(), text);
    let read = scenes::events(&text).unwrap();
    assert_eq!(read[0].frames, expected);
    assert!(read[0].labelled);

    let report: Value = serde_json::from_str(&show.report()).unwrap();
    assert_eq!(report["step"], 6);
    assert_eq!(report["over"], true);
    assert!(report["minds"][1]["subgoal"].is_string());
}

#[test]
fn actions_from_outside_are_carried_out() {
    let mut show = PageSimulation::new(&scene(), 9, OPTIONS).unwrap();
    show.step([Some(Action::TurnLeft), None]).unwrap();
    let report: Value = serde_json::from_str(&show.report()).unwrap();
    assert_eq!(report["actions"][0], "turnleft");
}

/// The picture with a mind is the frame that videos have of it.
#[test]
fn pictures_are_frames() {
    let mut show = PageSimulation::new(&scene(), 9, OPTIONS).unwrap();
    show.step([None, None]).unwrap();
    let frames = show.frames();
    let last = &frames[frames.len() - packed::STATE..];
    let state = packed::states(last).next().unwrap();
    let model = Scene::from_json(&scene()).unwrap();
    let style = Style { palette: Palette::ACCESSIBLE, ..Style::with_side(200) };
    let renderer = SceneRenderer::new(&model.physics(), style).unwrap();
    let mut picture = Picture::new(&scene(), 200, "accessible").unwrap();
    assert_eq!(picture.draw(last).unwrap(), renderer.frame(&state, None).rgba());
    for agent in AgentId::ALL {
        let observation = observe(&model.physics(), &state, agent);
        let belief = show.belief(agent);
        let particles: Vec<_> = packed::states(&belief).collect();
        let overlay =
            Overlay { agent, visible: &observation.visible, particles: &particles, title: "", captions: &[] };
        picture.show_mind(agent, &show.view(agent), &belief);
        assert_eq!(picture.draw(last).unwrap(), renderer.frame(&state, Some(&overlay)).rgba());
    }
    picture.hide_mind();
    assert_eq!(picture.draw(last).unwrap(), renderer.frame(&state, None).rgba());
}

/// Once with the time that it takes, a page's observer says what `phase eval --method simple` says of the
/// file.
#[test]
fn the_posterior_of_a_page_is_that_of_the_program() {
    let mut show = PageSimulation::new(&scene(), 9, OPTIONS).unwrap();
    let mut observer = PageObserver::new(&scene(), &show.row(), usize::MAX).unwrap();
    let mut said = Value::Null;
    while !show.is_over() {
        show.step([None, None]).unwrap();
        said = serde_json::from_str(&observer.push(&show.row()).unwrap()).unwrap();
    }
    let file = from_json(&show.document("event").unwrap()).unwrap();
    let observed = file[0].observed().unwrap();
    let program = Simple::bundled().unwrap();
    let judged = program.judge(&observed, 0, &mut || ControlFlow::Continue(())).unwrap();
    let (judgement, _) = judged.expect("nobody breaks it off");
    let answer = serde_json::to_value(Answer::of(&judgement).unwrap()).unwrap();
    said.as_object_mut().unwrap().remove("words");
    assert_eq!(said, answer);
}

#[test]
fn what_is_watched_is_answered() {
    let mut show = PageSimulation::new(&scene(), 9, OPTIONS).unwrap();
    let mut observer = PageObserver::new(&scene(), &show.row(), 4).unwrap();
    show.step([None, None]).unwrap();
    let answer: Value = serde_json::from_str(&observer.push(&show.row()).unwrap()).unwrap();
    let relation = answer["relation"].as_object().unwrap();
    let total: f64 = relation.values().map(|p| p.as_f64().unwrap()).sum();
    assert!((total - 1.0).abs() < 1e-9, "{total}");
    assert_eq!(answer["words"][0].as_array().unwrap().len(), 4);
    assert!(observer.push(&[f32::NAN; packed::STATE]).is_err());
    assert!(observer.push(&[]).is_err());
}

#[test]
fn scenes_are_described_and_rubbish_is_refused() {
    let description: Value = serde_json::from_str(&scenes::describe(&scene()).unwrap()).unwrap();
    assert_eq!(description["relation"], "adversarial");
    assert_eq!(description["landmarks"].as_array().unwrap().len(), 4);
    assert_eq!(description["overlap"], Value::Null);
    let mut wrong: Value = serde_json::from_str(&scene()).unwrap();
    wrong["agents"][0]["start"]["x"] = 400.into();
    assert!(scenes::describe(&wrong.to_string()).unwrap_err().contains("agents[0]"));
    wrong["agents"][0]["start"] = wrong["agents"][1]["start"].clone();
    let described: Value = serde_json::from_str(&scenes::describe(&wrong.to_string()).unwrap()).unwrap();
    assert!(described["overlap"].as_str().unwrap().contains("agents[1]"));
    for rubbish in ["", "{}", "[]", "null", "{\"layout\": 3}"] {
        assert!(scenes::describe(rubbish).is_err());
        assert!(scenes::events(rubbish).is_err());
        assert!(PageSimulation::new(rubbish, 0, "{}").is_err());
    }
    for options in ["", "[]", r#"{"speed": 3}"#, r#"{"minds": {"simulations": 0}}"#, r#"{"minds": 3}"#] {
        assert!(PageSimulation::new(&scene(), 0, options).is_err(), "{options}");
    }
    assert!(scenes::sample("helping", Some("chase"), 1).is_err());
    assert!(scenes::sample("flying", None, 1).is_err());
}

/// Every goal that a page offers makes a valid scene, and has other words than the others.
#[test]
fn goals_on_offer_are_goals() {
    let offered: Vec<Value> = serde_json::from_str(&scenes::goals(AgentId::ZERO, 2)).unwrap();
    let mut words: Vec<&str> = offered.iter().map(|it| it["words"].as_str().unwrap()).collect();
    assert_eq!(words.len(), 34);
    words.sort_unstable();
    words.dedup();
    assert_eq!(words.len(), 34);
    let mut scene: Value = serde_json::from_str(&scene()).unwrap();
    // Whoever helps or hinders has the other's goal.
    (0..2).for_each(|agent| scene["agents"][agent]["alpha"] = 0.into());
    scene["event"] = "independent".into();
    let objects = scene["objects"].as_array().unwrap().len() as u64;
    for choice in &offered {
        if choice["goal"]["object"].as_u64().is_some_and(|object| object >= objects) {
            continue;
        }
        scene["agents"][0]["goal"] = choice["goal"].clone();
        scenes::describe(&scene.to_string()).unwrap();
    }
}

/// A video that is drawn here is read in one pass, and its document opens as an event without labels.
#[test]
fn a_video_becomes_an_event_without_labels() {
    let scene = Scene::from_json(&scene()).unwrap();
    let renderer = SceneRenderer::new(&scene.physics(), Style::default()).unwrap();
    let [width, height] = [renderer.width(), renderer.height()].map(|side| side as usize);
    let mut tracker = PageTracker::default();
    for frame in 0..12 {
        let mut state = scene.initial_state();
        state.bodies[0].position.y += 0.02 * frame as f32;
        let picture = renderer.frame(&state, None);
        tracker.push(width, height, picture.rgba(), f64::from(frame) / 20.0).unwrap();
    }
    let answer: Value = serde_json::from_str(&tracker.finish("a film").unwrap().unwrap()).unwrap();
    let document = answer["document"].as_str().unwrap();
    let events = scenes::events(document).unwrap();
    assert_eq!((events.len(), events[0].id.as_str(), events[0].labelled), (1, "a-film", false));
    let found = Scene::from_json(&events[0].scene).unwrap();
    assert_eq!(found.layout.walls(), scene.layout.walls());
    let bodies = answer["bodies"].as_array().unwrap();
    assert_eq!(bodies.len(), 2 + scene.objects.len());
    // Where the first agent is drawn at first.
    let drawn = renderer.pixel(scene.agents[0].start.position);
    let path = bodies.iter().map(|body| body["path"][0].as_array().unwrap());
    let off = path
        .map(|at| (at[0].as_f64().unwrap() as f32 - drawn.x).hypot(at[1].as_f64().unwrap() as f32 - drawn.y));
    assert!(off.fold(f32::INFINITY, f32::min) < 1.0);
    let mut observer = PageObserver::of_event(document, 0, 1).unwrap();
    let rows = &events[0].rows;
    assert!(observer.push(&rows[packed::STATE..]).unwrap().contains("\"relation\""));
    assert!(tracker.finish("again").is_err());
}

/// Shapes without an arena take two more passes.
#[test]
fn a_video_of_shapes_is_watched_three_times() {
    let picture = |frame: usize| -> Vec<u8> {
        let pixel = |k: usize| {
            let (x, y) = (k % 120, k / 120);
            let is_in =
                |left: usize, top: usize| (left..left + 14).contains(&x) && (top..top + 14).contains(&y);
            let colour = if is_in(10 + 2 * frame, 20) { [200, 40, 40] } else { [240; 3] };
            if is_in(80, 20 + frame) { [30, 60, 200, 255] } else { [colour[0], colour[1], colour[2], 255] }
        };
        (0..120 * 90).flat_map(pixel).collect()
    };
    let mut tracker = PageTracker::default();
    let mut passes = 0;
    let answer = loop {
        for frame in 0..20 {
            tracker.push(120, 90, &picture(frame), frame as f64 / 20.0).unwrap();
        }
        passes += 1;
        if let Some(answer) = tracker.finish("").unwrap() {
            break serde_json::from_str::<Value>(&answer).unwrap();
        }
    };
    assert_eq!(passes, 3);
    assert_eq!(answer["bodies"].as_array().unwrap().len(), 2);
    assert_eq!(answer["bodies"][0]["path"][10][0].as_f64().unwrap().round(), 37.0);
    assert!(answer["notes"].as_array().unwrap().len() >= 2);
    let mut blank = PageTracker::default();
    let error = loop {
        (0..10).try_for_each(|frame| blank.push(64, 64, &[255; 4 * 64 * 64], f64::from(frame))).unwrap();
        if let Err(error) = blank.finish("blank") {
            break error;
        }
    };
    assert!(error.contains("shows no arena") && error.contains("nothing moves"), "{error}");
}
