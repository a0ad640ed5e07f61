//! Stages that several variants share.

use phase_model::{
    Layout, Relation,
    random::{Purpose, stream},
};
use phase_sampler::{Part, SampleError, Stage, Variant};
use std::collections::BTreeSet;

fn parts(variants: &[Variant], goal_index: usize) -> Vec<Part> {
    variants.iter().map(|&variant| Part { variant, goal_index }).collect()
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
        let stage = Stage::sample(&parts, &layouts, &mut random).unwrap();
        let mut relations = BTreeSet::new();
        for &part in &parts {
            let scene = stage.cast(part, &mut random).unwrap();
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

#[test]
fn a_stage_that_cannot_be_is_an_error() {
    let open = [Layout::new(0, None).unwrap()];
    let mut random = stream(1, Purpose::Stage, 0);
    // Without a narrow door nobody is kept out by one.
    let refused = Stage::sample(&parts(&[Variant::HandOver, Variant::Carry], 0), &open, &mut random);
    assert_eq!(refused, Err(SampleError(Variant::HandOver)));
    assert!(Stage::sample(&[], &open, &mut random).is_err());
    assert!(Stage::sample(&parts(&[Variant::Places], 0), &[], &mut random).is_err());
}
