//! The file that an option such as `--json FILE` writes.

use crate::error::LabError;
use phase_cli::output::{json_text, print_result};
use phase_files::atomic;
use phase_runs::error::RunError;
use serde::Serialize;
use std::path::Path;

/// The name that means stdout where a file may be named.
const STDOUT: &str = "-";

/// Checks that `option` can write to `out` without overwriting one of the inputs.
///
/// # Errors
/// [`RunError::Usage`].
pub(crate) fn check<'a>(
    option: &str,
    out: &Path,
    mut inputs: impl Iterator<Item = &'a Path>,
) -> Result<(), RunError> {
    let usage = |rule: &str| RunError::Usage(format!("{option} {}: {rule}", out.display()));
    if out == Path::new(STDOUT) {
        return Ok(());
    }
    if out.is_dir() {
        return Err(usage("is a folder; a file is needed"));
    }
    let folder = out.parent().filter(|folder| !folder.as_os_str().is_empty());
    if folder.is_some_and(|folder| !folder.is_dir()) {
        return Err(usage("cannot be written, for its folder does not exist"));
    }
    let same = |input: &Path| {
        out == input
            || out.canonicalize().is_ok_and(|out| input.canonicalize().is_ok_and(|input| out == input))
    };
    if inputs.any(same) { Err(usage("is an input file; choose another")) } else { Ok(()) }
}

/// Writes a result to a file, if one was named: whole, or not at all.
///
/// # Errors
/// [`RunError::Output`].
pub(crate) fn write(out: Option<&Path>, text: &str) -> Result<(), RunError> {
    out.map_or(Ok(()), |out| atomic::write(out, text.as_bytes()).map_err(RunError::Output))
}

/// Prints a report as its table; as JSON to `out` too, or alone where that is stdout.
pub(crate) fn print(out: Option<&Path>, report: &impl Serialize, table: &str) -> Result<(), LabError> {
    if let Some(out) = out {
        let text = json_text(report, "the report")?;
        if out == Path::new(STDOUT) {
            return Ok(print_result(text.trim_end())?);
        }
        write(Some(out), &text)?;
    }
    Ok(print_result(table.trim_end())?)
}
