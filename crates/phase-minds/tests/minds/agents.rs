//! Both kinds of minds behind one interface.

#![allow(clippy::unwrap_used, clippy::expect_used)]

use phase_event::ActionEvaluation;
use phase_minds::{
    Agent, BeliefView, Contest, MindKind, MindParameters, PhaseParameters, PublishedParameters, Recorder,
    mind, observe,
};
use phase_model::{
    Action, AgentBody, AgentId, BodySet, Dynamics, Entity, Flip, Layout, Scene, Strength,
    random::{Pcg64Mcg, Purpose, stream},
};

/// An agent that wants the landmark of the next room, and another that it sees; an object behind its back.
fn scene(flip: &str) -> Scene {
    let text = r#"{"layout": {"base": 4, "flip": FLIP}, "event": "independent",
        "objects": [{"size_level": 0, "start": {"x": 14, "y": 4, "angle": 0}}], "agents": [
        {"size_level": 0, "strength_level": 2, "alpha": 0, "start": {"x": 14, "y": 8, "angle": 0},
         "goal": {"kind": "agent_on_landmark", "agent": 0, "landmark": 3, "sign": 1}},
        {"size_level": 0, "strength_level": 2, "alpha": 0, "start": {"x": 20, "y": 8, "angle": 0},
         "goal": {"kind": "agent_on_landmark", "agent": 1, "landmark": 2, "sign": 1}}]}"#;
    Scene::from_json(&text.replace("FLIP", flip)).expect("a scene")
}

fn random(seed: u64) -> Pcg64Mcg {
    stream(seed, Purpose::Search, 0)
}

fn parameters(kind: MindKind) -> MindParameters {
    MindParameters::of(kind).with_particles(10).with_simulations(200)
}

/// Observation in; action, belief and reasons out.
#[test]
fn every_kind_walks_to_its_landmark() {
    for kind in MindKind::ALL {
        let scene = scene("null");
        let forward = phase_forward::Forward::new(&scene.physics());
        let mut state = scene.initial_state();
        let mut random = random(1);
        let first = observe(kind, &scene.physics(), &state, AgentId::ZERO);
        let mut agent = Agent::new(&scene, &parameters(kind), &first, None, &mut random).unwrap();
        let goal = scene.goals()[0];
        let before = goal.distance(&state);
        for _ in 0..14 {
            assert_eq!(agent.belief().particles().len(), 10);
            for particle in agent.belief().particles() {
                let me = Entity::Agent(AgentId::ZERO);
                assert_eq!(particle.body(me), state.body(me));
            }
            let (action, thought) = agent.decide(&mut random).unwrap();
            assert_eq!(thought.subgoals.iter().map(|proposed| proposed.particles).sum::<usize>(), 10);
            forward.step(&mut state, [action, Action::Stop]);
            let observation = agent.observe(&state);
            agent.perceive(action, &observation, &[], &mut random);
        }
        let after = goal.distance(&state);
        assert!(after < 0.5 * before, "{}: {before} u, then {after} u", kind.name());
    }
}

/// A copy with copies of the generator believes, decides and explains as the original.
#[test]
fn a_copy_decides_as_the_original() {
    for kind in MindKind::ALL {
        let scene = scene("null");
        let forward = phase_forward::Forward::new(&scene.physics());
        let mut state = scene.initial_state();
        let mut random = random(1);
        let first = observe(kind, &scene.physics(), &state, AgentId::ZERO);
        let mut agent = Agent::new(&scene, &parameters(kind), &first, Some(&state), &mut random).unwrap();
        for _ in 0..6 {
            let (mut copy, mut its_random) = (agent.clone(), random.clone());
            let decided = agent.decide(&mut random).unwrap();
            assert_eq!(copy.decide(&mut its_random).unwrap(), decided, "{}", kind.name());
            let substeps = forward.step_substeps(&mut state, [decided.0, Action::Up]);
            let observation = agent.observe(&state);
            agent.perceive(decided.0, &observation, &substeps, &mut random);
            copy.perceive(decided.0, &observation, &substeps, &mut its_random);
            assert_eq!(copy.belief().particles(), agent.belief().particles());
            assert_eq!(copy.stream_position(), agent.stream_position());
        }
    }
}

