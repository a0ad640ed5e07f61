//! A whole game, told what happens and what time it is.

use core::time::Duration;
use phase_event::{Controller, Recording, Thought};
use phase_game::{
    Doing, Effect, Ending, Entry, FromPlayer, GameSettings, Player, Room, Round, STEP, ToPlayer, View,
    journal::{Actions, entries},
    message::Sight,
};
use phase_model::{Action, AgentId, Entity, Goal, LandmarkId, Scene, Sign, Vec2, arena};
use phase_perception::observe;
use phase_sim::{Simulation, SimulationSettings};
use proptest::prelude::*;

const RED: AgentId = AgentId::ZERO;
const GREEN: AgentId = AgentId::ONE;

fn scene(kind: &str) -> Scene {
    phase_sampler::sample_named(Some(kind), None, 3).expect("a scene")
}

fn round(id: &str, kind: &str) -> Round {
    Round { id: id.into(), source: kind.into(), scene: scene(kind), seed: 5 }
}

fn settings(players: [Player; 2]) -> GameSettings {
    let mut settings = GameSettings { players, practice_steps: 4, ..GameSettings::default() };
    settings.simulation.max_steps = 6;
    settings.simulation.minds.particles = 5;
    settings.simulation.minds.simulations = 20;
    settings
}

/// A game, its clock, and all that followed so far.
struct Table {
    room: Room,
    now: Duration,
    effects: Vec<Effect>,
}

impl Table {
    fn new(settings: GameSettings, rounds: Vec<Round>) -> Self {
        let room = Room::open("room", [None, None], settings, rounds, Duration::ZERO).expect("good scenes");
        Self { room, now: Duration::ZERO, effects: Vec::new() }
    }

    fn two() -> Self {
        let rounds = vec![round("", "independent"), round("a", "helping"), round("b", "chasing")];
        Self::new(settings([Player::Human; 2]), rounds)
    }

    fn both_come(mut self) -> Self {
        for agent in AgentId::ALL {
            let effects = self.room.connect(agent, self.now);
            self.effects.extend(effects);
        }
        self
    }

    fn tell(&mut self, agent: AgentId, message: FromPlayer) {
        let effects = self.room.receive(agent, message, self.now);
        self.effects.extend(effects);
    }

    fn ready(&mut self) {
        AgentId::ALL.into_iter().for_each(|agent| self.tell(agent, FromPlayer::Ready));
    }

    /// Lets time pass until something is due, and does it.
    fn wait(&mut self) {
        self.now = self.room.due().expect("something is due");
        let effects = self.room.advance(self.now);
        self.effects.extend(effects);
    }

    fn play_until(&mut self, doing: Doing) {
        for _ in 0..1000 {
            if self.room.doing() == doing {
                return;
            }
            self.wait();
        }
        panic!("{doing:?} was never reached");
    }

    fn entries(&self) -> Vec<Entry> {
        let journalled = self.effects.iter().filter_map(|effect| match effect {
            Effect::Journal(entry) => Some(entry.clone()),
            _ => None,
        });
        std::iter::once(self.room.opening()).chain(journalled).collect()
    }

    fn steps(&self) -> usize {
        self.entries().iter().filter(|entry| matches!(entry, Entry::Step { .. })).count()
    }

    fn recordings(&self) -> Vec<Recording> {
        let finished = self.effects.iter().filter_map(|effect| match effect {
            Effect::Finished(recording) => Some((**recording).clone()),
            _ => None,
        });
        finished.collect()
    }

    fn sights(&self, of: AgentId) -> Vec<&Sight> {
        let sights = self.effects.iter().filter_map(|effect| match effect {
            Effect::Send(agent, ToPlayer::Sight(sight)) if *agent == of => Some(&**sight),
            _ => None,
        });
        sights.collect()
    }
}

