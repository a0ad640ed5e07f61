//! Stillness at the end.

use crate::support::{Move, track};
use phase_evidence::Rest;
use phase_model::{AgentId, Entity, ObjectId};

fn event(poses: &[(f32, f32)]) -> phase_evidence::Track {
    let one =
        |&(x, angle): &(f32, f32)| Move { agents: [(x, 8.0, angle), (20.0, 8.0, 0.0)], ..Move::default() };
    track(poses.iter().map(one))
}

#[test]
fn what_is_still_moving() {
    let rest = Rest::after(
        &event(&[(8.0, 0.0), (10.0, 0.0), (10.5, 0.5), (10.0, 0.0)]),
        Entity::Agent(AgentId::ZERO),
        1,
    );
    assert_eq!((rest.steps, rest.moving_steps), (2, 2));
    assert!((rest.travelled - 1.0).abs() < 1e-5, "{rest:?}");
    assert!((rest.displacement - 0.5).abs() < 1e-5, "{rest:?}");
    assert!((rest.turned - 1.0).abs() < 1e-5, "both ways count: {rest:?}");
}

#[test]
fn quiet_is_staying_facing_and_not_trembling() {
    let still = vec![(8.0, 0.0); 21];
    let drifting: Vec<(f32, f32)> = (0..21).map(|t| (8.0 + 0.019 * t as f32, 0.0)).collect();
    let spinning: Vec<(f32, f32)> = (0..21).map(|t| (8.0, t as f32)).collect();
    let trembling: Vec<(f32, f32)> = (0..21).map(|t| (8.0 + 0.05 * (t % 2) as f32, 0.0)).collect();
    let mut nudged = still.clone();
    nudged[20].0 = 8.1;
    let cases = [(still, true), (drifting, false), (spinning, false), (trembling, false), (nudged, true)];
    for (poses, quiet) in cases {
        assert_eq!(
            Rest::after(&event(&poses), Entity::Agent(AgentId::ZERO), 0).is_at_rest(),
            quiet,
            "{poses:?}"
        );
    }
}

#[test]
fn past_the_end_everything_is_quiet() {
    assert!(Rest::after(&event(&[(8.0, 0.0)]), Entity::Agent(AgentId::ZERO), 5).is_at_rest());
}

#[test]
fn nobody_sees_a_disc_turn() {
    let mut track = track([(); 5].map(|()| Move { objects: vec![(12.0, 12.0)], ..Move::default() }));
    for (t, state) in track.states.iter_mut().enumerate() {
        state.bodies[2].angle = t as f32;
    }
    let rest = Rest::after(&track, Entity::Object(ObjectId::ZERO), 0);
    assert!(rest.is_at_rest() && rest.turned == 0.0, "{rest:?}");
}
