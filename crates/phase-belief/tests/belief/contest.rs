//! Contests for an object, with grips by hand.

use phase_belief::{Belief, Contest};
use phase_forward::Forward;
use phase_model::{
    Action, AgentBody, AgentId, Body, Grip, ObjectId, PhysicsConfig, Side, State, Vec2,
    random::{Purpose, stream},
};
use phase_perception::observe;

const PATIENCE: u16 = 6;
const RESPITE: u16 = 11;

/// Both agents beside an object at x, which these hold.
fn state(x: f32, held: [bool; 2]) -> State {
    let places = [Vec2::new(x - 2.0, 9.0), Vec2::new(x + 2.0, 9.0), Vec2::new(x, 9.0), Vec2::ZERO];
    let mut state = State::new(places.map(|place| Body::at_rest(place, 0.0)));
    // The agents face the object and each other; angle 0 is along y.
    state.bodies[0].angle = -core::f32::consts::FRAC_PI_2;
    state.bodies[1].angle = core::f32::consts::FRAC_PI_2;
    let grip = Grip { object: ObjectId::ZERO, side: Side::Head, relative_angle: 0.0 };
    state.grips = held.map(|held| held.then_some(grip));
    state
}

/// Whether each agent cedes the object to the other after these states.
fn ceded(states: &[State]) -> [bool; 2] {
    let body = AgentBody { radius: 0.8, max_force: 450.0 };
    let physics =
        PhysicsConfig { walls: Vec::new(), agents: [body; 2], object_radii: [0.8; 2], object_count: 1 };
    let forward = Forward::new(&physics);
    AgentId::ALL.map(|agent| {
        let mut random = stream(1, Purpose::Belief, 0);
        let mut belief = Belief::new(&physics, &observe(&physics, &states[0], agent), 3, &mut random);
        for state in &states[1..] {
            let observation = observe(&physics, state, agent);
            belief.update(&forward, &physics, Action::NoForce, &observation, &mut random);
        }
        belief.contest().ceded(agent, PATIENCE, RESPITE) == Some(ObjectId::ZERO)
    })
}

/// Steps with these grips, the object at rest.
fn steps(count: usize, held: [bool; 2]) -> Vec<State> {
    vec![state(16.0, held); count]
}

#[test]
fn the_first_holder_lets_go_after_a_standstill() {
    let first = steps(2, [true, false]);
    let pulling = |count| [first.clone(), steps(count, [true, true])].concat();
    assert_eq!(ceded(&pulling(6)), [false; 2]);
    assert_eq!(ceded(&pulling(7)), [true, false]);
    // The same where the other came first.
    let other = [steps(2, [false, true]), steps(7, [true, true])].concat();
    assert_eq!(ceded(&other), [false, true]);
}

#[test]
fn an_object_that_gets_on_is_not_ceded() {
    let dragged = (0..20).map(|t| state(12.0 + 0.3 * t as f32, [true, true]));
    let states: Vec<State> = steps(2, [true, false]).into_iter().chain(dragged).collect();
    assert_eq!(ceded(&states), [false; 2]);
}

#[test]
fn it_is_left_alone_for_a_while_as_long_as_the_other_holds_it() {
    let fight = [steps(2, [true, false]), steps(8, [true, true])].concat();
    let after = |rest: Vec<State>| ceded(&[fight.clone(), rest].concat());
    assert_eq!(after(steps(10, [false, true])), [true, false]);
    assert_eq!(after(steps(11, [false, true])), [false; 2]);
    assert_eq!(after([steps(3, [false, true]), steps(1, [false; 2])].concat()), [false; 2]);
    // Taken again, it is the other that held it first.
    let again = [steps(11, [false, true]), steps(7, [true, true])].concat();
    assert_eq!(after(again), [false, true]);
}

#[test]
fn nothing_is_ceded_without_a_contest() {
    assert_eq!(Contest::default().ceded(AgentId::ZERO, 0, 1), None);
}
