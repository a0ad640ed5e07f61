//! A game that runs: its clock, its journal, its players' connections.

use super::{journal_file::JournalFile, resume::file_name};
use crate::log;
use axum::extract::ws::Utf8Bytes;
use phase_event::Recording;
use phase_files::{WriteError, atomic};
use phase_game::{Doing, Effect, Ending, FromPlayer, Room, RoomError, ToPlayer};
use phase_model::{AGENT_COUNT, AgentId};
use std::{
    path::PathBuf,
    sync::{
        Arc, Mutex, PoisonError,
        atomic::{AtomicBool, Ordering},
    },
    time::Duration,
};
use thiserror::Error;
use tokio::{
    sync::{Semaphore, mpsc, watch},
    time::{Instant, sleep_until},
};

/// Time for which the page of a finished game stays connected, so that its last messages arrive.
const LINGER: Duration = Duration::from_secs(2);

/// The connection of a player, as its room has it.
#[derive(Debug)]
pub(super) struct Line {
    pub(super) connection: u64,
    pub(super) out: mpsc::Sender<Utf8Bytes>,
    /// Whether another page of the player has taken its place.
    pub(super) replaced: Arc<AtomicBool>,
}

type Lines = [Option<Line>; AGENT_COUNT];

/// A command to a room.
#[derive(Debug)]
pub(super) enum Command {
    /// A connection for a player.
    Connect { agent: AgentId, line: Line },
    /// It is gone.
    Disconnect { agent: AgentId, connection: u64 },
    /// A message that came over it.
    Message { agent: AgentId, connection: u64, message: FromPlayer },
    /// Somebody in charge ends the game.
    End,
}

/// A game that ended because its simulation failed.
#[derive(Debug, Error)]
#[error("game {room}: the simulation failed, and the game is over")]
struct GameFailure {
    room: String,
    source: RoomError,
}

/// The part of a game that others may know.
#[derive(Clone, Copy, Debug)]
pub(super) struct Status {
    pub(super) doing: Doing,
    pub(super) round: usize,
    pub(super) rounds: usize,
    pub(super) connected: [bool; AGENT_COUNT],
    /// Time of the last round trip to each player (ms).
    pub(super) round_trip_ms: [Option<u32>; AGENT_COUNT],
}

/// A game that runs.
pub(super) struct Task {
    pub(super) room: Room,
    pub(super) journal: JournalFile,
    /// Folder for recordings.
    pub(super) events: PathBuf,
    pub(super) inbox: mpsc::Receiver<Command>,
    pub(super) status: Arc<Mutex<Status>>,
    /// As many minds think at the same time as there are cores.
    pub(super) cores: Arc<Semaphore>,
    pub(super) stop: watch::Receiver<bool>,
    /// Time in which somebody has to come, before the game is given up.
    pub(super) unvisited: Option<Duration>,
}

impl Task {
    /// Plays the game to its end, or until the server stops. Returns whether it is over.
    pub(super) async fn run(mut self, started: Vec<Effect>) -> bool {
        let begun = Instant::now();
        let mut seats: Lines = [None, None];
        let mut effects = started;
        loop {
            if let Err(error) = self.carry_out(effects, &mut seats).await {
                // Without its journal a game cannot go on: what is shown must not be lost.
                log::failure(&error);
                let failed = ToPlayer::State {
                    doing: Doing::Over,
                    ready: [false; AGENT_COUNT],
                    present: [false; AGENT_COUNT],
                    countdown_ms: None,
                    ending: Some(Ending::Failed),
                };
                AgentId::ALL.into_iter().for_each(|agent| send(&mut seats, agent, &failed));
                return true;
            }
            self.publish(&seats);
            if self.room.doing() == Doing::Over {
                tokio::time::sleep(LINGER).await;
                return true;
            }
            if self.room.must_think() {
                self = self.think().await;
            }
            let due = self.room.due().map_or_else(|| begun + Duration::from_secs(3600), |due| begun + due);
            let given_up = self.unvisited.map_or(due, |unvisited| begun + unvisited);
            effects = tokio::select! {
                () = sleep_until(given_up), if self.unvisited.is_some() => {
                    self.unvisited = None;
                    self.room.receive(AgentId::ZERO, FromPlayer::Leave, begun.elapsed())
                }
                () = sleep_until(due) => self.room.advance(begun.elapsed()),
                command = self.inbox.recv() => match command {
                    Some(command) => self.obey(command, &mut seats, begun.elapsed()),
                    None => return false,
                },
                _ = self.stop.changed() => return false,
            };
        }
    }