#[test]
fn two_people_play_all_rounds() {
    let mut table = Table::two();
    assert_eq!(table.room.doing(), Doing::Gathering);
    table = table.both_come();
    for round in 0..3 {
        assert_eq!((table.room.doing(), table.room.progress()), (Doing::Reading, (round, 2)));
        table.tell(RED, FromPlayer::Ready);
        assert_eq!(table.room.doing(), Doing::Reading);
        table.tell(GREEN, FromPlayer::Ready);
        assert_eq!(table.room.doing(), Doing::Countdown);
        table.tell(RED, FromPlayer::Hold(Action::Up));
        table.wait();
        assert_eq!(table.room.doing(), Doing::Playing);
        table.play_until(if round == 2 { Doing::Over } else { Doing::Reading });
    }
    assert_eq!(table.steps(), 4 + 6 + 6);
    let recordings = table.recordings();
    assert_eq!(recordings.iter().map(|it| it.id.as_str()).collect::<Vec<_>>(), ["a", "b"]);
    for recording in &recordings {
        assert_eq!(recording.controllers, [Controller::Human; 2]);
        let event = &recording.simulation.as_ref().expect("simulated").event;
        assert!(event.steps.iter().all(|step| step.actions == [Action::Up, Action::Stop]));
        assert!(event.steps.iter().all(|step| step.thoughts.iter().all(|it| *it == Thought::IDLE)));
    }
    assert_eq!(table.entries().last(), Some(&Entry::Over { ending: Ending::Complete }));
    assert_eq!(table.room.due(), None);
    // It stays over, whatever comes.
    assert!(table.room.advance(table.now + STEP).is_empty());
    table.tell(RED, FromPlayer::Leave);
    assert_eq!(table.room.doing(), Doing::Over);
}

/// Anybody can make the same bytes from the actions in a recording.
#[test]
fn replayed_actions_give_the_same_bytes() {
    for players in [[Player::Human; 2], [Player::Mind, Player::Human]] {
        let mut table =
            Table::new(settings(players), vec![round("", "independent"), round("a", "hindering")])
                .both_come();
        for moves in [[Action::Up, Action::TurnLeft], [Action::UpRight, Action::Down]] {
            table.ready();
            AgentId::ALL.into_iter().for_each(|agent| table.tell(agent, FromPlayer::Hold(moves[agent])));
            table.wait();
            table.tell(GREEN, FromPlayer::Grab);
            while table.room.doing() == Doing::Playing {
                if table.room.must_think() && table.steps().is_multiple_of(2) {
                    table.room.think();
                }
                table.wait();
            }
        }
        let [recording] = &table.recordings()[..] else { panic!("one recording") };
        let played = recording.simulation.as_ref().expect("simulated");
        // As a stranger would: with what the file says, and all minds there.
        let told: SimulationSettings = serde_json::from_value(played.settings.clone()).expect("settings");
        let mut again = Simulation::new(&recording.scene, played.event.seed, &told).expect("valid");
        for step in &played.event.steps {
            let given =
                AgentId::ALL.map(|agent| (players[agent] == Player::Human).then_some(step.actions[agent]));
            again.step(given).expect("a step");
        }
        let event = again.into_event();
        let again = Recording {
            controllers: recording.controllers,
            ..Recording::of_event("a", event, played.generator.clone(), played.settings.clone())
        };
        assert_eq!(again.to_json().expect("finite"), recording.to_json().expect("finite"));
    }
}

