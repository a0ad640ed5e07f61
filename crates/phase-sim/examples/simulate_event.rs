//! Two minds play a scene of helping: what each of them tries to do, and where it is.
//!
//! `cargo run --release --package phase-sim --example simulate_event`

use phase_minds::MindParameters;
use phase_model::{AgentId, Entity};
use phase_sim::{SimulationSettings, simulate};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let scene = phase_sampler::sample_named(Some("helping"), None, 1)?;
    // Less search than by default, to be quick.
    let minds = MindParameters::default().with_particles(10).with_simulations(100);
    let settings = SimulationSettings { max_steps: 12, minds, ..SimulationSettings::default() };
    let event = simulate(&scene, 1, &settings)?;

    println!("kind: {}, relation: {}", scene.kind.name(), scene.relation().name());
    for (k, step) in event.steps.iter().enumerate() {
        for agent in [AgentId::ZERO, AgentId::ONE] {
            let place = step.substeps[step.substeps.len() - 1].position(Entity::Agent(agent));
            let action = step.actions[agent].name();
            let subgoal = step.thoughts[agent].subgoal;
            println!(
                "step {k:2}: agent {agent} at ({:4.1}, {:4.1}) u tries {subgoal}: {action}",
                place.x, place.y
            );
        }
    }
    assert_eq!(event.steps.len(), settings.max_steps);
    Ok(())
}

#[test]
fn it_runs() {
    main().expect("an event");
}
