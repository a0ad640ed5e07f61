//! Discovery of the other's goal by helpers and hinderers, in events made of thoughts.

use crate::selection::{THING, event, place, scene};
use phase_event::{BelievedIntent, Event, Step, Thought};
use phase_evidence::{
    Discovery, Manner, Track,
    selection::{RejectionReason, check_discovery},
};
use phase_model::{
    Action, AgentId, Attitude, Awareness, Entity, EventKind, Goal, Intent, Level, Literal, Predicate,
    PredicateTarget, State, Subgoal,
};

/// A step of agent 0: it watches, or pursues a plan for a goal that it supposes.
#[derive(Clone, Copy)]
enum Does {
    Watch,
    LookForOther,
    Act(Goal),
}

fn thought(does: Does) -> Thought {
    let close =
        Predicate::Close(Entity::Agent(AgentId::ZERO), PredicateTarget::Entity(Entity::Agent(AgentId::ONE)));
    let subgoal = Subgoal::Achieve(Literal::is(close));
    let intent =
        |goal| BelievedIntent { intent: Intent { attitude: Attitude::Neutral, goal }, particles: 50 };
    match does {
        Does::Watch => Thought { intents: vec![intent(THING)], ..Thought::IDLE },
        Does::LookForOther => Thought { subgoal, intents: vec![intent(THING)], ..Thought::IDLE },
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
    assert_eq!(discovery, Discovery { watched: 12, mistaken: 5, wrong: 5, right: 10 });
    assert_eq!(check_discovery(&seen), Ok(()));
    let track = Track::of_event(&seen);
    assert_eq!(Manner::of_event(&seen, &track), [Manner::WatchingFirst, Manner::Correcting]);

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
