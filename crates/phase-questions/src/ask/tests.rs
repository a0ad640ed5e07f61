//! Tests of the choice of questions about an event: those that a viewer could not answer are not asked.

use super::{Draft, about_event, asks_without, foreseen};
use crate::{Alternative, Facts, FrameBudget, Inside, Query, SimulatedFutures, sampled, stills};
use phase_evidence::{Track, contact};
use phase_model::{
    AgentId, Entity, Grip, LandmarkId, ObjectId, RoomId, Scene, Side, State, Vec2, arena::LANDMARKS,
};

const OBJECT: Entity = Entity::Object(ObjectId::ZERO);
/// Places of the agents that are far from everything else.
pub(crate) const FAR: [Vec2; 2] = [Vec2::new(8.0, 20.0), Vec2::new(24.0, 20.0)];
/// The place of the object at the start.
pub(crate) const START: Vec2 = Vec2::new(12.0, 5.0);
/// As far from the object as the centre of an agent that touches it.
const BESIDE: Vec2 = Vec2::new(2.0, 0.0);

/// Two agents of these attitudes that want the object at the bottom right, and their places and the object's
/// by step.
pub(crate) fn event(kind: &str, alphas: [i8; 2], places: impl Fn(usize) -> [Vec2; 3]) -> Facts {
    let agent = |k: usize| {
        let sign = if alphas[k] < 0 { -1 } else { 1 };
        format!(
            r#"{{"size_level": 1, "strength_level": 1, "alpha": {}, "start": {{"x": {}, "y": {}, "angle": 0}},
                "goal": {{"kind": "object_on_landmark", "object": 0, "landmark": 2, "sign": {sign}}}}}"#,
            alphas[k], FAR[k].x, FAR[k].y
        )
    };
    let scene = Scene::from_json(&format!(
        r#"{{"layout": {{"base": 0}}, "agents": [{}, {}], "event": "{kind}",
            "objects": [{{"size_level": 1, "start": {{"x": 12, "y": 5}}}}]}}"#,
        agent(0),
        agent(1),
    ))
    .expect("a scene");
    let states = (0..=40).map(|step| {
        let mut state = scene.initial_state();
        for (body, place) in state.bodies.iter_mut().zip(places(step)) {
            body.position = place;
        }
        state
    });
    let track = Track { physics: scene.physics(), states: states.collect() };
    Facts { id: format!("{kind}-{alphas:?}"), set: None, scene, track, inside: None, ratings: None }
}

/// An agent takes the object a part of the way to its landmark, and the other one the rest.
pub(crate) fn shared(kind: &str, alphas: [i8; 2], first: AgentId) -> Facts {
    event(kind, alphas, move |step| {
        let object = START + (step as f32 / 40.0) * (LANDMARKS[2] - START);
        let mut places = [FAR[0], FAR[1], object];
        let at = if step < 20 { first } else { first.other() };
        places[at.index()] = object - BESIDE;
        places
    })
}

/// One agent alone takes the object to its landmark.
pub(crate) fn alone(kind: &str, alphas: [i8; 2], agent: AgentId) -> Facts {
    event(kind, alphas, move |step| {
        let object = START + (step as f32 / 40.0) * (LANDMARKS[2] - START);
        let mut places = [FAR[0], FAR[1], object];
        places[agent.index()] = object - BESIDE;
        places
    })
}

fn asked(facts: &Facts, name: &str) -> Vec<Draft> {
    about_event(facts).into_iter().filter(|draft| draft.query.type_name() == name).collect()
}

/// A viewer tells who acts upon whom by who was at the object first. Nobody does if neither is social.
#[test]
fn roles_are_asked_about_where_the_other_begins() {
    let roles = |facts: &Facts| -> Vec<String> {
        asked(facts, "role").into_iter().map(|draft| draft.value).collect()
    };
    for (kind, alphas) in [("helping", [1, 0]), ("hindering", [-1, 0])] {
        assert_eq!(roles(&shared(kind, alphas, AgentId::ONE)), ["0"], "{kind}");
        assert!(roles(&shared(kind, alphas, AgentId::ZERO)).is_empty(), "{kind}");
    }
    assert_eq!(roles(&alone("independent", [0, 0], AgentId::ONE)), ["neither"]);
    assert!(roles(&shared("collaborating", [0, 0], AgentId::ONE)).is_empty());
}

