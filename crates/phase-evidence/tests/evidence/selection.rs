//! Synthetic events that show their label, and reasons why others do not.

use crate::support::{Move, track};
use phase_evidence::{
    Track,
    selection::{CausalEffect, Counterfactual, Ending, RejectionReason, check_event},
};
use phase_model::{
    AgentId, AgentSpec, Attitude, Body, EventKind, Goal, LandmarkId, Layout, ObjectId, ObjectSpec, Scene,
    Sign, Size, Strength,
};

/// Steps of the synthetic events.
pub(super) const STEPS: usize = 40;

pub(super) fn place(agent: u8, landmark: u8) -> Goal {
    Goal::AgentOnLandmark {
        agent: AgentId::ALL[usize::from(agent)],
        landmark: LandmarkId::ALL[usize::from(landmark)],
        sign: Sign::Positive,
    }
}

/// Object 0 on landmark 2, whose centre is (23.5, 4.5).
pub(super) const THING: Goal = Goal::ObjectOnLandmark {
    object: ObjectId::ZERO,
    landmark: LandmarkId::BOTTOM_RIGHT,
    sign: Sign::Positive,
};
pub(super) const TOUCH: Goal =
    Goal::Touch { agent: AgentId::ZERO, other: AgentId::ONE, sign: Sign::Positive };

pub(super) fn scene(kind: EventKind, goals: [Goal; 2], first: Attitude) -> Scene {
    let agent = |goal, attitude| AgentSpec {
        size: Size::Small,
        strength: Strength::Fair,
        goal,
        attitude,
        awareness: phase_model::Awareness::default(),
        start: Body::default(),
    };
    let object = ObjectSpec { size: Size::Small, start: Body::default() };
    Scene {
        layout: Layout::new(0, None).expect("a layout"),
        agents: [agent(goals[0], first), agent(goals[1], Attitude::Neutral)],
        objects: vec![object],
        kind,
    }
}

/// Somewhere on the way from one point to another, from one step to another.
pub(super) fn on_way(
    t: usize,
    from: (f32, f32),
    to: (f32, f32),
    steps: core::ops::Range<usize>,
) -> (f32, f32) {
    let share = (t.saturating_sub(steps.start) as f32 / (steps.end - steps.start) as f32).min(1.0);
    (from.0 + share * (to.0 - from.0), from.1 + share * (to.1 - from.1))
}

pub(super) fn event(at: impl Fn(usize) -> Move) -> Track {
    track((0..=STEPS).map(at))
}

pub(super) fn facing((x, y): (f32, f32)) -> (f32, f32, f32) {
    (x, y, 0.0)
}

/// Agent 0 fetches the object at (12, 4.5), releases it at step 30 and stays; agent 1 stands by.
pub(super) fn fetch(t: usize) -> Move {
    let agent = if t < 10 {
        on_way(t, (8.0, 8.0), (10.0, 4.5), 0..10)
    } else {
        on_way(t, (10.0, 4.5), (21.5, 4.5), 10..30)
    };
    let object = on_way(t, (12.0, 4.5), (23.5, 4.5), 10..30);
    let held = (10..30).contains(&t).then_some(0);
    Move { agents: [facing(agent), (8.0, 18.0, 0.0)], objects: vec![object], held: [held, None] }
}

fn refusal(scene: &Scene, track: &Track) -> Option<RejectionReason> {
    check_event(scene, track, STEPS..=100, Ending::Settled).err()
}

