//! Agents that act on each other, directly and through an object.

use super::{Simulated, simulate};
use crate::InverseDynamics;
use phase_model::{Action, AgentId, Size, Vec2};

/// Both grab one object from opposite sides, pull it to and fro and turn it, let go of it one after the
/// other, and push each other.
pub(super) fn contested() -> Simulated {
    let object = Vec2::new(20.0, 6.0);
    let gap = 0.02;
    let below = Vec2::new(20.0, 6.0 - 2.0 * Size::Small.radius() - gap);
    let above = Vec2::new(20.0, 6.0 + Size::Small.radius() + Size::Medium.radius() + gap);
    let runs = [
        ([Action::Left, Action::Attach], 1),
        ([Action::Attach, Action::Up], 1),
        ([Action::Down, Action::Up], 3),
        ([Action::Left, Action::Right], 3),
        ([Action::TurnLeft, Action::UpLeft], 4),
        ([Action::Detach, Action::UpLeft], 1),
        ([Action::Up, Action::Down], 3),
        ([Action::Up, Action::Detach], 1),
        ([Action::UpRight, Action::Down], 6),
        ([Action::Up, Action::Down], 3),
    ];
    simulate([below, above, object, Vec2::new(8.0, 20.0)], vec![Size::Small, Size::Medium], &runs)
}

/// The actions that were done explain every step, and leads to the states that were simulated.
pub(super) fn assert_found(motion: &InverseDynamics, event: &Simulated) {
    assert_eq!(motion.strengths(), super::STRENGTHS);
    for (step, residuals) in motion.alternatives().iter().enumerate() {
        let found = motion.residuals[step];
        assert!(found < 1e-3, "residual {found} in step {step}");
        for agent in AgentId::ALL {
            let truth = residuals[agent.index()][event.actions[step][agent].index()];
            assert!(truth < 1e-3, "agent {agent:?}, step {step}: residual {truth} of what was done");
        }
    }
    for (step, (found, state)) in motion.states.iter().zip(&event.states).enumerate().skip(1) {
        for body in 0..4 {
            let off = found.bodies[body].position.distance(state.bodies[body].position);
            assert!(off < 1e-3, "body {body} is {off} u off after step {step}");
        }
    }
}

#[test]
fn agents_that_hold_and_push_the_same_are_told_apart() {
    let event = contested();
    let touching =
        |event: &Simulated| event.states.iter().filter(|state| state.contacts != Default::default()).count();
    assert!(touching(&event) > 3, "the simulation itself");
    let both = |event: &Simulated| {
        let held = |state: &&phase_model::State| state.grips.iter().all(Option::is_some);
        event.states.iter().filter(held).count()
    };
    assert!(both(&event) > 9, "the simulation itself");
    let motion = InverseDynamics::new(&event.observed);
    assert!(!motion.late_start);
    assert_found(&motion, &event);
    assert!(motion.explained().all(|explained| explained));
    let pushed = motion.actions.iter().zip(&event.actions).filter(|(found, truth)| found == truth).count();
    assert!(pushed + 4 >= event.actions.len(), "{pushed} of {}", event.actions.len());
}
