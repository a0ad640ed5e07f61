//! The published recorder's defect: whichever way an agent turns, its body turns one and the same way.

use phase_model::{Action, Layout};

/// The action that an agent's body carries out when its mind chooses `action`: the action itself, or with
/// `one_way_turns` a left turn for every turn, and a right turn in a reflected layout, as in the published
/// recordings.
///
/// The defect belongs to the body and not to the mind, which does not know of it: simulations and inference
/// have the switch in their own settings.
#[must_use]
pub const fn carried_out(action: Action, one_way_turns: bool, layout: Layout) -> Action {
    match action {
        Action::TurnLeft | Action::TurnRight if one_way_turns => {
            if layout.flip().is_some() {
                Action::TurnRight
            } else {
                Action::TurnLeft
            }
        }
        _ => action,
    }
}
