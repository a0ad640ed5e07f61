//! `eval`: how well a method perceives events.

pub mod options;

use crate::{
    context::Context,
    error::CliError,
    interrupt,
    output::{json_text, print_json, print_result},
};
use options::{Common, Eval};
use phase_files::atomic;
use phase_runs::{
    eval::{Answers, Evaluated, Evaluation, REPORT_FILE, networks},
    words,
};
use std::path::Path;

/// The name that means stdout where a file may be named.
const STDOUT: &str = "-";

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
    check_output_path(common)?;
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
    if arguments.json.as_deref() == Some(Path::new(STDOUT)) {
        return print_json(&done.results);
    }
    if let Some(path) = &arguments.json {
        let text = json_text(&done.results, "the results")?;
        atomic::write(path, text.as_bytes()).map_err(CliError::Output)?;
    }
    print_result(done.document.first_table().trim_end())?;
    let folder = &done.folder;
    print_result(if done.is_new {
        format!("{}; report in {}", words::events(done.events.len()), folder.join(REPORT_FILE).display())
    } else {
        format!("{} holds this evaluation already", folder.display())
    })
}

/// Checks before hours of work that the folder of the file to be written at the end exists.
fn check_output_path(arguments: &Common) -> Result<(), CliError> {
    let Some(path) = arguments.json.as_ref().filter(|path| *path != Path::new(STDOUT)) else { return Ok(()) };
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let rule = if path.is_dir() {
        "is a folder; --json needs a file"
    } else if !folder.is_dir() {
        "--json: there is no such folder to write into"
    } else {
        return Ok(());
    };
    Err(CliError::Usage(format!("{}: {rule}", path.display())))
}
