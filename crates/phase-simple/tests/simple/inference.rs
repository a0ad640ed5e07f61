//! Whole inferences, on events whose labels are known only to the test.

use phase_event::{Event, Missing, Noise, ObservedEvent, Recording, Tracking};
use phase_minds::MindParameters;
use phase_model::{
    AgentId, Attitude, Goal, LandmarkId, Layout, ObjectId, Relation, Vec2,
    random::{Purpose, stream},
};
use phase_sampler::{Request, Starts, Variant, sample};
use phase_simple::{
    ChainSettings, Inference, InferenceSettings, InverseDynamics, PreparedEvent, UniformStrength, Update,
    explain,
};
use serde_json::json;

/// An event of a variant, by agents with smaller searches than the paper's.
fn event(variant: Variant, seed: u64) -> Event {
    let layouts: Vec<Layout> = Layout::all_used().collect();
    let request = Request { variant, goal_index: seed as usize, layouts: &layouts, starts: Starts::Near };
    let scene = sample(&request, &mut stream(seed, Purpose::Scene, 0)).expect("there are such scenes");
    let minds = MindParameters::default().with_simulations(100);
    let settings = phase_sim::SimulationSettings { minds, ..phase_sim::SimulationSettings::default() };
    phase_sim::simulate(&scene, seed, &settings).expect("a sound scene")
}

fn observed(event: &Event) -> ObservedEvent {
    recording(event.clone()).observed().expect("a sound event")
}

fn recording(event: Event) -> Recording {
    Recording::of_event("event", event, "test".into(), serde_json::Value::Null)
}

/// Inverse planning and Algorithm 2, with agents that search little.
fn quick() -> [InferenceSettings; 2] {
    let chains =
        ChainSettings { particles: 4, iterations: 2, ..ChainSettings::resynchronised(Update::Local) };
    let minds = MindParameters::default().with_particles(10).with_simulations(20);
    [InferenceSettings::default(), InferenceSettings::chains(chains)]
        .map(|settings| settings.with_agents(minds.into()))
}

fn whole(inference: &Inference) -> f64 {
    inference.posterior.hypotheses.iter().map(|(_, weight)| weight).sum()
}

#[test]
fn no_label_is_seen() {
    let event = event(Variant::Places, 1);
    let mut relabelled = recording(event.clone());
    for agent in &mut relabelled.scene.agents {
        agent.goal = Goal::ObjectOnLandmark {
            object: ObjectId::ZERO,
            landmark: LandmarkId::TOP_LEFT,
            sign: phase_model::Sign::Positive,
        };
        agent.attitude = Attitude::Hinder;
        agent.strength = phase_model::Strength::Mighty;
    }
    relabelled.relation = Relation::Adversarial;
    relabelled.recorded_steps = Some(77);
    relabelled.simulation = None;
    assert_eq!(relabelled.observed().expect("a sound event"), observed(&event));
}

/// A setting out of its range is named before anything is simulated.
#[test]
fn settings_out_of_range_are_refused() {
    let event = observed(&event(Variant::Places, 2)).prefix(3);
    let [planning, chains] = quick().map(|settings| serde_json::to_value(settings).expect("JSON"));
    for (settings, path, value) in [
        (&planning, "algorithm.inverse_planning.interval", json!(0)),
        (&planning, "algorithm.inverse_planning.temper", json!(1.5)),
        (&planning, "algorithm.inverse_planning.tolerance", json!(0.0)),
        (&planning, "gamma", json!(-1.0)),
        (&chains, "algorithm.chains.particles", json!(0)),
        (&chains, "algorithm.chains.iterations", json!(1_000_000_000)),
        (&chains, "algorithm.chains.anchor", json!(0)),
    ] {
        let mut changed = settings.clone();
        *changed.pointer_mut(&format!("/{}", path.replace('.', "/"))).expect("there is one") = value;
        let read = serde_json::from_value(changed).expect("of the right types");
        let refused = explain(&event, &UniformStrength, 1, &read).expect_err(path).to_string();
        assert!(refused.contains(&format!("`{path}` must be")), "{refused}");
    }
}

#[test]
fn the_same_seed_gives_the_same_answer() {
    let event = observed(&event(Variant::Places, 2)).prefix(25);
    for settings in quick() {
        let answers =
            [1, 1, 2].map(|seed| explain(&event, &UniformStrength, seed, &settings).expect("is sound"));
        assert_eq!(answers[0], answers[1]);
        assert!((whole(&answers[0]) - 1.0).abs() < 1e-9, "{}", whole(&answers[0]));
        assert_ne!(answers[0].posterior, answers[2].posterior, "another seed draws other futures");
    }
}

