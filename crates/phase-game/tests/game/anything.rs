//! Anything in any order.

use crate::support::{Table, lines};
use core::time::Duration;
use phase_game::{Doing, Effect, FromPlayer, Room, journal::entries};
use phase_model::{Action, AgentId};
use proptest::prelude::*;

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

    /// Whatever happens in whatever order: no step while somebody is absent, messages go to who is connected
    /// only, and the journal can be resumed.
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
                Happening::Wait => {
                    let soon = table.now + Duration::from_secs(30);
                    if table.room.due().is_some_and(|due| due < soon) {
                        table.wait();
                    }
                }
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
                        rest => {
                            let gone = rest == 6;
                            if table.room.doing() != Doing::Over {
                                away[k] = gone;
                            }
                            FromPlayer::Away(gone)
                        }
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
        let journal = entries(&lines(&table.entries())).expect("our own journal");
        let resumed = Room::resume(journal, Duration::ZERO);
        let resumed = resumed.expect("our own journal");
        prop_assert_eq!(resumed.is_none(), table.room.doing() == Doing::Over);
        if let Some((room, effects)) = resumed {
            prop_assert!(effects.is_empty());
            prop_assert_eq!(room.recording(), table.room.recording());
        }
    }
}
