//! Settings of a simulation: engine, length, parameters of the minds.

use phase_minds::{MindParameters, RangeError, Recorder};
use phase_model::AgentId;
use serde::{Deserialize, Serialize};

/// The physics that an event itself is simulated in. The agents' searches use `phase-forward` in either case.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Engine {
    /// `phase-world`: the reference world, simulated by rapier2d.
    #[default]
    World,
    /// `phase-forward` with its warm-starting cache: closest to the published simulator, and faster.
    Forward,
}

impl Engine {
    /// All engines.
    pub const ALL: [Self; 2] = [Self::World, Self::Forward];

    /// The engine of a name, as [`name`](Self::name) gives it.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|engine| engine.name() == name)
    }

    /// The name used in files and options.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::World => "world",
            Self::Forward => "forward",
        }
    }
}

/// The settings of a simulation: engine, length, bodies and minds. The defaults are the paper's.
///
/// In a file they are one object with a member for every field, of which `idle` and `stop_between_steps` are
/// left out at their defaults. [`validate`](Self::validate) checks ranges; [`simulate`](crate::simulate) does
/// so itself.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
pub struct SimulationSettings {
    /// The engine that simulates the event.
    pub engine: Engine,
    /// Maximum length (steps of 0.25 s; the paper's 25 s).
    pub max_steps: usize,
    /// Minimum length unless `max_steps` is smaller (steps; the paper's 10 s).
    pub min_steps: usize,
    /// An event ends once, for this many consecutive steps, neither agent had anything to do and nothing
    /// moved.
    pub rest_steps: usize,
    /// An event also ends once nothing has moved for this many consecutive steps, whatever the subgoals.
    pub still_steps: usize,
    /// An agent that stops and stays whatever its goal, so that an event can be compared with its
    /// counterfactual without that agent; usually none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub idle: Option<AgentId>,
    /// Whether both agents' velocities are set to zero after every step, which makes agents easier to
    /// control, as in the paper's two-player game (appendix, "Experiment 2"); never where minds play alone.
    #[serde(default, skip_serializing_if = "core::ops::Not::not")]
    pub stop_between_steps: bool,
    /// Whether bodies turn one way whichever way their minds choose: to the left, and to the right in a
    /// reflected layout. It is a defect of the published recorder, of which its minds do not know.
    pub one_way_turns: bool,
    /// Whether `stop` has no effect on agents of the greatest strength, another defect of that recorder, of
    /// which its minds do know ([`phase_minds::PublishedParameters`]).
    #[serde(default, skip_serializing_if = "core::ops::Not::not")]
    pub strongest_coasts: bool,
    /// Parameters of both agents' minds.
    pub minds: MindParameters,
}

impl SimulationSettings {
    /// The defects of the agents' bodies.
    #[must_use]
    pub const fn recorder(&self) -> Recorder {
        Recorder { one_way_turns: self.one_way_turns, strongest_coasts: self.strongest_coasts }
    }

    /// Checks that every parameter of the minds is in its range.
    ///
    /// # Errors
    /// [`RangeError`], which names the parameter and its range.
    pub fn validate(&self) -> Result<(), RangeError> {
        self.minds.validate()
    }
}

impl Default for SimulationSettings {
    fn default() -> Self {
        Self {
            engine: Engine::default(),
            max_steps: 100,
            min_steps: 40,
            rest_steps: 8,
            still_steps: 24,
            idle: None,
            stop_between_steps: false,
            one_way_turns: false,
            strongest_coasts: false,
            minds: MindParameters::default(),
        }
    }
}
