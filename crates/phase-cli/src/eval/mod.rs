//! `eval`: how well a method perceives events.

pub mod options;

use crate::{context::Context, error::CliError, interrupt, output::print_result};
use options::{Common, Eval};
use phase_runs::{
    eval::{Answers, Evaluated, Evaluation, REPORT_FILE, networks},
    words,
};

/// Runs the command.
///
/// # Errors
/// Any [`CliError`].
pub fn run(arguments: &Eval, context: &Context) -> Result<(), CliError> {
    let answers = Answers::from(arguments);
    if let Answers::Method { name, .. } = &answers
        && networks::is_network(name)
    {
        require_networks(context)?;
    }
    let common = arguments.common();
    common.json.check([])?;
    interrupt::listen();
    let evaluation = Evaluation::from(arguments);
    match arguments {
        Eval::Goals(_) => announce(evaluation.goals(&answers, context)?, common),
        Eval::Trajectories(_) => announce(evaluation.trajectories(&answers, context)?, common),
    }
}

/// Checks that this program has networks.
///
/// # Errors
/// [`CliError::NotBuilt`].
pub(crate) const fn require_networks(context: &Context) -> Result<(), CliError> {
    if networks::INCLUDED {
        return Ok(());
    }
    Err(CliError::NotBuilt { part: "neural networks", hint: context.program.networks_hint })
}

/// Prints the table, writes the results to the other requested places, and says where the report is.
fn announce<A>(done: Option<Evaluated<A>>, arguments: &Common) -> Result<(), CliError> {
    let Some(done) = done else {
        return print_result(
            "this part is done; give the same command with --merge and the folders of all parts",
        );
    };
    let folder = &done.folder;
    let line = if done.is_new {
        format!("{}; report in {}", words::events(done.events.len()), folder.join(REPORT_FILE).display())
    } else {
        format!("{} holds this evaluation already", folder.display())
    };
    arguments.json.print(&done.results, format!("{}\n{line}", done.document.first_table().trim_end()))
}
