//! Parameters of the minds, from a file.

use phase_agent::{Mind, MindParameters};
use phase_cli::error::CliError;
use phase_dataset::{FileError, Problem, json};
use phase_forward::Forward;
use phase_model::{AgentId, Scene};
use serde_json::Value;
use std::path::Path;

/// The default parameters with those of a file in their place.
///
/// # Errors
/// If the file cannot be used, or holds something that is no parameter.
pub(crate) fn read(file: &Path) -> Result<MindParameters, CliError> {
    let wrong = |source| {
        let problem = Problem::Incomplete { what: "set of parameters", source };
        CliError::File(FileError { file: file.to_owned(), problem })
    };
    let usage = |rule: String| CliError::Usage(format!("{}: {rule}", file.display()));
    let Value::Object(given) = json::read(file)? else {
        return Err(usage("must be an object of parameters".into()));
    };
    let mut all = serde_json::to_value(MindParameters::default()).map_err(wrong)?;
    for (name, value) in given {
        let Some(place) = all.get_mut(&name) else {
            return Err(usage(format!("field `{name}` is no parameter of the minds")));
        };
        *place = value;
    }
    serde_json::from_value(all).map_err(wrong)
}

/// Checks that minds accept the parameters, on a scene that they are to act in.
///
/// # Errors
/// [`CliError::Usage`].
pub(crate) fn check(parameters: MindParameters, scene: &Scene, file: Option<&Path>) -> Result<(), CliError> {
    let wrong = |rule: String| match file {
        Some(file) => CliError::Usage(format!("{}: {rule}", file.display())),
        None => CliError::Usage(rule),
    };
    if parameters.particles == 0 {
        return Err(wrong("field `particles` must be at least 1".into()));
    }
    if !(parameters.decisiveness.is_finite() && parameters.decisiveness >= 0.0) {
        return Err(wrong("field `decisiveness` must be finite and at least 0".into()));
    }
    let mind = Mind::new(scene, AgentId::ZERO, Forward::new(&scene.physics()), parameters);
    mind.map(|_| ()).map_err(|error| wrong(error.to_string()))
}
