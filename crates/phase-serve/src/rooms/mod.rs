//! The games of a server: opened, joined, resumed.

mod api;
mod journal_file;
mod resume;
mod socket;
mod task;

use crate::{
    error::{ApiError, ServeError},
    limits::Bucket,
    settings::ServerSettings,
    token,
};
use axum::http::StatusCode;
use core::time::Duration;
use journal_file::JournalFile;
use phase_files::{WriteError, private};
use phase_game::{Doing, Effect, GameSettings, Player, Playlist, Room, Round, View, playlist::Item};
use phase_model::{
    AGENT_COUNT, AgentId,
    random::{Purpose, derive_seed},
};
use std::{
    collections::HashMap,
    net::IpAddr,
    path::PathBuf,
    sync::{
        Arc, Mutex, MutexGuard, PoisonError,
        atomic::{AtomicU64, Ordering},
    },
    time::Instant,
};
use task::{Command, Status, Task};
use tokio::sync::{Semaphore, mpsc, watch};

pub(crate) use api::routes;

/// Messages that wait for a room at most; a socket that brings more has to wait.
const INBOX: usize = 64;
/// Letters of an event's id that stay in the id of a recording.
const SOURCE_LETTERS: usize = 80;
/// Connections of a player at once, and then a second: of a page that is reloaded, not of one that takes its
/// own place again and again.
const COMINGS: (f64, f64) = (10.0, 0.5);
/// Rooms that one address may always have at the same time; and games with a mind. Beyond that no address
/// has more than half of them.
const OF_ADDRESS: (usize, usize) = (32, 4);
/// Time in which somebody has to come into a room that anybody could open, before it is given up.
const UNVISITED: Duration = Duration::from_secs(120);

/// The wish for a room: its players, and the part of the world that they see.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Wish {
    /// The address of who opens it; absent for the person in charge.
    pub(crate) opener: Option<IpAddr>,
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
    opener: Option<IpAddr>,
    inbox: mpsc::Sender<Command>,
    status: Arc<Mutex<Status>>,
}

/// The place of a player.
struct Seat {
    room: String,
    agent: AgentId,
    comings: Bucket,
}

#[derive(Default)]
struct Table {
    rooms: HashMap<String, Running>,
    /// By what is kept of a token.
    seats: HashMap<String, Seat>,
}

/// A room that is in the table, and leaves it when this is dropped, however its task ends.
struct Listed {
    rooms: Arc<Rooms>,
    name: String,
    commands: Option<mpsc::Receiver<Command>>,
    status: Arc<Mutex<Status>>,
}

impl Drop for Listed {
    fn drop(&mut self) {
        let mut table = lock(&self.rooms.table);
        table.rooms.remove(&self.name);
        table.seats.retain(|_, seat| seat.room != self.name);
    }
}

/// Why a player is not let in.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum NoSeat {
    /// There is no such game, or it is over.
    Unknown,
    /// The player has come too often.
    TooOften,
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
    /// Whether all journals have been looked at.
    known: watch::Receiver<bool>,
}

impl Rooms {
    /// The games in a server's folder go on, in the background; `practice` and `scenes` are for new ones.
    pub(crate) fn open(
        settings: ServerSettings,
        practice: Item,
        scenes: Vec<Item>,
        stop: watch::Receiver<bool>,
    ) -> Result<Arc<Self>, ServeError> {
        let (told, known) = watch::channel(false);
        let cores = std::thread::available_parallelism().map_or(1, usize::from);
        let rooms = Arc::new(Self {
            playlist: Mutex::new(Playlist::new(scenes, settings.seed)),
            table: Mutex::default(),
            cores: Arc::new(Semaphore::new(cores)),
            connections: AtomicU64::new(0),
            practice,
            settings,
            stop,
            known,
        });
        for folder in [rooms.journals(), rooms.events()] {
            let failed = |source| WriteError { path: folder.clone(), action: "prepare the folder", source };
            private::take_folder(&folder).map_err(failed)?;
        }
        let folder = rooms.journals();
        let files = journal_file::all(&folder).map_err(|source| ServeError::Read { path: folder, source })?;
        resume::begin(Arc::clone(&rooms), files, told);
        Ok(rooms)
    }

    /// Waits until all games are known that the server has.
    async fn known(&self) {
        // The sender is dropped once they are.
        let _ = self.known.clone().wait_for(|known| *known).await;
    }

    /// Folder of journals.
    fn journals(&self) -> PathBuf {
        self.settings.folder.join("rooms")
    }

    /// Folder of recordings.
    pub(crate) fn events(&self) -> PathBuf {
        self.settings.folder.join("events")
    }