#[test]
fn help_needs_a_goal_reached_in_time_a_hand_and_a_quiet_end() {
    let scene = scene(EventKind::Helping, [THING, THING], Attitude::Help);
    // Agent 1 starts out for it before it is taken, and lends a hand on the way.
    let helped = |t| {
        let helpee = on_way(t, (8.0, 18.0), (8.0, 14.0), 0..8);
        let fetched = fetch(t);
        let held = [fetched.held[0], (20..25).contains(&t).then_some(0)];
        Move { agents: [fetched.agents[0], facing(helpee)], held, ..fetched }
    };
    let good = event(helped);
    let counterfactual = Counterfactual {
        idle: AgentId::ZERO,
        judged: AgentId::ONE,
        change: CausalEffect::Helped,
        cut: false,
    };
    assert_eq!(check_event(&scene, &good, STEPS..=100, Ending::Settled), Ok(Some(counterfactual)));
    assert_eq!(check_event(&scene, &good, 41..=100, Ending::Settled), Err(RejectionReason::TooShort));
    assert_eq!(check_event(&scene, &good, 10..=39, Ending::Settled), Err(RejectionReason::TooLong));

    type Spoil = fn(usize, &mut Move);
    let cases: [(&str, Spoil, RejectionReason); 8] = [
        ("not wanted by anybody else", |_, it| it.agents[1] = (8.0, 18.0, 0.0), RejectionReason::Aimless),
        (
            "wanted once it is gone",
            |t, it| it.agents[1] = facing(on_way(t, (8.0, 18.0), (18.0, 5.0), 12..30)),
            RejectionReason::Aimless,
        ),
        ("left on the way", |_, it| it.objects[0].0 = it.objects[0].0.min(15.0), RejectionReason::GoalMissed),
        ("never in hand", |_, it| it.held = [None, None], RejectionReason::NoContact),
        (
            "there at once",
            |t, it| {
                if t > 2 {
                    it.objects[0] = (23.5, 4.5)
                }
            },
            RejectionReason::TooSoon,
        ),
        ("never in its own hand", |_, it| it.held[1] = None, RejectionReason::Aimless),
        ("still in hand", |t, it| it.held[0] = (t >= 10).then_some(0), RejectionReason::Restless),
        ("turning to the end", |t, it| it.agents[1].2 = t as f32, RejectionReason::Restless),
    ];
    for (what, change, reason) in cases {
        let changed = |t| {
            let mut step = helped(t);
            change(t, &mut step);
            step
        };
        assert_eq!(refusal(&scene, &event(changed)), Some(reason), "{what}");
    }
}

#[test]
fn an_effect_is_a_difference_to_the_event_without_the_agent() {
    let scene = scene(EventKind::Helping, [THING, THING], Attitude::Help);
    let counterfactual = Counterfactual {
        idle: AgentId::ZERO,
        judged: AgentId::ONE,
        change: CausalEffect::Helped,
        cut: false,
    };
    let with = event(fetch);
    let without = event(|_| fetch(0));
    assert_eq!(counterfactual.judge(&scene, &with, &without), Ok(()));
    assert_eq!(counterfactual.judge(&scene, &with, &with), Err(RejectionReason::NoEffect));
    let hindered = Counterfactual { change: CausalEffect::Hindered, ..counterfactual };
    assert_eq!(hindered.judge(&scene, &with, &without), Err(RejectionReason::NoEffect));
    assert_eq!(hindered.judge(&scene, &without, &with), Ok(()));
    assert_eq!(counterfactual.scene(&scene).attitudes(), [Attitude::Neutral; 2]);
    assert_eq!(counterfactual.scene(&scene).goals(), scene.goals());
}

/// Agent 1 moves to within 3 u of landmark 1 (23.5, 19.5) and finds agent 0 there.
fn stopped(t: usize) -> Move {
    let victim = on_way(t, (8.0, 19.5), (20.5, 19.5), 0..20);
    Move { agents: [(22.4, 19.5, 0.0), facing(victim)], objects: vec![(10.0, 6.0)], held: [None, None] }
}

#[test]
fn hindrance_needs_a_victim_after_something_and_somebody_in_its_way() {
    let goals = [place(1, 1).negated(), place(1, 1)];
    let scene = scene(EventKind::Hindering, goals, Attitude::Hinder);
    let counterfactual = Counterfactual {
        idle: AgentId::ZERO,
        judged: AgentId::ONE,
        change: CausalEffect::Hindered,
        cut: false,
    };
    assert_eq!(check_event(&scene, &event(stopped), STEPS..=100, Ending::Settled), Ok(Some(counterfactual)));
    let lazy = event(|t| Move { agents: [(22.4, 19.5, 0.0), (8.0, 19.5, t as f32)], ..stopped(t) });
    assert_eq!(refusal(&scene, &lazy), Some(RejectionReason::Aimless));
    let aloof = event(|t| Move { agents: [(8.0, 4.0, 0.0), stopped(t).agents[1]], ..stopped(t) });
    assert_eq!(refusal(&scene, &aloof), Some(RejectionReason::NoContact));
}

