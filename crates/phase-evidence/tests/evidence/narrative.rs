//! Events in words.

use crate::support::{Move, track};
use phase_evidence::{
    Narrative,
    narrative::{Happening, happenings},
};
use phase_model::{Scene, words::Names};

/// Agent 0 wants or, with `alpha` 1 or −1, wants agent 1 to have or not to have object 0 on landmark 1.
fn scene(alpha: i8) -> Scene {
    let agent = |alpha: i8, x: f32| {
        let sign = if alpha < 0 { -1 } else { 1 };
        let goal = format!(r#"{{"kind": "object_on_landmark", "object": 0, "landmark": 1, "sign": {sign}}}"#);
        format!(
            r#"{{"size_level": 1, "strength_level": 1, "alpha": {alpha}, "goal": {goal},
                "start": {{"x": {x}, "y": 8, "angle": 0}}}}"#
        )
    };
    let object = r#"{"size_level": 1, "start": {"x": 10, "y": 4.5}}"#;
    let kind = ["hindering", "collaborating", "helping"][usize::try_from(alpha + 1).expect("0 to 2")];
    Scene::from_json(&format!(
        r#"{{"layout": {{"base": 0}}, "agents": [{}, {}], "objects": [{object}], "event": "{kind}"}}"#,
        agent(alpha, 8.0),
        agent(0, 20.0),
    ))
    .expect("a scene")
}

/// Agent 0 takes the object along from the bottom left to the landmark at the top right, and leaves it there.
fn carried() -> phase_evidence::Track {
    let at = |x: f32, y: f32, held: bool| Move {
        agents: [(x, y, 0.0), (20.0, 4.5, 0.0)],
        objects: vec![(x, y)],
        held: [held.then_some(0), None],
    };
    let way = (0..=20u8).map(|k| {
        let part = f32::from(k) / 20.0;
        at(8.5 + 15.0 * part, 8.0 + 11.5 * part, (4..=18).contains(&k))
    });
    track(way)
}

#[test]
fn what_happens_is_told_in_order() {
    let told: Vec<(usize, String)> = happenings(&carried(), &Names::PAPER)
        .into_iter()
        .map(|Happening { step, text }| (step, text))
        .collect();
    let sentences: Vec<&str> = told.iter().map(|(_, text)| text.as_str()).collect();
    let expected = [
        "The red agent takes hold of the light blue object.",
        "The red agent enters the top right room with the light blue object.",
        "The light blue object comes to be on the green landmark (top right).",
        "The red agent lets go of the light blue object.",
        "The red agent comes to be on the green landmark (top right).",
    ];
    let places: Vec<Option<usize>> =
        expected.iter().map(|it| sentences.iter().position(|told| told == it)).collect();
    assert!(places.iter().all(Option::is_some), "{told:?}");
    assert_eq!((told[0].0, told.last().map(|it| it.0)), (4, Some(20)), "{told:?}");
    assert!(told.is_sorted_by_key(|(step, _)| *step));
}

#[test]
fn intents_are_in_all_lengths_but_what_is_seen() {
    let track = carried();
    let told = |alpha| Narrative::of(&scene(alpha), &track, &Names::PAPER);
    let aim = "the green agent, which wants to put the light blue object on the green landmark (top right) and succeeds.";
    let helping = told(1);
    assert_eq!(helping.short, format!("The red agent helps {aim}"));
    assert_eq!(told(-1).short, format!("The red agent hinders {aim}"));
    assert!(helping.medium.starts_with(&helping.short) && helping.long.starts_with(&helping.medium));
    assert!(helping.medium.contains("the helper brings the object."), "{}", helping.medium);
    assert!(helping.long.ends_with(&helping.seen));
    assert_eq!(helping.seen, told(-1).seen);
    assert_eq!(helping.seen, told(0).seen);
    for word in ["want", "help", "hinder", "goal"] {
        assert!(!helping.seen.contains(word), "{word}: {}", helping.seen);
    }
    assert!(told(0).short.starts_with("The two agents both want to put"), "{}", told(0).short);
}
