//! Games that go on where their journals end.

use crate::support::{RED, Table, lines, round, settings};
use core::time::Duration;
use phase_game::{
    Doing, Ending, Entry, FromPlayer, Player, Room,
    journal::{Actions, entries, is_over, whole as journal_text},
};
use phase_model::Action;

/// Wherever the journal ends, the game goes on from its last step, and becomes the same event.
#[test]
fn a_game_goes_on_where_its_journal_ends() {
    for players in [[Player::Human; 2], [Player::Human, Player::Mind]] {
        let script = |table: &mut Table| {
            // From the round's number and the step, so that it does not depend on when the game was
            // interrupted.
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
            assert!(!is_over(&read), "after {length} entries");
            let resumed = Room::resume(read, Duration::ZERO).expect("our own journal");
            let (room, effects) = resumed.unwrap_or_else(|| panic!("not over after {length} entries"));
            let mut table = Table { room, now: Duration::ZERO, effects }.both_come();
            play(&mut table);
            assert_eq!(table.recordings(), expected, "after {length} entries");
        }
        for length in [journal.len() - 1, journal.len()] {
            assert!(is_over(&journal[..length]));
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
    // A round that is over has no more steps.
    let Some(end) = journal.iter().position(|entry| *entry == Entry::Ended { round: 0 }) else {
        panic!("the practice has ended")
    };
    let longer = [&journal[..end], &journal[end - 1..end], &journal[end..]].concat();
    assert!(refused(longer).contains(&format!("entry {}", end + 1)));
    assert!(is_over(&[journal[0].clone(), Entry::Ended { round: usize::MAX }]));
    // Nor has a game that is over anything but its end.
    let over = Entry::Over { ending: Ending::Left };
    let longer = [&journal[..1], core::slice::from_ref(&over), &journal[1..2]].concat();
    assert!(refused(longer).contains("entry 3"));
    assert!(refused([&journal[..1], &[over.clone(), over]].concat()).contains("entry 3"));
    let blank = lines(&journal[..2]) + "\n";
    assert!(entries(&blank).expect_err("an empty line").to_string().contains("entry 3"));
    // Bytes that are no text are not read as if they were others, and unknown settings are not left out.
    let mut bytes = lines(&journal[..2]).into_bytes();
    let first = bytes.iter().position(|&byte| byte == b'\n').expect("a line");
    bytes[first + 3] = 0xff;
    let error = journal_text(&bytes).expect_err("not text").to_string();
    assert!(error.contains("entry 2 is not UTF-8"), "{error}");
    let unknown = lines(&journal[..1]).replacen("\"view\":", "\"blur\":1,\"view\":", 1);
    assert!(entries(&unknown).expect_err("unknown").to_string().contains("entry 1"));
    // Which of two members counts is not for a reader to choose.
    let twice = lines(&journal[..1]).replacen("\"seed\":", "\"seed\":1,\"seed\":", 1);
    assert!(twice.contains("\"seed\":1,"));
    let refused = entries(&twice).expect_err("ambiguous");
    assert!(core::error::Error::source(&refused).is_some_and(|why| why.to_string().contains("comes twice")));
    for text in ["{}\n", "nonsense\n", "{\"entry\":\"step\",\"actions\":[\"up\",\"fly\"]}\n", "[1]\n"] {
        assert!(entries(text).expect_err("no entry").to_string().contains("entry 1"));
    }
}
