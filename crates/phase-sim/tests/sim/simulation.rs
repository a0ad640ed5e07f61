//! One seed, one event; and beliefs that can be recomputed.

use core::ops::ControlFlow;
use phase_event::Thought;
use phase_forward::Forward;
use phase_minds::{MindKind, MindParameters};
use phase_model::{
    Action, AgentId, Attitude, Awareness, Entity, EventKind, Level, Scene, Sight, Vec2,
    random::{Purpose, stream},
};
use phase_perception::observe;
use phase_sim::{Engine, Simulation, SimulationError, SimulationSettings, beliefs, simulate, simulate_with};

fn scene(kind: EventKind) -> Scene {
    phase_sampler::sample_kind(kind, &mut stream(5, Purpose::Scene, 0)).expect("a scene of every kind")
}

/// Small searches and short events, so that a test takes a moment.
fn quick() -> SimulationSettings {
    let mut settings = SimulationSettings { max_steps: 12, min_steps: 4, ..SimulationSettings::default() };
    settings.minds = settings.minds.with_particles(10);
    settings.minds = settings.minds.with_simulations(40);
    settings
}

#[test]
fn one_seed_makes_one_event_on_any_thread() {
    for kind in [EventKind::Helping, EventKind::Chasing] {
        let scene = scene(kind);
        let first = simulate(&scene, 11, &quick()).unwrap();
        let others: Vec<_> = std::thread::scope(|scope| {
            let threads: Vec<_> =
                (0..3).map(|_| scope.spawn(|| simulate(&scene, 11, &quick()).unwrap())).collect();
            threads.into_iter().map(|thread| thread.join().unwrap()).collect()
        });
        for other in others {
            // `PartialEq` considers 0 and −0 equal; the text does not.
            assert_eq!(format!("{first:?}"), format!("{other:?}"));
        }
        let different = simulate(&scene, 12, &quick()).unwrap();
        assert_ne!(format!("{first:?}"), format!("{different:?}"));
    }
}

#[test]
fn engines_repeat_themselves_and_differ() {
    for kind in [EventKind::Chasing, EventKind::Hindering] {
        let scene = scene(kind);
        let [world, forward, original] = Engine::ALL.map(|engine| {
            let settings = SimulationSettings { engine, ..quick() };
            let [first, again] = [0, 1].map(|_| simulate(&scene, 3, &settings).unwrap());
            assert_eq!(format!("{first:?}"), format!("{again:?}"), "{engine:?}");
            first
        });
        assert_eq!(world.initial, forward.initial);
        assert_ne!(world.steps, forward.steps);
        assert_ne!(forward.steps, original.steps);
        // Before the first step, agents do not know which engine simulates the event.
        assert_eq!(world.steps[0].actions, forward.steps[0].actions);
    }
}

/// In the kernel, replaying an event's own actions with the cache reproduces it.
#[test]
fn events_of_the_kernel_are_replays_of_it() {
    let scene = scene(EventKind::Collaborating);
    let event = simulate(&scene, 4, &SimulationSettings { engine: Engine::Forward, ..quick() }).unwrap();
    let forward = Forward::new(&scene.physics());
    let mut state = event.initial;
    let mut cache = forward.fresh_cache(&event.initial);
    for step in &event.steps {
        assert_eq!(forward.step_warm(&mut state, &mut cache, step.actions), step.substeps);
    }
}

#[test]
fn settings_can_be_written_and_read_and_name_engine_and_kind_of_minds() {
    for (engine, kind) in [(Engine::World, MindKind::Phase), (Engine::Forward, MindKind::Published)] {
        let given = SimulationSettings { engine, minds: MindParameters::of(kind), ..quick() };
        let written = serde_json::to_value(given).unwrap();
        assert_eq!(
            (&written["engine"], &written["minds"]["kind"]),
            (&engine.name().into(), &kind.name().into())
        );
        assert_eq!(serde_json::from_value::<SimulationSettings>(written.clone()).unwrap(), given);
        for name in ["engine", "still_steps", "one_way_turns", "minds"] {
            let mut part = written.clone();
            part.as_object_mut().unwrap().remove(name);
            let refused = serde_json::from_value::<SimulationSettings>(part).unwrap_err().to_string();
            assert!(refused.contains(&format!("missing field `{name}`")), "{refused}");
        }
        let mut more = written;
        more["still_step"] = 1.into();
        let refused = SimulationSettings::read(&more, "settings").unwrap_err().to_string();
        assert!(refused.contains("unknown field `still_step`"), "{refused}");
    }
}

