//! Stages that several variants share.

use phase_model::{
    AgentId, Attitude, Entity, Goal, Layout, Relation, Scene, Sign, arena,
    random::{Purpose, stream},
};
use phase_navigation::{IMPASSABLE_COST, Map};
use phase_sampler::{Part, SampleError, Stage, Starts, Variant};
use std::collections::BTreeSet;

fn parts(variants: &[Variant], goal_index: usize) -> Vec<Part> {
    variants.iter().map(|&variant| Part { variant, goal_index, meet_soon: true }).collect()
}

/// Bodies regardless of their directions, of strengths, goals and attitudes.
fn bodies(stage: &Stage) -> BTreeSet<String> {
    let agents = stage.agents.iter().map(|(size, start)| format!("agent {size:?} {}", start.position));
    let objects = stage.objects.iter().map(|it| format!("object {:?} {}", it.size, it.start.position));
    agents.chain(objects).collect()
}

#[test]
fn every_part_is_played_by_the_same_bodies() {
    let layouts: Vec<Layout> = Layout::all_used().collect();
    let helping = [Variant::Lift, Variant::Fetch, Variant::HandOver, Variant::Move, Variant::MakeWay];
    let hindering = [Variant::Hide, Variant::Take, Variant::Drag, Variant::Undo, Variant::Block];
    let adversarial = [Variant::Compete, Variant::Chase, Variant::Drag, Variant::Compete, Variant::Chase];
    let neutral = [Variant::Cross, Variant::Mixed, Variant::Places, Variant::Objects, Variant::Places];
    for (k, helping) in helping.into_iter().enumerate() {
        let parts = parts(&[helping, Variant::Carry, hindering[k], adversarial[k], neutral[k]], k);
        let mut random = stream(3, Purpose::Stage, k as u64);
        let mut layouts = layouts.clone();
        layouts.rotate_left(17 * k);
        let stage = Stage::sample(&parts, &layouts, Starts::Near, &mut random).unwrap();
        let mut relations = BTreeSet::new();
        for &part in &parts {
            let scene = stage.scene(part, &mut random).unwrap();
            assert_eq!(scene.kind, part.variant.kind());
            assert_eq!(scene.validate_without_overlap(), Ok(()));
            assert_eq!(scene.check_kind(), Ok(()));
            assert_eq!(scene.objects.len(), 2);
            assert_eq!(bodies(&Stage::of(&scene)), bodies(&stage));
            relations.insert(scene.relation());
        }
        assert_eq!(relations, BTreeSet::from([Relation::Friendly, Relation::Adversarial, Relation::Neutral]));
    }
}

/// If an object is handed over, the way past the agent that waits for it is hardly a detour, and that agent
/// has no way to the object.
#[test]
fn objects_are_handed_over_on_their_way() {
    let mut layouts: Vec<Layout> = Layout::all_used().collect();
    for k in 0..12 {
        let mut random = stream(5, Purpose::Stage, k);
        layouts.rotate_left(7);
        let stage = Stage::sample(
            &parts(&[Variant::HandOver, Variant::Carry], 0),
            &layouts,
            Starts::Near,
            &mut random,
        )
        .unwrap();
        let part = parts(&[Variant::HandOver], k as usize)[0];
        let scene = stage.cast(part, &mut random).expect("the stage allows it");
        let is_helpee = |agent: &AgentId| scene.agents[*agent].attitude == Attitude::Neutral;
        let helpee = AgentId::ALL.into_iter().find(is_helpee).unwrap();
        let Goal::ObjectOnLandmark { object, landmark, .. } = scene.agents[helpee].goal else {
            panic!("no object")
        };
        let [from, past] =
            [Entity::Object(object), Entity::Agent(helpee)].map(|it| scene.initial_state().position(it));
        let map = Map::new(scene.layout);
        let physics = scene.physics();
        let to = arena::LANDMARKS[landmark];
        let way = |from, to, width| map.route_cost(from, to, width, map.gaps(), IMPASSABLE_COST);
        assert!(way(past, from, physics.agents[helpee].width()) >= IMPASSABLE_COST, "{k}");
        let width = physics.agents[helpee.other()].width().max(2.0 * physics.object_radii[object.index()]);
        let detour = way(from, past, width) + way(past, to, width) - way(from, to, width);
        // There and back over 2 u.
        assert!(detour <= 4.01, "{k}: {detour}");
    }
}

