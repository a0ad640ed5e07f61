//! The published recorder's defect: whichever way an agent turns, its body turns the same way.

use crate::MindParameters;
use phase_model::{Action, Layout};

/// What an agent's body does when its mind chooses an action. With
/// [`one_way_turns`](phase_agent::MindParameters::one_way_turns) all turns are left turns, and right turns in a reflected
/// layout, as in the published recordings; without it, the action itself.
#[must_use]
pub const fn carried_out(action: Action, parameters: &MindParameters, layout: Layout) -> Action {
    match action {
        Action::TurnLeft | Action::TurnRight if parameters.one_way_turns => {
            if layout.flip().is_some() {
                Action::TurnRight
            } else {
                Action::TurnLeft
            }
        }
        _ => action,
    }
}
