//! The text below the picture of an agent's decision.

use phase_event::{ActionEvaluation, BelievedIntent, SubgoalValue, Thought};
use phase_model::{
    Action, AgentId, Attitude, Entity, Goal, Intent, LandmarkId, Literal, ObjectId, Predicate, Sign, Subgoal,
};
use phase_render::{Caption, SizedFont, Style};
use phase_runs::captions::{COUNT, lines};

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
    let found = |action, visits, value| ActionEvaluation { action, visits, value };
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
        intents: vec![],
        suspicion: None,
    }
}

#[test]
fn a_thought_is_told_in_order_with_bars_for_shares() {
    let expected = [
        (&["V", "particles"][..], "subgoal (bar: share of particles)", 0.0),
        (&["0.25", "30"], "Attach(agent 0, object 1)", 0.6),
        (&["−0.50", "10"], "not On(object 1, landmark 2)", 0.2),
        (&["−1.00", "6"], "Stay", 0.12),
        (&[], "plan: Attach(agent 0, object 1)", 0.0),
        (&[], "→ On(object 1, landmark 2) +2", 0.0),
        (&["visits", "return"], "action (bar: share of visits)", 0.0),
        (&["600", "−0.125"], "down", 0.6),
        (&["150", "0.000"], "left", 0.15),
        (&["100", "0.500"], "up", 0.1),
        (&["100", "0.000"], "stop", 0.1),
    ]
    .map(|(cells, text, bar)| (cells.iter().map(ToString::to_string).collect(), text.to_owned(), bar));
    let found: Vec<(Vec<String>, String, f32)> =
        lines(&thought()).into_iter().map(|line| (line.cells, line.text, line.bar)).collect();
    assert_eq!(found, expected);
}

#[test]
fn there_are_always_as_many_lines() {
    let mut thought = thought();
    assert_eq!(lines(&thought).len(), COUNT);
    thought.actions.clear();
    let unsearched = lines(&thought);
    assert_eq!(unsearched.len(), COUNT);
    assert!(unsearched.iter().any(|line| line.text == "no search needed"));
    assert_eq!(lines(&Thought::IDLE).len(), COUNT);
}

#[test]
fn lines_fit_below_a_video_and_a_contact_sheet() {
    for style in [Style::default(), Style::with_side(320)] {
        let font = SizedFont::new(style.text_size()).expect("the embedded font is a font");
        let (cell, line) = (style.cell_width() as f32, style.text_width() as f32);
        for Caption { cells, text, .. } in lines(&thought()) {
            assert!(cells.iter().all(|text| font.width(text) < cell), "{cells:?} in {cell} pixels");
            let room = line - cells.len() as f32 * cell - 0.5 * style.text_size() as f32;
            assert!(font.width(&text) <= room, "{text:?} in {room} pixels");
        }
    }
}

/// An agent that does not know the other's goal tells what it believes, in as many lines.
#[test]
fn believed_intents_take_the_place_of_actions() {
    let goal = Goal::ObjectOnLandmark {
        object: ObjectId::ONE,
        landmark: LandmarkId::TOP_LEFT,
        sign: Sign::Positive,
    };
    let believed = |attitude, particles| BelievedIntent { intent: Intent { attitude, goal }, particles };
    let mut thought = thought();
    thought.intents = vec![believed(Attitude::Neutral, 15), believed(Attitude::Hinder, 5)];
    let lines = lines(&thought);
    assert_eq!(lines.len(), COUNT);
    let of = |text: &str| lines.iter().find(|line| line.text == text).map(|line| line.bar);
    assert_eq!(of("On(object 1, landmark 0)"), Some(0.75));
    assert_eq!(of("to hinder"), Some(0.25));
    assert_eq!(of("down"), None);
    assert_eq!(of("suspects hindrance"), None);
}

/// A hinderer that asks itself what the other suspects tells it, in as many lines.
#[test]
fn suspicion_is_the_last_line() {
    let goal = Goal::Touch { agent: AgentId::ONE, other: AgentId::ZERO, sign: Sign::Positive };
    let mut thought = thought();
    let intent = Intent { attitude: Attitude::Neutral, goal };
    thought.intents = vec![BelievedIntent { intent, particles: 20 }];
    thought.suspicion = Some(0.25);
    let lines = lines(&thought);
    assert_eq!(lines.len(), COUNT);
    let last = lines.last().expect("there are always lines");
    assert_eq!((last.text.as_str(), last.bar, last.cells[1].as_str()), ("suspects hindrance", 0.25, "0.25"));
}
