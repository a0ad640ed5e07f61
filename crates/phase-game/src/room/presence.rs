//! Presence of the players, and pauses when one is absent.

use super::{Phase, Room};
use crate::Player;
use core::time::Duration;
use phase_model::AGENT_COUNT;

impl Room {
    pub(super) fn present(&self) -> [bool; AGENT_COUNT] {
        self.seats.map(|seat| seat.connected && !seat.away)
    }

    /// Time at which the game is given up if nobody comes.
    pub(super) fn given_up(&self) -> Option<Duration> {
        let gathering = self.phase == Phase::Gathering;
        let patience = if gathering { self.settings.lobby_patience } else { self.settings.patience };
        self.absent_since.map(|since| since + patience)
    }

    pub(super) fn presence_changed(&mut self, now: Duration) {
        let all = self.present() == [true; AGENT_COUNT];
        if all {
            self.absent_since = None;
        } else if self.absent_since.is_none() {
            self.absent_since = Some(now);
        }
        match self.phase {
            Phase::Gathering if all => self.phase = Phase::Reading,
            Phase::Paused if all => self.count_down(now),
            Phase::Countdown { .. } | Phase::Playing { .. } if !all => {
                self.phase = Phase::Paused;
                self.seats.iter_mut().for_each(|seat| seat.controls.release());
            }
            _ => {}
        }
    }

    pub(super) fn begin_if_ready(&mut self, now: Duration) {
        if self.seats.iter().all(|seat| seat.ready && seat.connected && !seat.away) {
            // In the practice, to be ready means from now on to have had enough of it.
            for (seat, player) in self.seats.iter_mut().zip(self.settings.players) {
                seat.ready = player == Player::Mind;
            }
            self.count_down(now);
        }
    }

    fn count_down(&mut self, now: Duration) {
        self.phase = Phase::Countdown { until: now + self.settings.countdown };
    }
}
