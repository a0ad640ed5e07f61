//! Perception, belief updates, planning and decisions, a whole event, and the cost of decisions as a function
//! of settings; with a reference workload by which the machine's noise can be estimated.

use core::hint::black_box;
use criterion::{BatchSize, BenchmarkId, Criterion, SamplingMode};
use phase_agent::{Mind, PolicyNetwork};
use phase_belief::Belief;
use phase_forward::Forward;
use phase_minds::{Agent, BeliefView, Contest, MindKind, PhaseParameters, Prior, PublishedParameters};
use phase_model::{
    Action, AgentId, EventKind, Scene,
    random::{Purpose, stream},
};
use phase_perception::{field_of_view, observe, observed_set};
use phase_planner::Planner;

fn scene() -> Scene {
    phase_sampler::sample_kind(EventKind::Helping, &mut stream(1, Purpose::Scene, 0))
        .expect("a helping scene")
}

fn main() {
    let mut criterion = Criterion::default().configure_from_args();
    let scene = scene();
    let physics = scene.physics();
    let state = scene.initial_state();
    let observation = observe(&physics, &state, AgentId::ZERO);
    let forward = || Forward::new(&physics);

    let numbers: Vec<f64> = (0..10_000).map(f64::from).collect();
    criterion.bench_function("yardstick/sum of 10 000 square roots", |bencher| {
        bencher.iter(|| black_box(&numbers).iter().map(|number| number.sqrt()).sum::<f64>());
    });
    criterion.bench_function("perception/field of view", |bencher| {
        bencher.iter(|| field_of_view(&physics, black_box(&state), AgentId::ZERO));
    });
    criterion.bench_function("perception/observed set", |bencher| {
        bencher.iter(|| observed_set(&physics, black_box(&state), AgentId::ZERO));
    });
    criterion.bench_function("perception/one observation", |bencher| {
        bencher.iter(|| observe(&physics, black_box(&state), AgentId::ZERO));
    });
    criterion.bench_function("belief/update of 50 particles", |bencher| {
        let dynamics = forward();
        let mut random = stream(1, Purpose::Belief, 0);
        let mut belief = Belief::new(&physics, &observation, 50, &mut random);
        bencher.iter(|| belief.update(&dynamics, &physics, Action::NoForce, &observation, &mut random));
    });
    criterion.bench_function("belief/update of 50 particles, nobody observed", |bencher| {
        let dynamics = forward();
        let mut random = stream(1, Purpose::Belief, 0);
        // Rotated until it observes no other entity.
        let mut turned = (0..64).map(|k| {
            let mut turned = state;
            turned.bodies[0].angle = 0.1 * k as f32;
            observe(&physics, &turned, AgentId::ZERO)
        });
        let others = || physics.entities().skip(1);
        let blind = turned
            .find(|seen| others().all(|other| seen.body(other).is_none()))
            .expect("some direction in which there is nobody");
        let mut belief = Belief::new(&physics, &blind, 50, &mut random);
        bencher.iter(|| belief.update(&dynamics, &physics, Action::NoForce, &blind, &mut random));
    });
    criterion.bench_function("planner/one plan", |bencher| {
        let planner =
            Planner::new(physics.clone(), scene.layout, AgentId::ZERO, scene.goals(), scene.attitudes()[0]);
        bencher.iter(|| planner.plan(black_box(&state), observation.observed));
    });
    criterion.bench_function("planner/plans of 50 particles that differ", |bencher| {
        let planner =
            Planner::new(physics.clone(), scene.layout, AgentId::ZERO, scene.goals(), scene.attitudes()[0]);
        let mut random = stream(1, Purpose::Belief, 0);
        let mut turned = state;
        // Turned away from every other entity, so that every particle has them elsewhere.
        turned.bodies[0].angle += core::f32::consts::PI;
        let blind = observe(&physics, &turned, AgentId::ZERO);
        let belief = Belief::new(&physics, &blind, 50, &mut random);
        bencher.iter(|| {
            let plans: Vec<_> =
                belief.particles().iter().map(|particle| planner.plan(particle, blind.observed)).collect();
            plans
        });
    });
    criterion.bench_function("agent/one decision at the paper's settings", |bencher| {
        let mut random = stream(1, Purpose::Belief, 0);
        let parameters = PhaseParameters::default().into();
        let mut agent =
            Agent::new(&scene, &parameters, &observation, None, &mut random).expect("good parameters");
        let mut search = stream(1, Purpose::Search, 0);
        bencher.iter(|| agent.decide(&mut search));
    });
    criterion.bench_function("agent/the policy network, given its features", |bencher| {
        let mut mind =
            Mind::new(&scene, AgentId::ZERO, forward(), PhaseParameters::default()).expect("good parameters");
        let belief = BeliefView {
            particles: &[state],
            suppositions: &[],
            observed: observation.observed,
            last_action: None,
            contest: Contest::default(),
        };
        let considered = mind.consider(belief).expect("something to choose");
        bencher
            .iter(|| PolicyNetwork::bundled().evaluate(black_box(&considered.features), considered.actions));
    });
    for (name, prior, simulations) in [
        ("without a search", Prior::NetworkAlone, 1000),
        ("with a search of 50 simulations", Prior::Network, 50),
    ] {
        criterion.bench_function(&format!("agent/one decision by the network {name}"), |bencher| {
            let mut random = stream(1, Purpose::Belief, 0);
            let parameters = PhaseParameters { prior, simulations, ..PhaseParameters::default() }.into();
            let mut agent =
                Agent::new(&scene, &parameters, &observation, None, &mut random).expect("good parameters");
            let mut search = stream(1, Purpose::Search, 0);
            bencher.iter(|| agent.decide(&mut search));
        });
    }
    let recorded = PublishedParameters::default();
    for (name, parameters) in [
        ("with a search of 1000 simulations", recorded),
        ("with two of 100", PublishedParameters { simulations: 100, searches: 2, ..recorded }),
        ("by the network", PublishedParameters { network_alone: true, ..recorded }),
    ] {
        criterion.bench_function(&format!("published/one decision {name}"), |bencher| {
            let mut random = stream(1, Purpose::Belief, 0);
            let mut search = stream(1, Purpose::Search, 0);
            let parameters = parameters.into();
            // Minds remember what they imagined in a state, so that every decision is in another one.
            let mut places = (0..1000_u16).map(|k| f32::from(k) * 1e-4).cycle();
            let elsewhere = || {
                let mut moved = state;
                moved.bodies[0].position.x += places.next().unwrap_or_default();
                let seen = phase_minds::observe(MindKind::Published, &physics, &moved, AgentId::ZERO);
                Agent::new(&scene, &parameters, &seen, Some(&moved), &mut random).expect("good parameters")
            };
            bencher.iter_batched(elsewhere, |mut agent| agent.decide(&mut search), BatchSize::SmallInput);
        });
    }
    scaling(&mut criterion, &scene);
    whole_events(&mut criterion);
    criterion.final_summary();
}

