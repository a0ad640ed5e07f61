//! Games that were going on when the server stopped.
//!
//! Journals are looked at first, which takes milliseconds each, and nobody is told that a game does not exist
//! before that. Then the games that are not over are replayed, as many at a time as there are cores; their
//! players wait meanwhile. Those that are over are not.

use super::{Listed, Rooms, journal_file::JournalFile, lock};
use crate::log;
use core::time::Duration;
use phase_files::{FileError, regular};
use phase_game::{
    JournalError, Room, Round,
    journal::{Entry, entries, is_over, whole},
};
use phase_model::path::RelativePath;
use std::{
    collections::BTreeSet,
    path::{Path, PathBuf},
    sync::Arc,
};
use thiserror::Error;
use tokio::{runtime::Handle, sync::watch};

/// Largest journal that is read (bytes): that of a game of 1000 rounds has a tenth of it.
const LARGEST_JOURNAL: u64 = 256 * 1024 * 1024;

/// Why a game does not go on.
#[derive(Debug, Error)]
enum ResumeError {
    #[error(transparent)]
    Unreadable(#[from] FileError),
    #[error(transparent)]
    Journal(#[from] JournalError),
    #[error("has the room {0:?}, which is not the name of the file")]
    Name(String),
    #[error("has a recording {id:?}: {rule}")]
    Recording { id: String, rule: String },
    #[error("cannot be continued")]
    Write(#[from] phase_files::WriteError),
    #[error("its replay failed")]
    Replay(#[from] tokio::task::JoinError),
}

/// A game that is to go on.
struct Open {
    path: PathBuf,
    /// Length of its journal without a last line that has no end (bytes).
    whole: usize,
    entries: Vec<Entry>,
    listed: Listed,
}

/// Looks at all journals and lets the open games go on, in the background. `known` is told once all games are
/// in the table.
pub(super) fn begin(rooms: Arc<Rooms>, files: Vec<PathBuf>, known: watch::Sender<bool>) {
    let runtime = Handle::current();
    runtime.clone().spawn_blocking(move || {
        let mut open = Vec::new();
        for path in files {
            match look(&rooms, &path) {
                Ok(game) => open.extend(game),
                Err(error) => tell(&path, error),
            }
        }
        // Nobody may be waiting.
        let _ = known.send(true);
        for game in open {
            let rooms = Arc::clone(&rooms);
            runtime.spawn(async move {
                let path = game.path.clone();
                if let Err(error) = replay(&rooms, game).await {
                    tell(&path, error);
                }
            });
        }
    });
}

/// A game that stays where it is.
#[derive(Debug, Error)]
#[error("{}: this game does not go on", path.display())]
struct NotResumed {
    path: PathBuf,
    source: ResumeError,
}

fn tell(path: &Path, source: ResumeError) {
    log::failure(&NotResumed { path: path.to_owned(), source });
}

/// Reads a journal: scenes that were played before count as given, and a game that is not over is put into
/// the table.
fn look(rooms: &Arc<Rooms>, path: &Path) -> Result<Option<Open>, ResumeError> {
    let bytes = regular::bytes_within(path, LARGEST_JOURNAL)?;
    let text = whole(&bytes)?;
    let entries = entries(text)?;
    let Some(Entry::Opened { room, keys, settings, rounds, .. }) = entries.first() else {
        return Err(JournalError::Opening.into());
    };
    {
        let mut playlist = lock(&rooms.playlist);
        rounds.iter().skip(1).for_each(|round| playlist.note(&round.source));
    }
    if is_over(&entries) {
        return Ok(None);
    }
    if path.file_stem().is_none_or(|stem| stem != room.as_str()) {
        return Err(ResumeError::Name(room.clone()));
    }
    check_recordings(room, rounds)?;
    // It was there before, however many there may be now.
    let Ok(listed) = rooms.list(room, keys, settings.players, None, |_| Ok(())) else { return Ok(None) };
    Ok(Some(Open { path: path.to_owned(), whole: text.len(), entries, listed }))
}

/// Checks names of recordings, which become files beside those of all other games: each has a name of its
/// own, with that of its room.
fn check_recordings(room: &str, rounds: &[Round]) -> Result<(), ResumeError> {
    let mut names = BTreeSet::new();
    for Round { id, .. } in rounds.iter().skip(1) {
        let wrong = |rule: String| ResumeError::Recording { id: id.clone(), rule };
        let name = file_name(id).map_err(|rule| wrong(rule.to_string()))?;
        if name.name() != name.as_str() {
            return Err(wrong("must be the name of one file".into()));
        }
        if !id.ends_with(&format!("-played-{room}")) || !names.insert(id) {
            return Err(wrong("must be one of this room, and the only one of its name".into()));
        }
    }
    Ok(())
}

/// The file of a recording, below the folder of recordings.
pub(super) fn file_name(id: &str) -> Result<RelativePath, phase_model::path::PathError> {
    RelativePath::new(format!("{id}.json"))
}

/// Plays a game again to where it was, and lets it go on.
async fn replay(rooms: &Arc<Rooms>, game: Open) -> Result<(), ResumeError> {
    let Open { path, whole, entries, listed } = game;
    // The semaphore is never closed.
    let _permit = rooms.cores.acquire().await.ok();
    let resumed = tokio::task::spawn_blocking(move || Room::resume(entries, Duration::ZERO)).await??;
    if let Some((room, effects)) = resumed {
        let journal = JournalFile::reopen(&path, whole)?;
        rooms.start(listed, room, journal, effects, None);
    }
    Ok(())
}
