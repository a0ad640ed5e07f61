//! Which actions the low level considers for a subgoal.

use phase_model::{Action, AgentId, Entity, Literal, Place, Predicate, State, Subgoal};

/// For locomotion: viewers attribute intent to bodies that move in the direction they face.
const WALKING: [Action; 5] = [Action::TurnLeft, Action::TurnRight, Action::Up, Action::Stop, Action::NoForce];
/// The same with a backward push, for agents in contact: face to face there is no clearance to turn.
const BACKING_OFF: [Action; 6] =
    [Action::TurnLeft, Action::TurnRight, Action::Up, Action::Stop, Action::NoForce, Action::Down];
/// For releasing: come to rest first, so that the object stays in place.
const RELEASING: [Action; 3] = [Action::Stop, Action::NoForce, Action::Detach];
/// Number of leading actions of [`Action::ALL`] without grabbing and letting go.
const WITHOUT_HANDS: usize = 12;
/// Number of leading actions of [`Action::ALL`] without letting go.
const WITHOUT_RELEASE: usize = 13;

/// The actions to search, never empty; a single one needs no search. With `retreats`, pushing backward is included.
#[must_use]
pub fn actions(agent: AgentId, subgoal: Subgoal, state: &State, retreats: bool) -> &'static [Action] {
    let Subgoal::Achieve(Literal { predicate, holds }) = subgoal else { return &[Action::Stop] };
    let free = state.grips[agent].is_none();
    let me = Entity::Agent(agent);
    let held_up = retreats || state.contacts.touching(me, Entity::Agent(agent.other()));
    let walking: &'static [Action] = if held_up { &BACKING_OFF } else { &WALKING };
    match (predicate, holds) {
        (Predicate::Attach(..), false) => &RELEASING,
        (Predicate::Attach(..), true) => &Action::ALL[..WITHOUT_RELEASE],
        (Predicate::On(who, _) | Predicate::Close(who, Place::Landmark(_)), true) if who == me && free => {
            walking
        }
        (Predicate::Close(who, Place::Entity(_)), _) if who == me && free => walking,
        (Predicate::Touch(..), _) if free => walking,
        _ => &Action::ALL[..WITHOUT_HANDS],
    }
}
