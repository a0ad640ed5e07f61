//! Presets and the slots they consist of.

use phase_dataset::{
    labels::goal_counts,
    preset::{EventSlot, Preset, Selection},
    splits::Split,
};
use phase_model::{AGENT_COUNT, EventKind, Relation};
use phase_sampler::Variant;
use std::collections::{BTreeMap, BTreeSet};

const DEMO: &str = include_str!("../../../../data/presets/demo.json");
const PHASE_500: &str = include_str!("../../../../data/presets/phase-500.json");

fn slots(preset: &Preset, count: usize) -> Vec<EventSlot> {
    let composition = preset.composition();
    (0..count).map(|index| composition.slot(index)).collect()
}

#[test]
fn the_demo_has_two_of_each_kind() {
    let preset = Preset::parse("demo", DEMO).expect("a preset");
    assert_eq!((preset.name.as_str(), preset.events()), ("demo", 12));
    let slots = slots(&preset, 24);
    for kind in EventKind::ALL {
        let count = slots[..12].iter().filter(|slot| slot.variant.kind() == kind).count();
        assert_eq!(count, 2, "{kind:?}");
    }
    assert_eq!(preset.id(7), "demo-0007");
    assert_eq!(slots[12].variant, slots[0].variant);
    assert!(slots[12].goal_index > slots[0].goal_index, "goals go on by turns");
    assert_eq!(preset.pool("all").len(), 90);
    assert_eq!(preset.pool("none").len(), 0);
}

const fn relation(kind: EventKind) -> Relation {
    match kind {
        EventKind::Helping | EventKind::Collaborating => Relation::Friendly,
        EventKind::Hindering | EventKind::Chasing | EventKind::Competing => Relation::Adversarial,
        EventKind::Independent => Relation::Neutral,
    }
}

/// The paper's numbers (section "Dataset Statistics"), for the dataset and in proportion for one three times as
/// large.
#[test]
fn phase_500_has_the_papers_composition() {
    let preset = Preset::parse("phase-500", PHASE_500).expect("a preset");
    assert_eq!(preset.events(), 500);
    for times in [1, 3] {
        let slots = slots(&preset, 500 * times);
        let count = |holds: &dyn Fn(&EventSlot) -> bool| slots.iter().filter(|slot| holds(slot)).count();
        for (wanted, events) in
            [(Relation::Friendly, 200), (Relation::Adversarial, 192), (Relation::Neutral, 108)]
        {
            let found = count(&|slot: &EventSlot| relation(slot.variant.kind()) == wanted);
            assert_eq!(found, events * times, "{wanted:?}");
        }
        for (split, events) in [(Split::Train, 320), (Split::Validation, 80), (Split::Test, 100)] {
            assert_eq!(count(&|slot: &EventSlot| slot.split == Some(split)), events * times, "{split:?}");
        }
        assert_eq!(count(&|slot: &EventSlot| slot.layouts == "unseen"), 80 * times);
        let agents = slots.iter().flat_map(|slot| {
            let kind = slot.variant.kind();
            let alphas = match kind {
                EventKind::Helping => [1, 0],
                EventKind::Hindering => [-1, 0],
                _ => [0; AGENT_COUNT],
            };
            slot.variant.goals(slot.goal_index).into_iter().zip(alphas)
        });
        let goals = goal_counts(agents);
        assert_eq!(goals.len(), 16);
        for (goal, count) in goals {
            assert!((47 * times..=129 * times).contains(&count), "{goal}: {count} of {times} x 500");
        }
    }
}

