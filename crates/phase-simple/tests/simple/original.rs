//! Published minds with the original's random numbers act in the original's world.

use phase_event::Recording;
use phase_minds::{MindKind, PublishedParameters, RandomNumbers};
use phase_model::{
    Layout, Scene,
    random::{Purpose, stream},
};
use phase_sampler::{Request, Starts, Variant, sample};
use phase_sim::{Engine, SimulationSettings};
use phase_simple::{Hypothesis, ImaginedAgents, PreparedEvent};

/// Steps that are compared.
const STEPS: usize = 25;
/// Deviation of a world that takes the same steps, from rounding (u).
const SAME: f64 = 1e-4;
/// The seed of events and inferences: agents' beliefs are drawn from it.
const SEED: u64 = 1;

fn scene() -> Scene {
    let layouts: Vec<Layout> = Layout::all_used().collect();
    let request =
        Request { variant: Variant::Places, goal_index: 0, layouts: &layouts, starts: Starts::Near };
    sample(&request, &mut stream(5, Purpose::Scene, 0)).expect("there are such scenes")
}

/// Deviation by step, under the truth, of what minds with these random numbers do from an event in an engine
/// (u).
fn deviations(engine: Engine, random: RandomNumbers) -> Vec<f64> {
    let scene = scene();
    let minds = PublishedParameters { simulations: 100, random, ..PublishedParameters::default() };
    let settings =
        SimulationSettings { engine, minds: minds.into(), max_steps: STEPS, ..SimulationSettings::default() };
    let event = phase_sim::simulate(&scene, SEED, &settings).expect("a sound scene");
    let recording = Recording::of_event("event", event, "test".into(), serde_json::Value::Null);
    let observed = recording.observed().expect("a sound event");
    let truth = Hypothesis {
        goals: scene.goals(),
        attitudes: scene.agents.each_ref().map(|agent| agent.attitude),
        strengths: scene.agents.each_ref().map(|agent| agent.strength),
    };
    let agents = ImaginedAgents::of(MindKind::Published).with_minds(minds.into());
    let agents = ImaginedAgents { one_way_turns: false, strongest_coasts: false, ..agents };
    let prepared = PreparedEvent::new(&observed, agents, SEED);
    prepared.simulate(&truth, None, f64::INFINITY).expect("sound parameters")
}

#[test]
fn under_the_truth_the_originals_numbers_repeat_an_event_in_the_originals_world_alone() {
    let same = |deviations: &[f64]| deviations.iter().take_while(|&&deviation| deviation < SAME).count();
    let original = deviations(Engine::Original, RandomNumbers::Original);
    let forward = deviations(Engine::Forward, RandomNumbers::Original);
    println!("{original:?}\n{forward:?}");
    assert!(same(&original) > same(&forward));
    assert_eq!(same(&original), original.len(), "{original:?}");
}
