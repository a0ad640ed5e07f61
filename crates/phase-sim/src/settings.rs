//! Settings of a simulation: engine, length, parameters of the minds.

use phase_minds::{MindParameters, Recorder};
use phase_model::{
    AgentId,
    json::{FieldError, read_as},
    setting::{EVENT_STEPS, RangeError, Setting},
};
use serde::{Deserialize, Serialize, de::IgnoredAny};
use serde_json::Value;

/// Least length (steps). It may be 0, and above the greatest length, which then counts.
const MIN_STEPS: Setting = Setting::whole("min_steps", "steps", 0, 10_000);

/// The physics that an event itself is simulated in. The agents' searches use `phase-forward` in either case.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Engine {
    /// `phase-world`: the reference world, simulated by rapier2d.
    #[default]
    World,
    /// `phase-forward` with its warm-starting cache: closest to the published simulator, and faster.
    Forward,
    /// `phase_forward::OriginalWorld`: the published simulator's own, bit for bit. It makes a substep before
    /// the first step.
    Original,
}

impl Engine {
    /// All engines.
    pub const ALL: [Self; 3] = [Self::World, Self::Forward, Self::Original];

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
            Self::Original => "original",
        }
    }
}

/// The settings of a simulation: engine, length, bodies and minds. The defaults are the paper's.
///
/// In a file they are one object with a member for every field, of which `idle` and `stop_between_steps` are
/// left out at their defaults. Reading them checks ranges, as [`validate`](Self::validate) does;
/// [`simulate`](crate::simulate) does so itself.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
#[serde(try_from = "Unchecked")]
pub struct SimulationSettings {
    /// The engine that simulates the event.
    pub engine: Engine,
    /// Maximum length (steps of 0.25 s; the paper's 25 s), in the range [`EVENT_STEPS`].
    pub max_steps: usize,
    /// Minimum length unless `max_steps` is smaller (steps; the paper's 10 s), 0 to 10000.
    pub min_steps: usize,
    /// An event ends once, for this many consecutive steps, neither agent had anything to do and nothing
    /// moved; never, if they are more than `max_steps`.
    pub rest_steps: usize,
    /// An event also ends once nothing has moved for this many consecutive steps, whatever the subgoals;
    /// never, if they are more than `max_steps`.
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

/// Settings as a file has them, whose ranges have not been checked but for those of minds.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Unchecked {
    engine: Engine,
    max_steps: usize,
    min_steps: usize,
    rest_steps: usize,
    still_steps: usize,
    #[serde(default)]
    idle: Option<AgentId>,
    #[serde(default)]
    stop_between_steps: bool,
    one_way_turns: bool,
    #[serde(default)]
    strongest_coasts: bool,
    minds: MindParameters,
    /// The part of the world that players saw: a setting of the two-player game, which stands beside these.
    #[serde(default, rename = "view")]
    _view: Option<IgnoredAny>,
}

impl Unchecked {
    const fn settings(self) -> SimulationSettings {
        let Self { engine, max_steps, min_steps, rest_steps, still_steps, idle, .. } = self;
        let Self { stop_between_steps, one_way_turns, strongest_coasts, minds, .. } = self;
        SimulationSettings {
            engine,
            max_steps,
            min_steps,
            rest_steps,
            still_steps,
            idle,
            stop_between_steps,
            one_way_turns,
            strongest_coasts,
            minds,
        }
    }
}

impl TryFrom<Unchecked> for SimulationSettings {
    type Error = RangeError;

    fn try_from(read: Unchecked) -> Result<Self, RangeError> {
        let settings = read.settings();
        settings.validate()?;
        Ok(settings)
    }
}

impl SimulationSettings {
    /// The defects of the agents' bodies.
    #[must_use]
    pub const fn recorder(&self) -> Recorder {
        Recorder { one_way_turns: self.one_way_turns, strongest_coasts: self.strongest_coasts }
    }

    /// Settings as a file has them. `field` is their path in the file, for the error.
    ///
    /// ```
    /// use phase_sim::SimulationSettings;
    ///
    /// let mut settings = serde_json::to_value(SimulationSettings::default())?;
    /// settings["minds"]["particles"] = 1_000_000_000.into();
    /// let refused = SimulationSettings::read(&settings, "settings").unwrap_err();
    /// let rule = "field `settings.minds.particles` must be 1 to 100000, not 1000000000";
    /// assert_eq!(refused.to_string(), rule);
    /// # Ok::<(), serde_json::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`FieldError`], if one is missing, unknown, of the wrong type or out of its range.
    pub fn read(value: &Value, field: &str) -> Result<Self, FieldError> {
        if let Some(minds) = value.get("minds") {
            MindParameters::read(minds, &format!("{field}.minds"))?;
        }
        let unreadable = |error: serde_json::Error| FieldError {
            field: field.into(),
            rule: format!("must be the settings of a simulation: {error}"),
        };
        let settings = read_as::<Unchecked>(value.clone()).map_err(unreadable)?.settings();
        settings.validate().map_err(|error| error.at(field))?;
        Ok(settings)
    }

    /// Checks that everything is in its range.
    ///
    /// # Errors
    /// [`RangeError`], which names the setting and its range.
    pub fn validate(&self) -> Result<(), RangeError> {
        EVENT_STEPS.check_count(self.max_steps)?;
        MIN_STEPS.check_count(self.min_steps)?;
        self.minds.validate().map_err(|error| error.within("minds"))
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
