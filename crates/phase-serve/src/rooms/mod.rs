//! The games of a server: opened, joined, resumed.

mod api;
mod journal_file;
mod socket;
mod task;

use crate::{
    error::{ApiError, ServeError},
    log,
    settings::ServerSettings,
    token,
};
use axum::http::StatusCode;
use core::time::Duration;
use journal_file::JournalFile;
use phase_files::WriteError;
use phase_game::{
    Effect, GameSettings, Player, Playlist, Room, Round, View,
    journal::{Entry, entries},
    playlist::Item,
};
use phase_model::{
    AGENT_COUNT, AgentId,
    random::{Purpose, derive_seed},
};
use std::{
    collections::HashMap,
    fs,
    path::PathBuf,
    sync::{
        Arc, Mutex, MutexGuard, PoisonError,
        atomic::{AtomicU64, Ordering},
    },
};
use task::{Command, Status, Task};
use tokio::sync::{Semaphore, mpsc, watch};

pub(crate) use api::routes;

/// Messages that wait for a room at most; a socket that brings more has to wait.
const INBOX: usize = 64;
/// Letters of an event's id that stay in the id of a recording.
const SOURCE_LETTERS: usize = 80;

/// The wish for a room: its players, and the part of the world that they see.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Wish {
    pub(crate) players: [Player; AGENT_COUNT],
    pub(crate) view: View,
}

/// A room that was opened: its name, and by agent the token of its player.
#[derive(Clone, Debug)]
pub(crate) struct Opened {
    pub(crate) name: String,
    pub(crate) tokens: [Option<String>; AGENT_COUNT],
}

struct Running {
    /// Whether a mind plays.
    mind: bool,
    inbox: mpsc::Sender<Command>,
    status: Arc<Mutex<Status>>,
}

#[derive(Default)]
struct Table {
    rooms: HashMap<String, Running>,
    /// By what is kept of a token, the room and the agent.
    seats: HashMap<String, (String, AgentId)>,
}

/// The games of a server.
pub(crate) struct Rooms {
    settings: ServerSettings,
    practice: Item,
    playlist: Mutex<Playlist>,
    table: Mutex<Table>,
    cores: Arc<Semaphore>,
    stop: watch::Receiver<bool>,
    connections: AtomicU64,
}

impl Rooms {
    /// The games in a server's folder go on; `practice` and `scenes` are for new ones.
    pub(crate) fn open(
        settings: ServerSettings,
        practice: Item,
        scenes: Vec<Item>,
        stop: watch::Receiver<bool>,
    ) -> Result<Arc<Self>, ServeError> {
        let cores = std::thread::available_parallelism().map_or(1, usize::from);
        let rooms = Arc::new(Self {
            playlist: Mutex::new(Playlist::new(scenes, settings.seed)),
            table: Mutex::default(),
            cores: Arc::new(Semaphore::new(cores)),
            connections: AtomicU64::new(0),
            practice,
            settings,
            stop,
        });
        for folder in [rooms.journals(), rooms.events()] {
            let failed = |source| WriteError { path: folder.clone(), action: "create the folder", source };
            fs::create_dir_all(&folder).map_err(failed)?;
        }
        rooms.resume()?;
        Ok(rooms)
    }

    /// Folder of journals.
    fn journals(&self) -> PathBuf {
        self.settings.folder.join("rooms")
    }

    /// Folder of recordings.
    pub(crate) fn events(&self) -> PathBuf {
        self.settings.folder.join("events")
    }

    /// Reads the journals: games that are not over go on, and scenes that were played before count as given.
    fn resume(self: &Arc<Self>) -> Result<(), ServeError> {
        let folder = self.journals();
        let files = journal_file::read_all(&folder)
            .map_err(|source| ServeError::Read { path: folder.clone(), source })?;
        for (path, text) in files {
            let read = match entries(&text) {
                Ok(read) => read,
                Err(error) => {
                    log::line(&format!("{}: {error}; this game does not go on", path.display()));
                    continue;
                }
            };
            if let Some(Entry::Opened { rounds, .. }) = read.first() {
                let mut playlist = lock(&self.playlist);
                rounds.iter().skip(1).for_each(|round| playlist.note(&round.source));
            }
            match Room::resume(read, Duration::ZERO) {
                Ok(None) => {}
                Ok(Some((room, effects))) => {
                    let journal = JournalFile::reopen(&path, &text)?;
                    self.start(room, journal, effects);
                }
                Err(error) => {
                    log::line(&format!("{}: {error}; this game does not go on", path.display()));
                }
            }
        }
        Ok(())
    }

