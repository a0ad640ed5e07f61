//! In what manner agents of synthetic events help, hinder and meet.

use crate::{
    selection::{STEPS, THING, event, facing, fetch, on_way, place, scene},
    support::Move,
};
use core::f32::consts::{FRAC_PI_2, PI};
use phase_evidence::{Manner, Track};
use phase_model::{AgentId, Attitude, Entity, EventKind, Goal, ObjectId};

fn helping(goal: Goal, track: &Track) -> Vec<Manner> {
    Manner::shown(&scene(EventKind::Helping, [goal; 2], Attitude::Help), track)
}

fn hindering(goal: Goal, track: &Track) -> Vec<Manner> {
    Manner::shown(&scene(EventKind::Hindering, [goal.negated(), goal], Attitude::Hinder), track)
}

#[test]
fn who_holds_the_object_when_decides_how_help_is_given() {
    assert_eq!(helping(THING, &event(fetch)), [Manner::Fetching]);
    // The helper lets go at step 20, and the helpee brings it the rest of the way.
    let handed = |t| {
        let held = [(10..20).contains(&t).then_some(0), (20..30).contains(&t).then_some(0)];
        Move { held, ..fetch(t) }
    };
    assert_eq!(helping(THING, &event(handed)), [Manner::Fetching, Manner::HandingOver]);
    // In the other order nothing is handed over.
    let finished = |t| {
        let held = [(20..30).contains(&t).then_some(0), (10..20).contains(&t).then_some(0)];
        Move { held, ..fetch(t) }
    };
    assert_eq!(helping(THING, &event(finished)), [Manner::Fetching]);
    let together = |t| Move { held: [fetch(t).held[0]; 2], ..fetch(t) };
    assert_eq!(helping(THING, &event(together)), [Manner::CarryingAlong]);
    let unmoved = |t| Move { objects: vec![(12.0, 4.5)], ..together(t) };
    assert_eq!(helping(THING, &event(unmoved)), []);
    // The same motion is no help where nobody helps.
    let collaborating = scene(EventKind::Collaborating, [THING, THING], Attitude::Neutral);
    assert_eq!(Manner::shown(&collaborating, &event(fetch)), []);
}

#[test]
fn an_object_that_the_goal_is_not_about_is_cleared() {
    assert_eq!(helping(place(1, 0), &event(fetch)), [Manner::Clearing]);
    let pushed_by_the_helpee = |t| {
        let one = fetch(t);
        Move { agents: [one.agents[1], one.agents[0]], held: [None, None], ..one }
    };
    assert_eq!(helping(place(1, 0), &event(pushed_by_the_helpee)), []);
}

/// Agent 0 stands between agent 1 and its landmark at (8.5, 19.5), and steps aside; agent 1 walks on.
fn steps_aside(t: usize) -> Move {
    Move {
        agents: [
            facing(on_way(t, (8.5, 15.0), (12.0, 15.0), 10..14)),
            facing(on_way(t, (8.5, 12.0), (8.5, 19.0), 12..30)),
        ],
        objects: vec![(24.0, 4.0)],
        held: [None, None],
    }
}

#[test]
fn leaving_the_others_way_with_empty_hands_is_making_way() {
    assert_eq!(helping(place(1, 0), &event(steps_aside)), [Manner::MakingWay]);
    let stays = |t| {
        let one = steps_aside(t);
        Move { agents: [(8.5, 15.0, 0.0), facing(on_way(t, (8.5, 12.0), (8.5, 13.0), 0..10))], ..one }
    };
    assert_eq!(helping(place(1, 0), &event(stays)), []);
    let hands_full = |t| Move { held: [Some(0), None], ..steps_aside(t) };
    assert_eq!(helping(place(1, 0), &event(hands_full)), []);
}

#[test]
fn standing_in_the_others_way_and_meeting_it_is_blocking() {
    let blocked = |t| Move {
        agents: [(8.5, 15.0, 0.0), facing(on_way(t, (8.5, 8.0), (8.5, 13.4), 0..15))],
        objects: vec![(24.0, 4.0)],
        held: [None, None],
    };
    assert_eq!(hindering(place(1, 0), &event(blocked)), [Manner::Blocking]);
    let elsewhere = |t| Move { agents: [(15.0, 15.0, 0.0), blocked(t).agents[1]], ..blocked(t) };
    assert_eq!(hindering(place(1, 0), &event(elsewhere)), []);
}

