//! Clarity of synthetic events.

use crate::{
    selection::{THING, place, scene},
    support::{Move, track},
};
use phase_evidence::{
    Clarity,
    clarity::{Duration, Standstill, knots, landmark_shown, standstills, steps_trying},
    selection::{Limit, Quantity},
};
use phase_model::{AgentId, Attitude, EventKind, Goal};

/// Both agents at an object that is at x, turned by an angle.
fn pulling(x: f32, angle: f32) -> Move {
    Move { agents: [(x - 2.0, 12.0, angle), (x + 2.0, 12.0, 0.0)], objects: vec![(x, 12.0)], held: [None; 2] }
}

/// Agent 0 at an object that is at x, and agent 1 far away.
fn apart(x: f32) -> Move {
    Move { agents: [(x - 2.0, 12.0, 0.0), (24.0, 20.0, 0.0)], objects: vec![(x, 12.0)], held: [None; 2] }
}

fn clarity(moves: Vec<Move>) -> Clarity {
    let scene = scene(EventKind::Competing, [THING, place(1, 1)], Attitude::Neutral);
    Clarity::of(&scene, &track(moves)).expect("it has steps")
}

#[test]
fn a_knot_is_a_second_without_progress() {
    let scene = scene(EventKind::Competing, [THING, place(1, 1)], Attitude::Neutral);
    let moves =
        |both: usize| [vec![apart(14.0); 5], vec![pulling(14.0, 0.0); both], vec![apart(14.0); 11]].concat();
    assert_eq!(knots(&scene, &track(moves(3))), []);
    assert_eq!(knots(&scene, &track(moves(4))), vec![core::ops::Range { start: 5, end: 9 }]);
    let found = clarity(moves(4));
    assert!((found.knotted - 4.0 / 19.0).abs() < 1e-9 && found.knot_at_end == 0, "{found:?}");
    // An object that is dragged on is no knot.
    let dragged: Vec<Move> = (0..12).map(|t| pulling(10.0 + 0.4 * t as f32, 0.0)).collect();
    assert_eq!(knots(&scene, &track(dragged)), []);
}

#[test]
fn where_an_event_ends_is_told() {
    let ends = clarity([vec![apart(14.0); 5], vec![pulling(14.0, 0.0); 6]].concat());
    assert_eq!((ends.knot_at_end, ends.at_object), (6, [true, true]));
    assert!(!ends.changes_late, "{ends:?}");
    let Goal::ObjectOnLandmark { .. } = THING else { panic!("a goal about an object") };
    let left: f32 = THING.distance(&track([pulling(14.0, 0.0)]).states[0]);
    assert!((ends.remaining[0] - f64::from(left)).abs() < 1e-5, "{ends:?}");
    let walking: Vec<Move> = (0..12).map(|t| apart(14.0 - 0.4 * t as f32)).collect();
    assert!(clarity(walking).changes_late);
}

#[test]
fn spinning_and_trembling_are_shares_of_time() {
    let spin: Vec<Move> = (0..11).map(|t| pulling(14.0, 0.5 * t as f32)).collect();
    let spun = clarity(spin);
    // From step 4 on, when a second has passed: 7 of 10 steps.
    assert!((spun.spinning - 0.7).abs() < 1e-9, "{spun:?}");
    assert_eq!(clarity(vec![pulling(14.0, 0.0); 11]).spinning, 0.0);
    let tremble: Vec<Move> = (0..11).map(|t| apart(14.0 + 0.1 * (t % 2) as f32)).collect();
    assert!((clarity(tremble).trembling - 1.0).abs() < 1e-9);
    assert_eq!(clarity(vec![apart(14.0); 11]).trembling, 0.0);
}

#[test]
fn trying_is_being_at_what_is_wanted_or_at_the_other() {
    let moves = [vec![apart(14.0); 5], vec![pulling(14.0, 0.0); 6]].concat();
    assert_eq!(clarity(moves.clone()).trying, [11, 6]);
    let track = track(moves);
    let other = phase_model::ObjectId::ALL[1];
    let Goal::ObjectOnLandmark { landmark, sign, .. } = THING else { panic!("a goal about an object") };
    let about_another = Goal::ObjectOnLandmark { object: other, landmark, sign };
    assert_eq!(steps_trying(&track, AgentId::ZERO, about_another), 0);
}