#[test]
fn one_way_turns_go_left_and_in_reflections_right() {
    let layout = Layout::new(4, None).unwrap();
    let weak = AgentBody { radius: 0.8, max_force: Strength::Strong.max_force() };
    let recorder = Recorder { one_way_turns: true, ..Recorder::default() };
    for action in Action::ALL {
        assert_eq!(Recorder::default().carried_out(action, &weak, layout), action);
        for layout in [layout, layout.flipped(Flip::UpDown)] {
            let done = recorder.carried_out(action, &weak, layout);
            let turn = if layout.flip().is_some() { Action::TurnRight } else { Action::TurnLeft };
            assert_eq!(done, if action.turn() == 0.0 { action } else { turn });
        }
    }
}

/// `stop` has no effect on the strongest, in the recorder alone.
#[test]
fn the_strongest_coast() {
    let layout = Layout::new(4, None).unwrap();
    for strength in Strength::ALL {
        let body = AgentBody { radius: 0.8, max_force: strength.max_force() };
        let coasts = strength == Strength::Mighty;
        let done = Recorder::PUBLISHED.carried_out(Action::Stop, &body, layout);
        assert_eq!(done, if coasts { Action::NoForce } else { Action::Stop });
        assert_eq!(Recorder::default().carried_out(Action::Stop, &body, layout), Action::Stop);
    }
}

/// An agent's evaluation of its actions, at 5 u and on its way up, with a huge object at some height (u).
fn evaluations(kind: MindKind, collisions: bool, height: f32) -> Vec<ActionEvaluation> {
    let text = r#"{"layout": {"base": 0, "flip": null}, "event": "independent",
        "objects": [{"size_level": 3, "start": {"x": 8.5, "y": HEIGHT, "angle": 0}}], "agents": [
        {"size_level": 0, "strength_level": 2, "alpha": 0, "start": {"x": 8.5, "y": 5, "angle": 0},
         "goal": {"kind": "agent_on_landmark", "agent": 0, "landmark": 0, "sign": 1}},
        {"size_level": 0, "strength_level": 2, "alpha": 0, "start": {"x": 23, "y": 5, "angle": 0},
         "goal": {"kind": "agent_on_landmark", "agent": 1, "landmark": 2, "sign": 1}}]}"#;
    let scene = Scene::from_json(&text.replace("HEIGHT", &height.to_string())).expect("a scene");
    let particles = [scene.initial_state()];
    let mut observed = BodySet::OBJECTS;
    AgentId::ALL.into_iter().for_each(|agent| observed.insert(Entity::Agent(agent)));
    let belief = BeliefView {
        particles: &particles,
        observed,
        last_action: None,
        suppositions: &[],
        contest: Contest::default(),
    };
    // Few steps, in which only what is near can be reached.
    let parameters: MindParameters = match kind {
        MindKind::Phase => {
            PhaseParameters { simulations: 10, rollout_steps: 2, ..PhaseParameters::default() }.into()
        }
        MindKind::Published => {
            PublishedParameters { simulations: 10, rollout_steps: 2, ..PublishedParameters::default() }.into()
        }
    };
    let parameters = if collisions { parameters } else { parameters.without_collisions() };
    assert_eq!(parameters.foresees_collisions(), collisions);
    let mut mind = mind(&scene, AgentId::ZERO, &parameters).expect("a mind");
    mind.decide(belief, &mut random(1)).expect("a decision").1.actions
}

#[test]
fn a_search_without_collisions_disregards_bodies_in_the_way_and_nothing_else() {
    for kind in MindKind::ALL {
        let same = |height| {
            let [solid, points] = [true, false].map(|collisions| evaluations(kind, collisions, height));
            assert!(!solid.is_empty());
            solid == points
        };
        assert!(!same(8.0), "{}: a body is in the way", kind.name());
        assert!(same(20.0), "{}: nothing is in the way", kind.name());
    }
}
