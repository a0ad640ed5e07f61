//! The way of an agent to a landmark in another room, as subgoals: the planner alone, without physics or
//! search.
//!
//! `cargo run --release --package phase-planner --example plan_alone`

use phase_model::{
    AgentBody, AgentId, Attitude, Body, BodySet, Goal, LandmarkId, Layout, LayoutError, PhysicsConfig, Sign,
    State, Vec2,
};
use phase_planner::Planner;

fn main() -> Result<(), LayoutError> {
    let layout = Layout::new(2, None)?;
    let body = AgentBody { radius: 0.8, max_force: 450.0 };
    let physics =
        PhysicsConfig { walls: layout.walls(), agents: [body; 2], object_radii: [0.0; 2], object_count: 0 };
    let places = [Vec2::new(8.0, 18.0), Vec2::new(24.0, 8.0), Vec2::ZERO, Vec2::ZERO];
    let state = State::new(places.map(|place| Body::at_rest(place, 0.0)));
    let goals = [(AgentId::ZERO, LandmarkId::TOP_RIGHT), (AgentId::ONE, LandmarkId::TOP_LEFT)]
        .map(|(agent, landmark)| Goal::AgentOnLandmark { agent, landmark, sign: Sign::Positive });

    let planner = Planner::new(physics, layout, AgentId::ZERO, goals, Attitude::Neutral);
    let plan = planner.plan(&state, BodySet::EMPTY);
    println!("Agent 0 wants to be on landmark 1, {:.1} u away on its way:", plan.distance);
    for (k, subgoal) in plan.subgoals.iter().enumerate() {
        println!("{}. {subgoal}", k + 1);
    }
    assert_eq!(plan.subgoals.last().map(ToString::to_string).as_deref(), Some("On(agent 0, landmark 1)"));
    Ok(())
}

#[test]
fn it_runs() {
    main().expect("a layout");
}