/// What a player is sent of every frame is what its agent observes of it.
#[test]
fn players_see_what_their_agents_observe() {
    let mut hidden = 0;
    for kind in ["chasing", "hindering", "independent", "collaborating"] {
        for view in [View::Own, View::All] {
            let settings = GameSettings { view, ..settings([Player::Human; 2]) };
            let mut table = Table::new(settings, vec![round("", kind), round("a", kind)]).both_come();
            table.ready();
            AgentId::ALL.into_iter().for_each(|agent| table.tell(agent, FromPlayer::Hold(Action::TurnLeft)));
            table.play_until(Doing::Reading);
            table.effects.clear();
            table.ready();
            AgentId::ALL.into_iter().for_each(|agent| table.tell(agent, FromPlayer::Hold(Action::Up)));
            table.play_until(Doing::Over);
            let recording = &table.recordings()[0];
            let event = &recording.simulation.as_ref().expect("simulated").event;
            let physics = event.scene.physics();
            for agent in AgentId::ALL {
                let frames = table.sights(agent).into_iter().flat_map(|sight| &sight.frames);
                let mut count = 0;
                for (frame, state) in frames.zip(event.frames().skip(1)) {
                    let observation = observe(&physics, state, agent);
                    for (k, shown) in frame.iter().enumerate() {
                        let body = observation.body(Entity::ALL[k]);
                        let expected =
                            if view == View::All { Some(state.body(Entity::ALL[k])) } else { body };
                        assert_eq!(shown.is_some(), expected.is_some());
                        if let (Some([x, y, _]), Some(body)) = (shown, expected) {
                            assert!(
                                body.position
                                    .as_dvec2()
                                    .distance(phase_model::Vec2::new(*x as f32, *y as f32).as_dvec2())
                                    < 1e-3
                            );
                        }
                        hidden += usize::from(shown.is_none());
                    }
                    count += 1;
                }
                assert_eq!(count, 6 * arena::SUBSTEPS);
                for sight in table.sights(agent) {
                    assert_eq!(sight.visible.as_ref().map(String::len), (view == View::Own).then_some(100));
                    for (k, body) in sight.bodies.iter().enumerate() {
                        let last = sight.frames.last().expect("a frame");
                        assert_eq!(body.is_some(), last[k].is_some());
                    }
                }
            }
        }
    }
    assert!(hidden > 0, "something was hidden from somebody");
}

#[test]
fn absence_pauses_and_patience_ends() {
    let mut table = Table::two().both_come();
    table.ready();
    table.wait();
    table.wait();
    let steps = table.steps();
    let effects = table.room.disconnect(GREEN, table.now);
    assert!(effects.iter().all(|effect| matches!(effect, Effect::Send(RED, _))));
    assert_eq!(table.room.doing(), Doing::Paused);
    table.now += Duration::from_secs(20);
    assert!(table.room.advance(table.now).is_empty());
    let effects = table.room.connect(GREEN, table.now);
    table.effects.extend(effects);
    assert_eq!((table.room.doing(), table.steps()), (Doing::Countdown, steps));
    table.wait();
    table.wait();
    assert_eq!((table.room.doing(), table.steps()), (Doing::Playing, steps + 1));
    // A tab in the background is the same.
    table.tell(RED, FromPlayer::Away(true));
    assert_eq!(table.room.doing(), Doing::Paused);
    table.tell(RED, FromPlayer::Away(false));
    assert_eq!(table.room.doing(), Doing::Countdown);
    table.tell(RED, FromPlayer::Away(true));
    let patience = GameSettings::default().patience;
    assert_eq!(table.room.due(), Some(table.now + patience));
    table.wait();
    assert_eq!(table.entries().last(), Some(&Entry::Over { ending: Ending::Absent }));
    assert!(table.recordings().is_empty());
}

#[test]
fn whoever_leaves_ends_the_game() {
    let mut table = Table::two().both_come();
    table.tell(GREEN, FromPlayer::Leave);
    assert_eq!(table.entries().last(), Some(&Entry::Over { ending: Ending::Left }));
    // Nobody comes at all.
    let mut table = Table::two();
    table.wait();
    assert_eq!(table.now, GameSettings::default().lobby_patience);
    assert_eq!(table.entries().last(), Some(&Entry::Over { ending: Ending::Absent }));
}

/// Whoever has already arrived ends the round; whoever avoids something has to hold out.
#[test]
fn a_round_ends_when_both_goals_are_achieved() {
    let mut there = round("a", "independent");
    for agent in AgentId::ALL {
        let landmark = LandmarkId::ALL[agent.index()];
        there.scene.agents[agent].goal = Goal::AgentOnLandmark { agent, landmark, sign: Sign::Positive };
        there.scene.agents[agent].start.position = arena::LANDMARKS[landmark] + Vec2::new(0.0, 0.1);
    }
    let mut avoided = there.clone();
    avoided.scene.agents[1].goal =
        Goal::AgentOnLandmark { agent: GREEN, landmark: LandmarkId::ALL[3], sign: Sign::Negative };
    for (round, steps) in [(there, 4), (avoided, 6)] {
        let mut table = Table::new(settings([Player::Human; 2]), vec![round.clone(), round]).both_come();
        table.ready();
        table.play_until(Doing::Reading);
        table.effects.clear();
        table.ready();
        table.play_until(Doing::Over);
        assert_eq!(table.steps(), steps);
        let achieved = Effect::Send(RED, ToPlayer::Result { achieved: [true; 2] });
        assert!(table.effects.contains(&achieved));
    }
}