#[test]
fn lengths_are_kept() {
    let scene = scene(EventKind::Independent);
    let event = simulate(&scene, 1, &quick()).unwrap();
    assert!((4..=12).contains(&event.steps.len()));
    assert_eq!(event.frames().count(), 1 + 5 * event.steps.len());
}

#[test]
fn an_event_can_be_broken_off() {
    let scene = scene(EventKind::Independent);
    let mut steps = 0;
    let (event, finished) = simulate_with(&scene, 1, &quick(), &mut |_| {
        steps += 1;
        if steps == 3 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    })
    .unwrap();
    assert!(!finished);
    assert_eq!(event.steps.len(), 3);
}

#[test]
fn nonsense_is_refused() {
    let mut bad = scene(EventKind::Independent);
    bad.agents[0].start.position.x = f32::NAN;
    assert!(matches!(simulate(&bad, 1, &quick()), Err(SimulationError::Scene(_))));
    for minds in [quick().minds.with_particles(0), quick().minds.with_simulations(0)] {
        let refused = simulate(&scene(EventKind::Independent), 1, &SimulationSettings { minds, ..quick() });
        assert!(matches!(refused, Err(SimulationError::Settings(_))));
    }
    let refused = simulate(
        &scene(EventKind::Independent),
        1,
        &SimulationSettings { minds: quick().minds.with_particles(0), ..quick() },
    );
    assert_eq!(refused.unwrap_err().to_string(), "field `minds.particles` must be 1 to 100000, not 0");
}

#[test]
fn beliefs_are_recomputed_from_the_record() {
    let scene = scene(EventKind::Competing);
    let physics = scene.physics();
    for (engine, agent) in [(Engine::World, 0), (Engine::World, 1), (Engine::Forward, 0)] {
        let event = simulate(&scene, 2, &SimulationSettings { engine, ..quick() }).unwrap();
        let snapshots = beliefs(&event, AgentId::ALL[agent], &quick().minds);
        assert_eq!(snapshots.len(), event.steps.len() + 1);
        let states = core::iter::once(&event.initial).chain(event.steps.iter().map(|step| &step.substeps[4]));
        for (state, snapshot) in states.zip(&snapshots) {
            let observation = observe(&physics, state, AgentId::ALL[agent]);
            assert_eq!(snapshot.particles.len(), 10);
            for particle in &snapshot.particles {
                for entity in observation.observed.iter() {
                    assert_eq!(particle.body(entity), state.body(entity), "{entity:?}");
                }
            }
        }
        // The agent's own thoughts refer to as many particles as its belief has.
        for step in &event.steps {
            let named: usize = step.thoughts[agent].subgoals.iter().map(|value| value.particles).sum();
            assert_eq!(named, 10);
        }
    }
}

#[test]
fn an_idle_agent_stays_and_leaves_the_other_its_own_chance() {
    let scene = scene(EventKind::Independent);
    let event = simulate(&scene, 3, &quick()).unwrap();
    for idle in AgentId::ALL {
        let settings = SimulationSettings { idle: Some(idle), ..quick() };
        let without = simulate(&scene, 3, &settings).unwrap();
        assert!(without.steps.iter().all(|step| step.actions[idle] == phase_model::Action::Stop));
        // Both agents decide on the same first observation with separate streams.
        let other = idle.other();
        assert_eq!(without.steps[0].actions[other], event.steps[0].actions[other]);
        assert_eq!(without.steps[0].thoughts[other], event.steps[0].thoughts[other]);
        let start = without.initial.position(Entity::Agent(idle));
        let end = without.steps[0].substeps[4].position(Entity::Agent(idle));
        assert!(start.distance(end) < 0.01, "agent {idle} moved by itself");
    }
}

/// Step by step it is the same event, and an agent whose mind's actions are given to it makes no difference
/// to the other's mind.
#[test]
fn a_simulation_can_be_stepped_and_taken_over() {
    let scene = scene(EventKind::Helping);
    let settings = SimulationSettings { max_steps: 12, ..quick() };
    let whole = simulate(&scene, 7, &settings).unwrap();
    let mut stepped = Simulation::new(&scene, 7, &settings).unwrap();
    let mut taken = Simulation::new(&scene, 7, &settings).unwrap();
    for step in &whole.steps {
        assert!(!stepped.is_over());
        assert_eq!(stepped.step([None, None]).unwrap(), step);
        let given = taken.step([Some(step.actions[0]), None]).unwrap();
        assert_eq!((given.actions, given.substeps), (step.actions, step.substeps));
        assert_eq!(given.thoughts[0], Thought::IDLE);
        assert_eq!(given.thoughts[1], step.thoughts[1]);
        assert_eq!(stepped.particles(AgentId::ONE), taken.particles(AgentId::ONE));
    }
    assert!(stepped.is_over());
    assert_eq!(stepped.event(), &whole);
    assert_eq!(stepped.into_event(), whole);
    // An episode that is continued after its end goes on as if it had not ended.
    let longer = SimulationSettings { max_steps: 14, rest_steps: 100, still_steps: 100, ..settings };
    let long = simulate(&scene, 7, &longer).unwrap();
    let mut on = Simulation::new(&scene, 7, &SimulationSettings { max_steps: 3, ..longer }).unwrap();
    for step in &long.steps {
        assert_eq!(on.step([None, None]).unwrap(), step);
    }
}