#[test]
fn phase_500_keeps_layouts_and_one_type_for_the_test() {
    let preset = Preset::parse("phase-500", PHASE_500).expect("a preset");
    let slots = slots(&preset, 500);
    let bases = |name: &str| -> BTreeSet<u8> { preset.pool(name).iter().map(|it| it.base()).collect() };
    assert!(bases("seen").is_disjoint(&bases("unseen")));
    assert_eq!(preset.pool("seen").len() + preset.pool("unseen").len(), 90);
    for slot in &slots {
        assert!(slot.layouts == "seen" || slot.split == Some(Split::Test), "{slot:?}");
    }
    let tested = |slot: &&EventSlot| slot.split == Some(Split::Test);
    let learnt: BTreeSet<Variant> = slots.iter().filter(|it| !tested(it)).map(|it| it.variant).collect();
    let only: Vec<Variant> =
        slots.iter().filter(tested).map(|it| it.variant).filter(|it| !learnt.contains(it)).collect();
    assert_eq!(only, [Variant::Evade; 9]);
}

/// A run that stops early still has events of every kind.
#[test]
fn groups_are_spread_evenly() {
    let preset = Preset::parse("phase-500", PHASE_500).expect("a preset");
    for part in [50, 100, 250] {
        let mut counts: BTreeMap<Split, usize> = BTreeMap::new();
        for slot in slots(&preset, part) {
            *counts.entry(slot.split.expect("a split")).or_default() += 1;
        }
        assert!(counts[&Split::Train].abs_diff(part * 16 / 25) <= part / 10, "{part}: {counts:?}");
    }
    let turns = |variant: Variant| -> Vec<usize> {
        slots(&preset, 1500).into_iter().filter(|it| it.variant == variant).map(|it| it.goal_index).collect()
    };
    for variant in [Variant::Lift, Variant::Evade] {
        let turns = turns(variant);
        assert_eq!(turns, (0..turns.len()).collect::<Vec<_>>(), "{variant:?}");
    }
}

/// Every length is as likely as any other, and only for those whose events would not end by themselves.
#[test]
fn ends_are_drawn_for_those_at_odds() {
    let selection = Preset::parse("phase-500", PHASE_500).expect("a preset").selection.expect("selects");
    let mut ends = [0; 101];
    for seed in 0..6100 {
        assert_eq!(selection.sampled_end(Relation::Friendly, seed), None);
        assert_eq!(selection.sampled_end(Relation::Neutral, seed), None);
        ends[selection.sampled_end(Relation::Adversarial, seed).expect("is drawn")] += 1;
    }
    assert!(ends[..40].iter().all(|&count| count == 0));
    // A hundred each, give or take five standard deviations.
    assert!(ends[40..].iter().all(|count| (50..=150).contains(count)), "{ends:?}");
    let undrawn = Selection { draw_ends: false, ..selection };
    assert_eq!(undrawn.sampled_end(Relation::Adversarial, 1), None);
}

#[test]
fn what_is_no_preset_is_refused() {
    let nothing = DEMO.split("\"groups\"").next().unwrap_or_default().to_owned() + "\"groups\": []}";
    let cases = [
        ("{}", "missing field"),
        ("", "EOF"),
        (&DEMO.replace("phase-preset/2", "phase-preset/9"), "format"),
        (&DEMO.replace("\"events\": 1", "\"events\": 0"), "events"),
        (&nothing, "groups"),
        (&DEMO.replace("\"lift\"", "\"dance\""), "dance"),
        (&DEMO.replace("\"seed\"", "\"sead\""), "sead"),
        (&DEMO.replace("{\"all\"", "{\"most\""), "all"),
        (&DEMO.replace("[0, 2", "[1, 2"), "base 1"),
        (&DEMO.replace("\"demo\"", "\"../demo\""), "name"),
        (&PHASE_500.replace("400,", "0,"), "attempt"),
        (&PHASE_500.replace("\"max_steps\": 100", "\"max_steps\": 10"), "min_steps"),
        (&PHASE_500.replace("\"validation\"", "\"holdout\""), "holdout"),
    ];
    for (text, part) in cases {
        let sentence = Preset::parse("demo", text).expect_err(part).to_string();
        assert!(sentence.starts_with("demo: ") && sentence.contains(part), "{sentence}");
    }
}