/// Touched in 13 of the 31 steps from the first touch on, in 16, and in all.
#[test]
fn who_gets_loose_was_chased() {
    let scene = scene(EventKind::Chasing, [TOUCH, TOUCH.negated()], Attitude::Neutral);
    let counterfactual = Counterfactual {
        idle: AgentId::ONE,
        judged: AgentId::ZERO,
        change: CausalEffect::Hindered,
        cut: false,
    };
    let touching = |share: usize| {
        event(move |t| {
            let apart = if t >= 10 && t % 10 < share { 2.0 } else { 6.0 };
            let agents = [(8.0, 6.0, 0.0), (8.0, 6.0 + apart, 0.0)];
            Move { agents, objects: vec![(12.0, 18.0)], held: [None, None] }
        })
    };
    let without = touching(10);
    assert_eq!(counterfactual.judge(&scene, &touching(4), &without), Ok(()));
    assert_eq!(counterfactual.judge(&scene, &touching(5), &without), Err(RejectionReason::NoEffect));
    let helped = Counterfactual { change: CausalEffect::Helped, ..counterfactual };
    assert_eq!(helped.judge(&scene, &touching(4), &without), Err(RejectionReason::NoEffect));
}

/// Agent 0 pursues agent 1, which escapes from step 5 on, and follows close behind.
fn hunt(t: usize, speed: f32) -> Move {
    let fleer = 14.0 + speed * t.saturating_sub(5) as f32;
    let chaser = (7.0 + 0.35 * t as f32).min(fleer - 3.5);
    Move { agents: [(chaser, 6.0, 0.0), (fleer, 6.0, 0.0)], objects: vec![(10.0, 18.0)], held: [None, None] }
}

#[test]
fn a_chase_needs_pursuit_and_flight() {
    let scene = scene(EventKind::Chasing, [TOUCH, TOUCH.negated()], Attitude::Neutral);
    let counterfactual = Counterfactual {
        idle: AgentId::ONE,
        judged: AgentId::ZERO,
        change: CausalEffect::Hindered,
        cut: false,
    };
    let good = event(|t| hunt(t, 0.2));
    assert_eq!(check_event(&scene, &good, STEPS..=100, Ending::Settled), Ok(Some(counterfactual)));
    assert_eq!(refusal(&scene, &event(|t| hunt(t, 0.0))), Some(RejectionReason::NoFlight));
    // An agent that flees for a while and is then held down was not chased but caught.
    let pinned = |since: usize| {
        event(move |t| {
            let fleer = hunt(t, 0.2).agents[1];
            let caught = t >= since;
            let chaser = if caught { (fleer.0 - 2.5, 6.0, 0.0) } else { hunt(t, 0.2).agents[0] };
            Move { agents: [chaser, fleer], ..hunt(t, 0.2) }
        })
    };
    assert_eq!(refusal(&scene, &pinned(22)), None);
    assert_eq!(refusal(&scene, &pinned(18)), Some(RejectionReason::NoFlight));
    let idle = event(|t| Move { agents: [(7.0, 6.0, 0.0), hunt(t, 0.2).agents[1]], ..hunt(t, 0.2) });
    assert_eq!(refusal(&scene, &idle), Some(RejectionReason::NoPursuit));
    // The same between an agent that evades and one that is kept from touching it, agent 1 being the one that
    // evades.
    let mut evading = scene.clone();
    evading.kind = EventKind::Hindering;
    evading.agents[1].attitude = Attitude::Hinder;
    let counterfactual = Counterfactual {
        idle: AgentId::ONE,
        judged: AgentId::ZERO,
        change: CausalEffect::Hindered,
        cut: false,
    };
    assert_eq!(check_event(&evading, &good, STEPS..=100, Ending::Settled), Ok(Some(counterfactual)));
}

