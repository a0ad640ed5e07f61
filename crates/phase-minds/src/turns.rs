//! The published recorder's defects: bodies that do not do what minds choose.

use phase_model::{Action, AgentBody, Layout, Strength};

/// The published recorder's defects that agents' bodies have. They belong to the body and not to the mind:
/// simulations and inference have the switches in their own settings.
#[derive(Clone, Copy, PartialEq, Eq, Default, Debug)]
pub struct Recorder {
    /// Whether bodies turn one way whichever way their minds choose: to the left, and to the right in a
    /// reflected layout. The mind does not know of it.
    pub one_way_turns: bool,
    /// Whether `stop` has no effect on agents of the greatest strength, which coast instead. The minds of the
    /// recordings knew of it: [`PublishedParameters::strongest_coasts`](crate::PublishedParameters).
    pub strongest_coasts: bool,
}

impl Recorder {
    /// The recorder of the published events.
    pub const PUBLISHED: Self = Self { one_way_turns: true, strongest_coasts: true };

    /// The action that an agent's body carries out when its mind chooses one: that action, but for the
    /// defects.
    #[must_use]
    pub fn carried_out(self, action: Action, agent: &AgentBody, layout: Layout) -> Action {
        match action {
            Action::TurnLeft | Action::TurnRight if self.one_way_turns => {
                if layout.flip().is_some() {
                    Action::TurnRight
                } else {
                    Action::TurnLeft
                }
            }
            Action::Stop if self.strongest_coasts && agent.max_force >= Strength::Mighty.max_force() => {
                Action::NoForce
            }
            _ => action,
        }
    }
}
