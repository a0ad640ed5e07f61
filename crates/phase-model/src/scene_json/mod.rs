//! Scenes as JSON.
//!
//! A scene is an object with the members `layout`, `agents`, `objects` and `event`, which have the same
//! meaning as in an event of the format `phase-events/1`. In an event the starts of all bodies are the first
//! rows of its trajectory; in a standalone scene each agent and each object has a member `start` of `x`, `y`
//! (u), `vx`, `vy` (u/s), `angle` (rad) and `angular_velocity` (rad/s), of which all but the position may be
//! omitted and are then 0. Members whose names begin with `_`, such as `"_comment"`, are reserved for user
//! annotations; other unknown members are errors.

mod read;
mod write;

use crate::{
    AGENT_COUNT, Layout, Scene, SceneError, Size,
    json::{self, Field, FieldError, JsonError},
};
pub use read::{attitude, goal};
use serde::{Deserialize, Deserializer, Serialize, Serializer, de, ser};
use serde_json::Value;
use thiserror::Error;
pub use write::{AgentMembers, ObjectMembers};

/// The reason why a text is not a scene.
#[derive(Clone, PartialEq, Debug, Error)]
pub enum SceneReadError {
    /// It is not JSON.
    #[error(transparent)]
    Json(#[from] JsonError),
    /// A member is missing, unknown, of the wrong type or out of its range.
    #[error(transparent)]
    Field(#[from] FieldError),
    /// The scene breaks a rule of [`crate::validate`].
    #[error(transparent)]
    Scene(#[from] SceneError),
}

/// Layout, sizes of the agents, and sizes of the objects, of which there are at most two: all of a scene that
/// can be seen beside its motion.
pub type LayoutAndSizes = (Layout, [Size; AGENT_COUNT], Vec<Size>);

/// The location of each body's start pose.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Starts {
    /// In the member `start` of each agent and object.
    Members,
    /// Outside the scene's members: there must be no `start`, and every body is read as
    /// [`crate::Body::default`].
    Elsewhere,
}

impl Scene {
    /// Reads a scene and validates it.
    ///
    /// # Errors
    /// [`SceneReadError`] names the member and the rule that is violated.
    ///
    /// # Examples
    /// ```
    /// use phase_model::{EventKind, Scene};
    ///
    /// let scene = Scene::from_json(
    ///     r#"{
    ///         "layout": {"base": 0},
    ///         "agents": [
    ///             {"size_level": 0, "strength_level": 2, "alpha": 0, "start": {"x": 8, "y": 14, "angle": 1},
    ///              "goal": {"kind": "touch", "agent": 0, "other": 1, "sign": 1}},
    ///             {"size_level": 0, "strength_level": 2, "alpha": 0, "start": {"x": 24, "y": 14},
    ///              "goal": {"kind": "touch", "agent": 0, "other": 1, "sign": -1}}
    ///         ],
    ///         "objects": [],
    ///         "event": "chasing"
    ///     }"#,
    /// )?;
    /// assert_eq!(scene.kind, EventKind::Chasing);
    /// assert_eq!(Scene::from_json(&scene.to_json()?)?, scene);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn from_json(text: &str) -> Result<Self, SceneReadError> {
        Self::from_value(&json::parse_text(text)?)
    }

    /// Reads a scene from JSON that is already parsed.
    ///
    /// # Errors
    /// [`SceneReadError`] names the member and the rule that is violated.
    pub fn from_value(value: &Value) -> Result<Self, SceneReadError> {
        let field = Field::root(value);
        field.only(&["layout", "walls", "landmarks", "agents", "objects", "event"])?;
        let scene = Self::from_members(&field, Starts::Members)?;
        scene.validate()?;
        scene.check_kind()?;
        Ok(scene)
    }

    /// The scene among the members of an object; other members are ignored. It is not validated.
    ///
    /// # Errors
    /// [`FieldError`] names the member and the rule that is violated.
    pub fn from_members(object: &Field<'_>, starts: Starts) -> Result<Self, FieldError> {
        read::scene(object, starts)
    }

    /// Layout and sizes among the members of an object, which has the form of an event and may lack labels:
    /// `event`, and goals, attitudes and strengths of agents.
    ///
    /// # Errors
    /// [`FieldError`] names the member and the rule that is violated.
    pub fn layout_and_sizes(object: &Field<'_>) -> Result<LayoutAndSizes, FieldError> {
        read::layout_and_sizes(object)
    }

    /// The scene as JSON in one line; reading it restores the same scene bit for bit.
    ///
    /// # Errors
    /// If a start contains a number that is not finite.
    pub fn to_json(&self) -> serde_json::Result<String> {
        serde_json::to_string(self)
    }
}

impl Serialize for Scene {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.check_finite().map_err(ser::Error::custom)?;
        write::SceneMembers::of(self).serialize(serializer)
    }
}

/// For self-describing formats such as JSON.
impl<'de> Deserialize<'de> for Scene {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        Self::from_value(&Value::deserialize(deserializer)?).map_err(de::Error::custom)
    }
}
