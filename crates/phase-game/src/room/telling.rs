//! Messages to the players, and the recordings that rounds become.

use super::{Effect, Phase, Room};
use crate::{
    Doing, Ending, Instructions, Player, ToPlayer, instructions,
    sight::{sight, stage},
};
use core::time::Duration;
use phase_event::{Controller, Recording};
use phase_model::{AGENT_COUNT, AgentId, State};
use serde_json::Value;

/// The activity of a game as a page knows it.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) struct Told {
    doing: Doing,
    ready: [bool; AGENT_COUNT],
    present: [bool; AGENT_COUNT],
    countdown_until: Option<Duration>,
    ending: Option<Ending>,
}

impl Told {
    fn at(self, now: Duration) -> ToPlayer {
        let left = |until: Duration| until.saturating_sub(now).as_millis() as u64;
        ToPlayer::State {
            doing: self.doing,
            ready: self.ready,
            present: self.present,
            countdown_ms: self.countdown_until.map(left),
            ending: self.ending,
        }
    }
}

impl Room {
    /// The part of the round that has been played, as a recorded event.
    #[must_use]
    pub fn recording(&self) -> Recording {
        let round = &self.rounds[self.round];
        let generator = concat!("phase ", env!("CARGO_PKG_VERSION")).to_owned();
        let mut settings = serde_json::to_value(self.settings.simulation).unwrap_or_default();
        if let (Value::Object(members), Ok(view)) = (&mut settings, serde_json::to_value(self.settings.view))
        {
            members.insert("view".into(), view);
        }
        let controllers = self.settings.players.map(|player| match player {
            Player::Human => Controller::Human,
            Player::Mind => Controller::Mind,
        });
        let event = self.simulation.event().clone();
        Recording { controllers, ..Recording::of_event(round.id.clone(), event, generator, settings) }
    }

    /// The round and what is seen of it now.
    pub(super) fn stage_for(&self, agent: AgentId) -> Vec<Effect> {
        if self.settings.players[agent] == Player::Mind {
            return Vec::new();
        }
        let scene = &self.rounds[self.round].scene;
        let limit =
            if self.round == 0 { self.settings.practice_steps } else { self.settings.simulation.max_steps };
        let told: Option<[Instructions; AGENT_COUNT]> =
            (self.round > 0).then(|| instructions::of_both(scene));
        let told = told.map(|told| told[agent].clone());
        let stage = stage(scene, self.round, self.rounds.len() - 1, limit, told);
        let steps = self.simulation.event().steps.len();
        let now = sight(&self.physics, &[*self.simulation.state()], steps, agent, self.settings.view);
        vec![
            Effect::Send(agent, ToPlayer::Stage(Box::new(stage))),
            Effect::Send(agent, ToPlayer::Sight(Box::new(now))),
        ]
    }

    pub(super) fn show(&self, states: &[State], effects: &mut Vec<Effect>) {
        let steps = self.simulation.event().steps.len();
        self.send_all(effects, |agent| {
            ToPlayer::Sight(Box::new(sight(&self.physics, states, steps, agent, self.settings.view)))
        });
    }

    /// Tells each player what goes on, unless that is what its page was told last: who repeats a message
    /// makes no message for the other player.
    pub(super) fn tell(&mut self, now: Duration, effects: &mut Vec<Effect>) {
        let told = Told {
            doing: self.doing(),
            ready: self.seats.map(|seat| seat.ready),
            present: self.present(),
            countdown_until: match self.phase {
                Phase::Countdown { until } => Some(until),
                _ => None,
            },
            ending: match self.phase {
                Phase::Over(ending) => Some(ending),
                _ => None,
            },
        };
        for agent in AgentId::ALL {
            if self.has_page(agent) && self.seats[agent].told.replace(told) != Some(told) {
                effects.push(Effect::Send(agent, told.at(now)));
            }
        }
    }

    /// Whether a person plays an agent, and has a connection.
    fn has_page(&self, agent: AgentId) -> bool {
        self.settings.players[agent] == Player::Human && self.seats[agent].connected
    }

    pub(super) fn send_all(&self, effects: &mut Vec<Effect>, message: impl Fn(AgentId) -> ToPlayer) {
        for agent in AgentId::ALL {
            if self.has_page(agent) {
                effects.push(Effect::Send(agent, message(agent)));
            }
        }
    }
}
