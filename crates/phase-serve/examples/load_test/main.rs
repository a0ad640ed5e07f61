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
//! Players press keys at random, or are minds that see what the server tells their agents. When a game is
//! over, its players play another. Printed as JSON:
//! how late steps arrived, in milliseconds after the time at which they were due. A room's schedule begins
//! with the step that came earliest relative to its number, so lateness includes the server, the sockets and
//! the players' own waiting for a processor. The 99th percentile is there for each minute, too, and the
//! resident memory of the server each ten seconds, with the processor time that it took meanwhile.
//!
//! The server, the players and the clients that do not behave are a process each. The last have the lowest
//! priority, for elsewhere they would not share a processor with the server.

mod client;
mod mind;
mod misbehaving;

use clap::{Parser, ValueEnum, value_parser};
use client::{Failure, Late, Shared, play_on};
use phase_game::{GameSettings, playlist::Item};
use phase_model::EventKind;
use phase_sampler::sample_named;
use phase_serve::{Server, ServerSettings};
use serde_json::json;
use std::{
    collections::BTreeMap,
    io::{BufRead as _, BufReader, Read as _},
    net::SocketAddr,
    path::Path,
    process::{Child, Command, Stdio},
    sync::Arc,
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
    /// Be the server alone
    #[arg(long, hide = true)]
    server: bool,
    /// Be the clients that do not behave, of the server at this address
    #[arg(long, hide = true, num_args = 2, value_names = ["ADDRESS", "TOKEN"])]
    crowd: Option<Vec<String>>,
}

/// A process that does its part until its standard input is closed.
struct Part(Child);

impl Part {
    /// This program again, with its options and others.
    fn start(program: &mut Command, more: &[&str]) -> std::io::Result<Self> {
        program.args(std::env::args_os().skip(1)).args(more).stdin(Stdio::piped()).stdout(Stdio::piped());
        program.spawn().map(Self)
    }

    /// The first line that it prints.
    fn line(&mut self) -> Result<String, Failure> {
        let mut line = String::new();
        BufReader::new(self.0.stdout.take().ok_or("it prints once")?).read_line(&mut line)?;
        Ok(line)
    }
}

impl Drop for Part {
    fn drop(&mut self) {
        drop(self.0.stdin.take());
        let _ = self.0.wait();
    }
}

/// Waits until the standard input is closed.
fn asked_to_end() {
    let _ = std::io::stdin().read_to_end(&mut Vec::new());
}

fn main() -> Result<(), Failure> {
    let options = Options::parse();
    let mut scenes = Vec::new();
    for (seed, kind) in (0..).zip(EventKind::ALL) {
        scenes.push(Item { source: kind.name().into(), scene: sample_named(Some(kind.name()), None, seed)? });
    }
    let mut game = GameSettings::default();
    game.simulation.minds = game.simulation.minds.with_simulations(options.simulations);
    if options.server {
        return serve(&options, scenes, game);
    }
    let runtime = tokio::runtime::Builder::new_multi_thread().enable_all().build()?;
    if let Some([address, admin]) = options.crowd.as_deref() {
        let address = address.parse()?;
        let _entered = runtime.enter();
        misbehaving::start(options.misbehaving, address, admin);
        asked_to_end();
        return Ok(());
    }
    let own = std::env::current_exe()?;
    let mut server = Part::start(&mut Command::new(&own), &["--server"])?;
    let line = server.line()?;
    let (address, admin) = line.trim_end().split_once(' ').ok_or("the server did not start")?;
    let crowd = || match options.misbehaving {
        0 => Ok(None),
        _ => Part::start(Command::new("nice").args(["-n", "19"]).arg(&own), &["--crowd", address, admin])
            .map(Some),
    };
    let players = options.players == Players::Minds;
    let shared = Arc::new(Shared::new(scenes, game.simulation.minds, players));
    let measured = play(&options, address.parse()?, admin, &shared, server.0.id(), crowd);
    let measured = runtime.block_on(measured)?;
    println!("{}", report(&options, measured));
    Ok(())
}