#[test]
fn a_landmark_is_shown_by_coming_closer_to_it_than_to_the_others() {
    // Along the line between the two upper landmarks, (8.5, 19.5) and (23.5, 19.5), and back again.
    let along = |x: f32| Move {
        agents: [(12.0, 6.0, 0.0), (20.0, 6.0, 0.0)],
        objects: vec![(x, 19.5)],
        held: [None; 2],
    };
    let track = track([10.0, 12.0, 15.0, 11.0].map(along));
    let shown = |landmark: usize| {
        let goal = Goal::ObjectOnLandmark {
            object: phase_model::ObjectId::ZERO,
            landmark: phase_model::LandmarkId::ALL[landmark],
            sign: phase_model::Sign::Positive,
        };
        landmark_shown(&track, goal).expect("a landmark")
    };
    // At x = 15 it is 5 u closer to the right, where the lower one there is closer by 20.18 - 17.24 = 2.94.
    let lower = 13.5_f32.hypot(15.0) - 8.5_f32.hypot(15.0);
    assert!((shown(1) - f64::from(5.0 - lower)).abs() < 1e-4, "{}", shown(1));
    // It never comes closer to the left ones than to the right ones.
    assert_eq!((shown(0), shown(3)), (0.0, 0.0));
    let chase = Goal::Touch { agent: AgentId::ZERO, other: AgentId::ONE, sign: phase_model::Sign::Positive };
    assert_eq!(landmark_shown(&track, chase), None);
}

#[test]
fn the_rest_at_the_end_is_as_long_as_everything_stays_there() {
    let walk = (0..6).map(|t| apart(14.0 - 0.4 * t as f32));
    let rest = core::iter::repeat_n(apart(12.0), 7);
    assert_eq!(clarity(walk.chain(rest).collect()).rest_at_end, 7);
    assert_eq!(clarity(vec![apart(14.0); 5]).rest_at_end, 4);
}

#[test]
fn after_a_knot_the_one_that_leaves_keeps_off_until_it_is_back() {
    let scene = scene(EventKind::Competing, [THING, place(1, 1)], Attitude::Neutral);
    let both = |steps: usize| vec![pulling(14.0, 0.0); steps];
    // A knot, four steps in which agent 1 is away, a touch too short for a knot, and again five to the end.
    let moves = [both(6), vec![apart(14.0); 4], both(2), vec![apart(14.0); 5]].concat();
    let of = |steps, is_cut| Duration { steps, is_cut };
    let expected = Standstill { duration: of(6, false), kept_off: Some(of(4, false)) };
    assert_eq!(standstills(&scene, &track(moves)), [expected]);
    let away = track([both(6), vec![apart(14.0); 4]].concat());
    assert_eq!(standstills(&scene, &away)[0].kept_off, Some(of(4, true)));
    let to_the_end = Standstill { duration: of(6, true), kept_off: None };
    assert_eq!(standstills(&scene, &track(both(6))), [to_the_end]);
}

#[test]
fn quantities_that_selection_limits_are_measured_on_motion_alone() {
    let competing = scene(EventKind::Competing, [THING, place(1, 1)], Attitude::Neutral);
    let moves =
        [(0..4).map(|t| apart(14.0 - 0.5 * t as f32)).collect(), vec![pulling(12.5, 0.0); 8]].concat();
    let track = track(moves);
    let of = |quantity: Quantity| quantity.of(&competing, &track);
    // Steps 5 to 11 change nothing.
    assert_eq!(of(Quantity::Standstill), Some(7.0));
    assert_eq!(of(Quantity::Still), Some(7.0 / 11.0));
    assert_eq!(of(Quantity::Knotted), Some(8.0 / 11.0));
    assert_eq!(of(Quantity::KnotAtEnd), Some(8.0));
    // Agent 1 wants to be somewhere itself, and nobody is helped or hindered.
    assert_eq!((of(Quantity::Favour), of(Quantity::Trying)), (None, None));
    let helping = scene(EventKind::Helping, [THING, THING], Attitude::Help);
    assert!(Quantity::Trying.of(&helping, &track).is_some_and(|steps| steps > 0.0));
    assert!(Limit::AtMost(0.5).keeps(0.5) && !Limit::AtMost(0.5).keeps(0.6));
    assert!(Limit::AtLeast(0.5).keeps(0.5) && !Limit::AtLeast(0.5).keeps(0.4));
}
