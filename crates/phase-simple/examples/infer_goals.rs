//! SIMPLE watches a body move: which goals explain it?
//!
//! `cargo run --release --package phase-simple --example infer_goals`

use phase_event::ObservedEvent;
use phase_model::{AgentId, Body, Goal, LandmarkId, Layout, Size, Vec2};
use phase_simple::{InferenceSettings, UniformStrength, explain};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // Agent 0 moves up along the right wall, 1 u a step; agent 1 rests.
    let rows = (0..=8_u8).map(|step| {
        let places = [Vec2::new(23.5, 6.0 + f32::from(step)), Vec2::new(8.5, 19.5), Vec2::ZERO, Vec2::ZERO];
        let mut row = places.map(|place| Body::at_rest(place, 0.0));
        row[0].velocity = Vec2::new(0.0, 12.0);
        row
    });
    let observed = ObservedEvent::new(Layout::new(0, None)?, [Size::Small; 2], Vec::new(), rows.collect())?;

    // Less search than by default, to be quick.
    let mut settings = InferenceSettings::default();
    settings.agents.minds = settings.agents.minds.with_particles(5).with_simulations(20);
    let posterior = explain(&observed, &UniformStrength, 1, &settings)?.posterior;
    println!("What agent 0 may want:");
    for (goal, probability) in posterior.goals(AgentId::ZERO).into_iter().take(3) {
        println!("{:3.0} %  {goal:?}", 100.0 * probability);
    }
    println!("The relation: {:?}", posterior.relation());
    let likeliest = posterior.goals(AgentId::ZERO)[0].0;
    assert!(matches!(likeliest, Goal::AgentOnLandmark { landmark: LandmarkId::TOP_RIGHT, .. }));
    Ok(())
}

#[test]
fn it_runs() {
    main().expect("an inference");
}
