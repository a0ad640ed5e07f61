//! The actions that the low-level planner considers for a subgoal.

use phase_model::{Action, AgentId, Literal, Predicate, Subgoal};

/// For releasing: stop first, so that the object stays in place.
const RELEASE_ACTIONS: [Action; 3] = [Action::Stop, Action::NoForce, Action::Detach];
/// Number of leading actions of [`Action::ALL`] without attach and detach.
const ACTIONS_WITHOUT_GRASP: usize = Action::Attach.index();
/// Number of leading actions of [`Action::ALL`] without detach.
const ACTIONS_WITHOUT_RELEASE: usize = Action::Detach.index();

/// The actions to search, never empty; a single one needs no search. All pushes and turns for every subgoal,
/// grasping and releasing for those that are about it: which are likely is a matter of the priors.
#[must_use]
pub fn actions(agent: AgentId, subgoal: Subgoal) -> &'static [Action] {
    match subgoal {
        Subgoal::Stay => &[Action::Stop],
        Subgoal::Achieve(Literal { predicate: Predicate::Attach(who, _), holds }) if who == agent => {
            if holds { &Action::ALL[..ACTIONS_WITHOUT_RELEASE] } else { &RELEASE_ACTIONS }
        }
        Subgoal::Achieve(_) => &Action::ALL[..ACTIONS_WITHOUT_GRASP],
    }
}