    /// Opens a room.
    pub(crate) async fn create(self: &Arc<Self>, wish: Wish) -> Result<Opened, ApiError> {
        self.known().await;
        let failed = |error: getrandom::Error| ApiError::failed(&error);
        let name = token::short().map_err(failed)?;
        let mut tokens = [None, None];
        for (token, player) in tokens.iter_mut().zip(wish.players) {
            if player == Player::Human {
                *token = Some(token::new().map_err(failed)?);
            }
        }
        let keys = tokens.each_ref().map(|token| token.as_deref().map(token::kept));
        let listed =
            self.list(&name, &keys, wish.players, wish.opener, |table| self.has_room(table, wish))?;
        let game = GameSettings { players: wish.players, view: wish.view, ..self.settings.game };
        let (rounds, folder, named) = (self.rounds(&name), self.journals(), name.clone());
        // A world and a file take milliseconds, in which no step of others is to wait.
        let prepare = move || {
            let room = Room::open(&named, keys, game, rounds, Duration::ZERO)
                .map_err(|error| ApiError::failed(&error))?;
            let journal = JournalFile::create(&folder, &named).map_err(|error| ApiError::failed(&error))?;
            Ok::<_, ApiError>((room, journal))
        };
        let prepared = tokio::task::spawn_blocking(prepare).await;
        let (room, mut journal) = prepared.map_err(|error| ApiError::failed(&error))??;
        let opening = room.opening();
        journal.append(&opening).await.map_err(|error| ApiError::failed(&error))?;
        let unvisited = wish.opener.is_some().then_some(UNVISITED);
        self.start(listed, room, journal, Vec::new(), unvisited);
        Ok(Opened { name, tokens })
    }

    /// Whether there may be another room.
    fn has_room(&self, table: &Table, wish: Wish) -> Result<(), ApiError> {
        let own = |running: &&Running| wish.opener.is_some() && running.opener == wish.opener;
        let rooms = table.rooms.values();
        if rooms.len() >= self.settings.rooms {
            return Err(ApiError::busy("all rooms are taken; try again later"));
        }
        if rooms.clone().filter(own).count() >= OF_ADDRESS.0.max(self.settings.rooms / 2) {
            return Err(ApiError::busy("too many rooms were opened from here; try again later"));
        }
        let minds = rooms.filter(|running| running.mind);
        let own_minds = minds.clone().filter(own).count();
        if wish.players.contains(&Player::Mind)
            && (minds.count() >= self.settings.mind_rooms
                || own_minds >= OF_ADDRESS.1.max(self.settings.mind_rooms / 2))
        {
            return Err(ApiError::busy(
                "all minds are playing; try again later, or play with another person",
            ));
        }
        Ok(())
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

    /// Puts a room into the table, if it may be there.
    fn list(
        self: &Arc<Self>,
        name: &str,
        keys: &[Option<String>; AGENT_COUNT],
        players: [Player; AGENT_COUNT],
        opener: Option<IpAddr>,
        may: impl FnOnce(&Table) -> Result<(), ApiError>,
    ) -> Result<Listed, ApiError> {
        let (inbox, commands) = mpsc::channel(INBOX);
        let status = Arc::new(Mutex::new(Status {
            doing: Doing::Gathering,
            round: 0,
            rounds: 0,
            connected: [false; AGENT_COUNT],
            round_trip_ms: [None; AGENT_COUNT],
        }));
        let mut table = lock(&self.table);
        may(&table)?;
        if table.rooms.contains_key(name) {
            return Err(ApiError::busy("there is a room of this name; try again"));
        }
        for agent in AgentId::ALL {
            if let Some(key) = &keys[agent] {
                let comings = Bucket::new(COMINGS.0, COMINGS.1, Instant::now());
                let seat = Seat { room: name.to_owned(), agent, comings };
                table.seats.entry(key.clone()).or_insert(seat);
            }
        }
        let mind = players.contains(&Player::Mind);
        let running = Running { mind, opener, inbox, status: Arc::clone(&status) };
        table.rooms.insert(name.to_owned(), running);
        drop(table);
        Ok(Listed { rooms: Arc::clone(self), name: name.to_owned(), commands: Some(commands), status })
    }

    /// Lets a room begin. `unvisited` is the time in which somebody has to come.
    fn start(
        &self,
        mut listed: Listed,
        room: Room,
        journal: JournalFile,
        effects: Vec<Effect>,
        unvisited: Option<Duration>,
    ) {
        let Some(inbox) = listed.commands.take() else { return };
        let task = Task {
            room,
            journal,
            events: self.events(),
            inbox,
            status: Arc::clone(&listed.status),
            cores: Arc::clone(&self.cores),
            stop: self.stop.clone(),
            unvisited,
        };
        tokio::spawn(async move {
            task.run(effects).await;
            drop(listed);
        });
    }

    /// The room and the agent that a token lets in.
    async fn seat(
        &self,
        token: &str,
    ) -> Result<(mpsc::Sender<Command>, Arc<Mutex<Status>>, AgentId), NoSeat> {
        self.known().await;
        let mut table = lock(&self.table);
        let Table { rooms, seats } = &mut *table;
        let seat = seats.get_mut(&token::kept(token)).ok_or(NoSeat::Unknown)?;
        let running = rooms.get(&seat.room).ok_or(NoSeat::Unknown)?;
        if !seat.comings.take(Instant::now()) {
            return Err(NoSeat::TooOften);
        }
        Ok((running.inbox.clone(), Arc::clone(&running.status), seat.agent))
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
