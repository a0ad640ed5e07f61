//! A table at which a game is played.

use core::time::Duration;
use phase_event::Recording;
use phase_game::{
    Doing, Effect, Entry, FromPlayer, GameSettings, Player, Room, Round, ToPlayer, message::Sight,
};
use phase_model::{AgentId, Scene};

pub(crate) const RED: AgentId = AgentId::ZERO;
pub(crate) const GREEN: AgentId = AgentId::ONE;

pub(crate) fn scene(kind: &str) -> Scene {
    phase_sampler::sample_named(Some(kind), None, 3).expect("a scene")
}

pub(crate) fn round(id: &str, kind: &str) -> Round {
    Round { id: id.into(), source: kind.into(), scene: scene(kind), seed: 5 }
}

pub(crate) fn settings(players: [Player; 2]) -> GameSettings {
    let mut settings = GameSettings { players, practice_steps: 4, ..GameSettings::default() };
    settings.simulation.max_steps = 6;
    settings.simulation.minds = settings.simulation.minds.with_particles(5);
    settings.simulation.minds = settings.simulation.minds.with_simulations(20);
    settings
}

/// A game, its clock, and all that followed so far.
pub(crate) struct Table {
    pub(crate) room: Room,
    pub(crate) now: Duration,
    pub(crate) effects: Vec<Effect>,
}

impl Table {
    pub(crate) fn new(settings: GameSettings, rounds: Vec<Round>) -> Self {
        let room = Room::open("room", [None, None], settings, rounds, Duration::ZERO).expect("good scenes");
        Self { room, now: Duration::ZERO, effects: Vec::new() }
    }

    pub(crate) fn two() -> Self {
        let rounds = vec![round("", "independent"), round("a", "helping"), round("b", "chasing")];
        Self::new(settings([Player::Human; 2]), rounds)
    }

    pub(crate) fn both_come(mut self) -> Self {
        for agent in AgentId::ALL {
            let effects = self.room.connect(agent, self.now);
            self.effects.extend(effects);
        }
        self
    }

    pub(crate) fn tell(&mut self, agent: AgentId, message: FromPlayer) {
        let effects = self.room.receive(agent, message, self.now);
        self.effects.extend(effects);
    }

    pub(crate) fn ready(&mut self) {
        AgentId::ALL.into_iter().for_each(|agent| self.tell(agent, FromPlayer::Ready));
    }

    /// Lets time pass until something is due, and does it.
    pub(crate) fn wait(&mut self) {
        self.now = self.room.due().expect("something is due");
        let effects = self.room.advance(self.now);
        self.effects.extend(effects);
    }

    pub(crate) fn play_until(&mut self, doing: Doing) {
        for _ in 0..1000 {
            if self.room.doing() == doing {
                return;
            }
            self.wait();
        }
        panic!("{doing:?} was never reached");
    }

    pub(crate) fn entries(&self) -> Vec<Entry> {
        let journalled = self.effects.iter().filter_map(|effect| match effect {
            Effect::Journal(entry) => Some(entry.clone()),
            _ => None,
        });
        std::iter::once(self.room.opening()).chain(journalled).collect()
    }

    pub(crate) fn steps(&self) -> usize {
        self.entries().iter().filter(|entry| matches!(entry, Entry::Step { .. })).count()
    }

    pub(crate) fn recordings(&self) -> Vec<Recording> {
        let finished = self.effects.iter().filter_map(|effect| match effect {
            Effect::Finished(recording) => Some((**recording).clone()),
            _ => None,
        });
        finished.collect()
    }

    pub(crate) fn sights(&self, of: AgentId) -> Vec<&Sight> {
        let sights = self.effects.iter().filter_map(|effect| match effect {
            Effect::Send(agent, ToPlayer::Sight(sight)) if *agent == of => Some(&**sight),
            _ => None,
        });
        sights.collect()
    }
}

pub(crate) fn lines(entries: &[Entry]) -> String {
    entries.iter().map(|entry| serde_json::to_string(entry).expect("JSON") + "\n").collect()
}
