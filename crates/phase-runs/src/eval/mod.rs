//! `eval`: how well a method perceives events.
//!
//! [`methods`] knows the methods by name, `task` asks one of them event by event and stores its answers, so
//! that a run can be interrupted; `shards` divides it among machines; `goals` and `trajectories` are the two tasks, `given` the answers of an
//! external method.

mod answers;
pub(crate) mod goals;
pub(crate) mod input;
pub mod methods;
pub mod networks;
pub mod options;
pub(crate) mod ratings;
pub(crate) mod scored;
mod shards;
pub(crate) mod task;
pub(crate) mod trajectories;

use crate::{context::Context, error::CliError};
use options::Eval;

/// Runs the command.
///
/// # Errors
/// Any [`CliError`].
pub fn run(arguments: &Eval, context: &Context) -> Result<(), CliError> {
    let method = match arguments {
        Eval::Goals(arguments) => &arguments.method,
        Eval::Trajectories(arguments) => &arguments.method,
    };
    if method.as_deref().is_some_and(networks::is_network) {
        networks::require(context)?;
    }
    match arguments {
        Eval::Goals(arguments) => goals::run(arguments, context),
        Eval::Trajectories(arguments) => trajectories::run(arguments, context),
    }
}