/// A helper that does everything alone, or a hinderer whom the other never meets, seems to mind its own
/// business; two independent agents with one object seem to work together.
#[test]
fn relations_are_asked_about_where_motion_shows_them() {
    let [one, other] = AgentId::ALL;
    for (kind, alphas) in [("helping", [1, 0]), ("hindering", [-1, 0]), ("collaborating", [0, 0])] {
        assert_eq!(asked(&shared(kind, alphas, other), "relation").len(), 1, "{kind}");
        assert!(asked(&alone(kind, alphas, one), "relation").is_empty(), "{kind}");
        assert!(asked(&alone(kind, alphas, one), "kind").is_empty(), "{kind}");
    }
    assert_eq!(asked(&alone("independent", [0, 0], one), "relation").len(), 1);
    assert!(asked(&shared("independent", [0, 0], other), "relation").is_empty());
}

/// A touch between two shown frames is not seen, even where the straight line from frame to frame has one.
#[test]
fn a_touch_has_to_be_in_a_frame() {
    let query = Query::FirstTouch { object: ObjectId::ZERO };
    // Of four frames, step 13 shows the first agent on one side of the object, and step 27 on the other.
    let between = event("independent", [0, 0], |step| {
        let first = match step {
            ..=14 => START - 3.0 * BESIDE,
            15..=25 => START - BESIDE,
            _ => START + 3.0 * BESIDE,
        };
        [first, if step < 26 { FAR[1] } else { START + BESIDE }, START]
    });
    assert_eq!(query.seen(&between.track).as_deref(), Some("0"));
    let four = FrameBudget::Frames(4);
    assert_eq!(query.seen(&sampled(&between.track, four)).as_deref(), Some("0"), "by luck");
    assert_eq!(query.seen(&stills(&between.track, four)).as_deref(), Some("1"), "what the frames show");
    assert_eq!(query.seen(&stills(&between.track, FrameBudget::Frames(16))).as_deref(), Some("0"));
}

/// It is not asked who is first where the other agent has been nearly as close, or where a touch is short.
#[test]
fn the_first_touch_is_clear() {
    let at = |offset: f32, step: usize| {
        let near = START + Vec2::new(offset, 0.0);
        [if step < 10 { FAR[0] } else { START - BESIDE }, if step < 5 { near } else { FAR[1] }, START]
    };
    let with_other_at = |wanted: f32| {
        let events = (0..100_u8).map(|k| {
            let offset = BESIDE.x + f32::from(k) / 20.0;
            event("independent", [0, 0], move |step| at(offset, step))
        });
        let is_there = |facts: &Facts| {
            let Track { physics, states } = &facts.track;
            contact::gap(physics, &states[0], Entity::Agent(AgentId::ONE), OBJECT) >= wanted
        };
        events.into_iter().find(is_there).expect("a place so far from the object")
    };
    assert_eq!(asked(&with_other_at(2.0), "first-touch").len(), 1);
    assert!(asked(&with_other_at(0.3), "first-touch").is_empty());
    let bounced = event("independent", [0, 0], |step| {
        [FAR[0], if step == 10 { START + BESIDE } else { FAR[1] }, START]
    });
    assert!(asked(&bounced, "first-touch").is_empty());
}

/// The room of something at a moment is asked about if it is there for a second before and after.
#[test]
fn rooms_are_asked_about_away_from_the_moment_of_a_change() {
    let query = Query::RoomAt { entity: OBJECT, step: 20 };
    let leaves_at = |when: usize| {
        let track = event("independent", [0, 0], |step| {
            [FAR[0], FAR[1], if step < when { START } else { LANDMARKS[2] }]
        });
        query.seen(&track.track)
    };
    assert_eq!(leaves_at(26).as_deref(), Some("3"));
    assert_eq!(leaves_at(22), None);
    assert_eq!(leaves_at(18), None);
    assert_eq!(leaves_at(15).as_deref(), Some("2"));
}

