//! Scenes as JSON, from any scene and back.

use phase_model::{
    AgentId, AgentSpec, Attitude, Awareness, Body, EventKind, Flip, Goal, Knowledge, LandmarkId, Layout,
    Level, ObjectId, ObjectSpec, Scene, Sight, Sign, Size, Strength, Vec2,
};
use proptest::prelude::*;

fn body() -> impl Strategy<Value = Body> {
    (6.0..26.0_f32, 2.0..22.0_f32, -9.0..9.0_f32, prop::array::uniform3(-5.0..5.0_f32)).prop_map(
        |(x, y, angle, [u, v, turn])| Body {
            position: Vec2::new(x, y),
            velocity: Vec2::new(u, v),
            angle,
            angular_velocity: turn,
        },
    )
}

fn size() -> impl Strategy<Value = Size> {
    prop::sample::select(&Size::ALL[..])
}

/// A goal of the agent: itself or one of two objects on a landmark, or not.
fn goal(agent: AgentId) -> impl Strategy<Value = Goal> {
    let subjects = prop::option::of(prop::sample::select(&ObjectId::ALL[..]));
    let signs = prop::sample::select(&[Sign::Positive, Sign::Negative][..]);
    (subjects, prop::sample::select(&LandmarkId::ALL[..]), signs).prop_map(move |(object, landmark, sign)| {
        match object {
            Some(object) => Goal::ObjectOnLandmark { object, landmark, sign },
            None => Goal::AgentOnLandmark { agent, landmark, sign },
        }
    })
}

fn awareness() -> impl Strategy<Value = Awareness> {
    let levels = prop::option::of(prop::sample::select(&Level::ALL[..]));
    let sees = prop::sample::select(&[Sight::Own, Sight::Start, Sight::Objects][..]);
    (levels, sees, 0..=phase_model::MOST_WAITING).prop_map(|(level, sees, waits)| Awareness {
        knows: level.map_or(Knowledge::Goals, Knowledge::Nothing),
        sees,
        waits,
    })
}

fn agent(id: AgentId) -> impl Strategy<Value = AgentSpec> {
    let strength = prop::sample::select(&Strength::ALL[..]);
    (size(), strength, goal(id), awareness(), body()).prop_map(|(size, strength, goal, awareness, start)| {
        AgentSpec { size, strength, goal, attitude: Attitude::Neutral, awareness, start }
    })
}

fn scene() -> impl Strategy<Value = Scene> {
    let flips = prop::option::of(prop::sample::select(&Flip::ALL[..]));
    let layouts = (0..22_u8, flips).prop_map(|(base, flip)| Layout::new(base, flip).expect("a layout"));
    let objects = prop::collection::vec((size(), body()), 2);
    (layouts, agent(AgentId::ZERO), agent(AgentId::ONE), objects).prop_map(|(layout, one, other, objects)| {
        let objects = objects.into_iter().map(|(size, start)| ObjectSpec { size, start }).collect();
        Scene { layout, agents: [one, other], objects, kind: EventKind::Independent }
    })
}

proptest! {
    #[test]
    fn a_scene_comes_back_bit_for_bit(scene in scene()) {
        let text = scene.to_json().expect("finite");
        prop_assert_eq!(Scene::from_json(&text).expect("as written"), scene);
    }

    /// A scene of which something is missing is refused, and the sentence names it.
    #[test]
    fn a_missing_member_is_named(scene in scene(), place in any::<prop::sample::Index>()) {
        let text = scene.to_json().expect("finite");
        let mut value: serde_json::Value = serde_json::from_str(&text).expect("JSON");
        let members = value.as_object_mut().expect("an object");
        let name = members.keys().nth(place.index(members.len())).expect("a member").clone();
        members.remove(&name);
        if let Err(error) = Scene::from_json(&value.to_string()) {
            prop_assert!(error.to_string().contains(&name), "{}: {}", name, error);
        }
    }
}

/// A scene of the paper's world, whose agents may have further members.
fn with_members(members: &str) -> Result<Scene, String> {
    let agent = |k: u8, members: &str| {
        format!(
            r#"{{"size_level": 0, "strength_level": 2, "alpha": 0, "start": {{"x": {x}, "y": 14}} {members},
            "goal": {{"kind": "agent_on_landmark", "agent": {k}, "landmark": 1, "sign": 1}}}}"#,
            x = 9 + 10 * k
        )
    };
    let text = format!(
        r#"{{"layout": {{"base": 0}}, "objects": [], "event": "independent", "agents": [{}, {}]}}"#,
        agent(0, members),
        agent(1, "")
    );
    Scene::from_json(&text).map_err(|error| error.to_string())
}

#[test]
fn what_agents_know_is_read_and_its_default_is_not_written() {
    let paper = with_members("").expect("a scene");
    assert_eq!(paper.agents[0].awareness, Awareness::default());
    for member in ["knows", "level", "sees", "waits"] {
        assert!(!paper.to_json().expect("finite").contains(&format!("\"{member}\"")));
    }
    let explicit = with_members(r#", "knows": "goals", "sees": "own""#).expect("a scene");
    assert_eq!(explicit, paper);
    let level = |members: &str| with_members(members).expect("a scene").agents[0].awareness.knows.level();
    assert_eq!(level(r#", "knows": "nothing""#), Some(Level::One));
    assert_eq!(level(r#", "knows": "nothing", "level": 2"#), Some(Level::Two));
}

#[test]
fn knowledge_that_does_not_exist_is_refused() {
    for (members, expected) in [
        (r#", "knows": "everything""#, "field `agents[0].knows`"),
        (r#", "knows": "nothing", "level": 3"#, "field `agents[0].level`"),
        (r#", "level": 1"#, "field `agents[0].level` is for agents that know \"nothing\""),
        (r#", "knows": "goals", "level": 0"#, "field `agents[0].level` is for agents that know \"nothing\""),
        (r#", "sees": "objects and agents""#, "field `agents[0].sees`"),
        (r#", "waits": -1"#, "field `agents[0].waits`"),
        (r#", "waits": 10001"#, "field `agents[0].waits`"),
    ] {
        let error = with_members(members).expect_err(members);
        assert!(error.starts_with(expected), "{error}");
    }
}
