//! Suspicious scenes cause warnings; ordinary ones do not.

use core::f32::consts::{FRAC_PI_2, PI};
use phase_model::{
    AgentSpec, Attitude, Body, EventKind, Goal, LandmarkId, Layout, ObjectId, ObjectSpec, Scene, SceneError,
    SceneWarning, Sign, Size, Strength, Vec2, arena,
};

/// Two small agents that both want object 0, of radius 0.8, on landmark 1, all far from each other and from
/// walls.
fn scene() -> Scene {
    let goal = Goal::ObjectOnLandmark {
        object: ObjectId::ZERO,
        landmark: LandmarkId::TOP_RIGHT,
        sign: Sign::Positive,
    };
    let agent = |x| AgentSpec {
        size: Size::Small,
        strength: Strength::Strong,
        goal,
        attitude: Attitude::Neutral,
        awareness: phase_model::Awareness::default(),
        start: Body::at_rest(Vec2::new(x, 14.0), 0.0),
    };
    Scene {
        layout: Layout::new(0, None).expect("a layout"),
        agents: [agent(10.0), agent(22.0)],
        objects: vec![ObjectSpec { size: Size::Small, start: Body::at_rest(Vec2::new(16.0, 5.0), 0.0) }],
        kind: EventKind::Collaborating,
    }
}

/// The only warning of a scene, in words.
fn warning(scene: &Scene) -> String {
    let warnings = scene.warnings();
    assert_eq!(warnings.len(), 1, "{warnings:?}");
    warnings[0].to_string()
}

#[test]
fn a_scene_that_makes_sense_gives_no_warning() {
    assert_eq!(scene().warnings(), []);
}

#[test]
fn overlapping_bodies_are_named_with_their_depth() {
    let mut crowded = scene();
    // The agent's right side at mid-height is 0.8 u from its origin and slants; its front, 0.8 u before the
    // origin, does not.
    crowded.objects[0].start.position = Vec2::new(10.0, 14.0 + 0.8 + 0.8 - 0.25);
    let text = warning(&crowded);
    assert_eq!(text, "agents[0].start and objects[0].start: the bodies overlap by 0.25 u");
    crowded.objects[0].start.position.y += 0.26;
    assert_eq!(crowded.warnings(), [], "apart by 0.01 u");

    let mut crowded = scene();
    // Back to back, half a turn apart: both backs are 0.8 u from the origin.
    crowded.agents[1].start = Body::at_rest(Vec2::new(10.0, 14.0 - 1.6 + 0.1), PI);
    assert_eq!(warning(&crowded), "agents[0].start and agents[1].start: the bodies overlap by 0.10 u");
}

/// The depth is the minimum translation: after that distance the bodies are apart, after slightly less they
/// are not.
#[test]
fn the_depth_of_discs_is_the_way_out() {
    let mut crowded = scene();
    let other = ObjectSpec { size: Size::Medium, start: Body::at_rest(Vec2::new(16.5, 5.5), 0.0) };
    crowded.objects.push(other);
    let [SceneWarning::Overlap { depth, .. }] = crowded.warnings()[..] else { panic!("an overlap") };
    let away = (other.start.position - crowded.objects[0].start.position).normalize();
    for (share, apart) in [(0.9, false), (1.001, true)] {
        let mut moved = crowded.clone();
        moved.objects[1].start.position += away * depth * share;
        assert_eq!(moved.warnings().is_empty(), apart, "moved by {share} of {depth}");
        assert_eq!(moved.validate_without_overlap().is_ok(), apart);
    }
}

#[test]
fn bodies_across_walls_and_the_boundary_are_named() {
    let mut across = scene();
    // Layout 6 has a wall from the centre up to the boundary, along x = 16.
    across.layout = Layout::new(6, None).expect("a layout");
    across.objects[0].start.position = Vec2::new(16.5, 18.0);
    assert_eq!(warning(&across), "objects[0].start: the body stands across a wall by 0.30 u");
    across.objects[0].start.position = Vec2::new(arena::MAX.x - 0.3, 18.0);
    assert_eq!(warning(&across), "objects[0].start: the body stands across a wall by 0.50 u");
    across.objects[0].start.position = Vec2::new(20.0, 18.0);
    // An agent's back, across its heading, is 2.4 u wide; turned by a right angle it spans y 12.8 to 15.2.
    across.agents[0].start = Body::at_rest(Vec2::new(16.0 + 0.8 - 0.2, 14.0), -FRAC_PI_2);
    assert_eq!(warning(&across), "agents[0].start: the body stands across a wall by 0.20 u");
}

#[test]
fn degrees_are_noticed_and_turns_are_not() {
    let mut turned = scene();
    turned.agents[1].start.angle = 2.5 * PI;
    assert_eq!(turned.warnings(), [], "more than one turn, as some published recordings begin");
    turned.agents[1].start.angle = -90.0;
    let text = "agents[1].start: the angle -90 is in radians; -90 degrees are -1.5708 rad";
    assert_eq!(warning(&turned), text);
}

#[test]
fn a_kind_that_is_not_made_by_goals_and_attitudes_is_named() {
    let mut scene = scene();
    scene.kind = EventKind::Chasing;
    assert_eq!(warning(&scene), "event is \"chasing\", but goals and attitudes make it \"collaborating\"");
    assert_eq!(scene.check_kind(), Ok(()), "odd, but no contradiction");
}

#[test]
fn nobody_who_helps_or_hinders_is_an_error_of_readers() {
    for (kind, alpha) in [(EventKind::Helping, 1), (EventKind::Hindering, -1)] {
        let scene = Scene { kind, ..scene() };
        assert_eq!(scene.check_kind(), Err(SceneError::NobodySocial { kind, alpha }));
        let error = Scene::from_json(&scene.to_json().expect("finite")).expect_err("nobody social");
        let text = format!("event is {:?}, but no agent has the attitude `alpha` {alpha}", kind.name());
        assert_eq!(error.to_string(), text);
    }
}
