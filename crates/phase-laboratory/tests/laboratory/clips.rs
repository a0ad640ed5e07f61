//! Clips beside the events that they are of.

use phase_event::{Controller, Recording, Trajectory};
use phase_laboratory::clip::{Clip, ClipError, Cut, Start};
use phase_model::{
    AgentSpec, Attitude, Body, EventKind, Goal, LandmarkId, Layout, Relation, Scene, Sign, Size, Strength,
    Vec2, arena,
};
use proptest::prelude::*;

/// An agent that reaches its landmark in step 5 of 12 and leaves it again in step 9.
fn recording(steps: usize) -> Recording {
    let goal = |agent| Goal::AgentOnLandmark { agent, landmark: LandmarkId::TOP_RIGHT, sign: Sign::Positive };
    let target = arena::LANDMARKS[LandmarkId::TOP_RIGHT];
    let away = |t: usize| if (5..9).contains(&t) { 0.0 } else { 3.0 };
    let row = |x: f32, y: f32| [x, y, 0.0, 0.0, 0.0];
    let walker = (0..=steps).map(|t| row(target.x - away(t), target.y)).collect();
    let other = (0..=steps).map(|t| row(9.0 + 0.1 * t as f32, 9.0)).collect();
    let agent = |agent, start: [f32; 2]| AgentSpec {
        size: Size::Small,
        strength: Strength::Fair,
        goal: goal(agent),
        attitude: Attitude::Neutral,
        awareness: phase_model::Awareness::default(),
        start: Body::at_rest(Vec2::new(start[0], start[1]), 0.0),
    };
    let [zero, one] = phase_model::AgentId::ALL;
    Recording {
        id: "walk".into(),
        scene: Scene {
            layout: Layout::new(0, None).expect("a layout"),
            agents: [agent(zero, [target.x - 3.0, target.y]), agent(one, [9.0, 9.0])],
            objects: Vec::new(),
            kind: EventKind::Independent,
        },
        relation: Relation::Neutral,
        relation_human: None,
        row_0: None,
        recorded_steps: None,
        controllers: [Controller::Mind; 2],
        trajectory: Trajectory { agents: [walker, other], objects: Vec::new() },
        recovered_actions: None,
        tracking: None,
        seed: None,
        simulation: None,
    }
}

#[test]
fn a_clip_says_what_of_the_label_is_still_true() {
    let recording = recording(12);
    let reached = |first: usize, steps: usize| {
        let cut = Cut { steps, start: Start::Step(first) };
        let clip = Clip::of(&recording, cut, "clip".into()).expect("a clip");
        (clip.agents[0].event.reached, clip.agents[0].clip.reached, clip.agents[0].clip.steps)
    };
    // On the landmark from step 5 to step 8, but not at the end of the event.
    assert_eq!(reached(3, 4), (false, true, Some(2)));
    assert_eq!(reached(0, 4), (false, false, None));
    assert_eq!(reached(3, 8), (false, false, None));
}

#[test]
fn a_clip_is_an_event_that_reads_back() {
    let clip =
        Clip::of(&recording(12), Cut { steps: 6, start: Start::Middle }, "clip".into()).expect("a clip");
    assert_eq!((clip.window.first_step, clip.window.steps), (3, 6));
    let text = phase_event::to_json(core::slice::from_ref(&clip.recording)).expect("it can be written");
    let read = phase_event::from_json(&text).expect("it can be read");
    assert_eq!(read, [clip.recording]);
}

#[test]
fn what_does_not_fit_is_refused() {
    let event = recording(12);
    let cut = Cut { steps: 6, start: Start::Step(7) };
    let refused = Clip::of(&event, cut, "clip".into()).expect_err("too short");
    assert_eq!(refused.to_string(), "event walk lasts 3 s; a clip from 1.75 s to 3.25 s does not fit");
    for seconds in [0.0, 0.1, -1.0, f64::NAN, f64::INFINITY] {
        assert!(matches!(Cut::of_seconds(seconds, None), Err(ClipError::Seconds(_))), "{seconds}");
    }
}

proptest! {
    /// The rows of a clip are those of the event, and its frames lie between them: five for each step.
    #[test]
    fn rows_and_frames_are_those_of_the_event(first in 0_usize..12, length in 1_usize..12) {
        let event = recording(12);
        let cut = Cut { steps: length, start: Start::Step(first) };
        let Ok(clip) = Clip::of(&event, cut, "clip".into()) else {
            prop_assert!(first + length > 12);
            return Ok(());
        };
        for agent in 0..2 {
            let cut = &clip.recording.trajectory.agents[agent];
            prop_assert_eq!(&cut[..], &event.trajectory.agents[agent][first..=first + length]);
        }
        let frames: Vec<_> = clip.window.frames(&event).collect();
        prop_assert_eq!(frames.len(), 5 * length);
        for (k, frame) in frames.iter().step_by(5).enumerate() {
            prop_assert_eq!(frame.bodies[1].position.x, event.trajectory.agents[1][first + k][0]);
        }
    }
}
