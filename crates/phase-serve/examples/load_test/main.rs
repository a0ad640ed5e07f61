//! Load test of the two-player game: many rooms at once, each with two players that are programs, over real
//! sockets, on this machine.
//!
//! ```sh
//! cargo run --release --package phase-serve --example load_test -- --rooms 200 --seconds 30
//! cargo run --release --package phase-serve --example load_test -- --rooms 10 --players minds
//! cargo run --release --package phase-serve --example load_test -- --rooms 20 --partner mind
//! cargo run --release --package phase-serve --example load_test -- --rooms 200 --misbehaving 50
//! ```
//!
//! Players press keys at random, or are minds that see what the server tells their agents. Printed as JSON:
//! how late steps arrived, in milliseconds after the time at which they were due. A room's schedule begins
//! with the step that came earliest relative to its number, so lateness includes the server, the sockets and
//! the players' own waiting for a processor. Also the resident memory of the server and all players, which
//! are one program, each ten seconds.

mod client;
mod mind;
mod misbehaving;

use clap::{Parser, ValueEnum, value_parser};
use client::{Client, Shared};
use phase_game::{GameSettings, playlist::Item};
use phase_model::EventKind;
use phase_sampler::sample_named;
use phase_serve::{Server, ServerSettings};
use serde_json::json;
use std::{
    error::Error,
    sync::{
        Arc,
        atomic::{AtomicBool, Ordering},
    },
    time::{Duration, Instant},
};

/// Time between two looks at the memory.
const BETWEEN: Duration = Duration::from_secs(10);

/// Who plays in place of people.
#[derive(Clone, Copy, PartialEq, Eq, Debug, ValueEnum)]
enum Players {
    /// Keys at random, three changes a second.
    Keys,
    /// Minds at the paper's settings.
    Minds,
}

/// Who plays the other agent.
#[derive(Clone, Copy, PartialEq, Eq, Debug, ValueEnum)]
enum Partner {
    /// Another player of the same kind.
    Human,
    /// The server's mind.
    Mind,
}

/// Many rooms at once
#[derive(Parser, Debug)]
struct Options {
    /// Rooms at the same time
    #[arg(long, default_value_t = 200, value_parser = value_parser!(u16).range(1..=10_000))]
    rooms: u16,
    /// Time during which all of them play (s)
    #[arg(long, default_value_t = 30, value_parser = value_parser!(u16).range(1..=3600))]
    seconds: u16,
    /// Who plays in place of people
    #[arg(long, value_enum, default_value_t = Players::Keys)]
    players: Players,
    /// Who plays the other agent
    #[arg(long, value_enum, default_value_t = Partner::Human)]
    partner: Partner,
    /// Simulations of a decision
    #[arg(long, default_value_t = 1000)]
    simulations: usize,
    /// Beside them, clients of each kind that do not behave
    #[arg(long, default_value_t = 0, value_parser = value_parser!(u16).range(0..=250))]
    misbehaving: u16,
}

fn main() -> Result<(), Box<dyn Error>> {
    let options = Options::parse();
    let folder = tempfile::tempdir()?;
    let mut scenes = Vec::new();
    for (seed, kind) in (0..).zip(EventKind::ALL) {
        scenes.push(Item { source: kind.name().into(), scene: sample_named(Some(kind.name()), None, seed)? });
    }
    let mut game = GameSettings::default();
    game.simulation.minds = game.simulation.minds.with_simulations(options.simulations);
    let settings = ServerSettings {
        listen: ([127, 0, 0, 1], 0).into(),
        host: None,
        behind_proxy: false,
        folder: folder.path().to_owned(),
        // Two kinds of clients that do not behave have rooms.
        rooms: usize::from(options.rooms + 2 * options.misbehaving),
        mind_rooms: usize::from(options.rooms),
        open: true,
        rounds: scenes.len(),
        game,
        seed: 1,
    };
    let parameters = game.simulation.minds;
    let server = Server::bind(settings, scenes[0].clone(), scenes.clone(), None)?;
    let (address, admin) = (server.address(), server.admin_token().to_owned());
    let (stop, stopped) = tokio::sync::oneshot::channel::<()>();
    let serving = std::thread::spawn(move || {
        server.run(async {
            let _ = stopped.await;
        })
    });
    let shared = Arc::new(Shared::new(scenes, parameters, options.players == Players::Minds));
    let runtime = tokio::runtime::Builder::new_multi_thread().enable_all().build()?;
    let (lateness, memory) = runtime.block_on(play(&options, address, &admin, &shared))?;
    let _ = stop.send(());
    serving.join().map_err(|_| "the server panicked")??;
    println!("{}", report(&options, lateness, &memory));
    Ok(())
}

/// Plays for the time asked for; the lateness of each step of each player (ms), and the memory over time
/// (MiB).
async fn play(
    options: &Options,
    address: std::net::SocketAddr,
    admin: &str,
    shared: &Arc<Shared>,
) -> Result<(Vec<f64>, Vec<u64>), Box<dyn Error>> {
    let mut clients = Vec::new();
    for _ in 0..options.rooms {
        // As fast as the server lets one address ask.
        tokio::time::sleep(Duration::from_millis(20)).await;
        let partner = if options.partner == Partner::Mind { "mind" } else { "human" };
        for token in client::open_room(address, admin, partner).await? {
            let seed = clients.len() as u64;
            clients.push(tokio::spawn(Client::join(address, token, seed, Arc::clone(shared)).await?.play()));
        }
    }
    // Until all of them have left the practice.
    let opened = Instant::now();
    while shared.playing() < clients.len() && opened.elapsed() < Duration::from_secs(120) {
        tokio::time::sleep(Duration::from_millis(100)).await;
    }
    if shared.playing() < clients.len() {
        return Err("the games did not begin".into());
    }
    let over = Arc::new(AtomicBool::new(false));
    misbehaving::start(options.misbehaving, address, admin, &over);
    shared.measure(true);
    let mut memory = vec![resident()];
    let begun = Instant::now();
    let all = Duration::from_secs(options.seconds.into());
    while begun.elapsed() < all {
        tokio::time::sleep(BETWEEN.min(all.saturating_sub(begun.elapsed()))).await;
        memory.push(resident());
    }
    shared.measure(false);
    over.store(true, Ordering::Relaxed);
    let mut lateness = Vec::new();
    for client in clients {
        lateness.extend(client.await?);
    }
    Ok((lateness, memory))
}

/// Resident memory of this program (MiB); 0 where the system does not tell it like Linux.
fn resident() -> u64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix("VmRSS:"));
    line.and_then(|line| line.trim().trim_end_matches(" kB").parse::<u64>().ok()).unwrap_or_default() / 1024
}

fn report(options: &Options, mut lateness: Vec<f64>, memory: &[u64]) -> serde_json::Value {
    lateness.sort_by(f64::total_cmp);
    let quantile = |share: f64| {
        let rank = (share * lateness.len() as f64).ceil() as usize;
        lateness.get(rank.max(1) - 1).map(|ms| (ms * 10.0).round() / 10.0)
    };
    json!({
        "rooms": options.rooms, "seconds": options.seconds,
        "players": format!("{:?}", options.players).to_lowercase(),
        "partner": format!("{:?}", options.partner).to_lowercase(),
        "simulations": options.simulations, "misbehaving": options.misbehaving, "resident_mib": memory,
        "steps_seen": lateness.len(),
        "late_ms": {
            "median": quantile(0.5), "p90": quantile(0.9), "p99": quantile(0.99), "worst": quantile(1.0),
        },
    })
}
