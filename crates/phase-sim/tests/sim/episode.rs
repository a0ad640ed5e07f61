//! Minds that play from outside make the simulated event, and rewards are those of Equation 1.

use phase_minds::{Agent, MindParameters};
use phase_model::{
    Action, AgentId, Entity, Scene, Vec2, arena,
    random::{Purpose, stream},
};
use phase_sim::{Engine, Episode, SimulationSettings, View, simulate, vector};
use serde_json::{Value, json};

/// Agent 0 is on the landmark that it wants to be on. Agent 1, elsewhere, helps it, hinders it, or wants to
/// be there, too.
fn scene(alpha: i8) -> Scene {
    let subject = usize::from(alpha == 0);
    let sign = if alpha < 0 { -1 } else { 1 };
    let agent = |alpha: i8, place: Vec2, goal: Value| {
        let start = json!({ "x": place.x, "y": place.y, "angle": 0 });
        json!({ "size_level": 0, "strength_level": 2, "alpha": alpha, "start": start, "goal": goal })
    };
    let goal = |subject: usize, sign: i8| {
        let kind = "agent_on_landmark";
        json!({ "kind": kind, "agent": subject, "landmark": 0, "sign": sign })
    };
    let agents =
        [agent(0, arena::LANDMARKS[0], goal(0, 1)), agent(alpha, Vec2::new(23.5, 8.0), goal(subject, sign))];
    let scene = json!({ "layout": { "base": 0 }, "objects": [], "event": "independent", "agents": agents });
    Scene::from_json(&scene.to_string()).expect("the scene is valid")
}

#[test]
fn rewards_are_those_of_equation_1() {
    for (alpha, expected) in [(0, 0.0), (1, 1.0), (-1, -1.0)] {
        let episode = Episode::new(&scene(alpha), Engine::World);
        assert_eq!(episode.achieved(), [true, alpha == 1]);
        for action in Action::ALL {
            let cost = match action {
                Action::Down
                | Action::Left
                | Action::Right
                | Action::UpLeft
                | Action::UpRight
                | Action::DownLeft
                | Action::DownRight => 0.02,
                _ => 0.0,
            };
            assert_eq!(episode.rewards([Action::Stop, action]), [1.0, expected - cost], "{action:?}");
            assert_eq!(episode.rewards([action, Action::Stop]), [1.0 - cost, expected], "{action:?}");
        }
    }
}

#[test]
fn views_differ_in_what_is_hidden() {
    let episode = Episode::new(&scene(0), Engine::World);
    let own = episode.observe(AgentId::ZERO, View::Own);
    let everything = episode.observe(AgentId::ZERO, View::Everything);
    assert!(own.visible.iter().count() < 400);
    assert_eq!(everything.visible.iter().count(), 400);
    for agent in AgentId::ALL {
        let entity = Entity::Agent(agent);
        assert_eq!(everything.body(entity), Some(episode.state().body(entity)));
    }
    assert_eq!(everything.touched, own.touched);
    assert_eq!(episode.substeps(), &[scene(0).initial_state(); arena::SUBSTEPS]);
}

/// Nothing is lost in vectors: minds that read them play the event that `simulate` makes.
#[test]
fn minds_that_read_vectors_play_the_simulated_event() {
    let scene = phase_sampler::sample_named(Some("helping"), None, 1).unwrap();
    let minds = MindParameters::default().with_particles(10).with_simulations(40);
    for engine in Engine::ALL {
        let settings = SimulationSettings { engine, max_steps: 8, minds, ..SimulationSettings::default() };
        let event = simulate(&scene, 3, &settings).unwrap();
        let mut episode = Episode::new(&scene, engine);
        let mut numbers = [0.0; vector::SIZE];
        let mut streams = AgentId::ALL.map(|agent| {
            let number = agent.number().into();
            [stream(3, Purpose::Belief, number), stream(3, Purpose::Search, number)]
        });
        let mut agents: [Option<Agent>; 2] = [None, None];
        let mut last = [Action::Stop; 2];
        for step in &event.steps {
            let mut actions = [Action::Stop; 2];
            for (k, agent) in AgentId::ALL.into_iter().enumerate() {
                episode.write_observation(agent, View::Own, &mut numbers);
                let seen = vector::read(agent, &numbers).unwrap();
                let [belief, search] = &mut streams[k];
                match &mut agents[k] {
                    Some(mind) => mind.perceive(last[k], &seen, &[], belief),
                    none => *none = Some(Agent::new(&scene, &minds, &seen, None, belief).unwrap()),
                }
                let mind = agents[k].as_mut().unwrap();
                actions[k] = mind.decide(search).unwrap().0;
            }
            assert_eq!(actions, step.actions);
            episode.step(actions);
            assert_eq!(episode.substeps(), &step.substeps);
            last = actions;
        }
        assert_eq!(event.steps.len(), 8);
    }
}