/// Deciding before the step is due makes no difference, nor does an agent without a mind whose actions are
/// given.
#[test]
fn decisions_can_be_made_ahead_and_minds_left_out() {
    let scene = scene(EventKind::Hindering);
    let settings = SimulationSettings { max_steps: 12, ..quick() };
    let whole = simulate(&scene, 7, &settings).unwrap();
    let mut ahead = Simulation::new(&scene, 7, &settings).unwrap();
    let mut alone = Simulation::with_minds(&scene, 7, &settings, [false, true]).unwrap();
    for step in &whole.steps {
        for agent in AgentId::ALL {
            ahead.decide_ahead(agent).unwrap();
            ahead.decide_ahead(agent).unwrap();
        }
        alone.decide_ahead(AgentId::ONE).unwrap();
        assert_eq!(ahead.step([None, None]).unwrap(), step);
        let taken = alone.step([Some(step.actions[0]), None]).unwrap();
        assert_eq!(
            (taken.actions, &taken.thoughts[1], taken.substeps),
            (step.actions, &step.thoughts[1], step.substeps)
        );
        assert!(alone.particles(AgentId::ZERO).is_empty());
    }
    // Nobody decides for an agent without a mind.
    assert_eq!(alone.step([None, None]).unwrap().actions[0], Action::Stop);
}

/// The rule of the paper's game: agents are at rest after each step, in both engines, and objects keep their
/// velocities.
#[test]
fn agents_can_be_stopped_between_steps() {
    let scene = scene(EventKind::Collaborating);
    for engine in Engine::ALL {
        let settings = SimulationSettings { stop_between_steps: true, engine, ..quick() };
        let push = [Some(Action::Up), Some(Action::Left)];
        let mut game = Simulation::with_minds(&scene, 7, &settings, [false; 2]).unwrap();
        let mut free =
            Simulation::with_minds(&scene, 7, &SimulationSettings { engine, ..quick() }, [false; 2]).unwrap();
        for _ in 0..5 {
            let substeps = game.step(push).unwrap().substeps;
            free.step(push).unwrap();
            for agent in AgentId::ALL.map(Entity::Agent) {
                assert_eq!(substeps[4].body(agent).velocity, Vec2::ZERO);
                assert_eq!(substeps[4].body(agent).angular_velocity, 0.0);
            }
        }
        let path = |it: &Simulation| {
            let moved = |agent| it.event().initial.position(agent).distance(it.state().position(agent));
            moved(Entity::Agent(AgentId::ZERO)) + moved(Entity::Agent(AgentId::ONE))
        };
        let slow = path(&game);
        let fast = path(&free);
        assert!(0.2 < slow && slow < fast, "{engine:?}: {slow}, {fast}");
        // Each step begins at rest, so the first is like one in a simulation without it.
        let first = |it: &Simulation| it.event().steps[0].substeps[4].bodies.map(|body| body.position);
        assert_eq!(first(&game), first(&free));
    }
}

/// The scene of a kind in which both agents do not know each other's goals.
fn ignorant(kind: EventKind, level: Level) -> Scene {
    let mut scene = scene(kind);
    scene.agents.iter_mut().for_each(|agent| agent.awareness = Awareness::ignorant(level));
    scene
}

#[test]
fn thoughts_tell_what_ignorant_agents_believe_and_beliefs_can_be_recomputed() {
    for (kind, level) in [(EventKind::Helping, Level::One), (EventKind::Hindering, Level::Two)] {
        let event = simulate(&ignorant(kind, level), 5, &quick()).unwrap();
        for agent in AgentId::ALL {
            let recomputed = beliefs(&event, agent, &quick().minds);
            let hinders = event.scene.agents[agent].attitude == Attitude::Hinder;
            for (step, belief) in event.steps.iter().zip(&recomputed) {
                let thought = &step.thoughts[usize::from(agent)];
                assert_eq!(thought.suspicion.is_some(), hinders && level == Level::Two);
                let told: usize = thought.intents.iter().map(|it| it.particles).sum();
                assert_eq!((told, belief.suppositions.len()), (10, 10));
                for it in &thought.intents {
                    let those = belief.suppositions.iter().filter(|of| of.intent == it.intent).count();
                    assert_eq!(those, it.particles);
                }
            }
        }
    }
    let knowing = simulate(&scene(EventKind::Helping), 5, &quick()).unwrap();
    assert!(knowing.steps.iter().flat_map(|step| &step.thoughts).all(|thought| thought.intents.is_empty()));
}

