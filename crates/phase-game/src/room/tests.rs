//! Games that end because their simulation fails.

use super::*;

/// Rooms refuse what cannot be simulated, so the scene of the next round is broken from inside. The journal
/// has the practice, then the end; both players are told, and the server hears why.
#[test]
fn a_failed_simulation_ends_the_game() {
    let round = |seed| {
        let scene = phase_sampler::sample_named(Some("chasing"), None, 3).expect("a scene");
        Round { id: "a".into(), source: "chasing".into(), scene, seed }
    };
    let settings = GameSettings { practice_steps: 1, countdown: STEP, ..GameSettings::default() };
    let rounds = vec![round(1), round(2)];
    let mut room = Room::open("room", [None, None], settings, rounds, Duration::ZERO).expect("a room");
    for agent in AgentId::ALL {
        room.connect(agent, Duration::ZERO);
    }
    for agent in AgentId::ALL {
        room.receive(agent, FromPlayer::Ready, Duration::ZERO);
    }
    room.advance(STEP);
    room.rounds[1].scene.agents[0].start.angle = f32::NAN;
    let effects = room.advance(2 * STEP);

    assert_eq!((room.doing(), room.due()), (Doing::Over, None));
    let is_end = |effect: &Effect| *effect == Effect::Journal(Entry::Ended { round: 0 });
    let end = effects.iter().position(is_end).expect("the practice ended");
    let [Effect::Failed(RoomError::Simulation(SimulationError::Scene(_))), over, told @ ..] =
        &effects[end + 1..]
    else {
        panic!("{effects:?}");
    };
    assert_eq!(*over, Effect::Journal(Entry::Over { ending: Ending::Failed }));
    let hears = |effect: &Effect| match effect {
        Effect::Send(agent, ToPlayer::State { doing: Doing::Over, ending: Some(Ending::Failed), .. }) => {
            Some(*agent)
        }
        _ => None,
    };
    assert_eq!(told.iter().filter_map(hears).collect::<Vec<_>>(), AgentId::ALL);
    assert!(room.receive(AgentId::ZERO, FromPlayer::Ready, 3 * STEP).is_empty());
}
