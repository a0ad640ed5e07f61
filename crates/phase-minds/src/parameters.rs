//! The parameters of each kind of mind, and how they are read.

use crate::ranges;
use phase_agent::{Foresight, PhaseParameters};
use phase_model::{
    json::{FieldError, read_as},
    setting::{RangeError, Setting},
};
use phase_published::{PublishedParameters, RandomNumbers};
use serde::{Deserialize, Serialize, de::DeserializeOwned};
use serde_json::{Map, Value};
use thiserror::Error;

/// A kind of mind.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum MindKind {
    /// The minds of `phase-agent`.
    #[default]
    Phase,
    /// The minds of the published simulator, reimplemented in `phase-published`.
    Published,
}

impl MindKind {
    /// Every kind, the default first.
    pub const ALL: [Self; 2] = [Self::Phase, Self::Published];

    /// The name used in files and options.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Phase => "phase",
            Self::Published => "published",
        }
    }
}

/// The parameters of a mind: its kind, and every number that shapes the behaviour of minds of that kind.
///
/// In a file they are one object, which names its `kind`, `phase` or `published`, and has all parameters of
/// that kind and no others. Reading them checks their ranges, as [`from_overrides`](Self::from_overrides)
/// does for some of them and [`validate`](Self::validate) for those that a program has set.
///
/// ```
/// use phase_minds::{MindKind, MindParameters};
///
/// let quick = MindParameters::from_overrides(serde_json::json!({"kind": "published", "simulations": 100}))?;
/// assert_eq!(quick, MindParameters::of(MindKind::Published).with_simulations(100));
/// let foreign = MindParameters::from_overrides(serde_json::json!({"kind": "published", "effort": 0.5}));
/// let rule = "field `effort` is a parameter of phase minds, not of published minds";
/// assert_eq!(foreign.unwrap_err().to_string(), rule);
/// # Ok::<(), phase_minds::ParametersError>(())
/// ```
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "lowercase", try_from = "Unchecked")]
// Parameters are copied a few times an event, and a box could not be copied.
#[allow(clippy::large_enum_variant)]
pub enum MindParameters {
    /// Those of a mind of `phase-agent`.
    Phase(PhaseParameters),
    /// Those of a mind of `phase-published`.
    Published(PublishedParameters),
}

/// Parameters as a file has them, whose ranges have not been checked.
#[derive(Deserialize)]
#[serde(tag = "kind", rename_all = "lowercase")]
#[allow(clippy::large_enum_variant)]
enum Unchecked {
    Phase(PhaseParameters),
    Published(PublishedParameters),
}

impl TryFrom<Unchecked> for MindParameters {
    type Error = RangeError;

    fn try_from(read: Unchecked) -> Result<Self, RangeError> {
        let parameters = read.parameters();
        parameters.validate()?;
        Ok(parameters)
    }
}

impl Unchecked {
    const fn parameters(self) -> MindParameters {
        match self {
            Self::Phase(parameters) => MindParameters::Phase(parameters),
            Self::Published(parameters) => MindParameters::Published(parameters),
        }
    }
}

/// The reason why parameters of a mind cannot be used.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ParametersError {
    /// The parameters are no JSON object.
    #[error("parameters of minds must be an object")]
    NoObject,
    /// The kind is none.
    #[error("field `kind` must be phase or published, not {0}")]
    Kind(Value),
    /// A member of the object is no parameter of any mind.
    #[error("field `{name}` is no parameter of {} minds", kind.name())]
    Unknown {
        /// The member's name.
        name: String,
        /// The kind that the object names.
        kind: MindKind,
    },
    /// A member of the object is a parameter of minds of another kind.
    #[error("field `{name}` is a parameter of {} minds, not of {} minds", other.name(), kind.name())]
    Foreign {
        /// The member's name.
        name: String,
        /// The kind that the object names.
        kind: MindKind,
        /// The kind that has the parameter.
        other: MindKind,
    },
    /// A parameter has the wrong type.
    #[error("field `{name}` is wrong: {source}")]
    Type {
        /// The parameter's name.
        name: String,
        /// The type that was expected, and the value found.
        source: serde_json::Error,
    },
    /// A parameter is out of its range.
    #[error(transparent)]
    Range(#[from] RangeError),
}