/// Of two competitors the one with the shorter way to the object has at most 8 u to go, and is no stronger
/// than the other. A chaser has at most 14 u to go.
#[test]
fn competitors_and_chasers_meet_soon() {
    let mut layouts: Vec<Layout> = Layout::all_used().collect();
    for k in 0..12 {
        let mut random = stream(11, Purpose::Stage, k);
        layouts.rotate_left(7);
        let [compete, chase] = [Variant::Compete, Variant::Chase];
        let parts = parts(&[Variant::Move, compete, chase], k as usize);
        let stage = Stage::sample(&parts, &layouts, Starts::Near, &mut random).expect("a stage");
        let map = Map::new(stage.layout);
        let way = |scene: &Scene, agent: AgentId, to: Entity| {
            let state = scene.initial_state();
            let width = scene.physics().agents[agent].width();
            let [from, to] = [Entity::Agent(agent), to].map(|it| state.position(it));
            map.route_cost(from, to, width, map.gaps(), IMPASSABLE_COST)
        };
        let scene = stage.scene(parts[1], &mut random).expect("a scene");
        let ways = AgentId::ALL.map(|agent| way(&scene, agent, scene.agents[0].goal.subject()));
        let first = if ways[1] < ways[0] { AgentId::ONE } else { AgentId::ZERO };
        assert!(ways[first.index()] <= 8.0, "{k}: {ways:?}");
        assert!(scene.agents[first].strength <= scene.agents[first.other()].strength, "{k}");

        let scene = stage.scene(parts[2], &mut random).expect("a scene");
        let chases = |agent: &AgentId| scene.agents[*agent].goal.sign() == Sign::Positive;
        let chaser = AgentId::ALL.into_iter().find(chases).expect("one chases");
        assert!(way(&scene, chaser, Entity::Agent(chaser.other())) <= 14.0, "{k}");
    }
}

/// Otherwise the goals of a dataset would not be those of its composition, and would tell of the bodies'
/// places.
#[test]
fn nearly_every_part_has_its_own_goals() {
    let blocks = [
        [Variant::Fetch, Variant::Carry, Variant::Hide, Variant::Chase, Variant::Mixed],
        [Variant::Move, Variant::Carry, Variant::Undo, Variant::Compete, Variant::Places],
    ];
    let mut layouts: Vec<Layout> = Layout::all_used().collect();
    let mut own = 0;
    for k in 0..16 {
        layouts.rotate_left(11);
        let mut random = stream(7, Purpose::Stage, k as u64);
        let parts = parts(&blocks[k % 2], k);
        let stage = Stage::sample(&parts, &layouts, Starts::Near, &mut random).unwrap();
        for part in parts {
            let scene = stage.scene(part, &mut random).unwrap();
            let landmarks =
                |goals: [Goal; 2]| goals.map(|goal| goal.landmark()).into_iter().collect::<BTreeSet<_>>();
            own += usize::from(landmarks(scene.goals()) == landmarks(part.variant.goals(part.goal_index)));
        }
    }
    assert!(own >= 76, "{own} of 80");
}

#[test]
fn a_stage_that_cannot_be_is_an_error() {
    let open = [Layout::new(0, None).unwrap()];
    let mut random = stream(1, Purpose::Stage, 0);
    // Without a narrow door nobody is kept out by one.
    let refused =
        Stage::sample(&parts(&[Variant::HandOver, Variant::Carry], 0), &open, Starts::Near, &mut random);
    assert_eq!(refused, Err(SampleError(Variant::HandOver)));
    assert!(Stage::sample(&[], &open, Starts::Near, &mut random).is_err());
    assert!(Stage::sample(&parts(&[Variant::Places], 0), &[], Starts::Near, &mut random).is_err());
}
