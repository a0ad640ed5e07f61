//! A dataset of one event.

use phase_dataset::{
    form::StimulusForm,
    manifest::{DATASET_FORMAT, EventEntry, Manifest, event_path, video_path},
};
use phase_event::{Event, Step, SubgoalValue, Thought};
use phase_model::{
    Action, AgentId, AgentSpec, Attitude, Body, Entity, EventKind, Flip, Goal, LandmarkId, Layout, Literal,
    ObjectId, ObjectSpec, Predicate, Scene, Sign, Size, Strength, Subgoal, Vec2, arena::SUBSTEPS,
};
use serde_json::json;
use std::{fs, path::Path};

/// A scene in which agent 0 helps agent 1 to put object 0 on landmark 1.
fn scene() -> Scene {
    let goal = Goal::ObjectOnLandmark {
        object: ObjectId::ZERO,
        landmark: LandmarkId::TOP_RIGHT,
        sign: Sign::Positive,
    };
    let agent = |attitude, x| AgentSpec {
        size: Size::Medium,
        strength: Strength::Strong,
        goal,
        attitude,
        awareness: phase_model::Awareness::default(),
        start: Body::at_rest(Vec2::new(x, 14.0), 0.5),
    };
    let object = |size, y| ObjectSpec { size, start: Body::at_rest(Vec2::new(18.0, y), 0.0) };
    Scene {
        layout: Layout::new(20, Some(Flip::AntiDiagonal)).expect("a layout"),
        agents: [agent(Attitude::Help, 8.0), agent(Attitude::Neutral, 24.0)],
        objects: vec![object(Size::Small, 4.0), object(Size::Huge, 8.0)],
        kind: EventKind::Helping,
    }
}

/// An event in which nothing moves; agent 0 pursues two subgoals alternately with 40 of 50 particles, agent 1
/// none.
pub(crate) fn plain_event(steps: usize) -> Event {
    let scene = scene();
    let initial = scene.initial_state();
    let step = |t| Step {
        actions: [Action::Stop; 2],
        thoughts: [thought(t), Thought::IDLE],
        substeps: [initial; SUBSTEPS],
    };
    Event { steps: (0..steps).map(step).collect(), scene, seed: 7, initial }
}

fn thought(t: usize) -> Thought {
    let literal = if t.is_multiple_of(2) {
        Literal::is(Predicate::Attach(AgentId::ZERO, ObjectId::ONE))
    } else {
        Literal::not(Predicate::Touch(AgentId::ZERO, Entity::Agent(AgentId::ONE)))
    };
    let subgoal = Subgoal::Achieve(literal);
    let proposed = |subgoal, particles| SubgoalValue { subgoal, value: 1.0, particles };
    Thought {
        subgoal,
        subgoals: vec![proposed(subgoal, 40), proposed(Subgoal::Stay, 10)],
        plan: vec![subgoal],
        actions: vec![],
        intents: vec![],
        suspicion: None,
    }
}

/// A dataset of one event whose files hold a few bytes.
pub(crate) fn dataset(folder: &Path, id: &str) -> Manifest {
    for path in [event_path(id), video_path(id)] {
        fs::create_dir_all(folder.join(&path).parent().expect("a parent")).expect("a folder");
        fs::write(folder.join(&path), path.as_bytes()).expect("written");
    }
    Manifest {
        format: DATASET_FORMAT.into(),
        generator: "phase test".into(),
        preset: "demo".into(),
        seed: 1,
        date_published: None,
        settings: json!({"max_steps": 2}),
        form: StimulusForm::default(),
        selection: Vec::new(),
        sets: Vec::new(),
        events: vec![EventEntry::of(folder, id, &plain_event(2), true).expect("described")],
        files: vec![],
    }
}
