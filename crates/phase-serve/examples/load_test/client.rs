//! A player that is a program.

use crate::mind::Player;
use futures_util::{SinkExt as _, StreamExt as _};
use phase_game::playlist::Item;
use phase_minds::MindParameters;
use phase_model::{
    Action, AgentId,
    random::{Pcg64Mcg, Purpose, stream},
};
use rand::RngExt as _;
use serde_json::{Value, json};
use std::{
    collections::BTreeMap,
    net::SocketAddr,
    sync::{
        Arc, Mutex, PoisonError,
        atomic::{AtomicBool, AtomicUsize, Ordering},
    },
    time::{Duration, Instant},
};
use tokio::{
    io::{AsyncReadExt as _, AsyncWriteExt as _},
    net::TcpStream,
};
use tokio_tungstenite::{WebSocketStream, client_async, tungstenite::Message};

/// Chance that a player with random keys changes what it does after a step.
const CHANGE: f64 = 0.75;
/// Duration of a step (s).
const STEP: f64 = 0.25;
/// Pause after which a player whom the server refused asks again.
const PAUSE: Duration = Duration::from_secs(1);

/// Why a player cannot play.
pub(crate) type Failure = Box<dyn core::error::Error + Send + Sync>;

/// A step of a player: the minutes since the start, and how late it was (ms).
pub(crate) type Late = (u16, f32);

/// What all players share.
pub(crate) struct Shared {
    scenes: Vec<Item>,
    parameters: MindParameters,
    minds: bool,
    begun: Instant,
    playing: AtomicUsize,
    refused: Mutex<BTreeMap<String, usize>>,
    measuring: AtomicBool,
    over: AtomicBool,
}

impl Shared {
    pub(crate) fn new(scenes: Vec<Item>, parameters: MindParameters, minds: bool) -> Self {
        let (playing, refused) = Default::default();
        let [measuring, over] = [AtomicBool::new(false), AtomicBool::new(false)];
        Self { scenes, parameters, minds, begun: Instant::now(), playing, refused, measuring, over }
    }

    /// Players that have left the practice.
    pub(crate) fn playing(&self) -> usize {
        self.playing.load(Ordering::Relaxed)
    }

    /// Times that a player was not let in, by the reason: while a room that is over had not been closed, or
    /// because all players, who have one address, asked at once.
    pub(crate) fn refused(&self) -> BTreeMap<String, usize> {
        self.refused.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }

    fn refuse(&self, why: &Failure) {
        let mut refused = self.refused.lock().unwrap_or_else(PoisonError::into_inner);
        *refused.entry(why.to_string()).or_default() += 1;
    }

    /// Whether all is measured.
    fn is_over(&self) -> bool {
        self.over.load(Ordering::Relaxed)
    }

    /// Begins or ends what is measured.
    pub(crate) fn measure(&self, on: bool) {
        self.measuring.store(on, Ordering::Relaxed);
        self.over.store(!on, Ordering::Relaxed);
    }
}

/// Opens a room; the tokens of its players.
pub(crate) async fn open_room(
    address: SocketAddr,
    admin: &str,
    partner: &str,
) -> Result<Vec<String>, Failure> {
    let body = json!({ "partner": partner }).to_string();
    let request = format!(
        "POST /api/rooms HTTP/1.1\r\nHost: {address}\r\nAuthorization: Bearer {admin}\r\nContent-Length: {}\r\n\
         Connection: close\r\n\r\n{body}",
        body.len()
    );
    let mut stream = TcpStream::connect(address).await?;
    stream.write_all(request.as_bytes()).await?;
    let mut answer = String::new();
    stream.read_to_string(&mut answer).await?;
    let (_, body) = answer.split_once("\r\n\r\n").ok_or("no answer")?;
    let room: Value = serde_json::from_str(body)?;
    let tokens = room["tokens"].as_array().ok_or_else(|| format!("no room: {body}"))?;
    Ok(tokens.iter().filter_map(|token| token.as_str().map(Into::into)).collect())
}

/// Plays one game after the other in rooms of its own until all is measured; how late steps were. Seeds are
/// those of its first players.
pub(crate) async fn play_on(
    address: SocketAddr,
    admin: String,
    partner: &'static str,
    seed: u64,
    shared: Arc<Shared>,
) -> Result<Vec<Late>, Failure> {
    let mut lateness = Vec::new();
    while !shared.is_over() {
        match enter(address, &admin, partner, seed, &shared).await {
            Ok(clients) => {
                let players: Vec<_> = clients.into_iter().map(|it| tokio::spawn(it.play())).collect();
                for player in players {
                    lateness.extend(player.await?);
                }
            }
            Err(why) => {
                shared.refuse(&why);
                tokio::time::sleep(PAUSE).await;
            }
        }
    }
    Ok(lateness)
}

/// The players of a new room.
async fn enter(
    address: SocketAddr,
    admin: &str,
    partner: &str,
    seed: u64,
    shared: &Arc<Shared>,
) -> Result<Vec<Client>, Failure> {
    let mut clients = Vec::new();
    for (token, seed) in open_room(address, admin, partner).await?.into_iter().zip(seed..) {
        clients.push(Client::join(address, token, seed, Arc::clone(shared)).await?);
    }
    Ok(clients)
}

