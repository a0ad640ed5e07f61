//! Draws one decision of a mind into the .svg file given as argument: the picture in `docs/images`.

mod drawing;

use drawing::Drawing;
use phase_agent::{
    BeliefView, Contest, Mind, PhaseParameters,
    objective::Objective,
    search_model::{SearchModel, SearchState},
};
use phase_belief::Belief;
use phase_forward::Forward;
use phase_model::{
    Action, AgentId, Entity, Literal, ObjectId, Scene, State, Subgoal, Vec2, arena,
    random::{Purpose, stream},
};
use phase_navigation::Navigator;
use phase_perception::observe;
use phase_planner::{Plan, Planner, value};
use phase_pomcp::GenerativeModel;
use std::error::Error;

/// Agent 0 wants the object, which it does not see, on landmark 1; agent 1 is on the way.
const SCENE: &str = r#"{"layout": {"base": 16}, "event": "independent",
    "objects": [{"size_level": 0, "start": {"x": 23, "y": 8, "angle": 0}}],
    "agents": [
        {"size_level": 0, "strength_level": 2, "alpha": 0, "start": {"x": 13.5, "y": 18.5, "angle": 2.6},
         "goal": {"kind": "object_on_landmark", "object": 0, "landmark": 1, "sign": 1}},
        {"size_level": 0, "strength_level": 2, "alpha": 0, "start": {"x": 9.8, "y": 14.2, "angle": 0},
         "goal": {"kind": "agent_on_landmark", "agent": 1, "landmark": 0, "sign": 1}}]}"#;
/// Velocity of agent 0 (u/s).
const VELOCITY: Vec2 = Vec2::new(-3.0, -5.0);
const ME: AgentId = AgentId::ZERO;
/// Step of the way that is drawn (u), and the number of its steps.
const STEP: f32 = 0.25;
const STEPS: usize = 200;
/// Colours of the subgoals.
const COLOURS: [&str; 5] = ["#d55e00", "#0072b2", "#009e73", "#cc79a7", "#8a6d00"];

fn main() -> Result<(), Box<dyn Error>> {
    let path = std::env::args().nth(1).ok_or("usage: decision FILE.svg")?;
    let scene = Scene::from_json(SCENE)?;
    let physics = scene.physics();
    let parameters = PhaseParameters::default();
    let forward = Forward::new(&physics);
    let mut state = scene.initial_state();
    state.bodies[Entity::Agent(ME).index()].velocity = VELOCITY;
    let observation = observe(&physics, &state, ME);
    let mut random = stream(1, Purpose::Search, 0);
    let belief = Belief::new(&physics, &observation, parameters.particles, &mut random);
    let particles = belief.particles();

    let planner = Planner::new(physics.clone(), scene.layout, ME, scene.goals(), scene.agents[ME].attitude);
    let plans: Vec<Plan> =
        particles.iter().map(|particle| planner.plan(particle, observation.observed)).collect();
    let candidates = value::candidates(&plans.iter().collect::<Vec<_>>(), parameters.lambda);
    let best = candidates.first().ok_or("no subgoal")?;
    let root = particles[best.particles[0]];

    let last_action = Some(Action::Up);
    let view = BeliefView {
        particles,
        observed: observation.observed,
        last_action,
        suppositions: &[],
        contest: Contest::default(),
    };
    let (action, thought) = Mind::new(&scene, ME, forward.clone(), parameters)?.decide(view, &mut random)?;

    let costs = parameters.navigation();
    let mut navigator = Navigator::new(scene.layout, costs);
    let objective = Objective::new(&physics, &mut navigator, &root, ME, best.subgoal, &parameters);
    let others = Subgoal::Achieve(Literal::from(scene.goals()[AgentId::ONE]));
    let other_objective = Objective::new(&physics, &mut navigator, &root, ME.other(), others, &parameters);
    let actions: Vec<Action> = thought.actions.iter().map(|found| found.action).collect();
    let model = SearchModel {
        dynamics: &forward,
        objective: objective.clone(),
        physics: &physics,
        other_objective,
        actions: &actions,
        goals: scene.goals(),
        rewards_goals: true,
        attitude: scene.agents[ME].attitude,
        scrutiny: None,
        root_prior: Vec::new(),
    };
    let mut priors = Vec::new();
    model.prior_weights(&SearchState::new(&objective, root, last_action), &mut priors);

    let mut drawing = Drawing::new(&physics);
    drawing.panel(0, "1  Particles, each with a plan");
    drawing.walls();
    for (k, candidate) in candidates.iter().enumerate() {
        let colour = COLOURS[k % COLOURS.len()];
        for &particle in &candidate.particles {
            drawing.body(&particles[particle], Entity::Object(ObjectId::ZERO), colour, 0.35);
        }
        let share = candidate.particles.len() as f64 / particles.len() as f64;
        let text = format!("{}:  share {share:.2},  V {:.2}", candidate.subgoal, candidate.value);
        drawing.line(k, colour, &text.replace('-', "−"));
    }
    drawing.agents(&state);

    let distance = |point: Vec2| objective.distance(&moved(&root, point));
    drawing.panel(1, "2  Φ, the distance to go of the best subgoal");
    drawing.contours(distance);
    drawing.walls();
    drawing.way(&way(&objective, &root));
    drawing.agents(&state);
    drawing.line(0, COLOURS[0], &best.subgoal.to_string());
    drawing.line(1, "#333", &format!("Φ = {:.1} u here; a contour every 2 u", objective.distance(&root)));

    drawing.panel(2, "3  Search: prior (grey), visits (blue)");
    let total: f64 = priors.iter().sum();
    let visits: u32 = thought.actions.iter().map(|found| found.visits).sum();
    for (k, (found, prior)) in thought.actions.iter().zip(&priors).enumerate() {
        let share = f64::from(found.visits) / f64::from(visits);
        drawing.bars(k, found.action.name(), prior / total, share);
    }
    drawing.line(0, "#333", &format!("{visits} simulations; the action: {}", action.name()));
    drawing.line(1, "#333", "the action before: up");
    Ok(std::fs::write(path, drawing.finish())?)
}

/// A state with agent 0 elsewhere.
fn moved(state: &State, point: Vec2) -> State {
    let mut moved = *state;
    moved.bodies[Entity::Agent(ME).index()].position = point;
    moved
}

/// The way that the heuristic follows.
fn way(objective: &Objective<'_>, root: &State) -> Vec<Vec2> {
    let mut here = root.position(Entity::Agent(ME));
    let mut points = vec![here];
    for _ in 0..STEPS {
        let ahead = objective.motion(&moved(root, here)).waypoint - here;
        if ahead.length() < STEP || !arena::contains(here) {
            break;
        }
        here += ahead.normalize() * STEP;
        points.push(here);
    }
    points
}
