//! What a generated dataset is made of.

use crate::{FileError, Problem};
use phase_model::EventKind;
use serde::Deserialize;
use std::path::Path;

/// The value of the field `format` of preset files.
pub const PRESET_FORMAT: &str = "phase-preset/1";

/// A recipe for a dataset.
#[derive(Clone, PartialEq, Eq, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Preset {
    /// Always [`PRESET_FORMAT`].
    pub format: String,
    /// Name; the ids of events begin with it.
    pub name: String,
    /// Number of events unless another is asked for.
    pub events: usize,
    /// Seed unless another is given.
    pub seed: u64,
    /// Kinds of the first events; later ones repeat them in turn.
    pub kinds: Vec<EventKind>,
}

impl Preset {
    /// Reads a preset from text; `name` stands for it in messages.
    ///
    /// # Errors
    /// If the text is no preset or lists no kinds.
    pub fn parse(name: &str, text: &str) -> Result<Self, FileError> {
        let fail = |rule: String| FileError {
            file: Path::new(name).to_owned(),
            problem: Problem::Shape { what: "preset", rule },
        };
        let preset: Self = serde_json::from_str(text).map_err(|error| fail(error.to_string()))?;
        if preset.format != PRESET_FORMAT {
            return Err(fail(format!("field `format` must be {PRESET_FORMAT:?}")));
        }
        if preset.kinds.is_empty() || preset.events == 0 {
            return Err(fail("fields `kinds` and `events` must not be empty".into()));
        }
        Ok(preset)
    }

    /// The kind of the event with this number.
    #[must_use]
    pub fn kind(&self, index: usize) -> EventKind {
        self.kinds[index % self.kinds.len()]
    }

    /// The id of the event with this number.
    #[must_use]
    pub fn id(&self, index: usize) -> String {
        format!("{}-{index:04}", self.name)
    }
}