/// Is the server, and prints its address and the token of the person in charge.
fn serve(options: &Options, scenes: Vec<Item>, game: GameSettings) -> Result<(), Failure> {
    let folder = tempfile::tempdir()?;
    let settings = ServerSettings {
        listen: ([127, 0, 0, 1], 0).into(),
        host: None,
        only_studies: false,
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
    let server = Server::bind(settings, scenes[0].clone(), scenes, None)?;
    println!("{} {}", server.address(), server.admin_token());
    let (stop, stopped) = tokio::sync::oneshot::channel::<()>();
    std::thread::spawn(move || {
        asked_to_end();
        let _ = stop.send(());
    });
    let until = async {
        let _ = stopped.await;
    };
    Ok(server.run(until)?)
}

/// Measurements of a run.
struct Measured {
    /// Lateness of each step of each player.
    lateness: Vec<Late>,
    /// The memory of the server over time (MiB).
    memory: Vec<u64>,
    /// The share of one processor that the server took.
    load: f64,
    /// Times that players were not let in, by the reason.
    refused: BTreeMap<String, usize>,
}

/// Plays for the time asked for, beside the `crowd`.
async fn play(
    options: &Options,
    address: SocketAddr,
    admin: &str,
    shared: &Arc<Shared>,
    server: u32,
    crowd: impl FnOnce() -> std::io::Result<Option<Part>>,
) -> Result<Measured, Failure> {
    let (partner, players) = match options.partner {
        Partner::Mind => ("mind", 1),
        Partner::Human => ("human", 2),
    };
    let mut rooms = Vec::new();
    for room in 0..options.rooms {
        // As fast as the server lets one address ask.
        tokio::time::sleep(Duration::from_millis(20)).await;
        let seed = players * u64::from(room);
        rooms.push(tokio::spawn(play_on(address, admin.into(), partner, seed, Arc::clone(shared))));
    }
    // Until all of them have left the practice.
    let opened = Instant::now();
    let all = players as usize * rooms.len();
    while shared.playing() < all && opened.elapsed() < Duration::from_secs(120) {
        tokio::time::sleep(Duration::from_millis(100)).await;
    }
    if shared.playing() < all {
        return Err("the games did not begin".into());
    }
    let crowd = crowd()?;
    shared.measure(true);
    let mut memory = vec![resident(server)];
    let (begun, before) = (Instant::now(), processor_time(server));
    let all = Duration::from_secs(options.seconds.into());
    while begun.elapsed() < all {
        tokio::time::sleep(BETWEEN.min(all.saturating_sub(begun.elapsed()))).await;
        memory.push(resident(server));
    }
    let load = (processor_time(server) - before) / begun.elapsed().as_secs_f64();
    shared.measure(false);
    drop(crowd);
    let mut lateness = Vec::new();
    for room in rooms {
        lateness.extend(room.await??);
    }
    Ok(Measured { lateness, memory, load, refused: shared.refused() })
}

fn told(process: u32, file: &str) -> String {
    std::fs::read_to_string(Path::new("/proc").join(process.to_string()).join(file)).unwrap_or_default()
}

/// Resident memory of a process (MiB); 0 where the system does not tell it like Linux.
fn resident(process: u32) -> u64 {
    let status = told(process, "status");
    let line = status.lines().find_map(|line| line.strip_prefix("VmRSS:"));
    line.and_then(|line| line.trim().trim_end_matches(" kB").parse::<u64>().ok()).unwrap_or_default() / 1024
}

/// Processor time of a process (s); 0 where the system does not tell it like Linux.
fn processor_time(process: u32) -> f64 {
    let stat = told(process, "stat");
    // After the name, in brackets: fields 3 and on, of which 14 and 15 are times in hundredths.
    let fields = stat.rsplit_once(')').map_or("", |(_, fields)| fields).split_whitespace();
    fields.skip(11).take(2).filter_map(|field| field.parse::<f64>().ok()).sum::<f64>() / 100.0
}

fn report(options: &Options, measured: Measured) -> serde_json::Value {
    let Measured { lateness, memory, load, refused } = measured;
    let first = lateness.iter().map(|late| late.0).min().unwrap_or_default();
    let mut minutes = Vec::<Vec<f32>>::new();
    for &(minute, late) in &lateness {
        let minute = usize::from(minute - first);
        minutes.resize_with(minutes.len().max(minute + 1), Vec::new);
        minutes[minute].push(late);
    }
    let by_minute: Vec<_> = minutes.into_iter().map(|mut minute| quantile(&mut minute, 0.99)).collect();
    let mut all: Vec<f32> = lateness.into_iter().map(|late| late.1).collect();
    json!({
        "rooms": options.rooms, "seconds": options.seconds,
        "players": format!("{:?}", options.players).to_lowercase(),
        "partner": format!("{:?}", options.partner).to_lowercase(),
        "simulations": options.simulations, "misbehaving": options.misbehaving, "server_mib": memory,
        "server_processors": (load * 100.0).round() / 100.0,
        "steps_seen": all.len(), "rooms_refused": refused,
        "late_ms": {
            "median": quantile(&mut all, 0.5), "p90": quantile(&mut all, 0.9),
            "p99": quantile(&mut all, 0.99), "worst": quantile(&mut all, 1.0), "p99_by_minute": by_minute,
        },
    })
}

/// The nearest rank of some times (ms).
fn quantile(times: &mut [f32], share: f64) -> Option<f64> {
    let rank = (share * times.len() as f64).ceil() as usize;
    times.sort_by(f32::total_cmp);
    times.get(rank.max(1) - 1).map(|&ms| f64::from((ms * 10.0).round()) / 10.0)
}