/// An ignorant helper acts the same whatever the other's goal, until it has seen the other move.
#[test]
fn ignorant_agents_do_not_know_what_the_scene_says() {
    let first = ignorant(EventKind::Helping, Level::One);
    let helper =
        AgentId::ALL.into_iter().find(|&agent| first.agents[usize::from(agent)].attitude.alpha() == 1);
    let helper = helper.expect("a helper");
    let goals = phase_model::physical_goals(helper.other(), first.objects.len());
    let mut actions = Vec::new();
    for goal in goals {
        let mut scene = first.clone();
        scene.agents.iter_mut().for_each(|agent| agent.goal = goal);
        scene.agents[usize::from(helper.other())].strength = phase_model::Strength::ALL[actions.len() % 4];
        let event = simulate(&scene, 5, &SimulationSettings { max_steps: 1, ..quick() }).unwrap();
        actions.push((
            event.steps[0].actions[usize::from(helper)],
            event.steps[0].thoughts[usize::from(helper)].clone(),
        ));
    }
    assert!(actions.iter().all(|it| it == &actions[0]));
}

#[test]
fn an_agent_that_is_told_sees_objects_through_walls_and_nothing_else_changes() {
    let mut scene = scene(EventKind::Helping);
    scene.agents[0].awareness = Awareness { sees: Sight::Objects, ..Awareness::default() };
    let event = simulate(&scene, 5, &quick()).unwrap();
    for (step, belief) in event.steps.iter().zip(&beliefs(&event, AgentId::ZERO, &quick().minds)[1..]) {
        for entity in event.scene.physics().entities().skip(2) {
            let place = step.substeps[4].position(entity);
            assert!(belief.particles.iter().all(|particle| particle.position(entity) == place));
        }
    }
}

/// An agent that knows where an object was at the start believes it there until it looks.
#[test]
fn a_belief_from_the_start_outlasts_a_move_that_is_not_seen() {
    let text = r#"{"layout": {"base": 16}, "event": "independent", "agents": [
        {"size_level": 0, "strength_level": 2, "alpha": 0, "start": {"x": 24, "y": 20, "angle": 0},
         "goal": {"kind": "object_on_landmark", "object": 0, "landmark": 1, "sign": 1},
         "sees": "start", "waits": 60},
        {"size_level": 0, "strength_level": 2, "alpha": 0, "start": {"x": 9, "y": 17, "angle": 3.1416},
         "goal": {"kind": "object_on_landmark", "object": 0, "landmark": 3, "sign": 1}}],
        "objects": [{"size_level": 0, "start": {"x": 9, "y": 14}}]}"#;
    let scene = Scene::from_json(text).unwrap();
    let settings = SimulationSettings { max_steps: 60, ..quick() };
    let event = simulate(&scene, 5, &settings).unwrap();
    let object = scene.physics().entities().nth(2).unwrap();
    let there = event.steps.last().unwrap().substeps[4].position(object);
    let start = event.initial.position(object);
    assert!(there.distance(start) > 3.0, "it was moved to {there}");
    let belief = |scene: &Scene| {
        let event = phase_event::Event { scene: scene.clone(), ..event.clone() };
        let last = beliefs(&event, AgentId::ZERO, &quick().minds).pop().unwrap();
        last.particles.iter().map(|particle| particle.position(object)).collect::<Vec<_>>()
    };
    assert!(belief(&scene).iter().all(|place| place.distance(start) < 0.1));
    let mut told = scene.clone();
    told.agents[0].awareness.sees = Sight::Objects;
    assert!(belief(&told).iter().all(|place| *place == there));
    let mut untold = scene.clone();
    untold.agents[0].awareness.sees = Sight::Own;
    assert!(belief(&untold).iter().any(|place| place.distance(start) > 3.0));
    // It waited.
    assert!(event.steps.iter().all(|step| step.actions[0] == Action::Stop));
}

#[test]
fn published_minds_refuse_what_they_do_not_model() {
    let minds = MindParameters::of(MindKind::Published).with_particles(5).with_simulations(10);
    let settings = SimulationSettings { minds, max_steps: 1, ..quick() };
    let refused = simulate(&ignorant(EventKind::Chasing, Level::One), 5, &settings).unwrap_err();
    assert!(matches!(refused, SimulationError::Awareness(AgentId::ZERO)), "{refused}");
}