#[test]
fn a_contest_needs_two_at_the_object_and_an_issue() {
    let other = Goal::ObjectOnLandmark {
        object: ObjectId::ZERO,
        landmark: LandmarkId::TOP_LEFT,
        sign: Sign::Positive,
    };
    let scene = scene(EventKind::Competing, [THING, other], Attitude::Neutral);
    // Agent 1 has been at the object, where agent 0 then takes it from.
    let met = |t| {
        let mut step = fetch(t);
        step.agents[1] = facing(on_way(t, (12.0, 12.0), (12.0, 6.4), 0..6));
        step
    };
    let counterfactual = Counterfactual {
        idle: AgentId::ZERO,
        judged: AgentId::ONE,
        change: CausalEffect::Hindered,
        cut: false,
    };
    assert_eq!(check_event(&scene, &event(met), STEPS..=100, Ending::Settled), Ok(Some(counterfactual)));
    assert_eq!(refusal(&scene, &event(fetch)), Some(RejectionReason::Aimless));
    let near_miss =
        |t| Move { agents: [met(t).agents[0], facing(on_way(t, (12.0, 14.0), (12.0, 9.0), 0..6))], ..met(t) };
    assert_eq!(refusal(&scene, &event(near_miss)), Some(RejectionReason::Uncontested));
    // They pull at it, and it stays where it is.
    let tug = |pulling: usize| {
        move |t: usize| {
            let held = (10..10 + pulling).contains(&t).then_some(0);
            let first = met(t.min(9)).agents[0];
            Move { agents: [first, met(t).agents[1]], objects: vec![(12.0, 4.5)], held: [held, held] }
        }
    };
    assert!(check_event(&scene, &event(tug(5)), STEPS..=100, Ending::Settled).is_ok());
    assert_eq!(refusal(&scene, &event(tug(4))), Some(RejectionReason::Uncontested));
}

#[test]
fn collaborating_is_carrying_together_or_by_turns() {
    let scene = scene(EventKind::Collaborating, [THING, THING], Attitude::Neutral);
    let holding = |first: core::ops::Range<usize>, second: core::ops::Range<usize>| {
        move |t: usize| {
            let held = [first.contains(&t).then_some(0), second.contains(&t).then_some(0)];
            Move { held, ..fetch(t) }
        }
    };
    let cases = [
        (10..30, 10..30, None),
        (10..30, 26..29, None),
        (10..20, 20..30, None),
        (10..30, 28..30, Some(RejectionReason::NotTogether)),
        (10..30, 0..0, Some(RejectionReason::NotTogether)),
    ];
    for (first, second, expected) in cases {
        let track = event(holding(first.clone(), second.clone()));
        assert_eq!(refusal(&scene, &track), expected, "{first:?} {second:?}");
    }
}

#[test]
fn independent_agents_reach_their_goals_and_leave_each_other_alone() {
    let scene = scene(EventKind::Independent, [THING, place(1, 1)], Attitude::Neutral);
    let walk = |t: usize| {
        let mut step = fetch(t);
        step.agents[1] = facing(on_way(t, (8.0, 19.5), (23.5, 19.5), 0..20));
        step
    };
    assert_eq!(check_event(&scene, &event(walk), STEPS..=100, Ending::Settled), Ok(None));
    assert_eq!(refusal(&scene, &event(fetch)), Some(RejectionReason::GoalMissed));
    let meddling = event(|t| Move { held: [walk(t).held[0], (t == 3).then_some(0)], ..walk(t) });
    assert_eq!(refusal(&scene, &meddling), Some(RejectionReason::Interference));
    let entangled = |t: usize| {
        let mut step = walk(t);
        if t < 10 {
            step.agents[1] = (step.agents[0].0, step.agents[0].1 + 1.5, 0.0);
        }
        step
    };
    assert_eq!(refusal(&scene, &event(entangled)), Some(RejectionReason::Interference));
}