impl MindParameters {
    /// The default parameters of a kind.
    #[must_use]
    pub fn of(kind: MindKind) -> Self {
        match kind {
            MindKind::Phase => Self::Phase(PhaseParameters::default()),
            MindKind::Published => Self::Published(PublishedParameters::default()),
        }
    }

    /// The kind of mind that these are the parameters of.
    #[must_use]
    pub const fn kind(&self) -> MindKind {
        match self {
            Self::Phase(_) => MindKind::Phase,
            Self::Published(_) => MindKind::Published,
        }
    }

    /// The number of belief particles, at least 1.
    #[must_use]
    pub const fn particles(&self) -> usize {
        match self {
            Self::Phase(parameters) => parameters.particles,
            Self::Published(parameters) => parameters.particles,
        }
    }

    /// The number of simulations of a search, at least 1.
    #[must_use]
    pub const fn simulations(&self) -> usize {
        match self {
            Self::Phase(parameters) => parameters.simulations,
            Self::Published(parameters) => parameters.simulations,
        }
    }

    /// These parameters with another number of belief particles.
    #[must_use]
    pub const fn with_particles(mut self, particles: usize) -> Self {
        match &mut self {
            Self::Phase(parameters) => parameters.particles = particles,
            Self::Published(parameters) => parameters.particles = particles,
        }
        self
    }

    /// These parameters for a mind that searches, with so many simulations.
    #[must_use]
    pub const fn with_simulations(mut self, simulations: usize) -> Self {
        self = self.searching();
        match &mut self {
            Self::Phase(parameters) => parameters.simulations = simulations,
            Self::Published(parameters) => parameters.simulations = simulations,
        }
        self
    }

    /// These parameters with another λ of the subgoal value (1/u), at least 0.
    #[must_use]
    pub const fn with_lambda(mut self, lambda: f64) -> Self {
        match &mut self {
            Self::Phase(parameters) => parameters.lambda = lambda,
            Self::Published(parameters) => parameters.lambda = lambda,
        }
        self
    }

    /// Whether the mind's search foresees that bodies collide with each other.
    #[must_use]
    pub const fn foresees_collisions(&self) -> bool {
        match self {
            Self::Phase(parameters) => !matches!(parameters.foresight, Foresight::Points),
            Self::Published(parameters) => parameters.collisions,
        }
    }

    /// These parameters for a search in which bodies pass through each other; only walls stop them.
    #[must_use]
    pub const fn without_collisions(mut self) -> Self {
        match &mut self {
            Self::Phase(parameters) => parameters.foresight = Foresight::Points,
            Self::Published(parameters) => parameters.collisions = false,
        }
        self
    }

    /// Whether the mind draws the random numbers of the original, which both agents' minds share.
    #[must_use]
    pub const fn has_original_random(&self) -> bool {
        matches!(self, Self::Published(PublishedParameters { random: RandomNumbers::Original, .. }))
    }

    /// Parameters as a file has them, all of a kind. `field` is their path in the file, for the error.
    ///
    /// # Errors
    /// [`FieldError`], if a parameter is missing, of the wrong type, unknown or out of its range.
    pub fn read(value: &Value, field: &str) -> Result<Self, FieldError> {
        let refused = |rule: String| FieldError { field: field.into(), rule };
        let unreadable = |error: serde_json::Error| refused(format!("must be parameters of minds: {error}"));
        let mut members =
            value.as_object().cloned().ok_or_else(|| refused("must be an object".to_owned()))?;
        let named = members.remove("kind").unwrap_or_default();
        let kind = MindKind::ALL.into_iter().find(|kind| named == kind.name());
        // Each kind is read by its own type, whose errors name the member.
        let parameters = match kind {
            Some(MindKind::Phase) => Self::Phase(read_as(members.into()).map_err(unreadable)?),
            Some(MindKind::Published) => Self::Published(read_as(members.into()).map_err(unreadable)?),
            None => {
                let rule = format!("must be phase or published, not {named}");
                return Err(FieldError { field: format!("{field}.kind"), rule });
            }
        };
        parameters.validate().map_err(|error| error.at(field))?;
        Ok(parameters)
    }

