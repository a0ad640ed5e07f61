//! Rounds, absence, what is seen, what is recorded.

use crate::support::{GREEN, RED, Table, round, settings};
use core::time::Duration;
use phase_event::{Controller, Recording, Thought};
use phase_game::{
    Doing, Effect, Ending, Entry, FromPlayer, GameSettings, Player, Room, RoomError, STEP, ToPlayer, View,
};
use phase_model::{Action, AgentId, Entity, Goal, LandmarkId, Sign, Vec2, arena};
use phase_perception::observe;
use phase_sim::{Simulation, SimulationSettings};

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

/// A player who has arrived ends the round; a player who avoids something has to hold out.
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

#[test]
fn minds_that_no_machine_can_search_with_open_no_room() {
    let mut settings = settings([Player::Human, Player::Mind]);
    settings.simulation.minds = settings.simulation.minds.with_simulations(usize::MAX);
    let rounds = vec![round("", "independent")];
    let refused = Room::open("room", [None, None], settings, rounds, Duration::ZERO).unwrap_err();
    assert!(refused.to_string().contains("`minds.simulations` must be 1 to 1000000"), "{refused}");
}

/// A repeated message makes no work for the other player.
#[test]
fn what_changes_nothing_is_not_told() {
    let mut table = Table::two().both_come();
    for message in [FromPlayer::Ready, FromPlayer::Away(true)] {
        table.tell(RED, message);
        let told = table.effects.len();
        (0..100).for_each(|_| table.tell(RED, message));
        assert_eq!(table.effects.len(), told, "{message:?}");
    }
    // A page that comes again is told all the same.
    let effects = table.room.connect(GREEN, table.now);
    assert!(effects.iter().any(|it| matches!(it, Effect::Send(GREEN, ToPlayer::State { .. }))));
}

/// Times are added to others and steps are counted, whoever wrote the settings.
#[test]
fn settings_have_ranges() {
    let open = |settings: GameSettings| {
        let rounds = vec![round("", "independent")];
        phase_game::Room::open("room", [None, None], settings, rounds, Duration::ZERO)
    };
    let good = settings([Player::Human; 2]);
    let longest = phase_game::LONGEST_TIME;
    assert!(open(GameSettings { lobby_patience: longest, ..good }).is_ok());
    for bad in [
        GameSettings { lobby_patience: Duration::MAX, ..good },
        GameSettings { patience: longest + Duration::from_nanos(1), ..good },
        GameSettings { countdown: Duration::MAX, ..good },
        GameSettings { practice_steps: 0, ..good },
        GameSettings { achieved_steps: usize::MAX, ..good },
    ] {
        assert!(matches!(open(bad), Err(RoomError::Settings(_))), "{bad:?}");
    }
}
