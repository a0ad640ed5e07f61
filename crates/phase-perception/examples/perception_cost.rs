//! Measures the cost of observing: `cargo run --release -p phase-perception --example perception_cost`.

use phase_model::{
    AgentBody, AgentId, Body, Entity, Layout, LayoutError, ObjectId, PhysicsConfig, Size, State, Vec2,
    random::{Pcg64Mcg, Purpose, stream},
};
use phase_perception::{field_of_view, observe, observed_set, sees};
use std::{hint::black_box, time::Instant};

/// States observed repeatedly.
const STATES: usize = 1000;
/// Repetitions for each state.
const ROUNDS: usize = 50;

fn main() -> Result<(), LayoutError> {
    let physics = PhysicsConfig {
        walls: Layout::new(20, None)?.walls(),
        agents: [Size::Large, Size::Small].map(|size| AgentBody { radius: size.radius(), max_force: 300.0 }),
        object_radii: [Size::Medium.radius(), Size::Huge.radius()],
        object_count: 2,
    };
    let mut random = stream(1, Purpose::Scene, 0);
    let states: Vec<State> =
        (0..STATES).map(|_| State::new(core::array::from_fn(|_| any_body(&mut random)))).collect();
    let visible: usize = states.iter().map(|state| field_of_view(&physics, state, AgentId::ZERO).len()).sum();
    let observed: usize =
        states.iter().map(|state| observed_set(&physics, state, AgentId::ZERO).iter().count() - 1).sum();
    println!("{STATES} random states, 4 bodies, 4 walls; on average");
    println!("  {:.0} of 400 cells visible,", visible as f64 / STATES as f64);
    println!("  {:.2} of 3 others observed", observed as f64 / STATES as f64);
    measure("field_of_view", &states, |state| field_of_view(&physics, state, AgentId::ZERO).len());
    measure("observe", &states, |state| observe(&physics, state, AgentId::ZERO).visible.len());
    measure("observed_set", &states, |state| observed_set(&physics, state, AgentId::ZERO).bits().into());
    measure("sees (an agent)", &states, |state| {
        sees(&physics, state, AgentId::ZERO, Entity::Agent(AgentId::ONE)).into()
    });
    measure("sees (an object)", &states, |state| {
        sees(&physics, state, AgentId::ZERO, Entity::Object(ObjectId::ZERO)).into()
    });
    Ok(())
}

fn any_body(random: &mut Pcg64Mcg) -> Body {
    use rand::RngExt;
    let position = Vec2::new(random.random_range(7.5..24.5), random.random_range(3.5..20.5));
    Body::at_rest(position, random.random_range(-3.0..3.0))
}

fn measure(name: &str, states: &[State], look: impl Fn(&State) -> usize) {
    let start = Instant::now();
    for _ in 0..ROUNDS {
        for state in states {
            black_box(look(black_box(state)));
        }
    }
    let nanoseconds = start.elapsed().as_nanos() as f64 / (ROUNDS * states.len()) as f64;
    println!("  {name:<18}{nanoseconds:8.0} ns");
}