    fn obey(&mut self, command: Command, seats: &mut Lines, now: Duration) -> Vec<Effect> {
        let current = seats.each_ref().map(|line| line.as_ref().map(|line| line.connection));
        match command {
            Command::Connect { agent, line } => {
                self.unvisited = None;
                // The newest page of a player counts; the one before it is disconnected when its sender is
                // dropped.
                if let Some(before) = seats[agent].replace(line) {
                    before.replaced.store(true, Ordering::Relaxed);
                }
                self.room.connect(agent, now)
            }
            // Also where it did not keep up and was dropped before.
            Command::Disconnect { agent, connection }
                if current[agent].is_none_or(|current| current == connection) =>
            {
                seats[agent] = None;
                self.room.disconnect(agent, now)
            }
            Command::Message { agent, connection, message } if current[agent] == Some(connection) => {
                self.room.receive(agent, message, now)
            }
            Command::End => self.room.receive(AgentId::ZERO, FromPlayer::Leave, now),
            Command::Disconnect { .. } | Command::Message { .. } => Vec::new(),
        }
    }

    /// Minds take milliseconds, in which nobody else is to wait.
    async fn think(mut self) -> Self {
        let cores = Arc::clone(&self.cores);
        // The semaphore is never closed.
        let permit = cores.acquire().await.ok();
        let mut room = self.room;
        let thought = tokio::task::spawn_blocking(move || {
            room.think();
            room
        });
        match thought.await {
            Ok(room) => self.room = room,
            // It is neither cancelled nor does it panic; if it does after all, so does this task.
            Err(error) => std::panic::resume_unwind(Box::new(error.to_string())),
        }
        drop(permit);
        self
    }

    async fn carry_out(&mut self, effects: Vec<Effect>, seats: &mut Lines) -> Result<(), WriteError> {
        for effect in effects {
            match effect {
                Effect::Journal(entry) => self.journal.append(&entry).await?,
                Effect::Send(agent, message) => send(seats, agent, &message),
                Effect::Finished(recording) => save(self.events.clone(), recording).await?,
                Effect::Failed(source) => {
                    log::failure(&GameFailure { room: self.room.name().to_owned(), source });
                }
            }
        }
        Ok(())
    }

    fn publish(&self, seats: &Lines) {
        let mut status = self.status.lock().unwrap_or_else(PoisonError::into_inner);
        status.doing = self.room.doing();
        (status.round, status.rounds) = self.room.progress();
        status.connected = seats.each_ref().map(Option::is_some);
    }
}

/// Sends a message; a connection that does not keep up is dropped, and the player's page connects again.
fn send(seats: &mut Lines, agent: AgentId, message: &ToPlayer) {
    let Some(Line { out, .. }) = &seats[agent] else { return };
    // Messages have no maps with other keys than texts and no numbers that are not finite.
    let text = serde_json::to_string(message).unwrap_or_default();
    if out.try_send(text.into()).is_err() {
        seats[agent] = None;
    }
}

/// Writes a recording, as a file of one event.
async fn save(folder: PathBuf, recording: Box<Recording>) -> Result<(), WriteError> {
    let wrong = |rule| WriteError {
        path: folder.clone(),
        action: "write into the folder",
        source: std::io::Error::other(rule),
    };
    let path = file_name(&recording.id).map_err(wrong)?.below(&folder);
    let write = move || {
        let text = phase_event::to_json(&[*recording]).map_err(|error| WriteError {
            path: path.clone(),
            action: "write",
            source: std::io::Error::other(error),
        })?;
        atomic::write_private(&path, text.as_bytes())
    };
    match tokio::task::spawn_blocking(write).await {
        Ok(written) => written,
        Err(error) => std::panic::resume_unwind(Box::new(error.to_string())),
    }
}
