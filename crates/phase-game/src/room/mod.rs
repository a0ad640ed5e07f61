//! One game: who is there, what is going on, and what happens next.

mod effect;
mod presence;
mod telling;
#[cfg(test)]
mod tests;

pub use effect::{Effect, RoomError};

use crate::{
    Doing, Ending, Entry, FromPlayer, GameSettings, Player, Round, STEP, ToPlayer,
    controls::Controls,
    journal::{Actions, FORMAT},
    message::PROTOCOL,
};
use core::time::Duration;
use phase_model::{
    AGENT_COUNT, Action, AgentId, Entity, Goal, PhysicsConfig, Sign, setting::EVENT_STEPS, words::Names,
};
use phase_predicates::achieved;
use phase_sim::{Simulation, SimulationError, SimulationSettings};
use telling::Told;

/// The activity of a room; times are those at which it does the next thing.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) enum Phase {
    Gathering,
    Reading,
    Countdown { until: Duration },
    Playing { due: Duration },
    Paused,
    Over(Ending),
}

/// The place of a player.
#[derive(Clone, Copy, Debug, Default)]
struct Seat {
    connected: bool,
    away: bool,
    ready: bool,
    /// The last state that its page was told.
    told: Option<Told>,
    controls: Controls,
}

/// One game: a practice, then rounds, one scene each.
///
/// The caller owns sockets, files and the clock. It tells the room who comes ([`Room::connect`]), leaves
/// ([`Room::disconnect`]) and sends what ([`Room::receive`]), lets it act when something is due
/// ([`Room::due`], [`Room::advance`]), and carries out the [`Effect`]s that each call returns, in their
/// order. Times count from any moment that is the same for all calls. A room that is resumed from its journal
/// goes on as if nothing had happened.
#[derive(Debug)]
pub struct Room {
    name: String,
    keys: [Option<String>; AGENT_COUNT],
    settings: GameSettings,
    pub(crate) rounds: Vec<Round>,
    pub(crate) round: usize,
    seats: [Seat; AGENT_COUNT],
    physics: PhysicsConfig,
    pub(crate) simulation: Simulation,
    /// Whether the journal knows that the round has begun.
    pub(crate) begun: bool,
    /// Steps in a row after which both goals were achieved.
    achieved: usize,
    /// Whether all minds have decided on the next step.
    thought: bool,
    pub(crate) phase: Phase,
    /// Since when a player has been absent; where nobody was there yet, since when the room has been open.
    absent_since: Option<Duration>,
}

impl Room {
    /// A room for a practice, the first of the rounds, and the rounds after it. `keys` are kept in the
    /// journal for the server, which lets players in.
    ///
    /// # Errors
    /// [`RoomError`].
    pub fn open(
        name: &str,
        keys: [Option<String>; AGENT_COUNT],
        settings: GameSettings,
        rounds: Vec<Round>,
        now: Duration,
    ) -> Result<Self, RoomError> {
        settings.validate()?;
        for round in &rounds {
            round.scene.validate().map_err(SimulationError::from)?;
        }
        let first = rounds.first().ok_or(RoomError::NoRound)?;
        let simulation = simulation_of(first, &settings)?;
        let seats = settings.players.map(|player| {
            // A mind is always there.
            let there = player == Player::Mind;
            Seat { connected: there, ready: there, ..Seat::default() }
        });
        Ok(Self {
            name: name.into(),
            keys,
            physics: first.scene.physics(),
            simulation,
            rounds,
            round: 0,
            seats,
            settings,
            begun: false,
            achieved: 0,
            thought: false,
            phase: Phase::Gathering,
            absent_since: Some(now),
        })
    }

    /// The first entry of its journal.
    #[must_use]
    pub fn opening(&self) -> Entry {
        Entry::Opened {
            format: FORMAT.into(),
            room: self.name.clone(),
            keys: self.keys.clone(),
            settings: Box::new(self.settings),
            rounds: self.rounds.clone(),
        }
    }

    /// Its name.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// By agent, what its player has to know to be let in.
    #[must_use]
    pub const fn keys(&self) -> &[Option<String>; AGENT_COUNT] {
        &self.keys
    }

    /// By agent, whether a person or a mind plays it.
    #[must_use]
    pub const fn players(&self) -> [Player; AGENT_COUNT] {
        self.settings.players
    }

    /// Activity of the game.
    #[must_use]
    pub const fn doing(&self) -> Doing {
        match self.phase {
            Phase::Gathering => Doing::Gathering,
            Phase::Reading => Doing::Reading,
            Phase::Countdown { .. } => Doing::Countdown,
            Phase::Playing { .. } => Doing::Playing,
            Phase::Paused => Doing::Paused,
            Phase::Over(_) => Doing::Over,
        }
    }