#[test]
fn practice_ends_when_all_have_had_enough() {
    let mut table = Table::two().both_come();
    table.ready();
    table.wait();
    table.wait();
    table.tell(RED, FromPlayer::Ready);
    table.wait();
    assert_eq!(table.room.progress().0, 0);
    table.tell(GREEN, FromPlayer::Ready);
    table.wait();
    assert_eq!((table.room.progress().0, table.room.doing(), table.steps()), (1, Doing::Reading, 3));
}

/// A machine that was busy does not make the players live through all that was missed.
#[test]
fn late_steps_are_not_made_up_for() {
    let mut table = Table::two().both_come();
    table.ready();
    table.wait();
    table.now += Duration::from_secs(10);
    let effects = table.room.advance(table.now);
    assert_eq!(effects.iter().filter(|it| matches!(it, Effect::Journal(Entry::Step { .. }))).count(), 1);
    let due = table.room.due().expect("the next step");
    assert!(due >= table.now && due <= table.now + STEP);
}

fn lines(entries: &[Entry]) -> String {
    entries.iter().map(|entry| serde_json::to_string(entry).expect("JSON") + "\n").collect()
}

/// Wherever the journal ends, the game goes on from its last step, and becomes the same event.
#[test]
fn a_game_goes_on_where_its_journal_ends() {
    for players in [[Player::Human; 2], [Player::Human, Player::Mind]] {
        let script = |table: &mut Table| {
            // From the round's number and the step, so that it does not depend on when the game was interrupted.
            let step = table.room.recording().simulation.map_or(0, |it| it.event.steps.len());
            let action = Action::ALL[(table.room.progress().0 * 5 + step) % 8];
            table.tell(RED, FromPlayer::Hold(action));
        };
        let play = |table: &mut Table| {
            while table.room.doing() != Doing::Over {
                match table.room.doing() {
                    Doing::Reading => table.ready(),
                    _ => {
                        script(table);
                        table.wait();
                    }
                }
            }
        };
        let rounds = vec![round("", "independent"), round("a", "helping")];
        let mut whole = Table::new(settings(players), rounds).both_come();
        play(&mut whole);
        let (journal, expected) = (whole.entries(), whole.recordings());
        assert_eq!(expected.len(), 1);
        for length in 1..journal.len() - 1 {
            let text = lines(&journal[..length]) + "{\"entry\":\"st";
            let read = entries(&text).expect("our own journal");
            let resumed = Room::resume(read, Duration::ZERO).expect("our own journal");
            let (room, effects) = resumed.unwrap_or_else(|| panic!("not over after {length} entries"));
            let mut table = Table { room, now: Duration::ZERO, effects }.both_come();
            play(&mut table);
            assert_eq!(table.recordings(), expected, "after {length} entries");
        }
        for length in [journal.len() - 1, journal.len()] {
            let resumed = Room::resume(journal[..length].to_vec(), Duration::ZERO).expect("our own journal");
            assert!(resumed.is_none());
        }
    }
}

#[test]
fn damaged_journals_are_refused() {
    let mut table = Table::two().both_come();
    table.ready();
    table.play_until(Doing::Reading);
    let journal = table.entries();
    let refused =
        |entries: Vec<Entry>| Room::resume(entries, Duration::ZERO).expect_err("damaged").to_string();
    assert!(refused(Vec::new()).contains("must open a room"));
    assert!(refused(journal[1..].to_vec()).contains("must open a room"));
    let step = Entry::Step { actions: Actions([Action::Stop; 2]) };
    assert!(refused(vec![journal[0].clone(), step]).contains("entry 2"));
    assert!(refused(vec![journal[0].clone(), Entry::Ended { round: 0 }]).contains("entry 2"));
    for text in ["{}\n", "nonsense\n", "{\"entry\":\"step\",\"actions\":[\"up\",\"fly\"]}\n", "[1]\n"] {
        assert!(entries(text).expect_err("no entry").to_string().contains("entry 1"));
    }
}

