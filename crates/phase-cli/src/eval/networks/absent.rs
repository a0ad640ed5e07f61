//! What a program does about networks that was built without them: it goes on in one that has them.

use super::{FORECASTING, RECOGNISING};
use crate::{console::remark, error::CliError};
use phase_eval::{Forecaster, Recogniser, benchmark::Training};
use std::{path::Path, process::Command};

/// Nothing, unless the name is that of a network for goals and relations.
///
/// # Errors
/// For a network: as [`or_elsewhere`].
pub fn recogniser(name: &str, _: Option<&Path>) -> Result<Option<Box<dyn Recogniser>>, CliError> {
    if RECOGNISING.contains(&name) {
        or_elsewhere(&format!("eval goals --method {name}"))?;
    }
    Ok(None)
}

/// Nothing, unless the name is that of a network for trajectories.
///
/// # Errors
/// For a network: as [`or_elsewhere`].
pub fn forecaster(name: &str, _: Option<&Path>) -> Result<Option<Box<dyn Forecaster>>, CliError> {
    if FORECASTING.contains(&name) {
        or_elsewhere(&format!("eval trajectories --method {name}"))?;
    }
    Ok(None)
}

/// Nothing: no method of this program has learnt anything that the benchmark counts.
///
/// # Errors
/// None.
pub fn training(_: &str) -> Result<Option<Training>, CliError> {
    Ok(None)
}

/// How a file of weights came about, for which networks are needed.
///
/// # Errors
/// Always: that this program has none.
pub fn training_of(file: &Path) -> Result<Training, CliError> {
    Err(CliError::Usage(format!(
        "{}: is for a neural network, which this program was built without; use `cargo xtask-networks`",
        file.display()
    )))
}

/// Goes on in a program that has networks, built if need be, with the same command line: a newcomer need not know that
/// there are two.
///
/// # Errors
/// If there is no cargo to build it with, or no way to go on in another program: how else to get there.
pub fn or_elsewhere(command: &str) -> Result<(), CliError> {
    let instead = || {
        CliError::Usage(format!(
            "neural networks are needed, which this program was built without; use `cargo xtask-networks {command} …`"
        ))
    };
    let cargo = std::env::var_os("CARGO").ok_or_else(instead)?;
    remark("building the neural networks in, which takes some minutes the first time");
    let mut command = Command::new(cargo);
    command.args(["run", "--release", "--quiet", "--package", "xtask", "--features", "networks", "--"]);
    command.args(std::env::args_os().skip(1));
    #[cfg(unix)]
    {
        use std::os::unix::process::CommandExt;
        // Only a failure to begin comes back.
        let _ = command.exec();
    }
    Err(instead())
}
