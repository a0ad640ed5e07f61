//! Suspicious properties of an event that can nevertheless be used.

use crate::{Recording, error::in_trajectory};
use core::fmt;
use phase_model::{Relation, SceneWarning};

/// Something in an event that is likely to be a mistake. The text names the field and the rule, not the
/// event.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum EventWarning {
    /// A warning about its scene.
    Scene(SceneWarning),
    /// The relation does not follow from goals and attitudes.
    Relation {
        /// The relation given.
        relation: Relation,
        /// The relation that follows from goals and attitudes.
        follows: Relation,
    },
    /// There are more steps than were recorded.
    RecordedSteps {
        /// The stated number of recorded steps.
        recorded: u32,
        /// The steps of the trajectory.
        steps: usize,
    },
}

impl fmt::Display for EventWarning {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Scene(warning) => formatter.write_str(&in_trajectory(&warning.to_string())),
            Self::Relation { relation, follows } => {
                let relation = relation.name();
                let follows = follows.name();
                write!(formatter, "relation is {relation:?}, but goals and attitudes make it {follows:?}")
            }
            Self::RecordedSteps { recorded, steps } => {
                write!(formatter, "recorded_steps is {recorded}, but trajectory has {steps} steps")
            }
        }
    }
}

impl Recording {
    /// Suspicious properties of the event: see [`phase_model::Scene::warnings`], and labels that are
    /// inconsistent with the event. Empty for most events.
    #[must_use]
    pub fn warnings(&self) -> Vec<EventWarning> {
        let mut warnings: Vec<_> = self.scene.warnings().into_iter().map(EventWarning::Scene).collect();
        let relation = self.relation;
        let follows = self.scene.relation();
        if relation != follows {
            warnings.push(EventWarning::Relation { relation, follows });
        }
        let steps = self.trajectory.steps();
        if let Some(recorded) = self.recorded_steps.filter(|&recorded| (recorded as usize) < steps) {
            warnings.push(EventWarning::RecordedSteps { recorded, steps });
        }
        warnings
    }
}
