//! Rejections that are certain before the end of an event.

use crate::{
    selection::{THING, TOUCH, event, facing, fetch, on_way, place, scene},
    support::{Move, track},
};
use core::f32::consts::PI;
use phase_evidence::{
    Track,
    selection::{Ending, RejectionReason, certain_rejection, check_event},
};
use phase_model::{Attitude, Awareness, EventKind, Goal, LandmarkId, ObjectId, Scene, Sight, Sign};
use proptest::prelude::*;

const ENDING: Ending = Ending::Drawn { manner: None };
/// Every event of these tests is this long (steps).
const LENGTH: usize = 80;

fn certain(scene: &Scene, track: &Track) -> Option<RejectionReason> {
    certain_rejection(scene, track, 40..=LENGTH, ENDING)
}

/// The first step after which rejection is certain.
fn certain_at(scene: &Scene, track: &Track) -> Option<usize> {
    (0..=track.steps()).find(|&step| certain(scene, &track.until(step)).is_some())
}

/// Both agents stand from step 4 on.
fn standing(t: usize) -> Move {
    let agent = facing(on_way(t, (8.0, 8.0), (12.0, 8.0), 0..4));
    Move { agents: [agent, (18.0, 18.0, 0.0)], objects: vec![(12.0, 4.5)], held: [None, None] }
}

#[test]
fn six_seconds_of_standstill_are_enough() {
    let scene = scene(EventKind::Helping, [THING, THING], Attitude::Help);
    assert_eq!(certain_at(&scene, &event(standing)), Some(4 + 24));
    assert_eq!(certain(&scene, &event(fetch).until(30)), None);
    let settled = certain_rejection(&scene, &event(standing), 40..=LENGTH, Ending::Settled);
    assert_eq!(settled, None);
}

/// Agent 0 waits for 30 steps in the lower left and faces down, while agent 1 carries the object from the
/// upper left to the upper right; then it goes as `after` says, step after step.
fn waiting(after: &[(f32, f32, f32)], sees: Sight) -> (Scene, Track) {
    let goals = [
        Goal::ObjectOnLandmark {
            landmark: LandmarkId::TOP_LEFT,
            object: ObjectId::ZERO,
            sign: Sign::Positive,
        },
        THING,
    ];
    let mut scene = scene(EventKind::Competing, goals, Attitude::Neutral);
    scene.agents[0].awareness = Awareness { sees, waits: 30, ..Awareness::default() };
    let event = event(|t| {
        let object = on_way(t, (8.0, 19.0), (23.0, 19.0), 2..28);
        let pose = if t <= 30 { (8.0, 5.0, PI) } else { after[(t - 31).min(after.len() - 1)] };
        Move { agents: [pose, (object.0, object.1 + 2.0, PI)], objects: vec![object], held: [None, None] }
    });
    (scene, event)
}

#[test]
fn a_look_that_shows_no_belief_is_certain_at_once() {
    let up = [(8.0, 6.0, PI), (8.0, 8.0, PI), (8.0, 8.0, 0.0)];
    let (unaware, track) = waiting(&up, Sight::Start);
    assert_eq!(certain_at(&unaware, &track), None);
    let (told, track) = waiting(&up, Sight::Objects);
    assert_eq!(certain_at(&told, &track), Some(33));
    assert_eq!(certain(&told, &track), Some(RejectionReason::Unsearched));
    let (mut late, track) = waiting(&up, Sight::Start);
    late.agents[0].awareness.waits = 60;
    assert_eq!(certain_at(&late, &track), Some(33));
    assert_eq!(certain(&late, &track.until(33)), Some(RejectionReason::Unmoved));
    let (mut early, track) = waiting(&up, Sight::Start);
    early.agents[0].awareness.waits = 10;
    assert_eq!(certain_at(&early, &track), Some(10), "the object is not in another room yet");
}

fn goals() -> impl Strategy<Value = (EventKind, [Goal; 2], Attitude)> {
    use EventKind::{Chasing, Collaborating, Helping, Hindering, Independent};
    prop::sample::select(vec![
        (Helping, [THING, THING], Attitude::Help),
        (Helping, [place(1, 0), place(1, 0)], Attitude::Help),
        (Hindering, [THING.negated(), THING], Attitude::Hinder),
        (Chasing, [TOUCH, TOUCH.negated()], Attitude::Neutral),
        (Collaborating, [THING, THING], Attitude::Neutral),
        (Independent, [place(0, 0), place(1, 1)], Attitude::Neutral),
        (Independent, [TOUCH, THING], Attitude::Neutral),
    ])
}

/// A body that goes from place to place, some of which are landmarks, and stays at each for a time.
fn path() -> impl Strategy<Value = Vec<(f32, f32)>> {
    let places = vec![(8.5, 19.5), (23.5, 19.5), (23.5, 4.5), (16.0, 12.0), (16.4, 12.2), (21.0, 17.5)];
    let visits = prop::collection::vec((prop::sample::select(places), 0..40_usize, 1..12_usize), 2..8);
    visits.prop_map(|visits| {
        let mut path = vec![visits[0].0];
        for &(place, stay, way) in visits.iter().cycle().take(40) {
            let from = path[path.len() - 1];
            path.extend((1..=way).map(|t| on_way(t, from, place, 0..way)));
            path.extend(core::iter::repeat_n(place, stay));
        }
        path.truncate(LENGTH + 1);
        path
    })
}

proptest! {
    /// A reason that is certain after some steps is that of the whole event.
    #[test]
    fn what_is_certain_comes_true((kind, goals, first) in goals(), paths in [path(), path(), path()]) {
        let scene = scene(kind, goals, first);
        let last = paths.iter().map(Vec::len).min().unwrap_or(0);
        let track = track((0..last).map(|t| Move {
            agents: [facing(paths[0][t]), facing(paths[1][t])],
            objects: vec![paths[2][t]],
            held: [None, None],
        }));
        prop_assume!(track.steps() == LENGTH);
        let judged = check_event(&scene, &track, 40..=LENGTH, ENDING).err();
        for step in 0..LENGTH {
            if let Some(reason) = certain(&scene, &track.until(step)) {
                prop_assert_eq!(Some(reason), judged, "after {} steps", step);
            }
        }
        // At the end everything is certain.
        prop_assert_eq!(certain(&scene, &track).is_some(), judged == Some(RejectionReason::Lifeless));
    }
}
