//! Recordings that were mirrored: they begin late, lack the angles of objects, and may garble those of
//! agents.

use super::{
    Simulated,
    contact::{assert_found, contested},
    mean,
};
use crate::InverseDynamics;
use core::f32::consts::TAU;
use phase_event::ObservedEvent;
use phase_model::{AGENT_COUNT, Action, Body, Flip, MAX_ENTITIES, State, arena::SUBSTEPS};

/// An event as the published recorder changes it: every substep mirrored, angles of agents wrapped if the
/// axes were exchanged, and the mean taken.
pub(super) fn recorded(event: &Simulated, flip: Flip) -> ObservedEvent {
    let wraps = matches!(flip, Flip::Diagonal | Flip::AntiDiagonal);
    let body = |index: usize, body: &Body| {
        let mut body = body.mirrored(flip);
        if index >= AGENT_COUNT {
            body.angle = 0.0;
        } else if wraps {
            body.angle = body.angle.rem_euclid(TAU) - TAU;
        }
        body
    };
    let substep = |state: &State| State::new(core::array::from_fn(|index| body(index, &state.bodies[index])));
    let substeps: Vec<[State; SUBSTEPS]> =
        event.substeps.iter().map(|substeps| substeps.each_ref().map(substep)).collect();
    let row = |substeps: &[State; SUBSTEPS]| -> [Body; MAX_ENTITIES] {
        core::array::from_fn(|entity| mean(substeps, entity))
    };
    let rows = core::iter::once(substeps[0][0].bodies).chain(substeps.iter().map(row)).collect();
    let observed = &event.observed;
    let layout = observed.layout().flipped(flip);
    ObservedEvent::new(layout, observed.agent_sizes(), observed.object_sizes().to_vec(), rows)
        .expect("a sound event")
}

/// The event as it would have been seen mirrored, so that left is right.
fn mirrored(event: Simulated, flip: Flip) -> Simulated {
    let action = |action| match action {
        Action::TurnLeft => Action::TurnRight,
        Action::Left => Action::Right,
        Action::Right => Action::Left,
        Action::UpLeft => Action::UpRight,
        Action::UpRight => Action::UpLeft,
        other => other,
    };
    let actions = event.actions.iter().map(|both| both.map(action)).collect();
    let state = |state: &State| State::new(state.bodies.map(|body| body.mirrored(flip)));
    Simulated { states: event.states.iter().map(state).collect(), actions, ..event }
}

#[test]
fn what_was_done_before_mirroring_is_found() {
    for flip in Flip::ALL {
        let event = contested();
        let motion = InverseDynamics::new(&recorded(&event, flip));
        assert!(motion.late_start, "{flip:?}");
        assert_found(&motion, &mirrored(event, flip));
    }
}

#[test]
fn an_event_in_a_mirrored_layout_need_not_have_been_mirrored() {
    let event = contested();
    let rows = event.observed.rows().iter().map(|row| row.map(|body| body.mirrored(Flip::LeftRight)));
    let layout = event.observed.layout().flipped(Flip::LeftRight);
    let sizes = event.observed.object_sizes().to_vec();
    let observed = ObservedEvent::new(layout, event.observed.agent_sizes(), sizes, rows.collect());
    let motion = InverseDynamics::new(&observed.expect("a sound event"));
    assert!(!motion.late_start);
    assert!(motion.explained().all(|explained| explained));
}