/// Inverse planning weighs every hypothesis, and agents that are not social carry no information about each
/// other: the odds between two goals of one are the same whatever goal the other has.
#[test]
fn every_hypothesis_is_weighed_and_neutral_agents_are_independent() {
    let event = observed(&event(Variant::Carry, 1)).prefix(6);
    let [planning, _] = quick();
    let posterior = explain(&event, &UniformStrength, 1, &planning).expect("is sound").posterior;
    let goals = phase_simple::physical_goals(AgentId::ZERO, event.object_sizes().len()).len();
    assert_eq!(posterior.hypotheses.len(), goals * goals + 4 * goals);
    let neutral: Vec<_> = posterior
        .hypotheses
        .iter()
        .filter(|(hypothesis, _)| hypothesis.attitudes == [Attitude::Neutral; 2])
        .collect();
    let log = |goals: [Goal; 2]| {
        let action_likelihoods = neutral.iter().find(|(hypothesis, _)| hypothesis.goals == goals);
        action_likelihoods.expect("every pair is there").1.ln()
    };
    for ([a, b], [c, d]) in neutral.iter().zip(&neutral[1..]).map(|(x, y)| (x.0.goals, y.0.goals)) {
        let straight = log([a, b]) + log([c, d]);
        let crossed = log([a, d]) + log([c, b]);
        assert!((straight - crossed).abs() < 1e-6, "{straight} {crossed}");
    }
}

/// Both walk to their landmarks and stop: the simplest event.
#[test]
fn two_who_walk_to_their_landmarks_are_understood() {
    let event = event(Variant::Places, 3);
    let judgement = explain(&observed(&event), &UniformStrength, 1, &InferenceSettings::default())
        .expect("is sound")
        .posterior
        .judgement();
    for (goals, goal) in judgement.goals.iter().zip(event.scene.goals()) {
        assert_eq!(goals[0].0, goal, "{goals:?}");
    }
}

/// Actions and strengths are recovered from rows alone, which are means over steps.
#[test]
fn actions_strengths_and_grips_are_found_again() {
    /// Log-odds by which a strength is identified.
    const SURE: f64 = 10.0;
    let mut pushes = 0;
    let mut pushes_found = 0;
    let mut held = 0;
    let mut held_found = 0;
    let mut strengths = 0;
    for (seed, variant) in
        [(0, Variant::Carry), (1, Variant::Places), (2, Variant::Carry), (3, Variant::Chase)]
    {
        let event = event(variant, seed);
        let motion = InverseDynamics::new(&observed(&event));
        for (logs, agent) in motion.log_strengths.iter().zip(&event.scene.agents) {
            let truth = usize::from(agent.strength.level());
            let others = logs.iter().enumerate().filter(|(level, _)| *level != truth);
            let best_other = others.map(|(_, log)| *log).fold(f64::NEG_INFINITY, f64::max);
            // An agent that hardly moves does not reveal its strength.
            assert!(logs[truth] > best_other - SURE, "{variant:?} {seed}: {logs:?}");
            strengths += usize::from(logs[truth] > best_other + SURE);
        }
        assert!(!motion.late_start, "row 0 is the initial state");
        let action_likelihoods = motion.states[1..].iter().zip(&motion.actions);
        for (step, (state, actions)) in event.steps.iter().zip(action_likelihoods) {
            for (agent, (action, action_likelihoods)) in step.actions.iter().zip(actions).enumerate() {
                let shows = action.push().is_some();
                pushes += usize::from(shows);
                pushes_found += usize::from(shows && action == action_likelihoods);
                let truth = step.substeps[4].held_object(AgentId::ALL[agent]);
                held += usize::from(truth.is_some());
                held_found += usize::from(truth.is_some() && truth == state.held_object(AgentId::ALL[agent]));
            }
        }
    }
    assert!(strengths >= 5, "{strengths} of 8");
    // Pushes against a wall or another body may look alike.
    assert!(pushes > 50 && pushes_found * 5 > pushes * 4, "{pushes_found} of {pushes}");
    assert!(held > 20 && held_found * 10 > held * 9, "{held_found} of {held}");
}

/// Some recordings have as row 0 the state after the first substep of the first step.
#[test]
fn a_late_start_is_noticed() {
    // A push that moves nobody does not tell.
    let moves = |event: &Event| {
        let way = |agent: usize| event.steps[0].substeps[0].bodies[agent].velocity.length();
        AgentId::ALL
            .into_iter()
            .any(|agent| event.steps[0].actions[agent].push().is_some() && way(agent.index()) > 1.0)
    };
    let event =
        (0..40).map(|seed| event(Variant::Places, seed)).find(moves).expect("somebody sets off at once");
    let mut recording = recording(event.clone());
    for (agent, rows) in recording.trajectory.agents.iter_mut().enumerate() {
        let body = event.steps[0].substeps[0].bodies[agent];
        let position = body.position;
        let velocity = body.velocity;
        rows[0] = [position.x, position.y, velocity.x, velocity.y, body.angle];
    }
    let motion = InverseDynamics::new(&recording.observed().expect("a sound event"));
    assert!(motion.late_start);
    assert!(motion.residuals[0] < 0.01, "{}", motion.residuals[0]);
}