/// One decision and one belief update, one setting varied at a time, the others as in the paper unless
/// stated.
fn scaling(criterion: &mut Criterion, scene: &Scene) {
    let physics = scene.physics();
    let state = scene.initial_state();
    let observation = observe(&physics, &state, AgentId::ZERO);
    let paper = PhaseParameters::default();
    let with_simulations = |simulations| (simulations, PhaseParameters { simulations, ..paper });
    // One simulation, since the search does not grow with the number of particles, but the subgoal that they
    // agree on may change.
    let with_particles = |particles| (particles, PhaseParameters { particles, simulations: 1, ..paper });
    let with_rollout = |rollout_steps| (rollout_steps, PhaseParameters { rollout_steps, ..paper });
    for (name, settings) in [
        ("simulations", [250, 500, 1000, 2000].map(with_simulations).to_vec()),
        ("particles, one simulation", [25, 50, 100, 200].map(with_particles).to_vec()),
        ("rollout steps", [5, 10, 20].map(with_rollout).to_vec()),
    ] {
        let mut group = criterion.benchmark_group(format!("scaling/{name}"));
        for (count, settings) in settings {
            let mut random = stream(1, Purpose::Belief, 0);
            let mut search = stream(1, Purpose::Search, 0);
            let mut agent = Agent::new(scene, &settings.into(), &observation, None, &mut random)
                .expect("good parameters");
            group.bench_function(BenchmarkId::from_parameter(count), |bencher| {
                bencher.iter(|| {
                    let decision = agent.decide(&mut search);
                    // Nothing moves, so that every round decides on the same state.
                    agent.perceive(Action::NoForce, &observation, &[], &mut random);
                    decision
                });
            });
        }
        group.finish();
    }
}

/// The sampler's first scene of each kind at the paper's settings, forced to last exactly 100 steps.
fn whole_events(criterion: &mut Criterion) {
    let settings = phase_sim::SimulationSettings {
        min_steps: 100,
        max_steps: 100,
        ..phase_sim::SimulationSettings::default()
    };
    let mut group = criterion.benchmark_group("event");
    group.sample_size(10).sampling_mode(SamplingMode::Flat);
    for kind in EventKind::ALL {
        let scene = phase_sampler::sample_kind(kind, &mut stream(1, Purpose::Scene, 0))
            .expect("a scene of every kind");
        group.bench_function(format!("100 steps, {}, seed 1", kind.name()), |bencher| {
            bencher.iter(|| phase_sim::simulate(&scene, 1, &settings));
        });
    }
    group.finish();
}
