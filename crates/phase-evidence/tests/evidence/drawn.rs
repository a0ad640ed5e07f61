//! Synthetic events that end at a sampled step: those that show their label, and reasons why others do not.

use crate::{
    selection::{STEPS, THING, event, facing, fetch, on_way, place, scene},
    support::Move,
};
use phase_evidence::{
    Manner, Track,
    selection::{CausalEffect, Counterfactual, Ending, RejectionReason, check_event},
};
use phase_model::{AgentId, Attitude, EventKind, Scene};

fn drawn(
    scene: &Scene,
    track: &Track,
    manner: Option<Manner>,
) -> Result<Option<Counterfactual>, RejectionReason> {
    check_event(scene, track, 20..=100, Ending::Drawn { manner })
}

/// As `fetch`, and agent 1 is at agent 0 from step 12 to step 12 + `trying` - 1.
fn wanted_for(t: usize, trying: usize) -> Move {
    let helper = fetch(t).agents[0];
    let beside = (helper.0 - 2.0, helper.1);
    let helpee = match t {
        0..12 => on_way(t, (6.0, 18.0), (6.0, 14.0), 0..8),
        _ if t < 12 + trying => beside,
        _ => (beside.0 - 3.0, beside.1),
    };
    Move { agents: [helper, facing(helpee)], ..fetch(t) }
}

/// As `fetch`, and agent 1 tries for two seconds.
fn wanted(t: usize) -> Move {
    wanted_for(t, 8)
}

#[test]
fn help_may_be_cut_before_the_goal_is_reached() {
    let scene = scene(EventKind::Helping, [THING, THING], Attitude::Help);
    let counterfactual =
        Counterfactual { idle: AgentId::ZERO, judged: AgentId::ONE, change: CausalEffect::Helped, cut: true };
    let whole = event(wanted);
    let cut = event(wanted).until(22);
    for track in [&whole, &cut] {
        assert_eq!(drawn(&scene, track, Some(Manner::Fetching)), Ok(Some(counterfactual)));
    }
    let refused = [
        (drawn(&scene, &whole, Some(Manner::HandingOver)), RejectionReason::OtherManner),
        (drawn(&scene, &event(fetch), Some(Manner::Fetching)), RejectionReason::Aimless),
        (drawn(&scene, &whole.until(12), None), RejectionReason::TooShort),
    ];
    for (found, reason) in refused {
        assert_eq!(found, Err(reason));
    }
    let tries_too_little = event(|t| wanted_for(t, 7));
    assert_eq!(drawn(&scene, &tries_too_little, None), Err(RejectionReason::Aimless));
    let unmoved = |t| Move { objects: vec![(12.0, 4.5)], ..wanted(t) };
    assert_eq!(drawn(&scene, &event(unmoved), None), Err(RejectionReason::NoProgress));
}

/// As `wanted`, but the object goes so far down on its way to the right.
fn shows_by(t: usize, down: f32) -> Move {
    let object = on_way(t, (12.0, 12.0), (18.0, 12.0 - down), 10..30);
    let helper = if t < 10 { on_way(t, (8.0, 8.0), (10.0, 12.0), 0..10) } else { (object.0 - 2.0, object.1) };
    let beside = (helper.0, helper.1 + 2.0);
    let helpee = if t < 12 { on_way(t, (6.0, 18.0), (6.0, 14.0), 0..8) } else { beside };
    Move { agents: [facing(helper), facing(helpee)], objects: vec![object], held: wanted(t).held }
}

/// Both landmarks on the right are as far from the object, until it goes down.
#[test]
fn motion_shows_which_landmark_is_wanted() {
    let scene = scene(EventKind::Helping, [THING, THING], Attitude::Help);
    let judged = |down: f32| drawn(&scene, &event(|t| shows_by(t, down)), None);
    assert_eq!(judged(0.0), Err(RejectionReason::Unshown));
    // By 2.41 u: from (12, 12) it is 13.73 u to either landmark, from (18, 10.5) 8.14 u and 10.55 u.
    assert_eq!(judged(1.5), Err(RejectionReason::Unshown));
    // By 3.20 u: from (18, 10) it is 7.78 u and 10.98 u.
    assert!(judged(2.0).is_ok());
}

