//! Discovery of the other's goal by helpers and hinderers, in events made of thoughts.

use crate::selection::{THING, event, place, scene};
use phase_event::{BelievedIntent, Event, Step, Thought};
use phase_evidence::{
    Discovery, Manner, Track,
    selection::{RejectionReason, check_discovery},
};
use phase_model::{
    Action, AgentId, Attitude, Awareness, Body, Entity, EventKind, Goal, Intent, Level, Literal, Predicate,
    PredicateTarget, State, Subgoal, Vec2,
};

/// A step of agent 0: it watches, perhaps with a wrong idea, or pursues a plan for a goal that it supposes.
#[derive(Clone, Copy)]
enum Does {
    Watch,
    Suppose(Goal),
    LookForOther,
    Act(Goal),
    /// It acts on a wrong goal that fewer than half of its particles have.
    Try,
}

fn thought(does: Does) -> Thought {
    let close =
        Predicate::Close(Entity::Agent(AgentId::ZERO), PredicateTarget::Entity(Entity::Agent(AgentId::ONE)));
    let subgoal = Subgoal::Achieve(Literal::is(close));
    let intent =
        |goal| BelievedIntent { intent: Intent { attitude: Attitude::Neutral, goal }, particles: 50 };
    match does {
        Does::Watch => Thought { intents: vec![intent(THING)], ..Thought::IDLE },
        Does::Suppose(goal) => Thought { intents: vec![intent(goal)], ..Thought::IDLE },
        Does::LookForOther => Thought { subgoal, intents: vec![intent(THING)], ..Thought::IDLE },
        Does::Try => {
            let of = |goal, particles| BelievedIntent { particles, ..intent(goal) };
            let intents = vec![of(place(1, 0), 20), of(THING, 15), of(place(1, 1), 15)];
            Thought { subgoal, plan: vec![subgoal], intents, ..Thought::IDLE }
        }
        Does::Act(goal) => {
            Thought { subgoal, plan: vec![subgoal], intents: vec![intent(goal)], ..Thought::IDLE }
        }
    }
}

/// An event in which agent 0, which helps and reasons at a level, does this.
fn helping(level: Level, does: &[(Does, usize)]) -> Event {
    let mut scene = scene(EventKind::Helping, [THING, THING], Attitude::Help);
    scene.agents[0].awareness = Awareness::ignorant(level);
    let state: State =
        event(|_| crate::support::Move { objects: vec![(0.0, 0.0)], ..Default::default() }).states[0];
    let step = |does| Step {
        actions: [Action::Stop; 2],
        thoughts: [thought(does), Thought::IDLE],
        substeps: [state; 5],
    };
    let steps = does.iter().flat_map(|&(does, times)| core::iter::repeat_n(does, times)).map(step).collect();
    Event { scene, seed: 1, initial: state, steps }
}

#[test]
fn acts_count_as_right_only_for_the_others_goal() {
    let wrong = Does::Act(place(1, 0));
    let seen =
        helping(Level::One, &[(Does::Watch, 9), (Does::LookForOther, 3), (wrong, 5), (Does::Act(THING), 10)]);
    let discovery = Discovery::of(&seen).expect("an agent finds out");
    assert_eq!(
        discovery,
        Discovery { watched: 12, mistaken: 5, wrong: 5, right: 10, misled: 5, learning: None }
    );
    assert_eq!(check_discovery(&seen), Ok(()));
    let track = Track::of_event(&seen);
    let manners = Manner::of_event(&seen, &track);
    assert_eq!(manners, [Manner::WatchingFirst, Manner::Correcting, Manner::MistakenHelp]);
    let ends_wrong = helping(Level::One, &[(Does::Act(THING), 20), (wrong, 4)]);
    assert_eq!(Manner::of_event(&ends_wrong, &track), [Manner::MistakenHelp]);
    let doubts = helping(Level::One, &[(Does::Try, 12), (Does::Act(THING), 20)]);
    assert_eq!(Manner::of_event(&doubts, &track), [Manner::Correcting]);

    let refused: [&[(Does, usize)]; 3] = [
        &[(Does::Watch, 40)],
        &[(Does::Watch, 30), (Does::Act(THING), 7)],
        &[(wrong, 12), (Does::Act(THING), 11)],
    ];
    for does in refused {
        assert_eq!(check_discovery(&helping(Level::Two, does)), Err(RejectionReason::Mistaken));
    }
    let at_once = helping(Level::One, &[(Does::Watch, 7), (wrong, 3), (Does::Act(THING), 20)]);
    assert_eq!(Manner::of_event(&at_once, &track), []);
}

/// Agent 1 walks away from agent 0, which faces it or looks away, and learns the goal in step 6.
fn shows(looks_on: bool, act: Goal) -> Vec<Manner> {
    let doubtful = Does::Suppose(place(1, 0));
    let mut seen = helping(Level::One, &[(doubtful, 6), (Does::Watch, 1), (Does::Act(act), 20)]);
    let angle = if looks_on { 0.0 } else { core::f32::consts::PI };
    for (t, step) in seen.steps.iter_mut().enumerate() {
        let up = 12.0 + 0.25 * t as f32;
        for state in &mut step.substeps {
            *state.body_mut(Entity::Agent(AgentId::ZERO)) = Body::at_rest(Vec2::new(16.0, 4.0), angle);
            *state.body_mut(Entity::Agent(AgentId::ONE)) = Body::at_rest(Vec2::new(16.0, up), 0.0);
        }
    }
    Manner::of_event(&seen, &Track::of_event(&seen))
}

#[test]
fn a_goal_is_shown_by_motion_that_the_helper_sees_before_it_acts() {
    assert_eq!(shows(true, THING), [Manner::LeadingByShowing]);
    assert_eq!(shows(false, THING), []);
    // What it has learnt is not what it acts on.
    assert_eq!(shows(true, place(1, 0)), [Manner::MistakenHelp]);
    let wrong = Does::Suppose(place(1, 0));
    let learning =
        |does: &[(Does, usize)]| Discovery::of(&helping(Level::One, does)).and_then(|it| it.learning);
    let act = (Does::Act(place(1, 0)), 2);
    assert_eq!(learning(&[(wrong, 3), act, (wrong, 4), (Does::Act(THING), 20)]), Some((5, 9)));
    // It acts until it has learnt the goal, knows it from the first step on, or never learns it.
    assert_eq!(learning(&[(wrong, 3), act, (Does::Act(THING), 20)]), None);
    assert_eq!(learning(&[(Does::Act(THING), 20)]), None);
    assert_eq!(learning(&[(wrong, 20)]), None);
}

#[test]
fn only_agents_that_reason_about_an_unknown_goal_find_out() {
    let does = [(Does::Act(place(1, 0)), 30)];
    let mut knowing = helping(Level::One, &does);
    knowing.scene.agents[0].awareness = Awareness::default();
    let mut neutral = helping(Level::One, &does);
    neutral.scene.agents[0].attitude = Attitude::Neutral;
    for event in [knowing, neutral, helping(Level::Zero, &does)] {
        assert_eq!((Discovery::of(&event), check_discovery(&event)), (None, Ok(())));
    }
}
