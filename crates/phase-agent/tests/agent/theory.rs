//! Beliefs of an agent about another's mind, learnt from its motion.

use phase_agent::{PhaseParameters, TheoryOfMind};
use phase_forward::Forward;
use phase_model::{
    Action, AgentId, Attitude, Awareness, Dynamics, Entity, Goal, Intent, LandmarkId, Level, Scene, Sign,
    State, Strength,
};
use phase_perception::observe;

const WATCHER: AgentId = AgentId::ZERO;
const OTHER: AgentId = AgentId::ONE;
const TOP_RIGHT: Goal =
    Goal::AgentOnLandmark { agent: OTHER, landmark: LandmarkId::TOP_RIGHT, sign: Sign::Positive };

/// A helper of the given level looks at an agent of the strength 450 N, which faces the landmark above it.
fn scene(level: Level) -> Scene {
    let mut scene = Scene::from_json(
        r#"{"layout": {"base": 0}, "event": "helping", "objects": [{"size_level": 0, "start": {"x": 9, "y": 5}}],
            "agents": [
            {"size_level": 0, "strength_level": 2, "alpha": 1, "start": {"x": 10, "y": 9, "angle": -1.57},
             "goal": {"kind": "agent_on_landmark", "agent": 1, "landmark": 1, "sign": 1}},
            {"size_level": 0, "strength_level": 2, "alpha": 0, "start": {"x": 23.5, "y": 6, "angle": 0},
             "goal": {"kind": "agent_on_landmark", "agent": 1, "landmark": 1, "sign": 1}}]}"#,
    )
    .expect("a scene");
    scene.agents[WATCHER].awareness = Awareness::ignorant(level);
    scene
}

/// The theory after some steps in which the other acts like this, with the states in which they ended.
fn watched(scene: &Scene, actions: &[Action]) -> TheoryOfMind<Forward> {
    let physics = scene.physics();
    let forward = Forward::new(&physics);
    let mut state = scene.initial_state();
    let parameters = PhaseParameters { particles: 20, ..PhaseParameters::default() };
    let first = observe(&physics, &state, WATCHER);
    let mut theory =
        TheoryOfMind::new(scene, WATCHER, parameters, first.observed, Forward::new).expect("one");
    for &action in actions {
        let before = vec![state; parameters.particles];
        forward.step(&mut state, [Action::Stop, action]);
        let seen = observe(&physics, &state, WATCHER);
        assert_eq!(theory.learn(&before, Action::Stop, &seen), None, "equal particles stay");
    }
    theory
}

fn probability(theory: &TheoryOfMind<Forward>, holds: impl Fn(Intent, Strength) -> bool) -> f64 {
    theory.weighted().filter(|(it, _)| holds(it.intent, it.strength)).map(|(_, weight)| weight).sum()
}

#[test]
fn who_walks_to_a_landmark_wants_to_be_there_and_shows_its_strength() {
    let theory = watched(&scene(Level::One), &[Action::Up; 6]);
    let prior = probability(&watched(&scene(Level::One), &[]), |intent, _| intent.goal == TOP_RIGHT);
    let goal = probability(&theory, |intent, _| intent.goal == TOP_RIGHT);
    assert!((prior - 0.1).abs() < 1e-9, "four landmarks, the object on four, touching and not: {prior}");
    assert!(goal > 2.0 * prior, "{goal}");
    for landmark in LandmarkId::ALL.into_iter().filter(|&it| it != LandmarkId::TOP_RIGHT) {
        let there = Goal::AgentOnLandmark { agent: OTHER, landmark, sign: Sign::Positive };
        let there = probability(&theory, |intent, _| intent.goal == there);
        assert!(there < 0.6 * goal, "landmark {landmark}: {there}, and {goal} for that which it walks to");
    }
    let strength = probability(&theory, |_, strength| strength == Strength::ALL[2]);
    assert!(strength > 0.9, "{strength}");
    // The particles suppose it as often as it is likely.
    let those = theory.suppositions().iter().filter(|it| it.intent.goal == TOP_RIGHT).count();
    assert!((those as f64 / 20.0 - goal).abs() <= 0.05 + 1e-9, "{those} of 20 for {goal}");
}

#[test]
fn level_0_learns_nothing() {
    let theory = watched(&scene(Level::Zero), &[Action::Up; 6]);
    let weights: Vec<f64> = theory.weighted().map(|(_, weight)| weight).collect();
    assert!(weights.iter().all(|weight| (weight - weights[0]).abs() < 1e-12));
}

#[test]
fn what_is_not_seen_is_not_learnt_and_what_was_learnt_fades() {
    let actions = [Action::Up; 6];
    let mut blind = scene(Level::One);
    blind.agents[WATCHER].start.angle = 1.57;
    let theory = watched(&blind, &actions);
    let weights: Vec<f64> = theory.weighted().map(|(_, weight)| weight).collect();
    assert!(weights.iter().all(|weight| (weight - weights[0]).abs() < 1e-12));

    let scene = scene(Level::One);
    let mut theory = watched(&scene, &actions);
    let certain = probability(&theory, |intent, _| intent.goal == TOP_RIGHT);
    let physics = scene.physics();
    let mut turned: State = scene.initial_state();
    turned.body_mut(Entity::Agent(WATCHER)).angle = 1.57;
    for _ in 0..20 {
        theory.learn(&[turned; 20], Action::Stop, &observe(&physics, &turned, WATCHER));
    }
    let later = probability(&theory, |intent, _| intent.goal == TOP_RIGHT);
    assert!(later < certain && later > 0.1, "{certain} faded to {later}");
}

/// Only an agent that is neutral itself can be helped or hindered: at most one agent is social.
#[test]
fn a_helper_does_not_suppose_to_be_helped() {
    let social = |intent: Intent, _| intent.attitude != Attitude::Neutral;
    let helper = scene(Level::One);
    assert_eq!(probability(&watched(&helper, &[]), social), 0.0);
    let mut helped = helper;
    helped.agents[WATCHER].attitude = Attitude::Neutral;
    let weight = probability(&watched(&helped, &[]), social);
    assert!((weight - 2.0 / 12.0).abs() < 1e-9, "{weight}");
}

#[test]
fn an_agent_that_knows_has_no_theory() {
    let mut scene = scene(Level::One);
    scene.agents[WATCHER].awareness = Awareness::default();
    let observed = observe(&scene.physics(), &scene.initial_state(), WATCHER).observed;
    let theory = TheoryOfMind::new(&scene, WATCHER, PhaseParameters::default(), observed, Forward::new);
    assert!(theory.is_none());
}
