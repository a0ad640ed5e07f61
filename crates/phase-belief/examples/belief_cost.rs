//! Measures the cost of belief updates: `cargo run --release -p phase-belief --example belief_cost`.

use phase_belief::{Belief, PARTICLE_COUNT};
use phase_forward::Forward;
use phase_model::{
    AGENT_COUNT, Action, AgentBody, AgentId, Body, Dynamics, Entity, Layout, LayoutError, MAX_ENTITIES,
    PhysicsConfig, Size, State, Vec2, arena,
    geometry::Outline,
    random::{Pcg64Mcg, Purpose, stream},
};
use phase_perception::{Observation, observe};
use rand::RngExt;
use std::time::{Duration, Instant};

/// Events per layout, and steps of each.
const EVENTS: usize = 10;
const STEPS: usize = 60;

/// Nothing moves, at no computational cost.
struct StaticDynamics;

impl Dynamics for StaticDynamics {
    fn step(&self, _: &mut State, _: [Action; AGENT_COUNT]) {}
}

#[derive(Default)]
struct Total {
    updates: usize,
    first: Duration,
    all: Duration,
    longest: Duration,
    predicting: Duration,
    still: Duration,
    resampled: usize,
    unresolved: usize,
}

fn main() -> Result<(), LayoutError> {
    for base in [0, 7, 20] {
        let mut random = stream(1, Purpose::Scene, base.into());
        let mut total = Total::default();
        for _ in 0..EVENTS {
            event(&any_physique(base, &mut random)?, &mut random, &mut total);
        }
        let per = |spent: Duration, count: usize| spent.as_secs_f64() * 1e6 / count as f64;
        println!("layout {base}, {PARTICLE_COUNT} particles, mean of {} updates:", total.updates);
        println!("  first belief             {:7.1} µs", per(total.first, EVENTS));
        println!("  update                   {:7.1} µs", per(total.all, total.updates));
        println!("  update, longest          {:7.1} µs", per(total.longest, 1));
        println!("  the same dynamics alone  {:7.1} µs", per(total.predicting, total.updates));
        println!("  update without dynamics  {:7.1} µs", per(total.still, total.updates));
        println!(
            "  {:.1} bodies redrawn per update, {} without a place in all",
            total.resampled as f64 / total.updates as f64,
            total.unresolved
        );
    }
    Ok(())
}

/// One event in which both agents act at random, each action being held for a few steps.
fn event(physics: &PhysicsConfig, random: &mut Pcg64Mcg, total: &mut Total) {
    let forward = Forward::new(physics);
    let mut truth = legal_state(physics, random);
    let mut actions = [Action::NoForce; AGENT_COUNT];
    let mut observation = observe(physics, &truth, AgentId::ZERO);
    let start = Instant::now();
    let mut belief = Belief::new(physics, &observation, PARTICLE_COUNT, random);
    total.first += start.elapsed();
    for step in 0..STEPS {
        if step % 4 == 0 {
            actions = core::array::from_fn(|_| Action::ALL[random.random_range(0..Action::ALL.len())]);
        }
        forward.step(&mut truth, actions);
        observation = observe(physics, &truth, AgentId::ZERO);
        total.still += still_update(&belief, physics, &observation, actions[0], random);
        let start = Instant::now();
        for mut particle in belief.particles().iter().copied() {
            forward.step(&mut particle, [actions[0], Action::NoForce]);
            std::hint::black_box(&particle);
        }
        total.predicting += start.elapsed();
        // The minimum of three, so that other programs on the machine do not affect it.
        let before = belief.clone();
        let chance = random.clone();
        let spent = (0..3)
            .map(|_| {
                belief.clone_from(&before);
                random.clone_from(&chance);
                let start = Instant::now();
                belief.update(&forward, physics, actions[0], &observation, random);
                start.elapsed()
            })
            .min()
            .unwrap_or_default();
        total.all += spent;
        total.longest = total.longest.max(spent);
        total.updates += 1;
        total.resampled += belief.resampled();
        total.unresolved += belief.unresolved();
    }
}

/// Time for an update of a copy in which only the observation has a cost.
fn still_update(
    belief: &Belief,
    physics: &PhysicsConfig,
    observation: &Observation,
    action: Action,
    random: &mut Pcg64Mcg,
) -> Duration {
    let mut copy = belief.clone();
    let start = Instant::now();
    copy.update(&StaticDynamics, physics, action, observation, random);
    start.elapsed()
}

fn any_physique(base: u8, random: &mut Pcg64Mcg) -> Result<PhysicsConfig, LayoutError> {
    let mut radius = || Size::ALL[random.random_range(0..Size::ALL.len())].radius();
    Ok(PhysicsConfig {
        walls: Layout::new(base, None)?.walls(),
        agents: [
            AgentBody { radius: radius(), max_force: 450.0 },
            AgentBody { radius: radius(), max_force: 300.0 },
        ],
        object_radii: [radius(), radius()],
        object_count: 2,
    })
}

fn legal_state(physics: &PhysicsConfig, random: &mut Pcg64Mcg) -> State {
    let mut state = State::new([Body::default(); MAX_ENTITIES]);
    let mut outlines: Vec<Outline> = Vec::new();
    while outlines.len() < physics.entity_count() {
        let entity = Entity::ALL[outlines.len()];
        let position = arena::MIN + arena::SIDE * Vec2::new(random.random(), random.random());
        let body = Body::at_rest(position, random.random_range(-3.0..3.0));
        let outline = Outline::of(physics, entity, &body);
        let clear = outline.inside_arena() && !physics.walls.iter().any(|&wall| outline.overlaps_wall(wall));
        if clear && !outlines.iter().any(|other| outline.overlaps(other)) {
            *state.body_mut(entity) = body;
            outlines.push(outline);
        }
    }
    state
}
