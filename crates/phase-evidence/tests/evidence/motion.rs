//! Speed, path and contact of synthetic events.

use crate::support::{Move, track};
use phase_evidence::{MotionStatistics, Track, VideoMotion, contact::TOUCH_GAP, motion::common_steps};
use phase_model::{AgentId, Contacts, Entity, ObjectId};

/// Agent 0 at these x, facing up; agent 1 far away; an object at (20, 10).
fn walk(xs: &[f32]) -> Track {
    let one = |&x: &f32| Move {
        agents: [(x, 10.0, 0.0), (10.0, 20.0, 0.0)],
        objects: vec![(20.0, 10.0)],
        ..Move::default()
    };
    track(xs.iter().map(one))
}

#[test]
fn speed_and_path_go_by_the_origins() {
    // A step is 1/12 s of physics: 0.5 u in it are 6 u/s.
    let motion = MotionStatistics::of(&walk(&[8.0, 8.5, 8.5, 7.5]), AgentId::ZERO, 3);
    let expected = [6.0, 0.0, 12.0];
    assert_eq!(motion.speeds.len(), expected.len());
    for (speed, expected) in motion.speeds.iter().zip(expected) {
        assert!((speed - expected).abs() < 1e-4, "{motion:?}");
    }
    assert!((motion.path - 1.5).abs() < 1e-5, "there and back both count: {motion:?}");
    let other = MotionStatistics::of(&walk(&[8.0, 8.5, 8.5, 7.5]), AgentId::ONE, 3);
    assert_eq!((other.speeds, other.path), (vec![0.0; 3], 0.0));
}

#[test]
fn turning_on_the_spot_is_no_motion() {
    let spin = (0..4).map(|t| Move { agents: [(8.0, 8.0, t as f32), (20.0, 8.0, 0.0)], ..Move::default() });
    assert_eq!(MotionStatistics::of(&track(spin), AgentId::ZERO, 3).path, 0.0);
}

/// Agent 0 comes from below, facing up: its front is 1 u above its origin, the object's edge 1 u below (20,
/// 10).
#[test]
fn contact_is_counted_step_by_step_without_the_start() {
    let gaps = [0.5 * TOUCH_GAP, 1.0, 0.5 * TOUCH_GAP, 0.0, 1.5 * TOUCH_GAP];
    let moves = gaps.map(|gap| Move {
        agents: [(20.0, 8.0 - gap, 0.0), (10.0, 20.0, 0.0)],
        objects: vec![(20.0, 10.0)],
        ..Move::default()
    });
    let motion = MotionStatistics::of(&track(moves), AgentId::ZERO, 4);
    assert_eq!(motion.contact_steps, 2, "{motion:?}");
    assert_eq!(motion.contact_share(), Some(0.5));
}

#[test]
fn both_agents_are_in_contact_with_each_other() {
    let at = |x: f32| Move { agents: [(x, 10.0, 0.0), (15.0, 10.0, 0.0)], ..Move::default() };
    let track = track([at(8.0), at(12.0), at(8.0)]);
    let shares = [0, 1].map(|agent| MotionStatistics::of(&track, AgentId::ALL[agent], 2).contact_share());
    assert_eq!(shares, [Some(0.5); 2]);
}

/// Recordings contain no contacts, so those of a simulation must not count either.
#[test]
fn contacts_that_outlines_do_not_show_are_not_counted() {
    let mut track = walk(&[8.0, 8.0]);
    let mut contacts = Contacts::NONE;
    contacts.insert(Entity::Agent(AgentId::ZERO), Entity::Object(ObjectId::ZERO));
    track.states[1].contacts = contacts;
    assert_eq!(MotionStatistics::of(&track, AgentId::ZERO, 1).contact_steps, 0);
}

#[test]
fn a_longer_event_is_cut_to_the_shorter_one() {
    let long = walk(&[8.0, 8.5, 9.0, 12.0]);
    let short = walk(&[8.0, 9.0]);
    assert_eq!((common_steps(&long, &short), common_steps(&short, &long)), (1, 1));
    let motion = MotionStatistics::of(&long, AgentId::ZERO, 1);
    assert!((motion.path - 0.5).abs() < 1e-5 && motion.speeds.len() == 1, "{motion:?}");
    assert_eq!(MotionStatistics::of(&short, AgentId::ZERO, 5).speeds.len(), 1, "nothing lies past the end");
    assert_eq!(MotionStatistics::of(&walk(&[8.0]), AgentId::ZERO, 5).contact_share(), None);
}

#[test]
fn the_motion_of_a_video_is_in_its_seconds() {
    // Agent 0 stands, jumps 1 u a step twice, and stands; agent 1 stays at (20, 8). A step is 0.25 s.
    let places = [8.0, 8.0, 9.0, 10.0, 10.0];
    let track = crate::support::track(places.map(|x| crate::support::Move {
        agents: [(x, 8.0, 0.0), (20.0, 8.0, 0.0)],
        ..crate::support::Move::default()
    }));
    let motion = VideoMotion::of(&track).expect("steps");
    let close = |found: f64, expected: f64| assert!((found - expected).abs() < 1e-5, "{motion:?}");
    close(motion.seconds, 1.0);
    close(motion.path[0], 2.0);
    close(motion.speed[0], 2.0);
    close(motion.path[1], 0.0);
    // Displacements of steps 2 to 4 are 1, 1, 0: changes 0 and 1 u, over 0.25 s squared.
    close(motion.acceleration[0], 0.5 / 0.0625);
    close(motion.acceleration[1], 0.0);
    close(motion.distance, (12.0 + 12.0 + 11.0 + 10.0 + 10.0) / 5.0);
    close(motion.least_distance, 10.0);
    close(motion.agents_touch, 0.0);
    assert_eq!(VideoMotion::of(&track.until(0)), None);
}
