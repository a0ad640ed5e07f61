//! A copy of an episode goes on as the original, bit for bit: impulses, grips and released pairs included.

use phase_model::{AGENT_COUNT, Action, AgentId, Contacts, EventKind, Scene, State, Vec2, arena::SUBSTEPS};
use phase_sim::{Engine, Episode, View};
use proptest::prelude::*;

type Actions = [Action; AGENT_COUNT];

/// Any action; attaching and detaching more often than others.
fn action() -> impl Strategy<Value = Action> {
    let any = prop::sample::select(Action::ALL.to_vec());
    prop_oneof![2 => any, 1 => Just(Action::Attach), 1 => Just(Action::Detach)]
}

fn actions(steps: core::ops::Range<usize>) -> impl Strategy<Value = Vec<Actions>> {
    prop::collection::vec([action(), action()], steps)
}

/// A sampled scene whose bodies are moved into one corner, so that they touch.
fn crowded(seed: u64, places: [(f32, f32, f32); 4]) -> Scene {
    let kind = EventKind::ALL[seed as usize % EventKind::ALL.len()];
    let mut scene = phase_sampler::sample_named(Some(kind.name()), None, seed).expect("a scene");
    let starts = scene.agents.iter_mut().map(|agent| &mut agent.start);
    for (start, (x, y, angle)) in
        starts.chain(scene.objects.iter_mut().map(|object| &mut object.start)).zip(places)
    {
        (start.position, start.angle) = (Vec2::new(7.0 + x, 3.0 + y), angle);
    }
    scene
}

/// Every substep, so exactly that a zero and a negative zero differ.
fn play(episode: &mut Episode, actions: &[Actions]) -> String {
    let states = actions.iter().map(|&actions| {
        episode.step(actions);
        *episode.substeps()
    });
    format!("{:?}", states.collect::<Vec<[State; SUBSTEPS]>>())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 100, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn a_copy_goes_on_as_the_original(
        seed in 0..1000u64,
        places in prop::array::uniform4((0.0..7.0f32, 0.0..7.0f32, -3.0..3.0f32)),
        before in actions(0..20),
        after in actions(1..10),
        other in actions(1..10),
    ) {
        let scene = crowded(seed, places);
        for engine in Engine::ALL {
            let mut episode = Episode::new(&scene, engine);
            play(&mut episode, &before);
            let saved = episode.clone();
            // The original is disturbed, the copy kept, and copied again.
            play(&mut episode, &other);
            let found = play(&mut saved.clone(), &after);
            // The same from the start, without any copy.
            let mut whole = Episode::new(&scene, engine);
            play(&mut whole, &before);
            prop_assert_eq!(&found, &play(&mut whole, &after), "{}", engine.name());
            prop_assert_eq!(found, play(&mut saved.clone(), &after), "{}", engine.name());
        }
    }
}

/// A copy has more than places and velocities: a world that is made anew in the same state goes on otherwise.
#[test]
fn a_state_alone_does_not_go_on_alike() {
    let places = [(1.5, 1.5, 0.0), (3.5, 1.5, 0.5), (2.5, 3.6, 0.0), (4.8, 3.4, 0.0)];
    let script = |step: usize| {
        let other = Action::ALL[(step * 3 + 1) % 14];
        [
            [Action::Up, Action::Attach, Action::Right, Action::Up, Action::Detach, Action::Left][step % 6],
            other,
        ]
    };
    let actions: Vec<Actions> = (0..24).map(script).collect();
    let (mut gripped, mut touched, mut differ) = (0, 0, 0);
    for seed in 0..12 {
        let scene = crowded(seed, places);
        let mut episode = Episode::new(&scene, Engine::Forward);
        for k in 0..actions.len() {
            play(&mut episode, &actions[k..=k]);
            gripped += usize::from(episode.state().grips.iter().any(Option::is_some));
            touched += usize::from(episode.state().contacts != Contacts::NONE);
            let mut anew = phase_sim::Environment::new(Engine::Forward, episode.physics(), episode.state());
            let found = format!("{:?}", anew.step(script(k + 1)));
            let mut copy = episode.clone();
            copy.step(script(k + 1));
            differ += usize::from(found != format!("{:?}", copy.substeps()));
        }
    }
    assert!(gripped > 20 && touched > 100, "{gripped} steps with grips, {touched} with contacts");
    assert!(differ > 50, "{differ}");
}

#[test]
fn the_state_before_a_step_is_kept() {
    let scene = crowded(1, [(1.0, 1.0, 0.0), (5.0, 1.0, 0.0), (1.0, 6.0, 0.0), (6.0, 6.0, 0.0)]);
    let mut episode = Episode::new(&scene, Engine::World);
    assert_eq!(episode.before(), episode.state());
    for _ in 0..3 {
        let state = *episode.state();
        episode.step([Action::Up, Action::Left]);
        assert_eq!(*episode.before(), state);
        assert_ne!(*episode.state(), state);
    }
    assert_eq!(episode.clone().observe(AgentId::ONE, View::Own), episode.observe(AgentId::ONE, View::Own));
}
