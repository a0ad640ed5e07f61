//! Scenes that differ in one social variable.

use phase_model::{
    AgentSpec, Attitude, Layout, Scene,
    random::{Purpose, stream},
};
use phase_sampler::{About, Contrast, ContrastRequest, Stance, Starts};
use std::collections::BTreeSet;

/// An agent without its goal and attitude.
fn body(agent: &AgentSpec) -> String {
    format!("{:?} {:?} {:?}", agent.size, agent.strength, agent.start)
}

fn sample(
    stances: &[Stance],
    about: About,
    goal_index: usize,
    layouts: &[Layout],
    seed: u64,
) -> Option<Contrast> {
    let request = ContrastRequest { stances, about, goal_index, layouts, starts: Starts::Near };
    Contrast::sample(&request, &mut stream(seed, Purpose::Scene, 0)).ok()
}

#[test]
fn only_the_stance_of_one_agent_differs() {
    let layouts: Vec<Layout> = Layout::all_used().collect();
    let mut changed = BTreeSet::new();
    let cases = [(&Stance::ALL[..], About::Object), (&[Stance::Indifferent, Stance::Hinder], About::Place)];
    for (stances, about) in cases {
        for goal_index in 0..8 {
            let contrast = sample(stances, about, goal_index, &layouts, goal_index as u64).unwrap();
            let it = contrast.changed;
            let other = contrast.changed.other();
            changed.insert(it);
            assert_eq!(contrast.scenes.len(), stances.len());
            let first: &Scene = &contrast.scenes[0];
            for (scene, stance) in contrast.scenes.iter().zip(stances) {
                assert_eq!((scene.layout, &scene.objects), (first.layout, &first.objects));
                assert_eq!(scene.agents[other], first.agents[other], "the other agent is the same");
                assert_eq!(scene.agents[other].attitude, Attitude::Neutral);
                assert_eq!(body(&scene.agents[it]), body(&first.agents[it]));
                assert_eq!(scene.relation(), stance.relation(), "{stance:?}");
                assert_eq!(scene.kind, stance.variant(about).kind());
                assert_eq!((scene.validate_without_overlap(), scene.check_kind()), (Ok(()), Ok(())));
            }
            let wants: BTreeSet<String> = contrast
                .scenes
                .iter()
                .map(|scene| format!("{:?} {:?}", scene.agents[it].goal, scene.agents[it].attitude))
                .collect();
            assert_eq!(wants.len(), stances.len(), "every stance is another one");
        }
    }
    assert_eq!(changed.len(), 2, "either agent is the changed one at times");
}

#[test]
fn a_stance_that_does_not_suit_the_goal_is_an_error() {
    let layouts: Vec<Layout> = Layout::all_used().collect();
    assert_eq!(sample(&[Stance::Hinder, Stance::Rival], About::Place, 0, &layouts, 1), None);
    assert_eq!(sample(&[Stance::Help, Stance::Hinder], About::Object, 0, &[], 1), None);
}
