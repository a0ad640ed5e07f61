//! Suspicious properties of an event that can nevertheless be used.

use crate::{ObservedEvent, Recording, error::in_trajectory};
use core::fmt;
use phase_model::{AGENT_COUNT, Relation, SceneWarning, arena::STEP_SECONDS};

/// Shortest way of all bodies together that is compared with their velocities (u).
const SHORTEST_WAY: f32 = 5.0;
/// Largest ratio of the way that bodies move and the way that their velocities say, or its inverse. In the
/// paper's recordings it is 1.09 at most; a velocity in seconds of video makes it 3.
const LARGEST_RATIO: f32 = 1.5;

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
    /// Velocities do not fit the positions.
    Velocities {
        /// The way that all bodies move from row to row (u).
        moved: f32,
        /// The way that their velocities say (u).
        said: f32,
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
            Self::Velocities { moved, said } => write!(
                formatter,
                "trajectory: bodies move {moved:.1} u in all, but their velocities say {said:.1} u; vx and \
                 vy are per second of physics, of which a step lasts 1/12"
            ),
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
        warnings.extend(self.observed().iter().flat_map(ObservedEvent::warnings));
        warnings
    }
}

impl ObservedEvent {
    /// Suspicious properties of the motion: velocities that do not fit the positions. Empty for most events.
    #[must_use]
    pub fn warnings(&self) -> Vec<EventWarning> {
        let bodies = AGENT_COUNT + self.object_sizes().len();
        let (mut moved, mut said) = (0.0_f32, 0.0_f32);
        for pair in self.rows().windows(2) {
            for (before, after) in pair[0][..bodies].iter().zip(&pair[1]) {
                moved += before.position.distance(after.position);
                said += (0.5 * (before.velocity + after.velocity)).length() * STEP_SECONDS as f32;
            }
        }
        let fits = moved <= LARGEST_RATIO * said && said <= LARGEST_RATIO * moved;
        if fits || moved.max(said) < SHORTEST_WAY {
            return Vec::new();
        }
        vec![EventWarning::Velocities { moved, said }]
    }
}