    /// The round that is played, 0 for the practice, and the number of rounds after the practice.
    #[must_use]
    pub const fn progress(&self) -> (usize, usize) {
        (self.round, self.rounds.len() - 1)
    }

    /// Time at which [`advance`](Self::advance) is to be called next; `None` once the game is over.
    #[must_use]
    pub fn due(&self) -> Option<Duration> {
        let next = match self.phase {
            Phase::Over(_) => return None,
            Phase::Countdown { until } => Some(until),
            Phase::Playing { due } => Some(due),
            Phase::Gathering | Phase::Reading | Phase::Paused => None,
        };
        [next, self.given_up()].into_iter().flatten().min()
    }

    /// Whether a mind has to decide before the next step is due: [`think`](Self::think) takes some time.
    #[must_use]
    pub fn must_think(&self) -> bool {
        let soon = matches!(self.phase, Phase::Countdown { .. } | Phase::Playing { .. });
        soon && !self.thought && self.settings.players.contains(&Player::Mind)
    }

    /// Lets the minds decide on the next step. If that fails, so does the step, which says why.
    pub fn think(&mut self) {
        for agent in AgentId::ALL {
            if self.settings.players[agent] == Player::Mind && self.simulation.decide_ahead(agent).is_err() {
                break;
            }
        }
        self.thought = true;
    }

    /// A player has come, or come back.
    pub fn connect(&mut self, agent: AgentId, now: Duration) -> Vec<Effect> {
        if self.settings.players[agent] == Player::Mind {
            return Vec::new();
        }
        let seat = &mut self.seats[agent];
        (seat.connected, seat.away, seat.told, seat.controls) = (true, false, None, Controls::default());
        let other = agent.other();
        let welcome = ToPlayer::Welcome {
            protocol: PROTOCOL,
            agent,
            you: Names::PAPER.entity(Entity::Agent(agent)),
            view: self.settings.view,
            mind: self.settings.players[other] == Player::Mind,
            step_ms: STEP.as_millis() as u64,
        };
        let mut effects = vec![Effect::Send(agent, welcome)];
        effects.extend(self.stage_for(agent));
        self.presence_changed(now);
        self.tell(now, &mut effects);
        effects
    }

    /// A player's connection is lost.
    pub fn disconnect(&mut self, agent: AgentId, now: Duration) -> Vec<Effect> {
        let mut effects = Vec::new();
        if self.settings.players[agent] == Player::Human {
            self.seats[agent].connected = false;
            self.presence_changed(now);
            self.tell(now, &mut effects);
        }
        effects
    }

    /// A player's message.
    pub fn receive(&mut self, agent: AgentId, message: FromPlayer, now: Duration) -> Vec<Effect> {
        let mut effects = Vec::new();
        if self.settings.players[agent] == Player::Mind || matches!(self.phase, Phase::Over(_)) {
            return effects;
        }
        let playing = matches!(self.phase, Phase::Playing { .. });
        let seat = &mut self.seats[agent];
        match message {
            FromPlayer::Hold(action) => {
                // What is held when the countdown ends counts.
                if playing || action == Action::Stop || matches!(self.phase, Phase::Countdown { .. }) {
                    seat.controls.hold(action);
                }
                return effects;
            }
            FromPlayer::Grab => {
                if playing {
                    seat.controls.grab();
                }
                return effects;
            }
            FromPlayer::Ready => {
                let practising = playing && self.round == 0;
                seat.ready |= practising || self.phase == Phase::Reading;
                if self.phase == Phase::Reading {
                    self.begin_if_ready(now);
                }
            }
            FromPlayer::Away(away) => {
                seat.away = away;
                self.presence_changed(now);
            }
            FromPlayer::Leave => self.finish(Ending::Left, &mut effects),
        }
        self.tell(now, &mut effects);
        effects
    }

    /// Does what is due at this time.
    pub fn advance(&mut self, now: Duration) -> Vec<Effect> {
        let mut effects = Vec::new();
        if matches!(self.phase, Phase::Over(_)) {
            return effects;
        }
        if self.given_up().is_some_and(|at| now >= at) {
            self.finish(Ending::Absent, &mut effects);
            self.tell(now, &mut effects);
            return effects;
        }
        match self.phase {
            Phase::Countdown { until } if now >= until => {
                self.phase = Phase::Playing { due: until.max(now.saturating_sub(STEP)) + STEP };
                if !self.begun {
                    self.begun = true;
                    effects.push(Effect::Journal(Entry::Began { round: self.round }));
                }
                self.tell(now, &mut effects);
            }
            Phase::Playing { due } if now >= due => {
                // Steps that are late by more than one are not made up for: nobody could follow.
                self.phase = Phase::Playing { due: due.max(now.saturating_sub(STEP)) + STEP };
                self.step(now, &mut effects);
            }
            _ => {}
        }
        effects
    }

