//! Events simulated with known actions, whose actions are inferred.

mod contact;
mod mirrored;

use super::InverseDynamics;
use phase_event::ObservedEvent;
use phase_forward::Forward;
use phase_model::{
    AGENT_COUNT, Action, AgentId, Body, Layout, MAX_ENTITIES, Size, State, Strength, Vec2, arena::SUBSTEPS,
};

/// Steps for which an action is held.
const HELD: usize = 3;
const STRENGTHS: [Strength; AGENT_COUNT] = [Strength::Strong, Strength::Mighty];

/// A simulated event: the state at the end of every step, state 0 being the start, those after every substep,
/// and what a viewer sees.
struct Simulated {
    states: Vec<State>,
    substeps: Vec<[State; SUBSTEPS]>,
    actions: Vec<[Action; AGENT_COUNT]>,
    observed: ObservedEvent,
}

fn mean(substeps: &[State; SUBSTEPS], entity: usize) -> Body {
    let bodies = substeps.map(|state| state.bodies[entity]);
    let share = 1.0 / SUBSTEPS as f32;
    Body {
        position: bodies.iter().map(|body| body.position * share).sum(),
        velocity: bodies.iter().map(|body| body.velocity * share).sum(),
        angle: bodies.iter().map(|body| body.angle * share).sum(),
        angular_velocity: 0.0,
    }
}

/// Simulates runs of actions, each held for some steps, without walls in reach.
fn simulate(
    places: [Vec2; MAX_ENTITIES],
    object_sizes: Vec<Size>,
    runs: &[([Action; 2], usize)],
) -> Simulated {
    let start = State::new(places.map(|place| Body::at_rest(place, 0.0)));
    let layout = Layout::new(2, None).expect("a known layout");
    let event = |rows| ObservedEvent::new(layout, [Size::Small, Size::Medium], object_sizes.clone(), rows);
    let blank = event(vec![start.bodies]).expect("an event of one row");
    let world = Forward::new(&blank.physics(STRENGTHS.map(Strength::max_force)));
    let actions: Vec<_> = runs.iter().flat_map(|&(actions, steps)| vec![actions; steps]).collect();
    let mut states = vec![start];
    let mut rows = vec![start.bodies];
    let mut all = Vec::new();
    let mut state = start;
    let mut cache = world.fresh_cache(&start);
    for &actions in &actions {
        let substeps = world.step_warm(&mut state, &mut cache, actions);
        states.push(state);
        rows.push(core::array::from_fn(|entity| mean(&substeps, entity)));
        all.push(substeps);
    }
    Simulated { states, substeps: all, actions, observed: event(rows).expect("an event") }
}

/// Both agents in rooms of their own, far from everything.
fn apart() -> Simulated {
    let first =
        [Action::Up, Action::TurnLeft, Action::UpRight, Action::Stop, Action::Left, Action::TurnRight];
    let second = [Action::TurnRight, Action::Down, Action::Stop, Action::DownLeft, Action::Right, Action::Up];
    let runs: Vec<_> = first.into_iter().zip(second).map(|(a, b)| ([a, b], HELD)).collect();
    let places = [Vec2::new(10.0, 16.0), Vec2::new(22.0, 7.0), Vec2::ZERO, Vec2::ZERO];
    simulate(places, Vec::new(), &runs)
}

/// Agent 0 grabs an object in front of it, pulls it backwards and releases it.
fn pulled() -> Simulated {
    let object = Vec2::new(10.0, 17.0 + Size::Small.radius() + Size::Small.radius() + 0.02);
    let places = [Vec2::new(10.0, 17.0), Vec2::new(22.0, 7.0), object, Vec2::ZERO];
    let run = |action, steps| ([action, Action::NoForce], steps);
    let runs = [
        run(Action::NoForce, 1),
        run(Action::Attach, 1),
        run(Action::Down, 6),
        run(Action::Detach, 1),
        run(Action::Down, 4),
    ];
    simulate(places, vec![Size::Small], &runs)
}

