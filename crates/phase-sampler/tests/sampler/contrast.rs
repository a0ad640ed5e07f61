//! Scenes that differ in one social variable.

use phase_model::{
    AgentSpec, Attitude, Entity, Layout, Scene, Sight, Vec2,
    arena::LANDMARKS,
    layout::room_of,
    random::{Purpose, stream},
};
use phase_navigation::{IMPASSABLE_COST, Map};
use phase_perception::sees;
use phase_predicates::landmark_lead;
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
    let cases = [
        (&[Stance::Help, Stance::Hinder, Stance::Indifferent][..], About::Object),
        (&[Stance::Same, Stance::Rival, Stance::Indifferent], About::Object),
        (&[Stance::Indifferent, Stance::Hinder], About::Place),
    ];
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

/// Who is helped or hindered sees its object and is by it, the other agent is farther by 4 u and comes later,
/// and the first 8 u of the object's way show the landmark by 3 u.
#[test]
fn who_is_helped_or_hindered_can_show_what_it_wants_first() {
    let layouts: Vec<Layout> = Layout::all_used().collect();
    for goal_index in 0..8 {
        let stances = [Stance::Help, Stance::Hinder];
        let contrast = sample(&stances, About::Object, goal_index, &layouts, goal_index as u64).unwrap();
        let scene = &contrast.scenes[0];
        let (late, early) = (contrast.changed, contrast.changed.other());
        let goal = scene.agents[early].goal;
        let (object, landmark) =
            (goal.subject(), goal.landmark().expect("the object is wanted on a landmark"));
        let state = scene.initial_state();
        let place = state.position(object);
        let [late, near] = [late, early].map(|agent| state.position(Entity::Agent(agent)).distance(place));
        assert!(near <= 8.0 && near + 4.0 <= late && late <= 14.0, "{near}, {late}");
        assert_eq!(room_of(place), room_of(state.position(Entity::Agent(early))));
        assert!(sees(&scene.physics(), &state, early, object));
        let map = Map::new(scene.layout);
        let to = LANDMARKS[landmark];
        let Entity::Object(wanted) = object else { panic!("the goal is about an object") };
        let width = 2.0 * scene.physics().object_radii[wanted.index()];
        let way = map.route(place, to, width, map.gaps(), IMPASSABLE_COST).expect("there is a way");
        let shown = landmark_lead(place, way.at(place, to, 8.0), landmark);
        assert!(shown >= 3.0, "{shown}");
    }
}

#[test]
fn a_stance_that_does_not_suit_the_goal_is_an_error() {
    let layouts: Vec<Layout> = Layout::all_used().collect();
    assert_eq!(sample(&[Stance::Hinder, Stance::Rival], About::Place, 0, &layouts, 1), None);
    assert_eq!(sample(&[Stance::Help, Stance::Hinder], About::Object, 0, &[], 1), None);
}

/// The agent that waits sees the object neither where it is nor from where the other would bring it, however
/// it turns; its twin differs in nothing but what it is told.
#[test]
fn beliefs_differ_in_what_the_agent_is_told() {
    let layouts: Vec<Layout> = Layout::all_used().collect();
    let mut bases = BTreeSet::new();
    for goal_index in 0..8 {
        let stances = [Stance::Unaware, Stance::Told];
        let contrast = sample(&stances, About::Object, goal_index, &layouts, goal_index as u64).unwrap();
        let me = contrast.changed;
        bases.insert(contrast.scenes[0].layout.base());
        let [unaware, told] = [0, 1].map(|k: usize| contrast.scenes[k].clone());
        assert_eq!(
            (unaware.agents[me].awareness.sees, told.agents[me].awareness.sees),
            (Sight::Start, Sight::Objects)
        );
        assert!(unaware.agents[me].awareness.waits > 0);
        let mut same = told;
        same.agents[me].awareness.sees = Sight::Start;
        assert_eq!(unaware, same);
        let object = unaware.agents[me].goal.subject();
        assert_eq!(object, unaware.agents[me.other()].goal.subject());
        let physics = unaware.physics();
        let mut state = unaware.initial_state();
        // The other is somewhere on its way: here, outside of the arena, it hides nothing.
        state.body_mut(Entity::Agent(me.other())).position = Vec2::splat(100.0);
        let landmark =
            unaware.agents[me.other()].goal.landmark().expect("the object is wanted on a landmark");
        for place in [state.position(object), LANDMARKS[landmark]] {
            for turn in 0..64 {
                state.body_mut(object).position = place;
                state.body_mut(Entity::Agent(me)).angle = turn as f32 * core::f32::consts::TAU / 64.0;
                assert!(!sees(&physics, &state, me, object), "goal {goal_index}, turn {turn}");
            }
        }
    }
    // Most places that hide the object are in two of the layouts.
    assert!(bases.len() > 3, "{bases:?}");
}