/// The object is carried off from (14, 4.5) to (8.5, 4.5), the wrong landmark, before the victim is at it.
fn hides(t: usize) -> Move {
    let object = on_way(t, (14.0, 4.5), (8.5, 4.5), 6..26);
    let hinderer = if t < 26 { (object.0 - 2.0, 4.5) } else { on_way(t, (6.5, 4.5), (6.5, 8.0), 26..31) };
    let victim = on_way(t, (14.0, 16.0), (8.5, 6.5), 8..29);
    let held = [(6..26).contains(&t).then_some(0), None];
    Move { agents: [facing(hinderer), facing(victim)], objects: vec![object], held }
}

#[test]
fn who_hides_an_object_keeps_its_goal_from_being_seen() {
    let scene = scene(EventKind::Hindering, [THING.negated(), THING], Attitude::Hinder);
    let track = event(hides);
    assert!(drawn(&scene, &track, Some(Manner::Hiding)).is_ok());
    assert_eq!(drawn(&scene, &track, None), Err(RejectionReason::Unshown));
}

#[test]
fn a_cut_event_is_judged_by_how_far_it_has_come() {
    let scene = scene(EventKind::Helping, [THING, THING], Attitude::Help);
    let cut = event(wanted).until(22);
    let without = event(|t| Move { objects: vec![(12.0, 4.5)], held: [None, None], ..wanted(t) }).until(22);
    let counterfactual =
        Counterfactual { idle: AgentId::ZERO, judged: AgentId::ONE, change: CausalEffect::Helped, cut: true };
    assert_eq!(counterfactual.judge(&scene, &cut, &without), Ok(()));
    assert_eq!(counterfactual.judge(&scene, &without, &cut), Err(RejectionReason::NoEffect));
    assert_eq!(counterfactual.judge(&scene, &cut, &cut), Err(RejectionReason::NoEffect));
    let hindered = Counterfactual { change: CausalEffect::Hindered, ..counterfactual };
    assert_eq!(hindered.judge(&scene, &without, &cut), Ok(()));
    let settled = Counterfactual { cut: false, ..counterfactual };
    assert_eq!(settled.judge(&scene, &cut, &without), Err(RejectionReason::NoEffect));
}

/// Both walk to their landmarks, (23.5, 19.5) and (8.5, 4.5), far from each other, by step `arrived`.
fn errands(t: usize, arrived: usize) -> Move {
    Move {
        agents: [
            facing(on_way(t, (9.0, 20.0), (23.5, 19.5), 0..arrived)),
            facing(on_way(t, (24.0, 4.0), (8.5, 4.5), 0..arrived)),
        ],
        objects: vec![(16.0, 12.0)],
        held: [None, None],
    }
}

#[test]
fn most_of_an_event_must_not_be_still() {
    let scene = scene(EventKind::Independent, [place(0, 1), place(1, 3)], Attitude::Neutral);
    assert_eq!(drawn(&scene, &event(|t| errands(t, 17)), None), Ok(None));
    assert_eq!(drawn(&scene, &event(|t| errands(t, 9)), None), Err(RejectionReason::Lifeless));
    // Cut on the way.
    assert_eq!(drawn(&scene, &event(|t| errands(t, STEPS)).until(25), None), Ok(None));
    let turned_back = |t| errands(if t < 4 { t } else { 8_usize.saturating_sub(t) }, STEPS);
    assert!(drawn(&scene, &event(turned_back).until(20), None).is_err());
    let crossing = drawn(&scene, &event(|t| errands(t, 17)), Some(Manner::Crossing));
    assert_eq!(crossing, Err(RejectionReason::OtherManner));
}

/// Part of the way or all of it, and then trembling on the spot.
#[test]
fn nothing_is_followed_by_more_than_six_seconds_of_rest() {
    let scene = scene(EventKind::Independent, [place(0, 1), place(1, 3)], Attitude::Neutral);
    let resting = |until: usize, arrived: usize| {
        event(move |t| {
            let mut step = errands(t.min(until), arrived);
            step.agents[0].1 += if t % 2 == 0 { 0.1 } else { 0.0 };
            step
        })
    };
    for arrived in [30, STEPS - 24] {
        assert_eq!(drawn(&scene, &resting(STEPS - 24, arrived), None), Err(RejectionReason::Lifeless));
    }
    assert_eq!(drawn(&scene, &resting(STEPS - 23, 30), None), Ok(None), "stuck");
    assert_eq!(drawn(&scene, &resting(STEPS - 23, STEPS - 23), None), Ok(None), "done");
}