    fn step(&mut self, now: Duration, effects: &mut Vec<Effect>) {
        let grips = self.simulation.state().grips;
        let mut given = [None; AGENT_COUNT];
        for agent in AgentId::ALL {
            if self.settings.players[agent] == Player::Human {
                given[agent] = Some(self.seats[agent].controls.take(grips[agent].is_some()));
            }
        }
        let (actions, substeps) = match self.simulation.step(given) {
            Ok(step) => (step.actions, step.substeps),
            Err(error) => {
                self.fail(error, effects);
                return self.tell(now, effects);
            }
        };
        self.thought = false;
        effects.push(Effect::Journal(Entry::Step { actions: Actions(actions) }));
        self.show(&substeps, effects);
        self.judge();
        if self.is_round_over() {
            self.end_round(now, effects);
        }
    }

    /// Notes whether both goals are achieved.
    pub(crate) fn judge(&mut self) {
        let both = self.achieved_now().iter().all(|&achieved| achieved);
        // What somebody is to avoid is avoided only once the time is over.
        let positive = self.scene_goals().iter().all(|goal| goal.sign() == Sign::Positive);
        self.achieved = if both && positive { self.achieved + 1 } else { 0 };
    }

    fn scene_goals(&self) -> [Goal; AGENT_COUNT] {
        self.rounds[self.round].scene.goals()
    }

    fn achieved_now(&self) -> [bool; AGENT_COUNT] {
        self.scene_goals().map(|goal| achieved(&self.physics, self.simulation.state(), goal))
    }

    pub(crate) fn is_round_over(&self) -> bool {
        let steps = self.simulation.event().steps.len();
        if self.round == 0 {
            steps >= self.settings.practice_steps || self.seats.iter().all(|seat| seat.ready)
        } else {
            steps >= self.settings.simulation.max_steps || self.achieved >= self.settings.achieved_steps
        }
    }

    pub(crate) fn end_round(&mut self, now: Duration, effects: &mut Vec<Effect>) {
        if self.round > 0 {
            // The journal says that it has ended once its recording is safe.
            effects.push(Effect::Finished(Box::new(self.recording())));
        }
        effects.push(Effect::Journal(Entry::Ended { round: self.round }));
        if self.round > 0 {
            let achieved = self.achieved_now();
            self.send_all(effects, |_| ToPlayer::Result { achieved });
        }
        if self.round + 1 == self.rounds.len() {
            self.finish(Ending::Complete, effects);
        } else if let Err(error) = self.go_to(self.round + 1) {
            self.fail(error, effects);
        } else {
            self.phase = Phase::Reading;
            for agent in AgentId::ALL {
                effects.extend(self.stage_for(agent));
            }
        }
        self.tell(now, effects);
    }

    /// Prepares a round.
    pub(crate) fn go_to(&mut self, round: usize) -> Result<(), SimulationError> {
        self.round = round;
        self.simulation = simulation_of(&self.rounds[round], &self.settings)?;
        self.physics = self.rounds[round].scene.physics();
        (self.begun, self.achieved, self.thought) = (false, 0, false);
        for (seat, player) in self.seats.iter_mut().zip(self.settings.players) {
            seat.ready = player == Player::Mind;
            seat.controls.release();
        }
        Ok(())
    }

    fn fail(&mut self, error: SimulationError, effects: &mut Vec<Effect>) {
        effects.push(Effect::Failed(error.into()));
        self.finish(Ending::Failed, effects);
    }

    fn finish(&mut self, ending: Ending, effects: &mut Vec<Effect>) {
        self.phase = Phase::Over(ending);
        self.absent_since = None;
        effects.push(Effect::Journal(Entry::Over { ending }));
    }
}

/// A round at its start. Only agents that are not played have minds. A simulation that is over can be stepped
/// on: when a round ends is decided here.
fn simulation_of(round: &Round, settings: &GameSettings) -> Result<Simulation, SimulationError> {
    let minds = settings.players.map(|player| player == Player::Mind);
    let simulation = SimulationSettings { max_steps: EVENT_STEPS.most(), ..settings.simulation };
    Simulation::with_minds(&round.scene, round.seed, &simulation, minds)
}
