//! What is written below the picture of a mind.

use phase_cli::captions::{COUNT, lines};
use phase_event::{ActionValue, SubgoalValue, Thought};
use phase_model::{Action, AgentId, Entity, LandmarkId, Literal, ObjectId, Predicate, Subgoal};
use phase_render::Style;

fn on(object: u8, landmark: u8, holds: bool) -> Subgoal {
    Subgoal::Achieve(Literal {
        predicate: Predicate::On(
            Entity::Object(ObjectId::ALL[usize::from(object)]),
            LandmarkId::ALL[usize::from(landmark)],
        ),
        holds,
    })
}

fn thought() -> Thought {
    let attach =
        Subgoal::Achieve(Literal { predicate: Predicate::Attach(AgentId::ZERO, ObjectId::ONE), holds: true });
    let proposed = |subgoal, value, particles| SubgoalValue { subgoal, value, particles };
    let found = |action, visits, value| ActionValue { action, visits, value };
    Thought {
        subgoal: attach,
        subgoals: vec![
            proposed(attach, 0.25, 30),
            proposed(on(1, 2, false), -0.5, 10),
            proposed(Subgoal::Stay, -1.0, 6),
            proposed(on(0, 0, true), -9.75, 4),
        ],
        plan: vec![attach, on(1, 2, true), attach, Subgoal::Stay],
        actions: vec![
            found(Action::Up, 100, 0.5),
            found(Action::Down, 600, -0.125),
            found(Action::Stop, 100, 0.0),
            found(Action::Left, 150, 0.0),
            found(Action::Right, 50, 0.0),
        ],
    }
}

#[test]
fn a_thought_is_told_in_order_with_bars_for_shares() {
    let expected = [
        ("agent 0 (red), step 7: down", 0.0),
        ("V, particles (bar), subgoal", 0.0),
        (" 0.25 30 Attach(agent 0, object 1)", 0.6),
        ("-0.50 10 not On(object 1, landmark 2)", 0.2),
        ("-1.00  6 Stay", 0.12),
        ("plan: Attach(agent 0, object 1)", 0.0),
        ("  > On(object 1, landmark 2) +2", 0.0),
        ("visits (bar), mean return, action", 0.0),
        ("  600  -0.125 down", 0.6),
        ("  150   0.000 left", 0.15),
        ("  100   0.500 up", 0.1),
        ("  100   0.000 stop", 0.1),
    ];
    let found = lines("agent 0 (red), step 7: down".into(), &thought());
    let found: Vec<_> = found.iter().map(|line| (line.text.as_str(), line.bar)).collect();
    assert_eq!(found, expected);
}

#[test]
fn there_are_always_as_many_lines() {
    let mut thought = thought();
    assert_eq!(lines(String::new(), &thought).len(), COUNT);
    thought.actions.clear();
    let unsearched = lines(String::new(), &thought);
    assert_eq!(unsearched.len(), COUNT);
    assert!(unsearched.iter().any(|line| line.text == "no search needed"));
    assert_eq!(lines(String::new(), &Thought::IDLE).len(), COUNT);
}

#[test]
fn lines_fit_below_a_video_and_a_contact_sheet() {
    for style in [Style::default(), Style::with_side(320)] {
        for line in lines("agent 1 (green), step 100: downright".into(), &thought()) {
            let (length, columns) = (line.text.len(), style.caption_columns());
            assert!(length <= columns, "{:?} has {length} of {columns} columns", line.text);
        }
    }
}