    /// Opens a room.
    pub(crate) fn create(self: &Arc<Self>, wish: Wish) -> Result<Opened, ApiError> {
        let full = || ApiError::busy("all rooms are taken; try again later");
        let minds = {
            let table = lock(&self.table);
            if table.rooms.len() >= self.settings.rooms {
                return Err(full());
            }
            table.rooms.values().filter(|running| running.mind).count()
        };
        if wish.players.contains(&Player::Mind) && minds >= self.settings.mind_rooms {
            return Err(ApiError::busy(
                "all minds are playing; try again later, or play with another person",
            ));
        }
        let failed = |error: getrandom::Error| ApiError::failed(&error);
        let name = token::short().map_err(failed)?;
        let mut tokens = [None, None];
        for (token, player) in tokens.iter_mut().zip(wish.players) {
            if player == Player::Human {
                *token = Some(token::new().map_err(failed)?);
            }
        }
        let keys = tokens.each_ref().map(|token| token.as_deref().map(token::kept));
        let game = GameSettings { players: wish.players, view: wish.view, ..self.settings.game };
        let room = Room::open(&name, keys, game, self.rounds(&name), Duration::ZERO)
            .map_err(|error| ApiError::failed(&error))?;
        let mut journal =
            JournalFile::create(&self.journals(), &name).map_err(|error| ApiError::failed(&error))?;
        task::begin(&mut journal, &room).map_err(|error| ApiError::failed(&error))?;
        self.start(room, journal, Vec::new());
        Ok(Opened { name, tokens })
    }

    /// The practice, and scenes that were played least so far.
    fn rounds(&self, room: &str) -> Vec<Round> {
        let drawn = lock(&self.playlist).draw(self.settings.rounds);
        let practice = Round {
            id: String::new(),
            source: self.practice.source.clone(),
            scene: self.practice.scene.clone(),
            seed: self.settings.seed,
        };
        let named = u64::from_str_radix(room, 16).unwrap_or_default();
        let rounds = drawn.into_iter().zip(1..).map(|(item, number)| Round {
            id: format!("{}-played-{room}", item.source.chars().take(SOURCE_LETTERS).collect::<String>()),
            seed: derive_seed(self.settings.seed ^ (named << 8), Purpose::Event, number),
            source: item.source,
            scene: item.scene,
        });
        std::iter::once(practice).chain(rounds).collect()
    }

    fn start(self: &Arc<Self>, room: Room, journal: JournalFile, effects: Vec<Effect>) {
        let (inbox, commands) = mpsc::channel(INBOX);
        let (round, rounds) = room.progress();
        let status = Arc::new(Mutex::new(Status {
            doing: room.doing(),
            round,
            rounds,
            connected: [false; AGENT_COUNT],
            round_trip_ms: [None; AGENT_COUNT],
        }));
        let name = room.name().to_owned();
        {
            let mut table = lock(&self.table);
            for agent in AgentId::ALL {
                if let Some(key) = &room.keys()[agent] {
                    table.seats.insert(key.clone(), (name.clone(), agent));
                }
            }
            let mind = room.players().contains(&Player::Mind);
            table.rooms.insert(name.clone(), Running { mind, inbox, status: Arc::clone(&status) });
        }
        let task = Task {
            room,
            journal,
            events: self.events(),
            inbox: commands,
            status,
            cores: Arc::clone(&self.cores),
            stop: self.stop.clone(),
        };
        let rooms = Arc::clone(self);
        tokio::spawn(async move {
            task.run(effects).await;
            rooms.forget(&name);
        });
    }

    fn forget(&self, name: &str) {
        let mut table = lock(&self.table);
        table.rooms.remove(name);
        table.seats.retain(|_, (room, _)| room != name);
    }

    /// The room and the agent that a token lets in.
    fn seat(&self, token: &str) -> Option<(mpsc::Sender<Command>, Arc<Mutex<Status>>, AgentId)> {
        let table = lock(&self.table);
        let (room, agent) = table.seats.get(&token::kept(token))?;
        let running = table.rooms.get(room)?;
        Some((running.inbox.clone(), Arc::clone(&running.status), *agent))
    }

    /// Ends a game.
    pub(crate) async fn end(&self, name: &str) -> Result<(), ApiError> {
        let inbox = lock(&self.table).rooms.get(name).map(|running| running.inbox.clone());
        let inbox = inbox.ok_or_else(ApiError::missing)?;
        inbox.send(Command::End).await.map_err(|_| ApiError::new(StatusCode::GONE, "the game is over"))
    }

    /// The games that run, by name.
    pub(crate) fn statuses(&self) -> Vec<(String, serde_json::Value)> {
        let table = lock(&self.table);
        let described = table.rooms.iter().map(|(name, running)| {
            let status = *lock(&running.status);
            let described = serde_json::json!({
                "room": name, "doing": status.doing, "round": status.round, "rounds": status.rounds,
                "connected": status.connected, "round_trip_ms": status.round_trip_ms,
            });
            (name.clone(), described)
        });
        let mut described: Vec<_> = described.collect();
        described.sort_by(|a, b| a.0.cmp(&b.0));
        described
    }

    /// Scenes and how often each was given to a game.
    pub(crate) fn given(&self) -> Vec<(String, u32)> {
        lock(&self.playlist).given().map(|(source, count)| (source.to_owned(), count)).collect()
    }

    /// A number for a new connection.
    fn connection(&self) -> u64 {
        self.connections.fetch_add(1, Ordering::Relaxed)
    }

    /// Whether the server stops.
    fn stopping(&self) -> watch::Receiver<bool> {
        self.stop.clone()
    }
}

/// Nothing that is locked here can be left half-changed by a panic.
pub(crate) fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