/// Agent 0 carries the object away from its landmark, from (18, 4.5) to (10, 4.5), and agent 1 looks on.
fn carries_off(t: usize) -> Move {
    let object = on_way(t, (18.0, 4.5), (10.0, 4.5), 10..30);
    let held = (10..30).contains(&t).then_some(0);
    Move {
        agents: [facing((object.0 - 2.0, 4.5)), (8.0, 18.0, PI)],
        objects: vec![object],
        held: [held, None],
    }
}

#[test]
fn what_is_carried_off_was_taken_or_is_hidden() {
    assert_eq!(hindering(THING, &event(carries_off)), [Manner::Hiding]);
    // The victim had it in its hands first.
    let taken = |t| Move {
        agents: [carries_off(t).agents[0], (20.0, 4.5, FRAC_PI_2)],
        held: [carries_off(t).held[0], (t < 8).then_some(0)],
        ..carries_off(t)
    };
    assert_eq!(hindering(THING, &event(taken)), [Manner::Taking]);
    // Towards the landmark it is neither.
    assert_eq!(hindering(THING, &event(fetch)), []);
    let tug = |t| Move { held: [carries_off(t).held[0]; 2], ..carries_off(t) };
    assert!(hindering(THING, &event(tug)).contains(&Manner::Dragging));
}

#[test]
fn hindering_is_hidden_while_the_victim_perceives_neither_hinderer_nor_object() {
    // The victim looks away.
    let unseen = |t| Move { agents: [carries_off(t).agents[0], (8.0, 18.0, 0.0)], ..carries_off(t) };
    assert_eq!(hindering(THING, &event(unseen)), [Manner::Hiding, Manner::HiddenHindering]);
    // It turns when the object has gone 2 u.
    let turns = |t| if t < 15 { unseen(t) } else { carries_off(t) };
    assert_eq!(hindering(THING, &event(turns)), [Manner::Hiding]);
    // It sees nothing, but feels the object.
    let felt = |t| {
        let Move { agents, objects, held } = unseen(t);
        let [(x, y)] = objects[..] else { unreachable!("there is one object") };
        Move { agents: [agents[0], (x, y + 2.0, 0.0)], objects, held }
    };
    let mut track = event(felt);
    let [thing, victim] = [Entity::Object(ObjectId::ZERO), Entity::Agent(AgentId::ONE)];
    track.states.iter_mut().for_each(|state| state.contacts.insert(thing, victim));
    assert!(!hindering(THING, &track).contains(&Manner::HiddenHindering));
    // Towards the landmark it hinders nobody.
    assert_eq!(
        hindering(THING, &event(|t| Move { agents: [fetch(t).agents[0], (8.0, 18.0, 0.0)], ..fetch(t) })),
        []
    );
}

#[test]
fn what_has_been_achieved_is_undone() {
    let undone = |t| Move {
        objects: vec![on_way(t, (23.5, 4.5), (15.0, 4.5), 20..35)],
        agents: [facing(on_way(t, (21.0, 4.5), (12.5, 4.5), 20..35)), (8.0, 18.0, 0.0)],
        held: [(20..35).contains(&t).then_some(0), None],
    };
    assert!(hindering(THING, &event(undone)).contains(&Manner::Undoing));
    let back = |t| if t > 36 { Move { objects: vec![(23.5, 4.5)], ..undone(t) } } else { undone(t) };
    assert!(!hindering(THING, &event(back)).contains(&Manner::Undoing), "in the end it stands");
}

#[test]
fn paths_cross_where_two_pass_one_place_within_two_seconds() {
    let scene = scene(EventKind::Independent, [place(0, 1), place(1, 0)], Attitude::Neutral);
    let cross = |delay: usize| {
        event(move |t| Move {
            agents: [
                facing(on_way(t, (7.0, 12.0), (25.0, 12.0), 0..18)),
                facing(on_way(t, (16.0, 3.0), (16.0, 21.0), delay..delay + 18)),
            ],
            objects: vec![(24.0, 4.0)],
            held: [None, None],
        })
    };
    assert_eq!(Manner::shown(&scene, &cross(0)), [Manner::Crossing]);
    assert_eq!(Manner::shown(&scene, &cross(5)), [Manner::Crossing]);
    assert_eq!(Manner::shown(&scene, &cross(STEPS - 18)), []);
}
