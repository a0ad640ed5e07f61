//! Parameters of the minds, from a file.

use phase_files::json;
use phase_minds::MindParameters;
use phase_runs::error::RunError;
use std::path::Path;

/// The default parameters with those of a file in their place.
pub(crate) fn read(file: &Path) -> Result<MindParameters, RunError> {
    let parameters = MindParameters::from_overrides(json::read(file)?);
    parameters.map_err(|error| RunError::Usage(format!("{}: {error}", file.display())))
}