#[test]
fn a_chase_lasts_to_the_end() {
    let goals = [crate::selection::TOUCH, crate::selection::TOUCH.negated()];
    let goals = [
        goals[0],
        match goals[1] {
            phase_model::Goal::Touch { sign, .. } => {
                phase_model::Goal::Touch { agent: AgentId::ONE, other: AgentId::ZERO, sign }
            }
            other => other,
        },
    ];
    let scene = scene(EventKind::Chasing, goals, Attitude::Neutral);
    let chase = |until: usize| {
        event(move |t| {
            let t = t.min(until);
            Move {
                agents: [
                    facing(on_way(t, (7.0, 4.0), (19.0, 20.0), 0..STEPS)),
                    facing(on_way(t, (12.0, 4.0), (24.0, 20.0), 0..STEPS)),
                ],
                objects: vec![(8.0, 20.0)],
                held: [None, None],
            }
        })
    };
    assert!(drawn(&scene, &chase(STEPS), None).is_ok());
    assert_eq!(drawn(&scene, &chase(25), None), Err(RejectionReason::NoPursuit));
    // Adversaries may not stand still for more than six seconds.
    assert_eq!(drawn(&scene, &chase(14), None), Err(RejectionReason::Lifeless));
}

/// Both at an object that is fought over from step `from` to step `to`, and agent 1 carries it off later.
fn tug(t: usize, from: usize, to: usize) -> Move {
    let x = 12.0 + 0.4 * t.saturating_sub(to) as f32;
    let left =
        if (from..to).contains(&t) { (x - 2.0, 12.0) } else { on_way(t, (6.5, 4.0), (8.0, 14.0), 0..STEPS) };
    Move { agents: [facing(left), facing((x + 2.0, 12.0))], objects: vec![(x, 12.0)], held: [None, Some(0)] }
}

#[test]
fn agents_that_get_nowhere_let_go_in_time() {
    let rival = phase_model::Goal::ObjectOnLandmark {
        object: phase_model::ObjectId::ZERO,
        landmark: phase_model::LandmarkId::TOP_LEFT,
        sign: phase_model::Sign::Positive,
    };
    let scene = scene(EventKind::Competing, [rival, THING], Attitude::Neutral);
    let knotted =
        |from, to| drawn(&scene, &event(|t| tug(t, from, to)), None) == Err(RejectionReason::Knotted);
    assert!(!knotted(10, 18));
    assert!(knotted(10, 24), "for a third of the event");
    assert!(knotted(34, STEPS + 2), "at the end");
}

/// Agent 0 carries the object to the left for so many steps, and then agent 1 to the right, at first against
/// agent 0.
fn contest(left: usize) -> Track {
    event(move |t| {
        let x = 16.0 - 0.5 * t.min(left) as f32 + 0.5 * t.saturating_sub(left) as f32;
        let agents = [facing((x, 21.0)), facing((x, 18.0))];
        Move {
            agents,
            objects: vec![(x, 19.5)],
            held: [(t <= left + 6).then_some(0), (t >= left).then_some(0)],
        }
    })
}

#[test]
fn competitors_both_get_the_object_their_way() {
    let top = |landmark| phase_model::Goal::ObjectOnLandmark {
        object: phase_model::ObjectId::ZERO,
        landmark,
        sign: phase_model::Sign::Positive,
    };
    let goals = [phase_model::LandmarkId::TOP_LEFT, phase_model::LandmarkId::TOP_RIGHT].map(top);
    let scene = scene(EventKind::Competing, goals, Attitude::Neutral);
    assert_eq!(drawn(&scene, &contest(4), None), Err(RejectionReason::Uncontested));
    assert_ne!(drawn(&scene, &contest(14), None), Err(RejectionReason::Uncontested));
    // Along the line between both landmarks.
    let at = |x: f32| Move { objects: vec![(x, 19.5)], ..Move::default() };
    let track = crate::support::track([14.0, 13.0, 11.0, 15.0, 16.0].map(at));
    assert_eq!(phase_evidence::contest::favours(&track, goals), [3.0, 5.0]);
}
