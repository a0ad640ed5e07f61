//! Scenes as JSON, from any scene and back.

use phase_model::{
    AgentId, AgentSpec, Attitude, Body, EventKind, Flip, Goal, LandmarkId, Layout, ObjectId, ObjectSpec,
    Scene, Sign, Size, Strength, Vec2,
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

fn agent(id: AgentId) -> impl Strategy<Value = AgentSpec> {
    let strength = prop::sample::select(&Strength::ALL[..]);
    (size(), strength, goal(id), body()).prop_map(|(size, strength, goal, start)| AgentSpec {
        size,
        strength,
        goal,
        attitude: Attitude::Neutral,
        start,
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