#[test]
fn actions_and_strengths_of_free_agents_are_recovered() {
    let event = apart();
    let action_likelihoods = InverseDynamics::new(&event.observed);
    assert!(!action_likelihoods.late_start);
    assert_eq!(action_likelihoods.strengths(), STRENGTHS);
    assert_eq!(action_likelihoods.states.len(), event.states.len());
    let passive = |action: Action| matches!(action, Action::Stop | Action::NoForce);
    for (step, (action_likelihoods, actions)) in
        action_likelihoods.actions.iter().zip(&event.actions).enumerate()
    {
        for agent in 0..AGENT_COUNT {
            // Stopping and doing nothing are the same to an agent at rest.
            let at_rest = event.states[step].bodies[agent].velocity.length() < 1e-4;
            if !(at_rest && passive(action_likelihoods[agent]) && passive(actions[agent])) {
                assert_eq!(action_likelihoods[agent], actions[agent], "agent {agent}, step {step}");
            }
        }
    }
    for (step, (action_likelihoods, state)) in action_likelihoods.states.iter().zip(&event.states).enumerate()
    {
        for agent in 0..AGENT_COUNT {
            let off = action_likelihoods.bodies[agent].position.distance(state.bodies[agent].position);
            assert!(off < 1e-3, "agent {agent} is {off} u off after step {step}");
        }
    }
    assert!(action_likelihoods.residuals.iter().all(|&residual| residual < 1e-3));
}

#[test]
fn grips_are_recovered() {
    let event = pulled();
    let held: Vec<_> = event.states.iter().map(|state| state.held_object(AgentId::ZERO)).collect();
    assert_eq!(held.iter().filter(|held| held.is_some()).count(), 7, "the simulation itself");
    let action_likelihoods = InverseDynamics::new(&event.observed);
    // A grip does not show before it pulls, nor that it is gone before the object stays behind.
    for (step, (action_likelihoods, held)) in
        action_likelihoods.states.iter().zip(&held).enumerate().skip(3).take(5)
    {
        assert_eq!(action_likelihoods.held_object(AgentId::ZERO), *held, "after step {step}");
    }
    assert_eq!(action_likelihoods.states.last().and_then(|state| state.held_object(AgentId::ZERO)), None);
    let object = |state: &State| state.bodies[AGENT_COUNT].position;
    for (action_likelihoods, state) in action_likelihoods.states.iter().zip(&event.states) {
        assert!(object(action_likelihoods).distance(object(state)) < 0.05);
    }
}

#[test]
fn what_was_done_explains_more_than_anything_else() {
    let event = apart();
    let action_likelihoods = InverseDynamics::new(&event.observed);
    for (step, residuals) in action_likelihoods.alternatives().iter().enumerate() {
        for (agent, residuals) in residuals.iter().enumerate() {
            let simulated = residuals[event.actions[step][agent].index()];
            assert!(residuals.iter().all(|&other| simulated <= other + 1e-4), "agent {agent}, step {step}");
        }
    }
}

#[test]
fn an_explanation_repeats_bit_for_bit() {
    let event = pulled();
    let [first, second] = [0, 1].map(|_| InverseDynamics::new(&event.observed));
    assert_same(&first, &second);
}

/// Explanations are equal, bit for bit.
fn assert_same(first: &InverseDynamics, second: &InverseDynamics) {
    assert_eq!(first.states, second.states);
    assert_eq!(first.actions, second.actions);
    assert_eq!(first.late_start, second.late_start);
    let bits = |motion: &InverseDynamics| {
        let alternatives = motion.alternatives().concat().concat();
        let strengths = motion.log_strengths.concat().into_iter().map(f64::to_bits);
        let residuals = motion.residuals.iter().copied().chain(alternatives);
        strengths.chain(residuals.map(|residual| u64::from(residual.to_bits()))).collect::<Vec<_>>()
    };
    assert_eq!(bits(first), bits(second));
}
