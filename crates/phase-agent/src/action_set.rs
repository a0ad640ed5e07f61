//! The actions that the low-level planner considers for a subgoal.

use phase_model::{Action, AgentId, Entity, Literal, Predicate, PredicateTarget, State, Subgoal};

/// For locomotion: viewers attribute intent to bodies that move in the direction they face.
const WALK_ACTIONS: [Action; 5] =
    [Action::TurnLeft, Action::TurnRight, Action::Up, Action::Stop, Action::NoForce];
/// The same with a backward push, for agents in contact: face to face there is no clearance to turn.
const BACKOFF_ACTIONS: [Action; 6] =
    [Action::TurnLeft, Action::TurnRight, Action::Up, Action::Stop, Action::NoForce, Action::Down];
/// For releasing: stop first, so that the object stays in place.
const RELEASE_ACTIONS: [Action; 3] = [Action::Stop, Action::NoForce, Action::Detach];
/// Number of leading actions of [`Action::ALL`] without attach and detach.
const ACTIONS_WITHOUT_GRASP: usize = 12;
/// Number of leading actions of [`Action::ALL`] without detach.
const ACTIONS_WITHOUT_RELEASE: usize = 13;

/// The actions to search, never empty; a single one needs no search. With `backs_off`, pushing backward is included.
#[must_use]
pub fn actions(agent: AgentId, subgoal: Subgoal, state: &State, backs_off: bool) -> &'static [Action] {
    let Subgoal::Achieve(Literal { predicate, holds }) = subgoal else { return &[Action::Stop] };
    let free = state.grips[agent].is_none();
    let me = Entity::Agent(agent);
    let held_up = backs_off || state.contacts.touching(me, Entity::Agent(agent.other()));
    let walking: &'static [Action] = if held_up { &BACKOFF_ACTIONS } else { &WALK_ACTIONS };
    match (predicate, holds) {
        (Predicate::Attach(..), false) => &RELEASE_ACTIONS,
        (Predicate::Attach(..), true) => &Action::ALL[..ACTIONS_WITHOUT_RELEASE],
        (Predicate::On(who, _) | Predicate::Close(who, PredicateTarget::Landmark(_)), true)
            if who == me && free =>
        {
            walking
        }
        (Predicate::Close(who, PredicateTarget::Entity(_)), _) if who == me && free => walking,
        (Predicate::Touch(..), _) if free => walking,
        _ => &Action::ALL[..ACTIONS_WITHOUT_GRASP],
    }
}
