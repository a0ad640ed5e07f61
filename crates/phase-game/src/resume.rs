//! A game that goes on where its journal ends.

use crate::{
    Effect, Entry, JournalError, Player, Room, RoomError,
    journal::{Actions, FORMAT},
    room::Phase,
};
use core::time::Duration;
use phase_model::{AGENT_COUNT, AgentId};

impl Room {
    /// The game of a journal, which goes on when its players are back. Minds decide anew, as they did, so
    /// that they go on as if nothing had happened. What follows at once is the end of a round whose last step
    /// is the journal's last entry. `None` if the game is over.
    ///
    /// # Errors
    /// [`JournalError`].
    pub fn resume(entries: Vec<Entry>, now: Duration) -> Result<Option<(Self, Vec<Effect>)>, JournalError> {
        let mut entries = entries.into_iter().enumerate().map(|(k, entry)| (k + 1, entry));
        let Some((_, Entry::Opened { format, room, keys, settings, rounds })) = entries.next() else {
            return Err(JournalError::Opening);
        };
        if format != FORMAT {
            return Err(JournalError::Opening);
        }
        let players = settings.players;
        let mut room = Self::open(&room, keys, *settings, rounds, now)?;
        // The game's end, after which there is nothing.
        let over = |rest: &mut dyn Iterator<Item = (usize, Entry)>| match rest.next() {
            None => Ok(None),
            Some((number, _)) => Err(JournalError::Order { number }),
        };
        while let Some((number, entry)) = entries.next() {
            match entry {
                Entry::Began { round } if round == room.round && !room.begun => room.begun = true,
                // A round that is over has no more steps.
                Entry::Step { actions } if room.begun && !room.is_round_over() => {
                    let Actions(actions) = actions;
                    let mut given = [None; AGENT_COUNT];
                    for agent in AgentId::ALL {
                        given[agent] = (players[agent] == Player::Human).then_some(actions[agent]);
                    }
                    if room.simulation.step(given).map_err(RoomError::from)?.actions != actions {
                        return Err(JournalError::Minds { number });
                    }
                    room.judge();
                }
                Entry::Ended { round } if round == room.round && room.begun => {
                    if round + 1 == room.rounds.len() {
                        // That it is over may be missing.
                        return match entries.next() {
                            None | Some((_, Entry::Over { .. })) => over(&mut entries),
                            Some((number, _)) => Err(JournalError::Order { number }),
                        };
                    }
                    room.go_to(round + 1).map_err(RoomError::from)?;
                }
                Entry::Over { .. } => return over(&mut entries),
                _ => return Err(JournalError::Order { number }),
            }
        }
        room.phase = if room.begun { Phase::Paused } else { Phase::Gathering };
        let mut effects = Vec::new();
        if room.begun && room.is_round_over() {
            room.end_round(now, &mut effects);
            if room.phase == Phase::Reading {
                room.phase = Phase::Gathering;
            }
        }
        Ok(Some((room, effects)))
    }
}
