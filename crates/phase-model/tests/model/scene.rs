//! Scenes that are rejected, and relations as they follow from goals and attitudes.

use phase_model::{
    AgentId, AgentSpec, Attitude, Body, EventKind, Flip, Goal, LandmarkId, Layout, ObjectId, ObjectSpec,
    Relation, Scene, SceneError, Sign, Size, Strength, Vec2,
};

const ON_0: Goal =
    Goal::AgentOnLandmark { agent: AgentId::ONE, landmark: LandmarkId::TOP_LEFT, sign: Sign::Positive };

fn object_on(object: u8, landmark: u8) -> Goal {
    Goal::ObjectOnLandmark {
        object: ObjectId::ALL[usize::from(object)],
        landmark: LandmarkId::ALL[usize::from(landmark)],
        sign: Sign::Positive,
    }
}

fn scene() -> Scene {
    let agent = |x: f32, goal| AgentSpec {
        size: Size::Small,
        strength: Strength::Fair,
        goal,
        attitude: Attitude::Neutral,
        awareness: phase_model::Awareness::default(),
        start: Body::at_rest(Vec2::new(x, 8.0), 0.0),
    };
    Scene {
        layout: Layout::new(0, None).expect("layout 0"),
        agents: [agent(8.0, object_on(0, 2)), agent(24.0, ON_0)],
        objects: vec![ObjectSpec { size: Size::Small, start: Body::at_rest(Vec2::new(16.0, 18.0), 0.0) }],
        kind: EventKind::Independent,
    }
}

/// A change to a valid scene, and the expected content of the error message.
type Fault = (fn(&mut Scene), &'static str);

#[test]
fn faults_are_named() {
    assert_eq!(scene().validate(), Ok(()));
    assert_eq!(scene().validate_without_overlap(), Ok(()));
    let faults: [Fault; 11] = [
        (
            |s| s.agents[1].start.angle = -2e5,
            "agents[1].start.angle must be -100000 to 100000 rad, not -200000",
        ),
        (|s| s.agents[0].start.position.x = f32::NAN, "agents[0].start must hold finite numbers"),
        (
            |s| s.objects[0].start.velocity = Vec2::new(100.0, 100.0),
            "objects[0].start must not be faster than 120 u/s and 94.2 rad/s, not 141.42136 u/s and 0 rad/s",
        ),
        (
            |s| s.agents[0].start.angular_velocity = -100.0,
            "agents[0].start must not be faster than 120 u/s and 94.2 rad/s, not 0 u/s and -100 rad/s",
        ),
        (|s| s.objects[0].start.angle = f32::INFINITY, "objects[0].start must hold finite numbers"),
        (|s| s.agents[1].start.position.y = 22.5, "agents[1].start must lie inside the arena"),
        (|s| s.agents[0].goal = object_on(1, 2), "agents[0].goal refers to object 1"),
        (
            |s| {
                s.agents[1].goal =
                    Goal::Touch { agent: AgentId::ONE, other: AgentId::ONE, sign: Sign::Positive }
            },
            "cannot touch itself",
        ),
        (|s| s.objects = vec![s.objects[0]; 3], "objects must number 0 to 2, not 3"),
        (|s| s.agents.iter_mut().for_each(|agent| agent.attitude = Attitude::Help), "at most one agent"),
        (
            |s| s.agents[0].attitude = Attitude::Hinder,
            "must be the other agent's goal with the opposite sign",
        ),
    ];
    for (change, complaint) in faults {
        let mut scene = scene();
        change(&mut scene);
        let error = scene.validate().expect_err(complaint).to_string();
        assert!(error.contains(complaint), "{error} / {complaint}");
    }
}

#[test]
fn overlaps_are_refused_only_where_asked() {
    let mut scene = scene();
    scene.agents[1].start.position = Vec2::new(9.0, 8.0);
    assert_eq!(scene.validate(), Ok(()));
    assert!(matches!(scene.validate_without_overlap(), Err(SceneError::Overlap { .. })));
    scene.agents[1].start.position = Vec2::new(25.5, 8.0);
    assert!(matches!(scene.validate_without_overlap(), Err(SceneError::Overlap { .. })));
}

#[test]
fn relations_follow_the_papers_definitions() {
    use Attitude::{Help, Hinder, Neutral};
    let chase = Goal::Touch { agent: AgentId::ZERO, other: AgentId::ONE, sign: Sign::Positive };
    let own = |landmark| Goal::AgentOnLandmark { agent: AgentId::ZERO, landmark, sign: Sign::Positive };
    let cases = [
        ([ON_0, ON_0], [Help, Neutral], Relation::Friendly),
        ([ON_0.negated(), ON_0], [Hinder, Neutral], Relation::Adversarial),
        ([object_on(0, 1), object_on(0, 1)], [Neutral; 2], Relation::Friendly),
        ([object_on(0, 1), object_on(0, 2)], [Neutral; 2], Relation::Adversarial),
        ([object_on(0, 1), object_on(1, 1)], [Neutral; 2], Relation::Neutral),
        ([chase, chase.negated()], [Neutral; 2], Relation::Adversarial),
        ([own(LandmarkId::TOP_LEFT), ON_0], [Neutral; 2], Relation::Neutral),
    ];
    for (goals, attitudes, relation) in cases {
        assert_eq!(Relation::of(goals, attitudes), relation, "{goals:?} {attitudes:?}");
    }
}

#[test]
fn goals_are_written_as_the_recordings_write_them() {
    let json = serde_json::to_string(&object_on(0, 2).negated()).expect("plain data");
    assert_eq!(json, r#"{"kind":"object_on_landmark","object":0,"landmark":2,"sign":-1}"#);
    assert!(serde_json::from_str::<Goal>(&json.replace("-1", "0")).is_err());
}

#[test]
fn a_mirror_turns_everything_over() {
    let scene = scene();
    let mirrored = scene.mirrored(Flip::LeftRight).expect("layout 0 is no reflection");
    // Reflection about x = 16; landmarks 0 and 1, 2 and 3 swap; left turns become right turns.
    let positions = [mirrored.agents[0].start, mirrored.agents[1].start, mirrored.objects[0].start];
    assert_eq!(positions.map(|body| body.position.x), [24.0, 8.0, 16.0]);
    assert_eq!(positions.map(|body| body.position.y), [8.0, 8.0, 18.0]);
    assert_eq!(
        mirrored.goals(),
        [
            object_on(0, 3),
            Goal::AgentOnLandmark {
                agent: AgentId::ONE,
                landmark: LandmarkId::TOP_RIGHT,
                sign: Sign::Positive
            }
        ]
    );
    assert_eq!(mirrored.layout.flip(), Some(Flip::LeftRight));
    assert_eq!(mirrored.mirrored(Flip::LeftRight), None);
    for flip in Flip::ALL {
        let mirrored = scene.mirrored(flip).expect("layout 0 is no reflection");
        for (mirrored, agent) in mirrored.agents.iter().zip(&scene.agents) {
            let body = agent.start;
            let image = mirrored.start;
            assert!(image.forward().distance(flip.vector(body.forward())) < 1e-6, "{flip:?}");
            assert!(flip.point(image.position).distance(body.position) < 1e-5, "{flip:?}");
        }
    }
}
