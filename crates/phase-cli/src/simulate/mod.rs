//! `simulate`: the scenes of a `phase-events/1` file or of a folder, each from its first row and with one or
//! several seeds.

pub mod options;
mod outcomes;

use crate::{context::Context, error::CliError, interrupt};
use options::Simulate;
use phase_dataset::manifest::PAGE_FILE;
use phase_files::told;
use phase_report::summary;
use phase_runs::{
    simulate::{Simulated, Simulations},
    words,
};
use serde_json::json;

/// Runs the command.
///
/// # Errors
/// Any [`CliError`].
pub fn run(arguments: &Simulate, context: &Context) -> Result<(), CliError> {
    interrupt::listen();
    let simulated = Simulations::from(arguments).run(context)?;
    print(arguments, &simulated)
}

/// Prints the result of the run: compared with the recordings if there are any, otherwise of the simulations
/// alone.
fn print(arguments: &Simulate, Simulated { summary, is_new }: &Simulated) -> Result<(), CliError> {
    let out = &arguments.out;
    let recorded = summary.events.iter().any(|event| event.recorded_steps > 0);
    let table = if recorded { summary::table(&summary.kinds) } else { outcomes::table(&summary.events) };
    let line = if *is_new {
        format!("simulated {} in {}", words::events(summary.events.len()), out.display())
    } else {
        format!("{} holds these {} simulated events already", out.display(), summary.events.len())
    };
    let page = Some(out.join(PAGE_FILE)).filter(|page| page.exists());
    let open = page.as_ref().map_or_else(String::new, |it| format!("\nopen {} to watch them", it.display()));
    let value = json!({
        "folder": told(out), "page": page.as_deref().map(told), "new": is_new, "recorded": recorded,
        "kinds": summary.kinds, "events": summary.events,
    });
    arguments.output.print(format!("{}\n{line}{open}", table.trim_end()), &value)
}
