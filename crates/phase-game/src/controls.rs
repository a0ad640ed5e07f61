//! From the keys of a player to the action of a step.

use phase_model::Action;

/// The keys of a player, between two steps.
///
/// A key that is held acts in every step. One that is pressed and released between two steps acts in the next
/// one, so that a short press is never lost.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) struct Controls {
    held: Action,
    pressed: Option<Action>,
    grab: bool,
}

impl Default for Controls {
    fn default() -> Self {
        Self { held: Action::Stop, pressed: None, grab: false }
    }
}

impl Controls {
    /// The player begins to do something, or with [`Action::Stop`] ceases to. Grabbing and letting go are not
    /// held: [`grab`](Self::grab).
    pub(crate) fn hold(&mut self, action: Action) {
        if !matches!(action, Action::Attach | Action::Detach) {
            self.held = action;
            if action != Action::Stop {
                self.pressed = Some(action);
            }
        }
    }

    /// The player grabs, or lets go.
    pub(crate) const fn grab(&mut self) {
        self.grab = true;
    }

    /// Nothing is held any more.
    pub(crate) fn release(&mut self) {
        *self = Self::default();
    }

    /// The action of the next step, for an agent that holds an object or not.
    pub(crate) fn take(&mut self, holds: bool) -> Action {
        match (core::mem::take(&mut self.grab), holds) {
            // What was pressed beside it acts in the step after.
            (true, true) => Action::Detach,
            (true, false) => Action::Attach,
            (false, _) => self.pressed.take().unwrap_or(self.held),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_held_lasts_and_what_is_pressed_is_not_lost() {
        let mut controls = Controls::default();
        assert_eq!(controls.take(false), Action::Stop);
        controls.hold(Action::Up);
        assert_eq!([controls.take(false), controls.take(false)], [Action::Up, Action::Up]);
        controls.hold(Action::Left);
        controls.hold(Action::Stop);
        assert_eq!([controls.take(false), controls.take(false)], [Action::Left, Action::Stop]);
    }

    #[test]
    fn one_key_grabs_and_lets_go() {
        let mut controls = Controls::default();
        controls.hold(Action::Up);
        controls.grab();
        assert_eq!(controls.take(false), Action::Attach);
        assert_eq!(controls.take(true), Action::Up);
        controls.grab();
        assert_eq!(controls.take(true), Action::Detach);
        controls.hold(Action::Left);
        controls.hold(Action::Stop);
        controls.grab();
        assert_eq!([controls.take(false), controls.take(true)], [Action::Attach, Action::Left]);
        controls.hold(Action::Up);
        controls.hold(Action::Attach);
        assert_eq!(controls.take(true), Action::Up);
        controls.grab();
        controls.release();
        assert_eq!(controls.take(false), Action::Stop);
    }
}
