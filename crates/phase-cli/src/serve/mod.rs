//! `serve`: the playground, the two-player game and rating studies for browsers.

pub mod options;
#[cfg(feature = "serve")]
mod scenes;

use crate::{context::Context, error::CliError};
use options::Serve;

/// Runs the command, until Ctrl-C or SIGTERM.
///
/// # Errors
/// [`CliError::NotBuilt`] where the program was built without the feature `serve`; [`CliError::Serve`],
/// [`CliError::File`] or [`CliError::Usage`] for an address, scenes or WebAssembly that cannot be used.
#[cfg(not(feature = "serve"))]
pub fn run(_: &Serve, context: &Context) -> Result<(), CliError> {
    Err(CliError::NotBuilt { part: "the server", hint: context.program.serve_hint })
}

/// Runs the command, until Ctrl-C or SIGTERM.
///
/// # Errors
/// [`CliError::Serve`], [`CliError::File`] or [`CliError::Usage`] for an address, scenes or WebAssembly that
/// cannot be used.
#[cfg(feature = "serve")]
pub fn run(arguments: &Serve, context: &Context) -> Result<(), CliError> {
    use crate::{output::print_result, playground::read_wasm};
    use phase_game::{GameSettings, playlist::Item};
    use phase_serve::{Server, ServerSettings};
    use phase_sim::SimulationSettings;
    use std::net::Ipv4Addr;

    arguments.check()?;
    let only_studies = arguments.only_studies();
    let scenes: Vec<Item> = scenes::of(arguments, context)?;
    let practice = scenes::practice()?;
    let given = arguments.wasm.as_deref().map(read_wasm).transpose()?;
    let wasm = match &given {
        Some([script, code]) => Some([&script[..], &code[..]]),
        None => phase_web::included(),
    };
    let default = GameSettings::default();
    let simulation = SimulationSettings {
        stop_between_steps: !arguments.inertia,
        min_steps: default.simulation.min_steps,
        rest_steps: default.simulation.rest_steps,
        still_steps: default.simulation.still_steps,
        ..arguments.simulation.settings()?
    };
    let settings = ServerSettings {
        listen: arguments.port.map_or(arguments.listen, |port| (Ipv4Addr::LOCALHOST, port).into()),
        only_studies,
        host: arguments.host.clone(),
        behind_proxy: arguments.behind_proxy,
        folder: arguments.out.clone(),
        rooms: usize::from(arguments.rooms.unwrap_or(ROOMS)),
        mind_rooms: arguments.mind_rooms.map_or_else(mind_rooms, usize::from),
        open: !arguments.invite_only,
        rounds: usize::from(arguments.rounds.unwrap_or(ROUNDS)),
        game: GameSettings { simulation, ..default },
        seed: arguments.seed.unwrap_or(SEED),
    };
    if let Some(rounds) = arguments.rounds.map(usize::from).filter(|&rounds| rounds > scenes.len()) {
        context.note(format!("note: --rounds {rounds}: there are {} scenes, one a round", scenes.len()));
    }
    let mut server = Server::bind(settings, practice, scenes, wasm)?;
    server.open_studies(&arguments.studies)?;
    if wasm.is_none() && !only_studies {
        context.note("note: built without the playground; `cargo xtask playground` builds it, and --wasm names its folder");
    }
    let address = server.address();
    let studies: String = server.studies().map(|name| format!("http://{address}/study/{name}/\n")).collect();
    let first = if only_studies { String::new() } else { format!("http://{address}/\n") };
    print_result(format!(
        "{first}{studies}http://{address}/admin/#{} (for you alone)\nrecordings and journals in {}; Ctrl-C stops",
        server.admin_token(),
        arguments.out.display()
    ))?;
    Ok(server.run(stopped())?)
}

/// Games at the same time, unless given.
#[cfg(feature = "serve")]
const ROOMS: u16 = 200;
/// Scenes of a game after the practice, unless given.
#[cfg(feature = "serve")]
const ROUNDS: u16 = 5;
/// The seed, unless given.
#[cfg(feature = "serve")]
const SEED: u64 = 1;

/// Games with a mind that a machine of this size plays in time (docs/results/performance.md).
#[cfg(feature = "serve")]
fn mind_rooms() -> usize {
    const PER_CORE: usize = 12;
    PER_CORE * std::thread::available_parallelism().map_or(1, usize::from)
}

/// Until somebody asks this program to stop.
#[cfg(feature = "serve")]
async fn stopped() {
    let interrupted = tokio::signal::ctrl_c();
    #[cfg(unix)]
    {
        let terminated = tokio::signal::unix::signal(tokio::signal::unix::SignalKind::terminate());
        if let Ok(mut terminated) = terminated {
            tokio::select! {
                _ = interrupted => {}
                _ = terminated.recv() => {}
            }
            return;
        }
    }
    // Where signals cannot be listened for, they end the program at once.
    if interrupted.await.is_err() {
        std::future::pending::<()>().await;
    }
}