/// A player and its socket.
struct Client {
    socket: WebSocketStream<TcpStream>,
    random: Pcg64Mcg,
    shared: Arc<Shared>,
    agent: AgentId,
    counted: bool,
    round: u64,
    player: Option<Player>,
    /// Arrivals of the steps of the round: number and time (s).
    arrivals: Vec<(u64, f64)>,
    lateness: Vec<Late>,
}

impl Client {
    async fn join(
        address: SocketAddr,
        token: String,
        seed: u64,
        shared: Arc<Shared>,
    ) -> Result<Self, Failure> {
        let stream = TcpStream::connect(address).await?;
        stream.set_nodelay(true)?;
        let (mut socket, _) = client_async(format!("ws://{address}/play/socket"), stream).await?;
        socket.send(Message::text(json!({ "type": "join", "token": token }).to_string())).await?;
        let random = stream_of(seed);
        let (agent, player) = (AgentId::ZERO, None);
        Ok(Self {
            socket,
            random,
            shared,
            agent,
            counted: false,
            round: 0,
            player,
            arrivals: Vec::new(),
            lateness: Vec::new(),
        })
    }

    /// Plays until its game is over or all is measured; how late steps were.
    async fn play(mut self) -> Vec<Late> {
        while !self.shared.is_over() {
            let message = tokio::time::timeout(Duration::from_secs(1), self.socket.next()).await;
            let text = match message {
                Ok(Some(Ok(Message::Text(text)))) => text,
                Ok(Some(Ok(_))) | Err(_) => continue,
                Ok(Some(Err(_)) | None) => break,
            };
            let now = self.shared.begun.elapsed().as_secs_f64();
            let Ok(message) = serde_json::from_str::<Value>(&text) else { continue };
            for answer in self.answer(&message, now) {
                if self.socket.send(Message::text(answer.to_string())).await.is_err() {
                    break;
                }
            }
        }
        self.settle();
        self.lateness
    }

    fn answer(&mut self, message: &Value, now: f64) -> Vec<Value> {
        match message["type"].as_str() {
            Some("welcome") => {
                self.agent = AgentId::ALL[usize::from(message["agent"] == 1)];
                Vec::new()
            }
            Some("stage") => {
                self.settle();
                self.round = message["round"].as_u64().unwrap_or_default();
                let scenes = &self.shared.scenes;
                self.player = (self.shared.minds && self.round > 0)
                    .then(|| Player::new(scenes, message, self.agent, &self.shared.parameters))
                    .flatten();
                Vec::new()
            }
            Some("state") => self.ready(message),
            Some("sight") => self.act(message, now),
            _ => Vec::new(),
        }
    }

    /// Reads nothing and needs no practice.
    fn ready(&mut self, message: &Value) -> Vec<Value> {
        let waiting = message["doing"] == "reading" || (message["doing"] == "playing" && self.round == 0);
        if message["doing"] == "playing" && self.round > 0 && !self.counted {
            self.counted = true;
            self.shared.playing.fetch_add(1, Ordering::Relaxed);
        }
        let ready = message["ready"][self.agent.index()] == true;
        if waiting && !ready { vec![json!({ "type": "ready" })] } else { Vec::new() }
    }

    fn act(&mut self, sight: &Value, now: f64) -> Vec<Value> {
        let step = sight["step"].as_u64().unwrap_or_default();
        let first = sight["frames"].as_array().is_some_and(|frames| frames.len() == 1);
        if !first && self.shared.measuring.load(Ordering::Relaxed) {
            self.arrivals.push((step, now));
        }
        if let Some(player) = &mut self.player {
            return match player.decide(sight) {
                Some(Action::Attach | Action::Detach) => vec![json!({ "type": "grab" })],
                Some(action) => vec![json!({ "type": "hold", "action": action.name() })],
                None => Vec::new(),
            };
        }
        if !self.random.random_bool(CHANGE) {
            return Vec::new();
        }
        match Action::ALL[self.random.random_range(0..Action::ALL.len())] {
            Action::Attach | Action::Detach => vec![json!({ "type": "grab" })],
            action => vec![json!({ "type": "hold", "action": action.name() })],
        }
    }

    /// Compares the arrivals of a round with its schedule.
    fn settle(&mut self) {
        let offset = |&(step, at): &(u64, f64)| at - step as f64 * STEP;
        let earliest = self.arrivals.iter().map(offset).fold(f64::INFINITY, f64::min);
        let late =
            |arrival: &(u64, f64)| ((arrival.1 / 60.0) as u16, ((offset(arrival) - earliest) * 1e3) as f32);
        self.lateness.extend(self.arrivals.iter().map(late));
        self.arrivals.clear();
    }
}

fn stream_of(seed: u64) -> Pcg64Mcg {
    stream(seed, Purpose::Scene, 0)
}
