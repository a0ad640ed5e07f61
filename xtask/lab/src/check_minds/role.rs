//! The part that an agent plays in an event.

use phase_model::{AgentId, Attitude, EventKind, Scene, Sign};
use serde::Serialize;

/// The part that an agent plays in an event, which follows from goals and attitudes of both.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug, Serialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum Role {
    /// Hinders the other.
    Hinderer,
    /// Is hindered.
    Victim,
    /// Wants the same object elsewhere.
    Competitor,
    /// Wants to touch an agent that gets away.
    Chaser,
    /// Gets away from an agent that wants to touch it.
    Fleer,
    /// Wants the same as the other.
    Collaborator,
    /// Helps the other.
    Helper,
    /// Is helped.
    Helpee,
    /// Has nothing to do with the other.
    Independent,
}

impl Role {
    /// All roles.
    pub(super) const ALL: [Self; 9] = [
        Self::Hinderer,
        Self::Victim,
        Self::Competitor,
        Self::Chaser,
        Self::Fleer,
        Self::Collaborator,
        Self::Helper,
        Self::Helpee,
        Self::Independent,
    ];

    /// The role of an agent of a scene.
    pub(super) fn of(scene: &Scene, agent: AgentId) -> Self {
        let attitudes = scene.agents.map(|agent| agent.attitude);
        match (attitudes[agent], attitudes[agent.other()]) {
            (Attitude::Help, _) => Self::Helper,
            (Attitude::Hinder, _) => Self::Hinderer,
            (Attitude::Neutral, Attitude::Help) => Self::Helpee,
            (Attitude::Neutral, Attitude::Hinder) => Self::Victim,
            (Attitude::Neutral, Attitude::Neutral) => match EventKind::of(scene.goals(), attitudes) {
                EventKind::Collaborating => Self::Collaborator,
                EventKind::Competing => Self::Competitor,
                EventKind::Chasing if scene.agents[agent].goal.sign() == Sign::Positive => Self::Chaser,
                EventKind::Chasing => Self::Fleer,
                EventKind::Helping | EventKind::Hindering | EventKind::Independent => Self::Independent,
            },
        }
    }

    /// The name used in files and tables.
    pub(super) const fn name(self) -> &'static str {
        match self {
            Self::Hinderer => "hinderer",
            Self::Victim => "victim",
            Self::Competitor => "competitor",
            Self::Chaser => "chaser",
            Self::Fleer => "fleer",
            Self::Collaborator => "collaborator",
            Self::Helper => "helper",
            Self::Helpee => "helpee",
            Self::Independent => "independent",
        }
    }
}