/// An agent sees the object for five steps, perhaps in the other's hands; then that is behind it. Its
/// particles have the object in a room.
fn believing(believed: RoomId, held: bool) -> Facts {
    let eye = Vec2::new(8.5, 6.5);
    let mut facts = event("independent", [0, 0], |step| {
        [eye, FAR[1], if step < 5 { eye + Vec2::new(0.0, 3.0) } else { eye - Vec2::new(0.0, 3.0) }]
    });
    let mut states: Vec<State> = facts.track.states.clone();
    if held {
        for state in &mut states[..5] {
            state.grips[1] = Some(Grip { object: ObjectId::ZERO, side: Side::ALL[0], relative_angle: 0.0 });
        }
    }
    let beliefs = [vec![vec![(believed, 0.9)]; 41], vec![Vec::new(); 41]];
    facts.track.states.clone_from(&states);
    facts.inside = Some(Inside { states, beliefs, without: None, futures: None });
    facts
}

/// Particles that follow an object which was carried away unseen are no belief that a viewer can know of.
#[test]
fn beliefs_are_what_the_agent_saw() {
    let here = RoomId::ALL[3];
    let asked = |believed, held| asked(&believing(believed, held), "believes").len();
    assert!(asked(here, false) > 0);
    assert_eq!(asked(RoomId::ALL[2], false), 0, "the particles went on without it");
    assert_eq!(asked(here, true), 0, "in somebody's hands");
}

/// The counterfactual question names the goal, and is not asked where both runs fail or one nearly succeeds.
#[test]
fn what_would_have_been_is_asked_about_clear_outcomes() {
    let agent = AgentId::ZERO;
    let reached = alone("independent", [0, 0], AgentId::ONE);
    let failed = event("independent", [0, 0], |_| [FAR[0], FAR[1], START]);
    let nearly = event("independent", [0, 0], |_| [FAR[0], FAR[1], LANDMARKS[2] - Vec2::new(3.0, 0.0)]);
    let drafts = |with: &Facts, without: &Facts| {
        let mut facts = with.clone();
        let without = Some(Alternative { idle: agent, track: without.track.clone() });
        let states = facts.track.states.clone();
        facts.inside = Some(Inside { states, beliefs: [Vec::new(), Vec::new()], without, futures: None });
        asked(&facts, "without")
    };
    let value = |with, without| drafts(with, without).first().map(|draft| draft.value.clone());
    for (with, is_worth_it) in [(&reached, true), (&failed, true), (&nearly, false)] {
        assert_eq!(asks_without(with, agent), is_worth_it);
        let some = [&reached, &failed, &nearly].iter().any(|without| value(with, without).is_some());
        assert_eq!(some, is_worth_it, "what is not simulated is not asked");
    }
    assert_eq!(value(&reached, &failed).as_deref(), Some("worse"));
    assert_eq!(value(&failed, &reached).as_deref(), Some("better"));
    assert_eq!(value(&reached, &reached).as_deref(), Some("same"));
    assert_eq!(value(&failed, &failed), None);
    assert_eq!(value(&reached, &nearly), None);
    let names = phase_model::words::Names::PAPER;
    for phrasing in 0..crate::PHRASINGS {
        let text = crate::words::question(&drafts(&reached, &failed)[0].query, phrasing, &names);
        assert!(text.contains(&names.landmark(LandmarkId::ALL[2])), "{text}");
    }
}

/// More futures never foresee more, and what is foreseen is where every future ends.
#[test]
fn what_is_foreseen_is_agreed_on_by_all_futures() {
    let (here, beside, across) = (FAR[0], FAR[1], Vec2::new(24.0, 5.0));
    let facts = event("independent", [0, 0], |step| [if step < 5 { here } else { beside }, across, START]);
    let states = facts.track.states.clone();
    let end = |place| {
        let mut state = states[0];
        state.bodies[0].position = place;
        state.bodies[1].position = across;
        state
    };
    let room = phase_model::layout::room_of;
    let agent = Entity::Agent(AgentId::ZERO);
    let of = |ends: &[State]| {
        let futures = SimulatedFutures { step: 2, steps: 6, ends: ends.to_vec() };
        foreseen(&facts, &states, &futures).into_iter().find(|it| it.0 == agent)
    };
    let found = Some((agent, room(here), room(beside)));
    assert_eq!(of(&[]), found, "the event itself says so");
    assert_eq!(of(&[end(beside), end(beside)]), found);
    assert_eq!(of(&[end(beside), end(here)]), None);
    assert_eq!(of(&[end(across)]), None);
}