#[test]
fn messages_are_read_strictly() {
    let read = |text: &str| FromPlayer::parse(text).map_err(|error| error.to_string());
    assert_eq!(read(r#"{"type": "hold", "action": "upleft"}"#), Ok(FromPlayer::Hold(Action::UpLeft)));
    assert_eq!(read(r#"{"type": "away", "away": true}"#), Ok(FromPlayer::Away(true)));
    assert_eq!(read(r#"{"type": "grab"}"#), Ok(FromPlayer::Grab));
    for text in [
        "",
        "[]",
        "{}",
        r#"{"type": "win"}"#,
        r#"{"type": "ready", "x": 1}"#,
        r#"{"type": "away", "away": 1}"#,
    ] {
        assert!(read(text).is_err(), "{text}");
    }
    assert!(read(r#"{"type": "hold", "action": "fly"}"#).is_err_and(|error| error.contains("fly")));
}

#[derive(Clone, Debug)]
enum Happening {
    Wait,
    Say(usize, usize),
    Come(usize),
    Go(usize),
    Time(u64),
}

fn happening() -> impl Strategy<Value = Happening> {
    prop_oneof![
        4 => Just(Happening::Wait),
        6 => (0..2_usize, 0..9_usize).prop_map(|(who, what)| Happening::Say(who, what)),
        1 => (0..2_usize).prop_map(Happening::Come),
        1 => (0..2_usize).prop_map(Happening::Go),
        1 => (0..2000_u64).prop_map(Happening::Time),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 200, ..ProptestConfig::default() })]

    /// Whatever happens in whatever order: no step while somebody is absent, messages go to who is connected only, and the journal
    /// can be resumed.
    #[test]
    fn rooms_survive_anything(happenings in prop::collection::vec(happening(), 0..120)) {
        let mut table = Table::two();
        let mut connected = [false; 2];
        let mut away = [false; 2];
        for happening in happenings {
            let steps = table.steps();
            let told = table.effects.len();
            let before = connected;
            match happening {
                Happening::Wait => if table.room.due().is_some_and(|due| due < table.now + Duration::from_secs(30)) { table.wait() },
                Happening::Time(ms) => {
                    table.now += Duration::from_millis(ms);
                    let effects = table.room.advance(table.now);
                    table.effects.extend(effects);
                }
                Happening::Come(k) => {
                    let effects = table.room.connect(AgentId::ALL[k], table.now);
                    table.effects.extend(effects);
                    (connected[k], away[k]) = (true, false);
                }
                Happening::Go(k) => {
                    let effects = table.room.disconnect(AgentId::ALL[k], table.now);
                    table.effects.extend(effects);
                    connected[k] = false;
                }
                Happening::Say(k, what) => {
                    let message = match what {
                        0..=3 => FromPlayer::Ready,
                        4 => FromPlayer::Hold(Action::Up),
                        5 => FromPlayer::Grab,
                        6 => { if table.room.doing() != Doing::Over { away[k] = true }; FromPlayer::Away(true) }
                        _ => { if table.room.doing() != Doing::Over { away[k] = false }; FromPlayer::Away(false) }
                    };
                    table.tell(AgentId::ALL[k], message);
                }
            }
            if table.steps() > steps {
                prop_assert!(connected == [true; 2] && away == [false; 2]);
            }
            for effect in &table.effects[told..] {
                if let Effect::Send(agent, _) = effect {
                    prop_assert!(connected[agent.index()] || before[agent.index()]);
                }
            }
        }
        let resumed = Room::resume(entries(&lines(&table.entries())).expect("our own journal"), Duration::ZERO);
        let resumed = resumed.expect("our own journal");
        prop_assert_eq!(resumed.is_none(), table.room.doing() == Doing::Over);
        if let Some((room, effects)) = resumed {
            prop_assert!(effects.is_empty());
            prop_assert_eq!(room.recording(), table.room.recording());
        }
    }
}