/// Simulated with the same beliefs that led to it, a resynchronised event deviates less under the true
/// hypothesis than under a false one.
#[test]
fn the_truth_deviates_least() {
    let event = event(Variant::Places, 5);
    let seen = observed(&event);
    let prepared = PreparedEvent::new(&seen, InferenceSettings::default().agents, 1);
    let strengths = event.scene.agents.map(|agent| agent.strength);
    let deviation = |goals: [Goal; 2]| {
        let hypothesis = phase_simple::Hypothesis::new(goals, [Attitude::Neutral; 2], strengths);
        let deviations = prepared.simulate(&hypothesis, Some(10), f64::INFINITY).expect("is sound");
        assert_eq!(deviations.len(), seen.steps());
        deviations.iter().sum::<f64>()
    };
    let truth = deviation(event.scene.goals());
    let swapped = event.scene.goals().map(|goal| match goal {
        Goal::AgentOnLandmark { agent, landmark, sign } => {
            Goal::AgentOnLandmark { agent, landmark: LandmarkId::ALL[(landmark.index() + 2) % 4], sign }
        }
        other => other,
    });
    assert!(truth < deviation(swapped), "{truth}");
    // A caller that requests only a part gets only that part.
    let hypothesis = phase_simple::Hypothesis::new(swapped, [Attitude::Neutral; 2], strengths);
    let part = prepared.simulate(&hypothesis, Some(10), truth).expect("is sound");
    assert!(part.len() < seen.steps() && part.iter().sum::<f64>() > truth);
}

/// A track of a video: rows with errors of a well-read picture.
fn tracked(observed: ObservedEvent, missing: Missing) -> ObservedEvent {
    let noise = Noise { position: 0.01, velocity: 0.17, angle: 0.01 };
    let tracking = Tracking {
        noise,
        frames: 100,
        frame_rate: 20.0,
        straight: true,
        hidden: 0.0,
        missing,
        deviations: Vec::new(),
    };
    observed.with_tracking(&tracking)
}

/// Bodies without inertia, which go straight and turn at once, are not taken for agents with a plan.
#[test]
fn motion_of_another_physics_is_judged_with_care() {
    let event = event(Variant::Places, 3);
    let ours = observed(&event);
    let settings = quick()[0];
    let answer = |observed: &ObservedEvent| explain(observed, &UniformStrength, 1, &settings).expect("sound");
    let known = answer(&tracked(ours.clone(), Missing::default()));
    assert!(!known.foreign);
    let mut rows = ours.rows().to_vec();
    for (t, row) in rows.iter_mut().enumerate() {
        // From place to place in five steps, far faster than any agent turns and starts.
        let place = |k: usize| Vec2::new([8.0, 24.0, 16.0][k % 3], [4.0, 12.0, 20.0][k / 3 % 3]);
        for (k, body) in row.iter_mut().enumerate().take(2) {
            let from = t / 5 + k;
            let share = (t % 5) as f32 / 5.0;
            body.position = place(from).lerp(place(from + 1), share);
            body.velocity = (place(from + 1) - place(from)) * (12.0 / 5.0);
        }
    }
    let objects = ours.object_sizes().to_vec();
    let strange = ObservedEvent::new(ours.layout(), ours.agent_sizes(), objects, rows).expect("sound");
    let answered = answer(&tracked(strange.clone(), Missing::default()));
    assert!(
        answered.foreign,
        "{}",
        InverseDynamics::new(&tracked(strange, Missing::default())).error_up_to(99)
    );
    let surest = |inference: &Inference| {
        let goals = AgentId::ALL.map(|agent| inference.posterior.goals(agent)[0].1);
        goals[0].max(goals[1])
    };
    // The prior keeps a fifth, so not even the sum of all evidence is certain.
    assert!(surest(&answered) < 0.9, "{}", surest(&answered));
    assert!((whole(&answered) - 1.0).abs() < 1e-9);
    // Other forms and no landmarks: no goal that names one.
    let missing = Missing { forms: true, landmarks: true, ..Missing::default() };
    let answered = answer(&tracked(ours, missing));
    let at_landmarks = |agent| answered.posterior.goals(agent).iter().any(|it| it.0.landmark().is_some());
    assert!(answered.foreign && !AgentId::ALL.into_iter().any(at_landmarks));
    assert!((whole(&answered) - 1.0).abs() < 1e-9);
}