    /// Parameters from a JSON object that has some of them: the member `kind` names the kind (`phase` if
    /// absent), the other members replace the defaults of that kind, each by its name in files.
    ///
    /// # Errors
    /// [`ParametersError`], if `given` is no object, or a member is a parameter of another kind, no parameter
    /// at all, of the wrong type or out of its range.
    pub fn from_overrides(given: Value) -> Result<Self, ParametersError> {
        let Value::Object(mut given) = given else { return Err(ParametersError::NoObject) };
        let kind = match given.remove("kind") {
            None => MindKind::default(),
            Some(name) => {
                let named = MindKind::ALL.into_iter().find(|kind| name == kind.name());
                named.ok_or(ParametersError::Kind(name))?
            }
        };
        let parameters = match Self::of(kind) {
            Self::Phase(defaults) => Self::Phase(replace(defaults, kind, given)?),
            Self::Published(defaults) => Self::Published(replace(defaults, kind, given)?),
        };
        parameters.validate()?;
        Ok(parameters)
    }

    /// Every number among the parameters of this kind, with its range.
    #[must_use]
    pub fn settings(&self) -> Vec<Setting> {
        let names =
            |ranged: &[ranges::Ranged]| ranged.iter().map(|(setting, _)| *setting).collect::<Vec<_>>();
        let mut all = match self {
            Self::Phase(parameters) => names(&ranges::of_phase(parameters)),
            Self::Published(parameters) => names(&ranges::of_published(parameters)),
        };
        // The last is the work of all together.
        all.pop();
        all
    }

    /// Checks that every parameter is in its range.
    ///
    /// # Errors
    /// [`RangeError`], which names the first that is not.
    pub fn validate(&self) -> Result<(), RangeError> {
        match self {
            Self::Phase(parameters) => ranges::check(&ranges::of_phase(parameters)),
            Self::Published(parameters) => ranges::check(&ranges::of_published(parameters)),
        }
    }
}

impl Default for MindParameters {
    fn default() -> Self {
        Self::of(MindKind::default())
    }
}

impl From<PhaseParameters> for MindParameters {
    fn from(parameters: PhaseParameters) -> Self {
        Self::Phase(parameters)
    }
}

impl From<PublishedParameters> for MindParameters {
    fn from(parameters: PublishedParameters) -> Self {
        Self::Published(parameters)
    }
}

/// Puts the members of an object in the place of the parameters of their names, one by one, so that an error
/// names its member.
fn replace<T: Serialize + DeserializeOwned>(
    mut parameters: T,
    kind: MindKind,
    given: Map<String, Value>,
) -> Result<T, ParametersError> {
    for (name, value) in given {
        let typed = |source| ParametersError::Type { name: name.clone(), source };
        let mut all = serde_json::to_value(&parameters).map_err(typed)?;
        // A parameter that is left out of files at its default is known to the type alone.
        let written = all.as_object_mut().and_then(|all| all.insert(name.clone(), value)).is_some();
        parameters = match serde_json::from_value(all) {
            Ok(parameters) => parameters,
            Err(error) if !written && error.to_string().starts_with("unknown field") => {
                return Err(no_parameter(name, kind));
            }
            Err(error) => return Err(typed(error)),
        };
    }
    Ok(parameters)
}

/// The error about a member that no mind of a kind has as a parameter.
fn no_parameter(name: String, kind: MindKind) -> ParametersError {
    let has = |other: &MindKind| {
        serde_json::to_value(MindParameters::of(*other)).is_ok_and(|all| all.get(&name).is_some())
    };
    match MindKind::ALL.into_iter().filter(|other| *other != kind).find(has) {
        Some(other) => ParametersError::Foreign { name, kind, other },
        None => ParametersError::Unknown { name, kind },
    }
}
