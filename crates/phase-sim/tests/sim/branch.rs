//! A branch of a simulation has the same past and a future of its own.

use phase_minds::MindParameters;
use phase_model::AgentId;
use phase_sim::{Simulation, SimulationSettings};

const STEPS: usize = 12;

fn simulation(seed: u64) -> Simulation {
    let scene = phase_sampler::sample_named(Some("competing"), None, 3).expect("a scene");
    let minds = MindParameters::default().with_simulations(60);
    let settings = SimulationSettings { max_steps: 100, minds, ..SimulationSettings::default() };
    Simulation::new(&scene, seed, &settings).expect("a simulation")
}

fn go_on(simulation: &mut Simulation) -> String {
    for _ in 0..STEPS {
        simulation.step([None, None]).expect("a step");
    }
    let particles = AgentId::ALL.map(|agent| simulation.particles(agent).to_vec());
    format!("{:?} {particles:?}", simulation.event().steps)
}

#[test]
fn a_branch_begins_where_it_leaves_and_depends_on_its_seed_alone() {
    let mut original = simulation(1);
    go_on(&mut original);
    let branches = [original.branch(5), original.branch(5), original.branch(6)];
    for branch in &branches {
        assert_eq!(branch.state(), original.state());
        assert_eq!(branch.event().steps, original.event().steps);
        for agent in AgentId::ALL {
            assert_eq!(branch.particles(agent), original.particles(agent));
        }
    }
    let [one, same, other] = branches.map(|mut branch| go_on(&mut branch));
    assert_eq!(one, same);
    assert_ne!(one, other);
    let undisturbed = go_on(&mut original);
    assert_ne!(one, undisturbed);
    let mut whole = simulation(1);
    go_on(&mut whole);
    assert_eq!(undisturbed, go_on(&mut whole), "a branch leaves its original as it was");
}

#[test]
fn a_branch_forgets_what_was_decided_ahead() {
    let mut original = simulation(2);
    go_on(&mut original);
    let plain = go_on(&mut original.branch(5));
    original.decide_ahead(AgentId::ONE).expect("a decision");
    assert_eq!(go_on(&mut original.branch(5)), plain);
}
